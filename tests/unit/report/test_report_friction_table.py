"""The figure of a table of friction: there where friction is one, with a line for each row."""

import pytest
from stickslip import simulate

from cosim.report import trajectory_columns
from cosim.report.figures import TABLE, plates_of
from cosim.scenario import Scenario

OVER_SPEED = {"table_speed": (0.0, 0.2), "table_mu": (0.2, 0.1)}
OVER_BOTH = {
    "table_speed": (0.0, 0.2),
    "table_temperature_degC": (-10.0, -5.0, -1.0),
    "table_mu": (0.25, 0.2, 0.2, 0.1, 0.1, 0.05),
}


@pytest.mark.parametrize(("friction", "rows"), [({}, 0), (OVER_SPEED, 1), (OVER_BOTH, 3)])
def test_there_is_a_line_for_each_temperature(friction, rows):
    scenario = Scenario(friction=friction, initial={"vx": 0.15}, run={"duration": 1.0})
    trajectory = simulate(scenario.mechanics, 1.0, interpreted=True)
    dataset = trajectory_columns(
        trajectory, scenario, scenario.to_toml(), wall_time=0.1
    ).to_xarray()
    assert (TABLE in plates_of(dataset)) == bool(rows)
    if rows:
        (ax,) = TABLE.drawn(dataset).axes
        marked = [line for line in ax.lines if line.get_marker() == "o"]
        assert len(marked) == rows and all(line.get_xdata().size == 2 for line in marked)

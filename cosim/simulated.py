"""The mechanics of a scenario alone, as `stickslip simulate` has them, as a result."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from stickslip import Trajectory, simulate

from cosim.scenario import Scenario, check_work, read_scenario

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure


@dataclass(frozen=True, repr=False)
class SimulatedRun:
    """What was simulated and what came out.

    trajectory: the motion, sampled every `run.output_interval`, and its events.
    """

    scenario: Scenario
    trajectory: Trajectory

    def __repr__(self) -> str:
        return f"<SimulatedRun of {self.scenario.name}: {self.trajectory!r}>"

    def to_xarray(self) -> xarray.Dataset:
        """The dataset that `stickslip simulate` writes as ``result.nc``: all outputs over ``time``
        (n,) and events over ``event_time`` (k,), with units and long names; the scenario."""
        from cosim.report import trajectory_dataset  # pandas: only for who asks for it

        return trajectory_dataset(self.trajectory, self.scenario, self.scenario.to_toml())

    def plot(self, figure: str = "motion") -> Figure:
        """One of the figures of the run's page; which there are, the refusal of another name says.

        Raises ValueError for a name that is none.
        """
        from cosim.report.figures import figure_of

        return figure_of(self.to_xarray(), figure)


def simulate_scenario(scenario: Scenario | str | Path = "reference") -> SimulatedRun:
    """Simulate a scenario, the name of a packaged one, or a TOML file: no FMU, no heat conduction.

    Raises ScenarioError (a ValueError of one line) for input that cannot be.

    >>> from cosim import read_scenario
    >>> simulate_scenario(read_scenario("reference").changed({"run.duration": 2.0}))
    <SimulatedRun of reference: <Trajectory of 2 s, 201 rows: ...>>
    """
    if not isinstance(scenario, Scenario):
        scenario = read_scenario(scenario)
    check_work(scenario, coupled=False)
    trajectory = simulate(
        scenario.mechanics,
        scenario.run.duration,
        scenario.run.output_interval,
        interface_temperature=scenario.ambient.temperature_degC,
    )
    return SimulatedRun(scenario, trajectory)

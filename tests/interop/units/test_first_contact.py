"""The units as they come, nothing set: a rig that can be, and a word where it is none any more."""

import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy_slave import fmpy_slave

from cosim.fmu.variables import variables
from cosim.scenario.defaults import stated

STOP = 30.0  # s, as the units advise
#: A block that is pushed off its belt within the first second.
PUSHED = {"external_force_y": 4.0}


def bare(fmu, **options):
    """A whole run with nothing set."""
    names = ["x", "y", "slip_count", "heat", "off_belt", "spring_overstretched"]
    return simulate_fmu(str(fmu), output=names, output_interval=0.01, **options)


def test_a_unit_starts_as_a_scenario_that_leaves_all_out():
    starts = {each.name: each.start for each in variables()}
    assert {key: starts[key] for key in stated()} == stated()


def test_a_host_that_sets_nothing_has_one_motion_however_it_runs_the_unit(fmu, fmu3, python_fmu):
    """Slips and x of co-simulation and model exchange, FMI 2 and 3, over the default experiment."""
    runs = [bare(fmu), bare(fmu3), bare(python_fmu)]
    loose = [bare(each, fmi_type="ModelExchange") for each in (fmu, fmu3)]
    tight = bare(fmu, fmi_type="ModelExchange", relative_tolerance=1e-9)
    first = runs[0]
    assert first["time"][-1] == STOP and first["slip_count"][-1] > 40
    assert np.abs(first["y"]).max() < 1e-12
    for other, allowed in [(each, 1e-12) for each in runs] + [(each, 1e-4) for each in loose]:
        assert other["slip_count"][-1] == first["slip_count"][-1]
        assert other["x"][-1] == pytest.approx(first["x"][-1], abs=allowed)
        assert not other["off_belt"].any() and not other["spring_overstretched"].any()
    x = np.interp(first["time"], tight["time"], tight["x"])
    np.testing.assert_allclose(x, first["x"], rtol=0, atol=1e-6)


@pytest.mark.parametrize(("values", "name"), [
    (PUSHED, "off_belt"),
    ({"springs.longest": 1.2, **PUSHED, "belt.width": 0.0}, "spring_overstretched"),
])  # fmt: skip
def test_what_no_rig_bears_is_shown_and_logged_once(unit, values, name, tmp_path):
    with fmpy_slave(unit, tmp_path) as block:
        block.begin(**values)
        seen = []
        for n in range(150):
            block.march(n, 1, 0.01)
            seen.append(bool(block.get(name)))
        said = [each for each in block.log.messages if each.status == "warning"]
        assert seen[-1] and not seen[0] and block.get("y") > 0.0375
    assert len(said) == 1 and said[0].text.startswith(f"{name}: ")


def test_in_model_exchange_it_changes_at_an_event(fmu):
    """So that a host may take it for what FMI calls discrete; late by a step of the integrator."""
    result = bare(fmu, fmi_type="ModelExchange", stop_time=2.0, start_values=PUSHED)
    at = int(np.flatnonzero(np.diff(result["off_belt"]))[0])
    assert result["time"][at] == result["time"][at + 1]
    assert 0.0375 < result["y"][at] < 0.0375 + 0.01

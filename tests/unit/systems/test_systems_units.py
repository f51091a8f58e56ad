"""What a system's file says of a unit: steps of its own, elements of arrays."""

import numpy as np
import pytest
from c_units import made
from lag_unit import RAMP, lag_unit

from cosim.systems import SystemFault, read_system, run_system


@pytest.fixture
def lag(tmp_path):
    """What the second unit comes to, by lines of its table."""
    lag_unit(tmp_path / "lag.fmu")

    def values(extra):
        path = tmp_path / "ramp.toml"
        path.write_text(RAMP.format(more=extra))
        with read_system(path) as specification:
            result = run_system(specification).result
        assert result.status == "complete", result.reason
        return result["lag.y"], result.time

    return values


def test_substeps_follow_the_waveform_more_closely(lag):
    """The unit holds the mean over each part, which is of second order in its length."""

    def error(extra):
        found, time = lag(extra)
        return np.abs(found - (3.0 * time - 1.5 * (1.0 - np.exp(-2.0 * time)))).max()

    one, ten = error(""), error("substeps = 10")
    assert one > 1e-4
    # a hundredth; the whole step of 0.1 is of a rate of 2, and terms of higher order make 2 %
    assert one / ten == pytest.approx(100.0, rel=0.05)


@pytest.mark.parametrize("value", ["0", "2.5", "true", '"ten"', "1e9", "2000000"])
def test_substeps_that_cannot_be_are_refused(lag, value):
    with pytest.raises(SystemFault, match=r"ramp.toml: units.lag.substeps: "):
        lag(f"substeps = {value}")


ARRAYS = """
coupling.macro_step = 0.5
run.stop = 1.0
[units.unit]
file = "events.fmu"
parameters = { "p[1,2]" = 7.0 }
inputs = { "u[2]" = 10.0 }
"""


@pytest.mark.parametrize("isolate", ["", "isolate = true"])
def test_elements_of_arrays_are_set_by_name(tmp_path, isolate):
    """y = p u with p = [[1, 7], [3, 4]] and u = [0, 10]."""
    made("events", tmp_path)
    (tmp_path / "arrays.toml").write_text(
        ARRAYS.replace("[units.unit]", f"[units.unit]\n{isolate}")
    )
    with read_system(tmp_path / "arrays.toml") as specification:
        result = run_system(specification).result
    assert (result["unit.y[1]"][0], result["unit.y[2]"][0]) == (70.0, 40.0)

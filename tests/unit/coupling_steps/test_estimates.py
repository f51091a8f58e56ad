"""What a step's error is estimated at, against what the scheme has made of it."""

import numpy as np
import pytest
from linear_participant import Linear

from cosim import coupling
from cosim.coupling import CoupledSystem, Tolerance, run


def heater(unit):
    """Gives off 3 of its unit a second, as what there was since the start."""
    return Linear("heater", [[0.0]], [[3.0]], [[1.0]], ins={"on": "1"}, outs={"heat": unit}, x=[0])


def stove(unit):
    """Takes up what it is handed."""
    return Linear(
        "stove", [[-1.0]], [[0.0]], [[0.0]], [[1.0]],
        ins={"heat": unit}, outs={"taken": unit}, x=[0.0],
    )  # fmt: skip


def heated(unit):
    source = heater(unit)
    source.u = [coupling.Waveform((1.0,), 0.0)]
    link = coupling.Connection("heater.heat", "stove.heat", taken="taken" if unit == "J" else None)
    return CoupledSystem([source, stove(unit)], [link])


def steps_of(unit, allowed):
    """Sizes (s) of the steps that a control by the defect takes, of so much of it a step."""
    control = coupling.AdaptiveStep(
        coupling.Defect(Tolerance(1e-12, {"heater.heat": allowed})), 1e-3, 1e-6, 10.0
    )
    scheme = coupling.Jacobi(("heater", "stove"), "linear")
    return np.diff(run(heated(unit), scheme, stop=2.0, control=control).time)


def test_joules_are_held_by_the_estimate_as_they_are_by_the_scheme():
    """Linear schemes hold a total of joules: a step of h is off by all that it hands over, 3 h.

    Of a length that grows as evenly they extrapolate, and are off by rounding.
    """
    assert steps_of("J", allowed=0.3).max() <= 0.1 * (1.0 + 1e-9)
    # the control settles where its proportional and integral parts hold each other, at 0.59
    assert steps_of("J", allowed=0.3).max() == pytest.approx(0.059, rel=0.05)
    assert steps_of("m", allowed=0.3).max() > 0.5


@pytest.mark.parametrize(
    ("unit", "waveform", "more"), [("m", "linear", 1), ("m", "held", 10), ("J", "linear", 10)]
)
def test_an_iteration_sets_out_from_what_the_waveform_extrapolates(unit, waveform, more):
    """A length that grows evenly is guessed from the second step on; joules, and what is held, are
    guessed as they were, and each of ten steps is made once more."""
    scheme = coupling.Iterated(("stove", "heater"), waveform, acceleration=coupling.Relaxation())
    result = run(heated(unit), scheme, stop=1.0, macro_step=0.1)
    assert result.status == "complete", result.reason
    assert result.statistics.iterations == result.steps + more == 10 + more

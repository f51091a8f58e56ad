"""The bell-shaped friction of a rubber belt: the formula, over the disc, and its candidates."""

from math import exp, log10

import numpy as np
import pytest
from stickslip import EFFECTS, Parameters, friction_coefficient
from stickslip.effects.candidate import Scales

MU = 0.2
BELL = {"height": 0.8, "peak_speed": 0.1, "narrowness": 0.7}
RIG = Parameters(friction={"mu_k": MU}, lateral_friction={"ratio": 1.0}, viscoelastic_peak=BELL)


def law(speed: float) -> float:
    away = BELL["narrowness"] * log10(max(speed, 1e-300) / BELL["peak_speed"])
    return MU * (1.0 + BELL["height"] * exp(-(away**2)))


def test_the_formula_and_its_landmarks():
    """The peak, 1/e of it a width away on either side, and nothing left far away."""
    width = 10.0 ** (1.0 / BELL["narrowness"])
    speeds = np.array([1e-9, 0.1 / width, 0.05, 0.1, 0.1 * width, 1e7])
    found = friction_coefficient(RIG, speeds)
    assert found == pytest.approx([law(v) for v in speeds], rel=1e-13)
    assert found[3] == pytest.approx(1.8 * MU, rel=1e-13)
    assert found[[1, 4]] == pytest.approx(MU * (1.0 + 0.8 / np.e), rel=1e-13)
    assert found[[0, 5]] == pytest.approx(MU, rel=1e-12)


def test_the_catalogue_does_not_offer_it():
    """Unasked `gap` does not try it, so that no campaign's answer changes by its being there."""
    (effect,) = (each for each in EFFECTS if each.id == "viscoelastic_peak")
    assert not effect.offered
    table = Parameters().viscoelastic_peak
    tried = list(effect.candidates(Scales(0.15, 1.0, 1.0, 10.0, 20.0, 0.02, 0.67, 6.57)))
    for candidate in tried:
        for free in candidate.free_parameters:
            assert free.low < free.start < free.high
            assert hasattr(table, free.key.removeprefix("viscoelastic_peak."))
    assert len(tried) == 2

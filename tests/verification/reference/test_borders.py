"""At which numbers of a rig its motion becomes another: by closed forms, and of the reference."""

import math
from pathlib import Path

import pytest
from line_rig import published
from stickslip.reference.coulomb_oscillator import BeltStart, CoulombOscillator
from stickslip.steady_motion import Interface
from stickslip.steady_motion.borders import (
    DAMPING,
    RAMP,
    RATIO,
    SPEED,
    all_borders,
    nearest_borders,
    numbers_of,
)
from stickslip.steady_motion.live import OutOfWork, Work
from stickslip.steady_motion.regimes import SLIDING, STICK_SLIP
from stickslip.steady_motion.starts import RAMP as FROM_RAMP
from stickslip.steady_motion.starts import REST, RIDING, other_starts

from cosim import read_scenario

REFERENCE = read_scenario("reference").mechanics
MU_S, MU_K, LOAD, STIFFNESS = 0.2815, 0.2086, 0.67 * 9.81, 4.0 * 20.17


def closed_form(damping, sticks):
    """The speed above which the Coulomb oscillator does not stick, bisected, m/s."""
    low, high = 0.1, 0.6
    while high - low > 1e-7:
        speed = 0.5 * (low + high)
        oscillator = CoulombOscillator(0.67, STIFFNESS, speed, MU_S * LOAD, MU_K * LOAD)
        if sticks(BeltStart(oscillator, damping, 10.0)):
            low = speed
        else:
            high = speed
    return low


@pytest.mark.parametrize(("start", "damping", "sticks"), [
    (REST, 0.0, BeltStart.sticks_from_rest),
    (REST, 0.07, BeltStart.sticks_from_rest),
    (RIDING, 0.07, BeltStart.sticks_riding),
    (FROM_RAMP, 0.07, BeltStart.sticks_after_run_up),
])  # fmt: skip
def test_the_fastest_stick_slip_is_that_of_the_closed_form(start, damping, sticks):
    """Bisected to 1e-4; a last stick within half the run at constant speed is one."""
    parameters = other_starts(published(damping=damping))[start]
    found = all_borders(
        parameters, numbers_of(parameters)[0], 20.0 + parameters.surface.run_up_time
    )
    stops = [border for border in found if border.below == (STICK_SLIP, False)]
    assert len(stops) == 1 and stops[0].above == (SLIDING, False)
    assert stops[0].value == pytest.approx(closed_form(damping, sticks), rel=2e-4)
    if start == REST and damping == 0.0:
        assert stops[0].value == pytest.approx(MU_K * 9.81 / math.sqrt(STIFFNESS / 0.67), rel=2e-4)


def test_the_reference_is_near_its_borders():
    """In speed, ramp, damping and mu_s/mu_k: beyond, the block slides."""
    found = {border.number.key: border for border in nearest_borders(REFERENCE)}
    values = {key: border.value for key, border in found.items()}
    assert values == {
        SPEED: pytest.approx(0.157, rel=0.01),
        RAMP: pytest.approx(8.25, rel=0.01),
        DAMPING: pytest.approx(0.0938, rel=0.01),
        RATIO: pytest.approx(1.334, abs=0.005),
    }
    assert list(found) == [RATIO, SPEED, RAMP, DAMPING]
    assert {border.beyond for border in found.values()} == {(SLIDING, False)}
    readme, guide = (
        " ".join((Path(__file__).parents[3] / file).read_text(encoding="utf-8").split())
        for file in ("README.md", "tests/docs/site/guide/motion.md")
    )
    assert f"Above {values[SPEED]:.3f} m/s it slides steadily" in readme
    assert f"slides at {values[SPEED]:.3f} m/s (0.15 given)" in guide
    assert f"after a ramp of {values[RAMP]:.1f} s (10)" in guide
    assert f"damp {values[DAMPING]:.3f} N s/m (0.07)" in guide
    assert f"with μ_s/μ_k below {values[RATIO]:.2f} (1.35)" in guide


def test_no_more_steps_are_taken_than_are_allowed():
    with pytest.raises(OutOfWork):
        nearest_borders(REFERENCE, interface=Interface(work=Work(1e4, 45.0)))

"""Which regime a run comes to, and which exist beside it: closed form against simulation."""

import math

import numpy as np
import pytest
from stickslip import Friction, LateralFriction, Parameters, Rig, StructuralDamping, Surface
from stickslip.reference.coulomb_oscillator import CoulombOscillator
from stickslip.reference.coulomb_starts import BeltStart
from stickslip.steady_motion.regimes import (
    CREEPING,
    DISTURBED,
    OWN,
    RAMP,
    REST,
    RIDING,
    SLIDING,
    STARTS,
    STICK_SLIP,
    STICKING,
    coexisting,
    regimes,
)

MU_K, LOAD, STIFFNESS = 0.2086, 0.67 * 9.81, 4.0 * 20.17


def rig(speed, mu_s=0.2815, damping=0.0, **blocks):
    """The published rig, pretensioned, so that it keeps to its line."""
    return Parameters(
        **{
            "rig": Rig(spring_natural_length=0.17),
            "lateral_friction": LateralFriction(ratio=1.0),
            "friction": Friction(mu_s=mu_s, mu_k=MU_K),
            "surface": Surface(speed=speed, run_up_time=10.0),
            "structural_damping": StructuralDamping(coefficient=damping),
        }
        | blocks
    )


def closed_form(speed, mu_s, damping, run_up=10.0):
    oscillator = CoulombOscillator(0.67, STIFFNESS, speed, mu_s * LOAD, MU_K * LOAD)
    start = BeltStart(oscillator, damping, run_up)
    sticks = {
        REST: start.sticks_from_rest(),
        RIDING: start.sticks_riding(),
        RAMP: start.sticks_after_run_up(),
    }
    return {name: STICK_SLIP if does else SLIDING for name, does in sticks.items()}


@pytest.mark.slow
def test_no_cell_of_twenty_by_twenty_is_wrong():
    """Undamped; speeds up to four times, ratios of mu_s to mu_k up to twice."""
    wrong, seen = [], set()
    for speed in np.linspace(0.03, 0.6, 20):
        for ratio in np.linspace(1.02, 2.0, 20):
            found = regimes(rig(speed, ratio * MU_K))
            for start, name in closed_form(speed, ratio * MU_K, 0.0).items():
                seen.add((start, name))
                if found[start].name != name:
                    wrong.append((speed, ratio, start, found[start].name))
    assert not wrong
    assert len(seen) == 5  # all but riding, which always sticks again


@pytest.mark.parametrize("damping", [0.07, 0.5])
def test_nor_is_one_with_damping(damping):
    for speed in np.linspace(0.04, 0.6, 6):
        for ratio in np.linspace(1.05, 1.9, 6):
            found = regimes(rig(speed, ratio * MU_K, damping))
            expected = closed_form(speed, ratio * MU_K, damping)
            assert {start: found[start].name for start in expected} == expected


def test_from_rest_it_sticks_up_to_the_speed_of_the_swing():
    """v = F_k / (m omega), the first velocity peak of a free vibration about F_k/K."""
    border = MU_K * 9.81 / math.sqrt(STIFFNESS / 0.67)
    start = BeltStart(CoulombOscillator(0.67, STIFFNESS, 0.15, 0.2815 * LOAD, MU_K * LOAD))
    assert start.fastest_from_rest == pytest.approx(border, rel=1e-12)
    below, above = (regimes(rig(factor * border))[REST].name for factor in (0.999, 1.001))
    assert (below, above) == (STICK_SLIP, SLIDING)


def test_at_a_fifth_of_a_metre_a_second_two_regimes_exist():
    found = regimes(rig(0.2))
    assert list(found) == list(STARTS)
    assert {start: regime.name for start, regime in found.items()} == {
        OWN: SLIDING,
        DISTURBED: SLIDING,
        REST: SLIDING,
        RIDING: STICK_SLIP,
        RAMP: SLIDING,
    }
    assert list(coexisting(found)) == [RIDING]
    assert found[RIDING].frequency > 1.0 and found[OWN].frequency == 0.0
    # a free vibration about F_k/K from rest has that amplitude
    assert found[REST].half_range_x == pytest.approx(MU_K * LOAD / STIFFNESS, rel=1e-2)
    assert found[REST].mean_x == pytest.approx(MU_K * LOAD / STIFFNESS, rel=5e-2)


def test_at_the_speed_of_the_reference_there_is_one():
    assert not coexisting(regimes(rig(0.15)))


def test_a_stick_that_creeps_as_fast_as_the_surface_is_refused_or_said():
    with pytest.raises(ValueError, match=r"friction.stick_creep = 0.2 m/s is not below surface"):
        Parameters(friction=Friction(stick_creep=0.2), surface=Surface(speed=0.15))
    Parameters(friction=Friction(stick_creep=0.2), surface=Surface(speed=0.0))
    # what grows stronger by its age can creep for ever below the refused speed
    strong = {"static_strengthening": {"saturating": 1.0, "saturation_time": 0.1}}
    slow = rig(0.02, friction=Friction(mu_s=0.2815, mu_k=MU_K, stick_creep=0.015), **strong)
    assert regimes(slow)[OWN].name == CREEPING
    assert regimes(rig(0.02, surface=Surface(speed=0.0)))[OWN].name == STICKING


@pytest.mark.parametrize(("damping", "run_up"), [(-0.1, 0.0), (20.0, 0.0), (0.0, -1.0)])
def test_what_cannot_be_is_refused(damping, run_up):
    oscillator = CoulombOscillator(0.67, STIFFNESS, 0.15, 0.2815 * LOAD, MU_K * LOAD)
    with pytest.raises(ValueError, match="damping|run_up"):
        BeltStart(oscillator, damping, run_up)

"""What the drift does to friction and to the stick-slip motion.

Kinetic friction that falls linearly with the interface temperature, to nothing at the melting
point, as measured on rock; or with a sensitivity that is given. Less friction makes less heat, so
belt and ice are followed once more with the friction that their temperature leaves. Quasi-steady:
a run of the mechanics with the friction at the end beside one with that of the start. The
temperature varies over a stick-slip cycle by far less than over the run; coupled runs agree.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

from stickslip import Friction, Initial, Parameters, Rig, Springs, Surface, simulate

from thermal.materials import MELTING_POINT_DEGC

from .case import Case

#: Length of the mechanical runs, s.
_DURATION = 40.0


@dataclass(frozen=True)
class FrictionEffect:
    """What the drift of the runs does, and what that does to the drift.

    mu_change: of mu_k, relative; drift, interface: rises with the friction that is left, K.
    frequency: of stick-slip at the start, Hz, and its relative change; None where the block does
    not stick and slip.
    """

    mu_change: float
    drift: float
    interface: float
    frequency: float | None
    frequency_change: float | None


def linear_sensitivity(ambient_degC: float) -> float:
    """Part of mu_k lost per kelvin when nothing is left at the melting point, 1/K."""
    return 1.0 / (MELTING_POINT_DEGC - ambient_degC)


@lru_cache(maxsize=4096)
def stick_slip_frequency(
    speed: float, mass: float, stiffness: float, mu_s: float, mu_k: float
) -> float | None:
    """Break-aways per second along x on a belt, Hz; None where there are none."""
    run = simulate(
        mechanics(speed, mass, stiffness, mu_s, mu_k), duration=_DURATION, output_interval=1.0
    )
    starts = run.slip_starts
    if len(starts) < 3:
        return None
    return float((len(starts) - 1) / (starts[-1] - starts[0]))


def mechanics(speed: float, mass: float, stiffness: float, mu_s: float, mu_k: float) -> Parameters:
    """The rig along x; the block moves with the belt at the start."""
    return Parameters(
        rig=Rig(mass=mass, degrees_of_freedom=("x",)),
        springs=Springs(stiffness=stiffness),
        friction=Friction(mu_s=mu_s, mu_k=mu_k),
        surface=Surface(speed=speed),
        initial=Initial(vx=speed),
    )


def friction_effect(case: Case, sensitivity: float | None = None) -> FrictionEffect:
    """Of the interface's rise over the runs; sensitivity: 1/K, linear to melting when left out."""
    lost = sensitivity if sensitivity is not None else linear_sensitivity(case.ambient_degC)
    _, warm_belt = case.follow(case.sliding(lost))
    mu_change = -min(1.0, lost * warm_belt.mean_interface)
    mu_s = case.static_over_kinetic * case.friction
    rig = case.speed, case.mass, case.stiffness, mu_s
    cold = stick_slip_frequency(*rig, case.friction)
    warm = stick_slip_frequency(*rig, round(case.friction * (1.0 + mu_change), 12))
    change = warm / cold - 1.0 if cold and warm else None
    return FrictionEffect(mu_change, warm_belt.entry, warm_belt.mean_interface, cold, change)

"""What would help, and what the drift does: each change of a case alone, friction that warms.

Kinetic friction that falls linearly with the interface temperature, to nothing at the melting
point, as measured on rock; or with a sensitivity that is given. Less friction makes less heat, so
belt and ice are followed once more with the friction that their temperature leaves. Quasi-steady:
a run of the mechanics with the friction at the end beside one with that of the start. The
temperature varies over a stick-slip cycle by far less than over the run; coupled runs agree.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache

from stickslip import Friction, Initial, Parameters, Rig, Springs, Surface, simulate
from stickslip.trajectory import break_away_frequency

from thermal.materials import MELTING_POINT_DEGC

from .case import Case
from .drift import endless_belt, followed

#: What the changes take: K, W/m2K, 1, and a roller's good contact, W/m2K, over 0.1 m of belt.
COLDER_AIR, COLDER_SAMPLE, WARMER_SAMPLE, GOOD_ROLLER, ROLLER_ARC = 8.0, 1.0, 0.3, 1000.0, 0.1
#: What they are called that are no part of the doubt.
COLDER_START = f"sample {COLDER_SAMPLE:g} K colder than the air at the start"
WARMER_START = f"sample {WARMER_SAMPLE:g} K warmer than the air at the start"
#: No help: a belt that nobody has room for, and a start that hides a rise behind its own.
ENDLESS = "belt that never comes round"
NO_HELP = (ENDLESS, COLDER_START, WARMER_START)
#: PTFE on cloth; half of the heat enters the belt.
RAILING_FRICTION = 0.1


@dataclass(frozen=True)
class Change:
    """Rises with one change, K: of the belt at entry, of the interface in the run at constant speed
    and over the air at its end."""

    what: str
    run: float
    interface_drift: float
    interface_run: float


def changes(case: Case) -> list[Change]:
    """As the case is, then each change alone; what has no room on the rig is left out."""
    return [Change(what, *followed(changed)[0]) for what, changed in _changed(case)]


def _changed(case: Case) -> Iterator[tuple[str, Case]]:
    protocol, contact, belt = case.protocol, case.rig.contact, case.rig.belt
    yield "as it is", case
    yield "belt twice as long", case.with_length(2.0 * case.length)
    yield ENDLESS, endless_belt(case)
    yield f"air {COLDER_AIR:g} K colder", replace(case, ambient_degC=case.ambient_degC - COLDER_AIR)
    yield "run half as long", replace(case, protocol=replace(protocol, run=0.5 * protocol.run))
    if protocol.ramp > 0.0:
        yield "no ramp", replace(case, protocol=replace(protocol, ramp=0.0))
    yield "half the mass", replace(case, mass=0.5 * case.mass)
    if not case.rig.ice.mesh:
        yield "sample twice as high", case.changed({"ice.height": 2.0 * case.rig.ice.height})
        if 3.0 * contact.radius < case.length:
            wide = {
                f"contact.{name}": 1.5 * getattr(contact, name) for name in ("radius", "length")
            }
            yield "sample of 1.5 times the diameter, same mass", case.changed(wide)
    yield COLDER_START, replace(case, ice_rise=-COLDER_SAMPLE)
    yield WARMER_START, replace(case, ice_rise=WARMER_SAMPLE)
    yield "twice the heat transfer to the air", replace(case, h=2.0 * case.film)
    if case.frost is not None:
        yield "belt frosted all over", replace(case, h=case.film + case.frost.added)
    if belt.rollers == 0 and belt.railing_length + 2.0 * ROLLER_ARC < 0.5 * case.length:
        rollers = {"belt.rollers": 2, "belt.roller_arc": ROLLER_ARC}
        good = rollers | {"belt.roller_conductance": GOOD_ROLLER}
        warm = rollers | {"belt.roller_conductance": 100.0, "belt.roller_rise": 1.0}
        what = f"two rollers that touch {ROLLER_ARC:g} m with {GOOD_ROLLER:g} W/m2K"
        yield what, case.changed(good)
        yield "two rollers at 100 W/m2K, 1 K warmer than the air", case.changed(warm)
    if belt.railing_friction == 0.0:
        railing = {
            "belt.railing_friction": RAILING_FRICTION,
            "belt.railing_share": 0.5,
            "belt.railing_length": belt.railing_length or 2.0 * contact.radius,
            "belt.railing_conductance": belt.railing_conductance or case.film,
        }
        what = f"friction {RAILING_FRICTION:g} on the railing, half of its heat to the belt"
        yield what, case.changed(railing)


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


def linear_sensitivity(ambient_degC: float, melting_degC: float = MELTING_POINT_DEGC) -> float:
    """Part of mu_k lost per kelvin when nothing is left at the melting point, 1/K.

    0 for what does not melt, whose melting point is infinite.
    """
    return 1.0 / (melting_degC - ambient_degC)


@lru_cache(maxsize=4096)
def stick_slip_frequency(
    speed: float, mass: float, stiffness: float, mu_s: float, mu_k: float
) -> float | None:
    """Of the break-aways along x on a belt, Hz; None where there are fewer than three.

    The block moves with the belt at the start.
    """
    rig = Parameters(
        rig=Rig(mass=mass, degrees_of_freedom=("x",)),
        springs=Springs(stiffness=stiffness),
        friction=Friction(mu_s=mu_s, mu_k=mu_k),
        surface=Surface(speed=speed),
        initial=Initial(vx=speed),
    )
    starts = simulate(rig, duration=_DURATION, output_interval=1.0).slip_starts
    return None if len(starts) < 3 else break_away_frequency(starts)


def friction_effect(case: Case, sensitivity: float | None = None) -> FrictionEffect:
    """Of the interface's rise over the runs; sensitivity: 1/K, linear to melting when left out."""
    linear = linear_sensitivity(case.ambient_degC, case.rig.ice.melting_point_degC)
    lost = linear if sensitivity is None else sensitivity
    _, warm_belt = case.follow(case.sliding(lost))
    mu_change = -min(1.0, lost * warm_belt.mean_interface)
    mu_s = case.static_over_kinetic * case.friction
    rig = case.speed, case.mass, case.stiffness, mu_s
    cold = stick_slip_frequency(*rig, case.friction)
    warm = stick_slip_frequency(*rig, round(case.friction * (1.0 + mu_change), 12))
    change = warm / cold - 1.0 if cold and warm else None
    return FrictionEffect(mu_change, warm_belt.entry, warm_belt.mean_interface, cold, change)

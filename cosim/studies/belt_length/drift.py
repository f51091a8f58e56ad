"""What a case comes to: rises of belt and ice after the runs and for ever, by four models.

How long to wait between two runs: the least pause after which the next one is as the first. What
would help: each change of a case alone. And what the drift does, by friction that warms.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from scipy.optimize import brentq
from stickslip import Friction, Initial, Parameters, Rig, Springs, Surface, simulate
from stickslip.trajectory import break_away_frequency

from thermal import SlidingState, SteadySliding
from thermal.materials import MELTING_POINT_DEGC

from .case import CONTACT_LENGTH, Case

#: What the study's thermal camera tells apart, K.
CAMERA = 0.07


@dataclass(frozen=True)
class Drift:
    """Rises over the air, K, where the belt enters the contact unless said.

    study: one pass, all heat to the belt, the study's rate; single_pass: mended; run, steady:
    finite elements at the end of the last run and for ever. interface_run: mean of the two faces
    then, interface_drift: what of it came at constant speed; both again on a belt that never comes
    round (endless). belt_share: of the friction heat so far. Where the ice melts for ever,
    `steady_melts`.
    """

    study: float
    single_pass: float
    run: float
    steady: float
    ice_run: float
    ice_steady: float
    interface_run: float
    interface_drift: float
    interface_run_endless: float
    interface_drift_endless: float
    flash_run: float
    belt_share: float
    belt_share_steady: float
    steady_melts: bool


def drift(case: Case) -> Drift:
    """All of it. NoSteadyState for h = 0, ParameterError for a belt that cannot be."""
    rises, run = followed(case)
    steady = case.lasting.sliding().settle()
    endless = followed(endless_belt(case))[0]
    ambient = case.ambient_degC
    return Drift(
        study=case.as_the_study().temperature_degC(case.length) - ambient,
        single_pass=case.single_pass().temperature_degC(case.length) - ambient,
        run=rises.run,
        steady=steady.entry,
        ice_run=run.ice_face,
        ice_steady=steady.ice_face,
        interface_run=rises.interface_run,
        interface_drift=rises.interface_drift,
        interface_run_endless=endless.interface_run,
        interface_drift_endless=endless.interface_drift,
        flash_run=run.hottest_interface,
        belt_share=run.belt_share_so_far,
        belt_share_steady=steady.belt_share,
        steady_melts=steady.melting > 0.0,
    )


@dataclass(frozen=True)
class Rises:
    """At the end of the last run, K: of the belt where it enters the contact, of the interface at
    constant speed and from the start on. what: the change of the case that they are with."""

    what: str
    run: float
    interface_drift: float
    interface_run: float


def followed(case: Case, what: str = "as it is") -> tuple[Rises, SlidingState]:
    """Cold at the start: the rises at the end of the last run, and all of the state there."""
    before, end = case.follow(case.sliding())
    entry = 0.0 if never_comes_round(case) else end.entry
    interface = end.mean_interface
    return Rises(what, entry, interface - before.mean_interface, interface), end


def run_drift(case: Case) -> float:
    """Rise where the belt enters the contact at the end of the last run, K."""
    return 0.0 if never_comes_round(case) else followed(case)[0].run


def interface_drift(case: Case) -> float:
    """Rise of the interface at constant speed in the last run, K."""
    return followed(case)[0].interface_drift


def steady_drift(case: Case) -> float:
    """Rise where the belt enters the contact for ever, K."""
    return case.lasting.sliding().settle().entry


def least_below(
    rise: Callable[[float], float],
    limit: float,
    between: tuple[float, float],
    tolerance: float,
    *,
    surely: bool = False,
) -> float | None:
    """Least value in a range at which a rise (K) that falls with it is below a limit (K), or None.

    tolerance: relative; surely: the value errs upwards alone.
    """

    def over_the_limit(logarithm: float) -> float:
        return math.log(max(rise(math.exp(logarithm)), 1e-9) / limit)

    low, high = map(math.log, between)
    if over_the_limit(low) <= 0.0:
        return between[0]
    if over_the_limit(high) > 0.0:
        return None
    found = brentq(over_the_limit, low, high, xtol=tolerance)
    # the root is that near, on either side
    while surely and over_the_limit(found) > 0.0:
        found += tolerance
    return math.exp(min(found, high))


def never_comes_round(case: Case) -> bool:
    """Does the contact never meet again what was heated, in all runs? The belt enters cold then."""
    belt = case.rig.belt
    elsewhere = (belt.rollers > 0 and belt.roller_rise != 0.0) or (
        belt.railing_friction > 0.0 and belt.railing_length > CONTACT_LENGTH
    )
    return case.length > _never_round(case) and not elsewhere


def endless_belt(case: Case) -> Case:
    """The same on a belt that never comes round."""
    return case.with_length(1.01 * _never_round(case))


def _never_round(case: Case) -> float:
    """Length that a belt must have never to come round, m."""
    return case.travel + (2.0 * CONTACT_LENGTH + case.rig.belt.railing_length)


#: Shortest and longest pause that is tried, s.
SHORTEST_PAUSE, LONGEST_PAUSE = 1.0, 6.0 * 3600.0
#: How well a pause is found, relative.
_TOLERANCE = 1e-2
#: Places at which the belt is read, for each length of the contact.
_PLACES = 4


@dataclass(frozen=True)
class Wait:
    """Least pauses before run number `before`, s, all pauses being equal; None with the reason.

    belt, ice: until the warmest place of the belt's face, and the ice's face, are less than the
    limit above the air; begin: both. drift: until the belt's rise at entry stays below the limit
    through that run, too.
    """

    before: int
    belt: float | None
    ice: float | None
    begin: float | None
    drift: float | None
    reason: str


def wait(case: Case, limit: float) -> Wait:
    """Of a case before its last run, the second if it has but one; limit in K."""
    runs, hours = max(2, case.protocol.runs), LONGEST_PAUSE / 3600.0
    once = replace(case, protocol=replace(case.protocol, runs=1))
    sliding = case.sliding()
    first = once.follow(sliding)[1].entry
    after_first = sliding.snapshot()

    def least(rise: Callable[[], float]) -> float | None:
        """Least pause, s, after which a rise at the start of the last run is below the limit."""

        def after(pause: float) -> float:
            sliding.restore(after_first)
            for run in range(1, runs):
                if run > 1:
                    once.follow(sliding)
                case.rest(sliding, pause)
            return rise()

        if after(0.0) <= limit:
            return 0.0
        return least_below(after, limit, (SHORTEST_PAUSE, LONGEST_PAUSE), _TOLERANCE)

    belt, ice = least(lambda: _warmest(sliding)), least(lambda: abs(sliding.state().ice_face))
    through = least(lambda: once.follow(sliding)[1].entry) if first <= limit else None
    begin = None if belt is None or ice is None else max(belt, ice)
    said = [
        f"the {name} is not within {limit:g} K of the air after {hours:g} h"
        for name, value in (("belt", belt), ("ice", ice))
        if value is None
    ]
    if first > limit:
        said.append(f"the belt enters {first:.2g} K warm at the end of the first run already")
    elif through is None:
        said.append(f"after {hours:g} h the next run still takes the belt above {limit:g} K")
    return Wait(runs, belt, ice, begin, through, "; ".join(said))


def _warmest(sliding: SteadySliding) -> float:
    """Largest rise of the belt's face, or fall below the air, K."""
    length = sliding.parameters.belt.length
    places = math.ceil(_PLACES * length / sliding.footprint.length)
    return float(np.abs(sliding.face(np.linspace(0.0, length, places, endpoint=False))).max())


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


def changes(case: Case) -> list[Rises]:
    """As the case is, then each change alone; what has no room on the rig is left out."""
    each = [followed(changed, what)[0] for what, changed in _changed(case)]
    return [followed(case)[0], *each]


def _changed(case: Case) -> Iterator[tuple[str, Case]]:
    protocol, contact, belt = case.protocol, case.rig.contact, case.rig.belt
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

"""Frictional ageing: mu_s grows with the time at rest.

With its logarithm, mu_s + b log10(1 + t / t_0), as Dieterich found for rock and as ice does, up to
a limit, mu_s + c (1 - exp(-t / t_1)), or with a power, mu_s + d t^n, t in s (Rabinowicz, Proc.
Phys. Soc. 71, 1958). In slip the age is lost over a distance (Dieterich's D_c).
"""

from collections.abc import Iterator
from math import exp, log10

from ...quantity import Table, quantity
from ..effect import Candidate, Case, Effect, FormsOf, Scales


class StaticStrengthening(Table):
    """Static friction grows with the time at rest: its logarithm, a power, or up to a limit.

    rate : growth of mu_s per decade of hold time
    hold_time : hold time above which mu_s grows: log10(1 + t / hold_time)
    saturating : growth of mu_s that a long hold comes to
    saturation_time : hold time over which it does: 1 - exp(-t / saturation_time)
    slip_distance : slip over which a contact loses its age: exp(-s / slip_distance); matters only
        with friction.transition_speed, without which it is lost at once
    power : growth of mu_s in a hold of 1 s, by its power
    exponent : power of the hold time with which it grows
    """

    rate: float = quantity(0.0, "1", ge=0, le=2, typical=(0.01, 0.3))
    hold_time: float = quantity(0.01, "s", gt=0, tried=(1e-3, 0.1))
    saturating: float = quantity(0.0, "1", ge=0, le=5, typical=(0.02, 0.5))
    saturation_time: float = quantity(0.3, "s", gt=0, tried=(0.05, 2.0))
    slip_distance: float = quantity(1e-4, "m", gt=0, tried=(1e-5, 1e-3))
    power: float = quantity(0.0, "1", ge=0, le=5, typical=(0.02, 0.3))
    exponent: float = quantity(0.3, "1", ge=0.02, le=2, tried=(0.1, 0.8))


def static_growth(
    hold: float,
    rate: float,
    hold_time: float,
    saturating: float,
    saturation_time: float,
    power: float,
    exponent: float,
) -> float:
    """What ``hold`` seconds at rest add to mu_s: so much a decade, in the end, or by a power."""
    growth = 0.0
    if rate != 0.0:
        growth += rate * log10(1.0 + hold / hold_time)
    if saturating != 0.0:
        growth += saturating * (1.0 - exp(-hold / saturation_time))
    if power != 0.0:
        growth += power * hold**exponent
    return growth


own = FormsOf("static_strengthening")


def candidates(s: Scales) -> Iterator[Candidate]:
    """Logarithmic at once or after an onset, saturating, a power; each loses its age in slip."""
    # nobody knows beforehand over how much slip, and break-aways hang on it
    lost = own.free("slip_distance", 1e-3, 0.5, 1e-5, 3e-2, log=True)
    rate = own.free("rate", 0.03, 0.02, 0.0, 2.0)
    yield own.form("logarithmic", rate, lost, hold_time=0.01)
    for time in (0.03, 0.5):
        onset = own.free("hold_time", time, 0.5, 1e-4, 30.0, log=True)
        yield own.form("logarithmic after an onset", rate, onset, lost)
    most = own.free("saturating", 0.05, 0.03, 0.0, 5.0)
    for time in (0.1, 0.5):
        # over a much shorter time it would be another mu_s, not a law of the hold
        over = own.free("saturation_time", time, 0.5, 0.03, 30.0, log=True)
        yield own.form("saturating", most, over, lost)
    power = own.free("power", 0.05, 0.03, 0.0, 5.0)
    exponent = own.free("exponent", 0.3, 0.15, 0.05, 1.0)
    yield own.form("power", power, exponent, lost)


EFFECT = Effect(
    id="static_strengthening",
    table=StaticStrengthening,
    switch=("rate", "saturating", "power"),
    enters="contact",
    axis="hold time",
    source="Dieterich, J. Geophys. Res. 77 (1972); Schulson & Fortt, 0.3 a decade on ice",
    terms=(static_growth,),
    core={"slip_distance": "AGE_DISTANCE"},
    candidates=candidates,
    case=Case({"rate": 0.08}),
)

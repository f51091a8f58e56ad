"""Kinetic friction drifts with the distance slid: wear, polishing, wetting.

    mu_k (1 + r (1 - exp(-(s / D)^n)) + r2 (1 - exp(-s / D2)))

n = 1 is a first-order change; below 1 it is fast at first and then long drawn out, as where quick
smoothing goes before slow wear, above 1 it sets in after a while (stretched exponential). A later
change may undo the first, as where a surface polishes and then wears. mu_s stays, or takes its
share (static_relative, static_absolute).
"""

from collections.abc import Iterator
from dataclasses import replace
from math import exp

from ...quantity import Table, quantity
from ..effect import Candidate, Case, Effect, FormsOf, FreeParameter, Scales
from ..static_share import STATIC_FORMS, static_factor, static_share


class RunIn(Table):
    """Kinetic friction drifts with the distance slid: wear, polishing, wetting.

    change : final change of mu_k, part of it
    distance : distance over which the change is approached exponentially
    stretching : n of 1 - exp(-(s / distance)^n): 1 exponential, below 1 long drawn out, above 1
        delayed
    later_change : change that comes beside it, part of mu_k
    later_distance : distance over which that one is approached
    static_relative : what mu_s takes of mu_k's relative change: 1 all, in proportion; 0 none, it
        stays
    static_absolute : what mu_s takes of mu_k's change: 1 all, it moves by as much; 0 none
    """

    change: float = quantity(0.0, "1", ge=-0.95, le=5, typical=(-0.5, 0.5))
    distance: float = quantity(1.0, "m", gt=0, tried=(0.1, 3.0))
    stretching: float = quantity(1.0, "1", ge=0.2, le=4, tried=(0.5, 2.0))
    later_change: float = quantity(0.0, "1", ge=-5, le=5, typical=(-0.5, 0.5))
    later_distance: float = quantity(3.0, "m", gt=0, tried=(0.3, 9.0))
    static_relative: float = static_share()
    static_absolute: float = static_share()


def kinetic_factor(
    slid: float,
    change: float,
    distance: float,
    stretching: float,
    later_change: float,
    later_distance: float,
) -> float:
    """mu_k over its value at the start."""
    factor = 1.0
    if later_change != 0.0:
        factor += later_change * (1.0 - exp(-slid / later_distance))
    if stretching == 1.0 or slid <= 0.0:
        factor += change * (1.0 - exp(-slid / distance))
    else:
        factor += change * (1.0 - exp(-((slid / distance) ** stretching)))
    return max(0.0, factor)


own = FormsOf("run_in")


def candidates(s: Scales) -> Iterator[Candidate]:
    """A growth or a fall, over a tenth or half of a run; mu_s with it; or stretched."""
    for share in (0.1, 0.5):
        for change in (0.1, -0.1):
            yield own.form("exponential", *_drift(s, share, change))
    for form, static in STATIC_FORMS.items():
        for change in (0.1, -0.1):
            yield own.form(f"exponential, {form}", *_drift(s, 0.3, change), **{static: 1.0})
    yield own.form("stretched", *_drift(s, 0.3, -0.1), own.free("stretching", 0.7, 0.2, 0.3, 3.0))
    for change in (0.3, -0.3):
        first = _drift(s, 0.1, change)
        after = own.free("later_change", -change, 0.1, -5.0, 5.0)
        over = replace(first[1], key="run_in.later_distance", start=3.0 * first[1].start)
        yield own.form("there and back", *first, after, over)


def _drift(s: Scales, share: float, change: float) -> tuple[FreeParameter, ...]:
    """A change, over a share of the distance that a run slides."""
    # what is over within one stroke is the contact's own
    low = min(max(1e-3 * s.distance, s.travel), 0.5 * share * s.distance)
    start, high = share * s.distance, 1e2 * s.distance
    return (
        own.free("change", change, 0.1, -0.95, 5.0),
        own.free("distance", start, 0.5, low, high, log=True),
    )


EFFECT = Effect(
    id="run_in",
    table=RunIn,
    switch=("change",),
    enters="friction",
    axis="distance",
    source="wear, polishing and wetting, named by the source study; Blau, Tribol. Int. 38 (2005)",
    terms=(kinetic_factor, static_factor),
    candidates=candidates,
    case=Case({"change": -0.5}, window=(0.0, 8.0)),
)

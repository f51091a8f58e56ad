"""Break-aways: the spring force at which a block that stuck let go.

Noise hides the instant of a break-away, but not what follows from it. A block that lets go at x_b
with the speed V of the surface swings about the place x_k where springs and kinetic friction are in
balance, and turns at

    x_max = x_k + sqrt((x_b - x_k)^2 + (V / omega)^2),

which is read off the track and solved for x_b.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cosim.gap.data.campaign_file import Rig
from cosim.gap.weak_form.across import Plane
from cosim.gap.weak_form.constants import (
    MOST_OVERSHOOT,
    SHORTEST_STICK,
    SLIPS_OF_A_POWER,
)
from cosim.gap.weak_form.rig_geometry import spring_loads
from cosim.gap.weak_form.track import SmoothTrack


@dataclass(frozen=True)
class BreakAway:
    """One break-away.

    Attributes
    ----------
    at : its grid point
    force : of the springs, N, positive along the surface's motion
    sd : its standard deviation, N
    hold : time for which the block had stuck, s; of the first stick, since the record began
    """

    at: int
    force: float
    sd: float
    hold: float


def break_aways(track: SmoothTrack, rig: Rig, plane: Plane | None = None) -> tuple[BreakAway, ...]:
    """Of every stick that was seen from its beginning to its end.

    plane : how the block moves across: the contact holds the springs' force along x and y together
    """
    run = track.run
    sign = 1.0 if run.surface_speed >= 0.0 else -1.0
    overshoot = abs(run.surface_speed) / run.natural_frequency
    swing = round(np.pi / run.natural_frequency / track.interval)
    shortest = SHORTEST_STICK * 2.0 * np.pi / run.natural_frequency
    found = []
    balances = sign * _balances(track)[1:]
    for (_, end), (begin, last), balance in zip(
        track.slips, track.slips[1:], balances, strict=False
    ):
        hold = (begin - end) * track.interval
        if hold < shortest or not track.seen[end:begin].all():
            continue
        stop = min(begin + swing, last)
        if stop - begin < 3:
            continue
        turn = float(np.max(sign * track.place[max(begin - 3, 0) : stop]))
        reach = turn - balance
        if reach <= 0.0 or overshoot > MOST_OVERSHOOT * reach:
            continue
        place = balance + np.sqrt(reach**2 - overshoot**2)
        force = _held(rig, run.stiffness, sign * place, begin, plane)
        found.append((begin, force, hold, reach / np.sqrt(reach**2 - overshoot**2)))
    return _weighed(track, found)


def _held(rig: Rig, stiffness: float, x: float, at: int, plane: Plane | None) -> float:
    """Force of the springs at x, N, its sign that of what they pull back along x."""
    place = np.array([x])
    if plane is None:
        return -float(spring_loads(rig, stiffness, place)[0][0])
    along, across, _ = plane.at(at).loads(rig, stiffness, place)
    return -float(np.copysign(np.hypot(along[0], across[0]), along[0]))


def _balances(track: SmoothTrack) -> np.ndarray:
    """(slips,) where springs and kinetic friction balance, m: m x'' / K + x, its median in a slip.

    A slip has much noise, which its neighbours must not share, and friction may drift over a run:
    a cubic of the time, less where slips are few.
    """
    force = track.place + track.acceleration / track.run.natural_frequency**2
    medians = [float(np.median(force[first:last])) for first, last in track.slips]
    if not medians:
        return np.zeros(0)
    lengths = [last - first for first, last in track.slips]
    middles = [0.5 * (first + last) for first, last in track.slips]
    degree = min(len(medians) // SLIPS_OF_A_POWER, 3)
    course = np.polynomial.Polynomial.fit(middles, medians, degree, w=np.sqrt(lengths))
    return np.asarray(course(np.array(middles)))


def _weighed(
    track: SmoothTrack, found: list[tuple[int, float, float, float]]
) -> tuple[BreakAway, ...]:
    """With their standard deviation: what they scatter by in this run, beyond a slow change."""
    if len(found) < 3:
        return ()
    force = np.array([each[1] for each in found])
    steps = np.diff(force)
    scatter = 1.4826 * float(np.median(np.abs(steps - np.median(steps)))) / np.sqrt(2.0)
    least = 0.3 * track.run.noise["x"] * track.run.total_stiffness
    sd = max(scatter, least)
    return tuple(BreakAway(begin, one, sd * steep, hold) for begin, one, hold, steep in found)

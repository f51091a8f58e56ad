"""The run whose worst pair of models is set farthest apart."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations, permutations

import numpy as np
from stickslip import EFFECTS

from cosim.gap.data import Campaign
from cosim.gap.estimation.fitted import shared_of
from cosim.gap.estimation.segmented_run import SegmentedRun

from .member import Member
from .range import Experiment, experiments
from .rehearsal import Setting, rehearse, setting_of
from .separation import separation

#: Experiments times pairs that are screened, linearised, which says too much of many; so many of
#: the best are then refitted ...
_SCREENED, _FINALISTS = 180, 10
#: ... with so many Levenberg-Marquardt steps: contact and springs take up more by and by.
_ROUNDS = 8
#: Of runs nearly as good as the best, within this part, the one that needs least new equipment.
_NEARLY = 0.8
#: More members than this are not compared: the ones that fit best stand for the class.
_MEMBERS = 4
#: A coefficient is not known that the campaign knows no better than this many of its fit's steps.
_VAGUE = 20.0
#: What a break-away takes, over kinetic friction, where no break-away was seen.
_UNSEEN_RATIO = 1.3


@dataclass(frozen=True)
class _Side:
    """A member as it predicts, and what its campaign knows."""

    member: Member
    information: np.ndarray


def next_experiment(campaign: Campaign, members: Sequence[Member], planar: bool) -> dict | None:
    """The run that sets the members apart best, as plain data; None where none can be proposed.

    members : at least two, the best fit first; planar: their models move across the surface.
    The worst pair's separation is maximised over masses, springs, speeds and starts within the
    rig's range (see `range`). Keys: mass (kg), stiffness (N/m, one spring), surface_speed (m/s),
    duration (s), interval (s), start, pull (m, where "let go"), separates ([a, b, noise units] by
    pair), predicted_separation (the smallest of these), text.
    """
    sides = [_side(member) for member in members[:_MEMBERS]]
    if len(sides) < 2:
        return None
    setting = setting_of(campaign, planar)
    pairs = list(combinations(range(len(sides)), 2))
    screened = [
        (min(_apart(setting, one, sides, pairs, 0).values(), default=0.0), one)
        for one in experiments(campaign, _SCREENED // len(pairs))
    ]
    best = _most_telling(screened)[:_FINALISTS]
    both_ways = list(permutations(range(len(sides)), 2))
    simulated = {one: _apart(setting, one, sides, both_ways, _ROUNDS) for _, one in best}
    told = [(min(found.values()), one) for one, found in simulated.items() if found]
    if not told:
        return None
    chosen = _most_telling(told)[0][1]
    return _described(setting, chosen, sides, simulated[chosen])


def _most_telling(scored: Sequence[tuple[float, Experiment]]) -> list[tuple[float, Experiment]]:
    """Best first; among those nearly as good as the best, what the rig already has comes first."""
    scored = [pair for pair in scored if pair[0] > 0.0]
    most = max((score for score, _ in scored), default=0.0)
    return sorted(
        scored,
        key=lambda pair: (
            pair[0] < _NEARLY * most,
            pair[1].changed if pair[0] >= _NEARLY * most else 0,
            -pair[0],
        ),
    )


def _side(member: Member) -> _Side:
    """A static friction that no run has felt is set to what is usual."""
    information = member.information()
    shared = shared_of(member.free_parameters)
    keys = [free.key for free in shared]
    if {"friction.mu_s", "friction.mu_k"} <= set(keys):
        at = keys.index("friction.mu_s")
        if information[at, at] < _VAGUE**-2:
            usual = _UNSEEN_RATIO * member.fitted.values["friction.mu_k"]
            point = member.fitted.point
            moved = point.shared.copy()
            moved[at] = shared[at].scaled(usual)
            fitted = replace(member.fitted, point=replace(point, shared=moved))
            member = replace(member, fitted=fitted)
    return _Side(member, information)


def _apart(setting: Setting, experiment: Experiment, sides, pairs, rounds: int) -> dict:
    """(truth, other) -> separation; empty where the rig cannot do the experiment."""
    runs: dict[int, SegmentedRun] = {}
    for truth in sorted({truth for truth, _ in pairs}):
        rehearsed = rehearse(setting, experiment, sides[truth].member.values)
        if rehearsed is None:
            return {}
        runs[truth] = rehearsed
    return {
        (truth, other): separation(
            runs[truth], sides[other].member, sides[other].information, rounds
        )
        for truth, other in pairs
    }


def _described(setting: Setting, one: Experiment, sides, found: dict) -> dict:
    names = [side.member.effect for side in sides]
    apart = [
        [names[a], names[b], round(min(found[a, b], found[b, a]), 3)]
        for a, b in combinations(range(len(names)), 2)
    ]
    least = min(apart, key=lambda pair: pair[2])
    interval = float(np.median(np.diff(setting.time)))
    pull = {"pull": one.pull} if one.start == "let go" else {}
    return {
        "mass": one.mass,
        "stiffness": one.stiffness,
        "surface_speed": one.surface_speed,
        "duration": round(float(setting.time[-1]), 6),
        "interval": round(interval, 9),
        "start": one.start,
        **pull,
        "separates": apart,
        "predicted_separation": least[2],
        "text": _text(setting, one, least),
    }


def _text(setting: Setting, one: Experiment, least: Sequence) -> str:
    how = (
        "laid on the running surface with slack springs"
        if one.start == "carried"
        else f"pulled to x = {1e3 * one.pull:.3g} mm and let go"
    )
    a, b, units = least
    known = {entry.id for entry in EFFECTS}
    pair = f"{a} and {b}" if {a, b} <= known else f"{a} against {b}"
    return (
        f"{one.mass:.4g} kg, springs of {one.stiffness:.4g} N/m, surface at "
        f"{one.surface_speed:.2g} m/s for {setting.time[-1]:.3g} s, block {how}: {pair} would then "
        f"differ by {units:.2g} noise units after refitting"
    )

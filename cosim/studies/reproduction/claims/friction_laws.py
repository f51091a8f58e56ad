"""C11 and C16 to C18: mu_k/mu_s; dry or lubricated; falling with the speed; strengthening."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from itertools import product
from typing import Any

import numpy as np
from stickslip.reference.scheme_options import PRINTED

from cosim.studies.belt_length import Protocol

from .. import cases
from ..cases import DATASET_1, DATASET_2, GUIDED, SPEEDS, STIFFNESSES, WEAKENING, Case
from ..claim import STUDY, WRITTEN, Claim
from ..drawing import LABELS, Panel, add_picture, models_over_time
from ..motion import WINDOW, figures
from ..readings import Reading, standing, steady
from .belt_length import belt_case

Array = np.ndarray

#: Assumed, as in the packaged scenario `melting_friction`.
MELTING = {"rig": GUIDED} | WRITTEN["C16"]["melting"]
DRY = MELTING["friction"]["mu_k"]
MELTED = 0.5  # part of the dry value below which friction is that of melting


def _face_degC(case: Case) -> float:
    """Of the ice after a run of 30 s, all friction heat at the contact; finite elements."""
    belt = replace(
        belt_case(1.0, speed=case.speed),
        mass=case.mass,
        friction=case.mu_k,
        protocol=Protocol(ramp=0.0, run=cases.SETTLING + WINDOW),
    )
    return belt.ambient_degC + belt.follow(belt.sliding())[1].ice_face


def judge_dry_friction(claim: Claim) -> dict[str, float]:
    """No melting of the face by finite elements; sticking of a block whose asperities melt."""
    melting = cases.exact_figures(DATASET_1, **MELTING)
    share, part = melting["slip_share"], melting["friction"] / (DRY * DATASET_1.weight)
    claim.row_each("dry", cases.tabulated("slip_share", [DATASET_1], cases.SEEDS))
    claim.row("melting", [None, None, share])
    claim.row("friction", [None, None, part])
    faces = {v: _face_degC(DATASET_1.changed(speed=v)) for v in (SPEEDS[0], SPEEDS[-1])}
    for speed, face in faces.items():
        claim.row("face", [None, None, face], v=speed)
    claim.check("face", [None, None, max(faces.values())])
    claim.check("contact", [None, None, not (share < 1.0 and part < MELTED)], margin=share)
    for case in DATASET_1.over("speed", SPEEDS[1:3]):
        faster = cases.exact_figures(case, **MELTING)["slip_share"]
        claim.turn("speed", faster, sound=faster == 1.0, v=case.speed)
    told = {"sticks": 100.0 * (1.0 - share), "part": 100.0 * part}
    return told | {"law": part * DRY, "measured": DATASET_1.mu_k}


def judge_falling_friction(claim: Claim) -> dict[str, float]:
    """Mean slip times of the two approaches to friction, in three models."""
    both = DATASET_1.over("weakening", (0.0, WEAKENING))
    before, after = cases.tabulated("slip_duration", both, cases.SEEDS).T
    claim.row("steady", before)
    claim.row("falling", after)
    claim.check("longer", after / before)
    for name, numbers in claim.changes("case").items():
        falling = DATASET_1.changed(**numbers)
        both = falling.over("weakening", (0.0, falling.weakening))
        pair = cases.exact_table("slip_duration", both, rig=GUIDED)
        claim.turn(name, pair[1] / pair[0], times=pair)
    return {}


#: Hold by speed above which strengthening is told to be considerable, m.
THRESHOLD = 1e-4
#: Growth of mu_s in a decade of the hold time, and its uncertainty (§2.4).
GROWTH, UNCERTAIN = 0.30, 0.03
#: A coefficient contains what differs by no more than this part of it from run to run.
CONTAINED = 0.1
#: Of the series: softest and stiffest, slowest and fastest that a block sticks on in every model.
SERIES = [DATASET_1.changed(stiffness=k, speed=v) for k in STIFFNESSES[::3] for v in SPEEDS[:4:3]]


def judge_strengthening(claim: Claim) -> dict[str, float]:
    """Hold times of the series against the threshold, and what they would make of mu_s."""
    needed = THRESHOLD / SPEEDS[0]
    times = cases.tabulated("hold", SERIES)
    factors = times.max(axis=1) / times.min(axis=1)
    spreads = GROWTH * np.log10(factors)
    claim.row("needed", derived=1e4 * needed)
    claim.row_each("hold", times, of=SERIES)
    claim.row("spread", spreads)
    claim.check("holds", times[:, 0], limit=needed)
    claim.turn("measured", sound=times[2, 0] > 0.3, hold=times[2, 0])
    claim.check("contains", spreads, limit=CONTAINED * DATASET_1.mu_s)
    claim.turn("weaker", (GROWTH - UNCERTAIN) * np.log10(factors[2]))
    return {"factor": factors[2], "spread": spreads[2]}


RATIOS = (0.5, 0.77, 1.0)
RATIO_CASES = DATASET_2.over("mu_k", [ratio * DATASET_2.mu_s for ratio in RATIOS])
COUNTED = STUDY["oscillations_at_1"].value
MEASURED = STUDY["oscillations_measured"].value
# "one or two more" and "29" are counts: half an oscillation either way rounds to them
MORE = (0.5, 2.5)
NEAR = 1.0
OTHER_PRETENSIONS = (0.0, 0.004)  # m
# the study compares one run of each ratio: a reading allows what so many of its single runs give
SINGLE_RUNS = range(12)
ALLOWED = 0.05


def gaps(counts: Array) -> Array:
    """(..., 2): by how much 0.77 counts more than 0.5 and 1.0, of counts (..., 3)."""
    return np.asarray(counts[..., 1:2] - counts[..., ::2])


def _counts_more(counts: Array) -> Array:
    return np.asarray(np.all((gaps(counts) >= MORE[0]) & (gaps(counts) <= MORE[1]), axis=-1))


def _counts_29(counts: Array) -> Array:
    return np.asarray(np.abs(counts[..., 2] - COUNTED) <= NEAR)


def judge_ratio(claim: Claim) -> dict[str, Any]:
    """Oscillations in 20 s by model, for mu_k/mu_s of 0.5, 0.77 and 1.0."""
    counts, ranges = (
        cases.tabulated(figure, RATIO_CASES, cases.SEEDS, rig={})
        for figure in ("oscillations", "amplitude_x")
    )
    for ratio, ours in zip(RATIOS, counts.T, strict=True):
        claim.row(f"count_{ratio:g}", ours)
    claim.row_each("half_range", ranges, ratio=RATIOS)
    claim.check("more", _counts_more(counts), margin=gaps(counts[2]).min())
    _turn_ratio(claim, _counts_more)
    claim.check("one", np.abs(counts[:, 2] - COUNTED))
    _turn_ratio(claim, _counts_29)
    lines = [models_over_time(cases.three_motions(case), "x", 100.0, 0.4) for case in RATIO_CASES]
    pairs = zip(lines, RATIOS, strict=True)
    panels = [[Panel(line, f"µ_k/µ_s = {ratio:g}", end=12.0)] for line, ratio in pairs]
    add_picture(claim, "C11_ratio", panels)
    near, at = np.unravel_index(np.abs(counts - MEASURED).argmin(), counts.shape)
    nearest = f"{LABELS[near]} at {RATIOS[at]:g} with {counts[near, at]:.1f}"
    return {"more": gaps(_mended("F1")), "nearest": nearest}


def _mended(fault: str) -> Array:
    mended = PRINTED.without(fault)
    return np.array([cases.scheme_figures(one, mended)["oscillations"] for one in RATIO_CASES])


@cache
def _singles(reading: Reading) -> Array:
    """(3, runs): counts of single runs of each ratio, which draw their own scatter."""
    counts = [
        figures(steady(reading.motion(2, seed, mu_k=case.mu_k)))["oscillations"]
        for case, seed in product(RATIO_CASES, SINGLE_RUNS)
    ]
    return np.reshape(counts, (len(RATIOS), -1))


def _turn_ratio(claim: Claim, holds: Callable[[Array], Array]) -> None:
    """Other readings, other pretensions of the exact model, the scheme with a fault mended."""
    for one in standing():
        singles = _singles(one)
        # every run of one ratio beside every run of the others
        share = holds(np.array(list(product(*singles)))).mean()
        said = {"name": one.name, "counts": singles.mean(axis=1), "share": 100.0 * share}
        claim.turn("reading", sound=share >= ALLOWED, weight=one.weight, **said)
    for loose in OTHER_PRETENSIONS:
        counts = cases.exact_table("oscillations", RATIO_CASES, pretension=loose)
        claim.turn("pretension", sound=holds(counts), mm=1e3 * loose, counts=counts)
    for fault in ("F2", "F1"):
        counts = _mended(fault)
        claim.turn("mended", sound=holds(counts), fault=fault, counts=counts)

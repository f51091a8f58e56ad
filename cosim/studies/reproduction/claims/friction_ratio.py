"""C11: oscillations counted for mu_k/mu_s of 0.5, 0.77 and 1.0."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from itertools import product

import numpy as np
from stickslip.reference.scheme_errors import PRINTED

from ..cases import DATASET_2, exact_figures, scheme_figures, three_figures, three_motions
from ..claim import FAR, OPEN, Claim
from ..drawing import LABELS, Panel, models_over_time
from ..readings import Reading, standing, steady_figures
from ..sheet import STUDY, Sheet

Array = np.ndarray

RATIOS = (0.5, 0.77, 1.0)
COEFFICIENTS = [ratio * DATASET_2.mu_s for ratio in RATIOS]
CASES = DATASET_2.over("mu_k", COEFFICIENTS)
COUNTED = STUDY["oscillations_at_1"].number
MEASURED = STUDY["oscillations_measured"].number
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
    return np.abs(counts[..., 2] - COUNTED) <= NEAR


def judge() -> Claim:
    """Counts in 20 s by model."""
    sheet = Sheet("C11")
    found = [three_figures(case) for case in CASES]
    counts = np.array([[one.oscillations for one in models] for models in found]).T
    for ratio, ours in zip(RATIOS, counts.T, strict=True):
        sheet.row(f"count_{ratio:g}", ours)
    ranges = np.array([[one.half_range_x for one in models] for models in found]).T
    sheet.rows("half_range", ranges, ratio=RATIOS)
    sheet.check("more", answers=_counts_more(counts), margin=gaps(counts[2]).min())
    _turn(sheet, _counts_more)
    sheet.check("one", np.abs(counts[:, 2] - COUNTED))
    _turn(sheet, _counts_29)
    lines = [models_over_time(three_motions(case), "x", 100.0, 0.4) for case in CASES]
    titles = [f"µ_k/µ_s = {ratio:g}" for ratio in RATIOS]
    rows = [[Panel(*pair, end=12.0)] for pair in zip(lines, titles, strict=True)]
    sheet.picture("C11_ratio", rows)
    near, at = np.unravel_index(np.abs(counts - MEASURED).argmin(), counts.shape)
    nearest = f"{LABELS[near]} at {RATIOS[at]:g} with {counts[near, at]:.1f}"
    return sheet.claim(more=gaps(_mended("F1")), nearest=nearest)


def _mended(fault: str) -> Array:
    faults = PRINTED.without(fault)
    return np.array([scheme_figures(case, faults).oscillations for case in CASES])


@cache
def _singles(reading: Reading) -> Array:
    """(3, runs): counts of single runs of each ratio, which draw their own scatter."""

    counts = [
        steady_figures(reading.motion(2, seed, mu_k=mu_k)).oscillations
        for mu_k, seed in product(COEFFICIENTS, SINGLE_RUNS)
    ]
    return np.reshape(counts, (len(RATIOS), -1))


def _turn(sheet: Sheet, holds: Callable[[Array], Array]) -> None:
    """Other readings, other pretensions of the exact model, the scheme with a fault mended."""
    for one in standing():
        singles, weight = _singles(one), OPEN if one.place else FAR
        # every run of one ratio beside every run of the others
        share = holds(np.array(list(product(*singles)))).mean()
        said = {"name": one.name, "counts": singles.mean(axis=1), "share": 100.0 * share}
        sheet.turn("reading", sound=share >= ALLOWED, weight=weight, **said)
    for loose in OTHER_PRETENSIONS:
        counts = np.array([exact_figures(case, pretension=loose).oscillations for case in CASES])
        sheet.turn("pretension", sound=holds(counts), mm=1e3 * loose, counts=counts)
    for fault in ("F2", "F1"):
        counts = _mended(fault)
        sheet.turn("mended", sound=holds(counts), fault=fault, counts=counts)

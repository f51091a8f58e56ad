"""C11: oscillations counted for mu_k/mu_s of 0.5, 0.77 and 1.0."""

from __future__ import annotations

from functools import cache
from itertools import product

import numpy as np
from matplotlib.figure import Figure
from stickslip.reference.scheme_errors import MENDED, PRINTED

from ..cases import DATASET_2, exact_figures, exact_motion, many, scheme_figures, scheme_motion
from ..claim import FAR, OPEN, Claim
from ..drawing import COLOURS, LABELS, Panel, figure_of, over_time
from ..readings import Reading, standing, steady_figures
from ..sheet import STUDY, Sheet

Array = np.ndarray

RATIOS = (0.5, 0.77, 1.0)
CASES = DATASET_2.over("mu_k", [ratio * DATASET_2.mu_s for ratio in RATIOS])
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
    return counts[..., 1:2] - counts[..., ::2]


def judge() -> Claim:
    """Counts in 20 s by model."""
    sheet, found = Sheet("C11"), {}
    for ratio, case in zip(RATIOS, CASES, strict=True):
        of_scheme = [scheme_figures(case, faults) for faults in (PRINTED, MENDED)]
        found[ratio] = [*of_scheme, exact_figures(case)]
    counts = np.array([[one.oscillations for one in models] for models in found.values()]).T
    for ratio, ours in zip(RATIOS, counts.T, strict=True):
        sheet.row(f"count_{ratio:g}", ours)
    for ratio, models in found.items():
        sheet.row("half_range", [one.half_range_x for one in models], ratio=ratio)
    sheet.check("more", answers=_counts_more(counts), margin=gaps(counts[2]).min())
    _turn(sheet, _counts_more)
    sheet.check("one", np.abs(counts[:, 2] - COUNTED))
    _turn(sheet, _counts_29)
    nearest, at = np.unravel_index(np.abs(counts - MEASURED).argmin(), counts.shape)
    sheet.picture("C11_ratio", _draw)
    return sheet.claim(
        more=gaps(_of_scheme("F1")),
        model=LABELS[nearest],
        nearest=RATIOS[at],
        count=counts[nearest, at],
    )


def _counts_more(counts: Array) -> Array:
    return np.all((gaps(counts) >= MORE[0]) & (gaps(counts) <= MORE[1]), axis=-1)


def _counts_29(counts: Array) -> Array:
    return np.abs(counts[..., 2] - COUNTED) <= NEAR


def _of_scheme(fault: str) -> Array:
    return np.array([scheme_figures(case, PRINTED.without(fault)).oscillations for case in CASES])


@cache
def _singles(reading: Reading) -> Array:
    """(3, runs): counts of single runs of each ratio, which draw their own scatter."""

    def count(ratio_and_seed: tuple[float, int]) -> float:
        ratio, seed = ratio_and_seed
        return steady_figures(reading.motion(2, seed, mu_k=ratio * DATASET_2.mu_s)).oscillations

    return np.reshape(many(count, product(RATIOS, SINGLE_RUNS)), (len(RATIOS), -1))


def _turn(sheet: Sheet, holds) -> None:
    """Other readings, other pretensions of the exact model, the scheme with a fault mended."""
    for reading in standing():
        singles = _singles(reading)
        # every run of one ratio beside every run of the others
        share = holds(np.array(list(product(*singles)))).mean()
        sheet.turn(
            "reading",
            sound=share >= ALLOWED,
            weight=OPEN if reading.place else FAR,
            name=reading.name,
            counts=singles.mean(axis=1),
            share=100.0 * share,
        )
    for pretension in OTHER_PRETENSIONS:
        counts = np.array([exact_figures(c, pretension=pretension).oscillations for c in CASES])
        sheet.turn("pretension", sound=holds(counts), mm=1e3 * pretension, counts=counts)
    for fault in ("F2", "F1"):
        counts = _of_scheme(fault)
        sheet.turn("mended", sound=holds(counts), fault=fault, counts=counts)


def _draw() -> Figure:
    rows = []
    for ratio, case in zip(RATIOS, CASES, strict=True):
        runs = (scheme_motion(case, PRINTED), scheme_motion(case, MENDED), exact_motion(case))
        lines = [
            over_time(run, "x", 100.0, 0.4 * run.time[-1], color=colour, label=label, lw=1.0)
            for run, colour, label in zip(runs, COLOURS, LABELS, strict=True)
        ]
        rows.append([Panel(lines, "time, s", "x, cm", f"µ_k/µ_s = {ratio:g}", end=12.0)])
    return figure_of(rows, height=1.7, sharex=True, sharey=True)

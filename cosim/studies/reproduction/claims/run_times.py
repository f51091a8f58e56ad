"""C12: what updating the spring angles costs, as a ratio measured here."""

from __future__ import annotations

import timeit
from collections.abc import Callable
from functools import partial
from statistics import median
from typing import Any

from stickslip import simulate
from stickslip.reference.interpreted_scheme import interpreted_run
from stickslip.reference.scheme_errors import PRINTED

from ..cases import DATASET_1, exact_parameters, scheme
from ..claim import Claim
from ..sheet import Sheet

# one stick and one slip, then the next ones begin: what a script needs grows with the slips
DURATION = 0.7
WHOLE = 20.0
CYCLES = 40  # the runs that the study compares
KINDS = ("updated", "zero")


def measured() -> dict[str, list[float]]:
    """Seconds of a run with updated angles and with angle zero; the exact model has one.

    python, numpy: script with strips in either, over `DURATION`; compiled, exact: over `WHOLE`.
    """
    schemes = [scheme(DATASET_1, PRINTED, treatment=kind) for kind in KINDS]
    script = partial(interpreted_run, DURATION)
    calls: dict[str, tuple[int, list[Callable[[], Any]]]] = {
        "python": (1, [partial(script, treatment=kind) for kind in KINDS]),
        "numpy": (3, [partial(script, treatment=kind, together=True) for kind in KINDS]),
        "compiled": (5, [partial(one.run, duration=WHOLE) for one in schemes]),
        "exact": (5, [partial(simulate, exact_parameters(DATASET_1), WHOLE)]),
    }
    return {
        name: [median(timeit.repeat(call, number=1, repeat=repeats)) for call in called]
        for name, (repeats, called) in calls.items()
    }


def judge() -> Claim:
    """Script with strips in Python, script with strips in numpy, compiled scheme, exact model."""
    sheet, times = Sheet("C12"), measured()
    (updated, zero), (compiled, _), (exact,) = (
        times[name] for name in ("python", "compiled", "exact")
    )
    ratios = [times[name][0] / times[name][1] for name in ("python", "numpy", "compiled")]
    whole = updated / DURATION * WHOLE
    sheet.row("updated", [CYCLES * updated / 60.0, None, None])
    sheet.row("zero", [CYCLES * zero, None, None])
    sheet.row("python", [ratios[0], None, None])
    sheet.row("numpy", [ratios[1], None, None])
    sheet.row("compiled", [None, ratios[2], None])
    sheet.row("by_compiled", [None, whole / compiled, None])
    sheet.row("by_exact", [None, None, whole / exact])
    sheet.check("ratio")
    return sheet.claim(ratios=ratios, exact=1e3 * exact)

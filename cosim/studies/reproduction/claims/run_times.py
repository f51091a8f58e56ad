"""C12: what updating the spring angles costs, as a ratio measured here."""

from __future__ import annotations

import timeit
from collections.abc import Callable
from functools import partial
from statistics import median
from typing import Any

from stickslip.reference.interpreted_scheme import interpreted_run
from stickslip.reference.linearised import Scheme
from stickslip.reference.scheme_errors import PRINTED

from ..cases import DATASET_1, scheme
from ..claim import Claim
from ..sheet import Sheet

# one stick and one slip, then the next ones begin: what a script needs grows with the slips
DURATION = 0.7
WHOLE = 20.0
CYCLES = 40  # the runs that the study compares
KINDS = ("updated", "zero")


def measured() -> dict[str, list[float]]:
    """Seconds of a run with updated angles and with angle zero: as a script, and compiled."""
    schemes = [scheme(DATASET_1, PRINTED, treatment=kind) for kind in KINDS]
    plain = [Scheme(scatter=0.0, treatment=kind) for kind in KINDS]
    calls: dict[str, list[Callable[[], Any]]] = {
        "script": [partial(interpreted_run, DURATION, one) for one in plain],
        "compiled": [partial(one.run, duration=WHOLE) for one in schemes],
    }
    return {
        name: [median(timeit.repeat(call, number=1, repeat=3)) for call in called]
        for name, called in calls.items()
    }


def judge() -> Claim:
    """A script with its strips in Python, and the compiled scheme."""
    sheet, times = Sheet("C12"), measured()
    updated, zero = times["script"]
    ratios = [one / other for one, other in times.values()]
    sheet.row("updated", [CYCLES * updated / 60.0])
    sheet.row("zero", [CYCLES * zero])
    sheet.row("script", ratios[:1])
    sheet.row("compiled", [None, ratios[1]])
    sheet.check("ratio")
    return sheet.claim(ratios=ratios)

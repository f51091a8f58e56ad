"""The study's numbers, as JSON has them and as a page shows them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from stickslip.steady_motion.regimes import STARTS

from cosim.report.page import Picture, render

from .maps import STARTS as MAPPED
from .maps import Case, PretensionMap, RegimeMap


def as_json(
    case: Case, stretched: PretensionMap | None, regimes: RegimeMap | None
) -> dict[str, Any]:
    """Case and maps with plain numbers, SI; what was not computed is None."""
    return {
        "name": case.name,
        **case.assessment.as_dict(),
        "starts": STARTS,
        "pretension_map": None
        if stretched is None
        else {
            "pretensions": stretched.pretensions.tolist(),
            "speeds": stretched.speeds.tolist(),
            "growth": _plain(stretched.growth),
            "sticks": _plain(stretched.sticks),
        },
        "regime_map": None
        if regimes is None
        else {
            "ratios": regimes.ratios.tolist(),
            "speeds": regimes.speeds.tolist(),
            "simulated": dict(zip(MAPPED, regimes.simulated.tolist(), strict=True)),
            "closed_form": None
            if regimes.closed_form is None
            else dict(zip(MAPPED, regimes.closed_form.tolist(), strict=True)),
            "cells_that_differ": regimes.wrong,
            "fastest_from_rest": regimes.fastest_from_rest,
        },
    }


def page(numbers: dict[str, Any], sentences: Sequence[str], pictures: Sequence[Picture]) -> str:
    """HTML of the numbers of `as_json`, what they say, and the maps."""
    return render(
        "stability.html.j2",
        "cosim.studies.stability",
        numbers=numbers,
        sentences=sentences,
        pictures=pictures,
    )


def _plain(table: np.ndarray) -> list[list[float | None]]:
    """JSON has no NaN."""
    return [[value if math.isfinite(value) else None for value in row] for row in table.tolist()]

"""What the two periodic effects share: a sine, and its harmonics."""

from __future__ import annotations

from typing import Any

from ..quantity import quantity
from .candidate import Candidate, FreeParameter


def harmonic_amplitude(which: str) -> Any:
    """A parameter that a wave which is no sine has besides."""
    return quantity(
        0.0,
        "1",
        f"amplitude of the {which} harmonic as part of the first's",
        ge=0,
        le=10,
        typical=(0.1, 0.6),
    )


def harmonic_phase(which: str) -> Any:
    """The phase of that harmonic."""
    return quantity(
        0.0,
        "deg",
        f"phase of the {which} harmonic where that of the first is nothing",
        tried=(-180.0, 180.0),
    )


def periodic(effect: str, period: FreeParameter, form: str) -> Candidate:
    """A sine; a scan says where its period starts."""
    free = (
        FreeParameter(f"{effect}.amplitude", 0.1, 0.05, 0.0, 1.0),
        period,
        FreeParameter(f"{effect}.phase_deg", 0.0, 30.0, per_run=True),
    )
    return Candidate(effect, form, free, periodic=period.key)

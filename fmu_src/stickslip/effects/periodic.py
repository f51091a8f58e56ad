"""What the two periodic effects share: a sine, and its harmonics."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ..quantity import quantity
from .candidate import SECOND, Candidate, FreeParameter


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


def periodic(effect: str, period: FreeParameter, form: str) -> Iterator[Candidate]:
    """Candidates: a sine, and one with its second harmonic; a scan says where they start."""
    free = (
        FreeParameter(f"{effect}.amplitude", 0.1, 0.05, 0.0, 1.0),
        period,
        FreeParameter(f"{effect}.phase_deg", 0.0, 30.0, per_run=True),
    )
    yield Candidate(effect, form, free, periodic=period.key)
    # what is periodic is seldom a sine: its second harmonic, relative to the first
    second = tuple(FreeParameter(f"{effect}.{part}", 0.0, 0.1, -0.7, 0.7) for part in SECOND)
    yield Candidate(effect, f"{form} and second harmonic", free + second, periodic=period.key)

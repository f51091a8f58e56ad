"""What the gap workflow refuses."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from cosim.scenario.validation import ScenarioError


class CampaignError(ValueError):
    """A campaign that cannot be used; one line: file, key, what is wrong, what is allowed."""


class ColumnMissing(CampaignError):
    """A file without time or place, or under a name that nobody has told."""


@contextmanager
def within(place: object) -> Iterator[None]:
    """Put a file, or a place in it, before what is refused in the block."""
    try:
        yield
    except (CampaignError, ScenarioError) as fault:
        kind = ColumnMissing if isinstance(fault, ColumnMissing) else CampaignError
        raise kind(f"{place}: {fault}") from None

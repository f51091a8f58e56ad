"""Which claims there are."""

from __future__ import annotations

from collections.abc import Sequence

CLAIM_IDS = tuple(f"C{n}" for n in range(1, 16))


class UnknownClaim(ValueError):
    """An id that the study does not have; the message is one line."""


def claim_ids(wanted: Sequence[str]) -> tuple[str, ...]:
    """The ids asked for, once each and in the study's order; all of them for none asked."""
    asked = {one.upper() for one in wanted}
    for one in wanted:
        if one.upper() not in CLAIM_IDS:
            raise UnknownClaim(
                f"claim {one!r}: unknown, allowed are {CLAIM_IDS[0]} to {CLAIM_IDS[-1]}"
            )
    return tuple(one for one in CLAIM_IDS if not asked or one in asked)

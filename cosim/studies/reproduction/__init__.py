"""The source study's claims C1 to C18, each computed anew and judged.

>>> from cosim.studies.reproduction import reproduce
>>> reproduce(["C1"])[0].verdict
'holds'
"""

from collections.abc import Callable, Sequence

from .claim import Check, Claim, Row, UnknownClaim, claim_ids, judged
from .result import Reproduction

__all__ = ["Check", "Claim", "Reproduction", "Row", "UnknownClaim", "claim_ids", "reproduce"]


def reproduce(
    ids: Sequence[str] = (), progress: Callable[[str], None] = lambda _id: None
) -> Reproduction:
    """Compute and judge the claims (all of them for no ids), in the study's order.

    ``progress`` is called with each id when its claim is judged. Raises `UnknownClaim`.
    """
    from .claims import JUDGES  # matplotlib and the thermal model: only when there is work

    found = Reproduction()
    for one in claim_ids(ids):
        found.append(judged(one, JUDGES[one]))
        progress(one)
    return found

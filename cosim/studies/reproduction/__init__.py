"""The source study's claims C1 to C18, each computed anew and judged.

>>> from cosim.studies.reproduction import reproduce
>>> reproduce(["C1"])[0].verdict
'holds'
"""

from collections.abc import Sequence

from .claim import Check, Claim, Row, UnknownClaim, claim_ids, judged
from .result import Reproduction

__all__ = ["Check", "Claim", "Reproduction", "Row", "UnknownClaim", "claim_ids", "reproduce"]


def reproduce(ids: Sequence[str] = ()) -> Reproduction:
    """Compute and judge the claims (all of them for no ids), in the study's order.

    Raises `UnknownClaim`.

    >>> from cosim import reproduce
    >>> [(claim["id"], claim["verdict"]) for claim in reproduce(["C4"]).summary()["claims"]]
    [('C4', 'holds')]
    """
    from .claims import JUDGES  # matplotlib and the thermal model: only when there is work

    return Reproduction(judged(one, JUDGES[one]) for one in claim_ids(ids))

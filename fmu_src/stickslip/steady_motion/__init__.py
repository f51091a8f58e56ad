"""Which steady motion a run comes to: whether it is stable, and which others exist beside it."""

from .assessment import Assessment, assess
from .live import Interface, RunEnded
from .pretension import with_pretension
from .regimes import regimes
from .stability import stability

__all__ = [
    "Assessment",
    "Interface",
    "RunEnded",
    "assess",
    "regimes",
    "stability",
    "with_pretension",
]

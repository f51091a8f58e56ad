"""Which steady motion a run comes to: whether it is stable, and which others exist beside it."""

from .assessment import Assessment, assess
from .live import Interface, RunEnded
from .pretension import PretensionBorders, pretension_borders, with_pretension
from .regimes import Regime, coexisting, regimes
from .stability import Stability, stability

__all__ = [
    "Assessment",
    "Interface",
    "PretensionBorders",
    "Regime",
    "RunEnded",
    "Stability",
    "assess",
    "coexisting",
    "pretension_borders",
    "regimes",
    "stability",
    "with_pretension",
]

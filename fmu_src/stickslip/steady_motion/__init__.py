"""Which steady motion a run comes to: whether it is stable, and which others exist beside it."""

from .assessment import Assessment, assess
from .live import Interface, RunEnded
from .pretension import PretensionBorders, pretension_borders, with_pretension
from .regimes import Regime, coexisting, grouped, regimes
from .stability import Stability, stability
from .work import OutOfWork, Work

__all__ = [
    "Assessment",
    "Interface",
    "OutOfWork",
    "PretensionBorders",
    "Regime",
    "RunEnded",
    "Stability",
    "Work",
    "assess",
    "coexisting",
    "grouped",
    "pretension_borders",
    "regimes",
    "stability",
    "with_pretension",
]

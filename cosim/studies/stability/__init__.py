"""Which steady motions a rig has, and which of them it can keep to: two maps and a page."""

from .case import Case, NotAMotion, case_of
from .maps import PretensionMap, RegimeMap, pretension_map, regime_map

__all__ = [
    "Case",
    "NotAMotion",
    "PretensionMap",
    "RegimeMap",
    "case_of",
    "pretension_map",
    "regime_map",
]

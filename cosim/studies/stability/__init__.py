"""Which steady motions a rig has, and which of them it can keep to: two maps and a page."""

from .maps import Case, NotAMotion, PretensionMap, RegimeMap, case_of, pretension_map, regime_map

__all__ = [
    "Case",
    "NotAMotion",
    "PretensionMap",
    "RegimeMap",
    "case_of",
    "pretension_map",
    "regime_map",
]

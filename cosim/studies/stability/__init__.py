"""Which steady motions a rig has, which of them it can keep to, and where stick-slip stops."""

from .maps import Case, NotAMotion, case_of, pretension_map, regime_map
from .stick_slip_range import range_sentence, stick_slip_range

__all__ = [
    "Case",
    "NotAMotion",
    "case_of",
    "pretension_map",
    "range_sentence",
    "regime_map",
    "stick_slip_range",
]

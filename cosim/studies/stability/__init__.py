"""Which steady motions a rig has, which of them it can keep to, and where stick-slip stops."""

from .maps import Case, NotAMotion, case_of, pretension_map, regime_map
from .stick_slip_range import range_sentence, stick_slip_range
from .study import Stability, stability

__all__ = [
    "Case",
    "NotAMotion",
    "Stability",
    "case_of",
    "pretension_map",
    "range_sentence",
    "regime_map",
    "stability",
    "stick_slip_range",
]

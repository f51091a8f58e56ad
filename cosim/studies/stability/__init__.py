"""Which steady motions a rig has, which of them it can keep to, and where stick-slip stops."""

from .maps import Case as Case
from .maps import NotAMotion as NotAMotion
from .maps import case_of as case_of
from .maps import pretension_map as pretension_map
from .maps import regime_map as regime_map
from .study import Stability as Stability
from .study import range_sentence as range_sentence
from .study import stability as stability
from .study import stick_slip_range as stick_slip_range

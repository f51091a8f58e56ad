"""How long must the belt be? The study's single pass, and heat that stays from loop to loop."""

from .case import Case, StudyError
from .drift import CAMERA, Drift, drift, run_drift, steady_drift
from .friction_effect import FrictionEffect, friction_effect
from .length_speed_map import DriftMap, empty_map, fill_map
from .shortest import shortest_belt
from .study import AIR, Options, Row, Study, cases, work_off
from .uncertainty import Uncertainty, uncertainty
from .verdict import verdict

__all__ = [
    "AIR", "CAMERA", "Case", "Drift", "DriftMap", "FrictionEffect", "Options", "Row", "Study",
    "StudyError", "Uncertainty", "cases", "drift", "empty_map", "fill_map", "friction_effect",
    "run_drift", "shortest_belt", "steady_drift", "uncertainty", "verdict", "work_off",
]

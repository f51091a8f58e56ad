"""How long must the belt be? The study's single pass, and heat that stays from loop to loop."""

from .case import Case
from .changes import Change, changes
from .drift import CAMERA, Drift, drift, interface_drift, run_drift, steady_drift
from .friction_effect import FrictionEffect, friction_effect
from .length_speed_map import DriftMap, empty_map, fill_map
from .protocol import Protocol, StudyError
from .shortest import shortest_belt
from .study import AIR, Options, Row, Study, cases, scenario_case, work_off
from .uncertainty import FEWEST_SAMPLES, Uncertainty, uncertainty
from .verdict import verdict
from .wait import Wait, wait

__all__ = [
    "AIR",
    "CAMERA",
    "Case",
    "Change",
    "Drift",
    "DriftMap",
    "FEWEST_SAMPLES",
    "FrictionEffect",
    "Options",
    "Protocol",
    "Row",
    "Study",
    "StudyError",
    "Uncertainty",
    "Wait",
    "cases",
    "changes",
    "drift",
    "empty_map",
    "fill_map",
    "friction_effect",
    "interface_drift",
    "run_drift",
    "scenario_case",
    "shortest_belt",
    "steady_drift",
    "uncertainty",
    "verdict",
    "wait",
    "work_off",
]

"""How long must the belt be? The study's single pass, and heat that stays from loop to loop."""

from .case import Case, Protocol, StudyError
from .changes import Change, FrictionEffect, changes, friction_effect
from .drift import CAMERA, Drift, Wait, drift, interface_drift, run_drift, steady_drift, wait
from .lengths import DriftMap, empty_map, fill_map, shortest_belt
from .result import Options, Row, Study
from .study import AIR, cases, scenario_case, work_off
from .uncertainty import FEWEST_SAMPLES, Uncertainty, uncertainty
from .verdict import verdict

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

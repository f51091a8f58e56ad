"""How long must the belt be? The study's single pass, and heat that stays from loop to loop."""

from .case import Case, Protocol, StudyError
from .changes import Change, FrictionEffect, changes, friction_effect
from .drift import CAMERA, Drift, Wait, drift, interface_drift, run_drift, steady_drift, wait
from .lengths import DriftMap, empty_map, fill_map, shortest_belt
from .required_length import Answer, Question, how_long
from .result import Options, Row, Study
from .scenario_priors import check_slides, ignored_keys, remarks, scenario_case, with_ranges
from .show.verdict import verdict
from .study import AIR, answer_all, cases, work_off
from .uncertainty import Uncertainty, uncertainty

__all__ = [
    "AIR",
    "Answer",
    "CAMERA",
    "Case",
    "Change",
    "Drift",
    "DriftMap",
    "FrictionEffect",
    "Options",
    "Protocol",
    "Question",
    "Row",
    "Study",
    "StudyError",
    "Uncertainty",
    "Wait",
    "answer_all",
    "cases",
    "changes",
    "check_slides",
    "drift",
    "empty_map",
    "fill_map",
    "friction_effect",
    "how_long",
    "interface_drift",
    "remarks",
    "run_drift",
    "scenario_case",
    "shortest_belt",
    "steady_drift",
    "uncertainty",
    "ignored_keys",
    "verdict",
    "wait",
    "with_ranges",
    "work_off",
]

"""How long must the belt be? The study's single pass, and heat that stays from loop to loop."""

from .case import Case, Protocol, StudyError
from .changes import changes, friction_effect
from .drift import CAMERA, drift, interface_drift, run_drift, steady_drift, wait
from .lengths import DriftMap, empty_map, fill_map, shortest_belt
from .required_length import Answer, how_long
from .result import Options, Study
from .scenario_priors import check_slides, ignored_keys, remarks, scenario_case, with_ranges
from .show.verdict import verdict
from .study import AIR, answer_all, cases, work_off
from .uncertainty import uncertainty

__all__ = [
    "AIR",
    "Answer",
    "CAMERA",
    "Case",
    "DriftMap",
    "Options",
    "Protocol",
    "Study",
    "StudyError",
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

"""How long must the belt be? The study's single pass, and heat that stays from loop to loop."""

from .case import Case, Protocol, StudyError
from .drift import CAMERA
from .lengths import DriftMap, empty_map, fill_map, shortest_belt
from .required_length import how_long
from .result import Options, Study
from .scenario_priors import check_slides, ignored_keys, remarks, scenario_case, with_ranges
from .show.verdict import verdict
from .study import answer_all, cases, work_off

__all__ = [
    "CAMERA",
    "Case",
    "DriftMap",
    "Options",
    "Protocol",
    "Study",
    "StudyError",
    "answer_all",
    "cases",
    "check_slides",
    "empty_map",
    "fill_map",
    "how_long",
    "remarks",
    "scenario_case",
    "shortest_belt",
    "ignored_keys",
    "verdict",
    "with_ranges",
    "work_off",
]

"""How long must the belt be? The study's single pass, and heat that stays from loop to loop."""

from .case import Case as Case
from .case import Protocol as Protocol
from .case import StudyError as StudyError
from .drift import CAMERA as CAMERA
from .lengths import DriftMap as DriftMap
from .lengths import empty_map as empty_map
from .lengths import fill_map as fill_map
from .lengths import shortest_belt as shortest_belt
from .required_length import how_long as how_long
from .result import Options as Options
from .result import Study as Study
from .show import verdict as verdict
from .study import answer_all as answer_all
from .study import cases as cases
from .study import work_off as work_off
from .unknowns import check_slides as check_slides
from .unknowns import ignored_keys as ignored_keys
from .unknowns import remarks as remarks
from .unknowns import scenario_case as scenario_case
from .unknowns import with_ranges as with_ranges

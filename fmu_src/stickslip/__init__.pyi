from typing import Any

from .effects import EFFECTS as EFFECTS
from .friction.law import friction_coefficient as friction_coefficient
from .friction.parameters import Friction as Friction
from .parameters import Imperfections as Imperfections
from .parameters import Initial as Initial
from .parameters import Parameters as Parameters
from .parameters import Rig as Rig
from .parameters import Solver as Solver
from .parameters import Springs as Springs
from .parameters import Surface as Surface
from .simulation import simulate as simulate
from .trajectory import Trajectory as Trajectory

def __getattr__(name: str) -> Any: ...

"""Mechanics of an ice block on four springs and a moving surface: stick, slip and heat.

>>> from stickslip import Friction, Parameters, simulate
>>> run = simulate(Parameters(friction=Friction(mu_s=0.28, mu_k=0.21)), duration=5.0)
>>> run["x"].shape
(501,)
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .effects import EFFECTS
    from .friction.law import friction_coefficient
    from .friction.parameters import Friction
    from .parameters import Imperfections, Initial, Parameters, Rig, Solver, Springs, Surface
    from .simulation import simulate
    from .trajectory import Trajectory

__all__ = [
    "EFFECTS",
    "Friction",
    "Imperfections",
    "Initial",
    "Parameters",
    "Rig",
    "Solver",
    "Springs",
    "Surface",
    "Trajectory",
    "friction_coefficient",
    "simulate",
]

_HOME = dict.fromkeys(
    ("Friction", "Imperfections", "Initial", "Parameters", "Rig", "Solver", "Springs", "Surface"),
    ".parameters",
) | {
    "EFFECTS": ".effects",
    "Trajectory": ".trajectory",
    "friction_coefficient": ".friction.law",
    "simulate": ".simulation",
}


def __getattr__(name: str) -> Any:
    """Import on first use: who only builds a unit needs no numpy.

    The effects' tables of parameters have their names here too: VelocityWeakening, FilmDrag, ...
    """
    if name in _HOME:
        return getattr(import_module(_HOME[name], __name__), name)
    if name[:1].isupper() and name in _tables():
        return _tables()[name]
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def _tables() -> dict[str, Any]:
    from .effects import EFFECTS

    return {effect.table.__name__: effect.table for effect in EFFECTS}


def __dir__() -> list[str]:
    return sorted({*__all__, *_tables()})

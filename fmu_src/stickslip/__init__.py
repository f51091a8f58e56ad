"""Mechanics of an ice block on four springs and a moving surface: stick, slip and heat.

>>> from stickslip import Friction, Parameters, simulate
>>> run = simulate(Parameters(friction=Friction(mu_s=0.28, mu_k=0.21)), duration=5.0)
>>> run["x"].shape
(501,)
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
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

_HOMES = {
    ".effects": "EFFECTS",
    ".friction.law": "friction_coefficient",
    ".friction.parameters": "Friction",
    ".parameters": "Imperfections Initial Parameters Rig Solver Springs Surface",
    ".simulation": "simulate",
    ".trajectory": "Trajectory",
}
_HOME = {name: home for home, names in _HOMES.items() for name in names.split()}
__all__ = sorted(_HOME)


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

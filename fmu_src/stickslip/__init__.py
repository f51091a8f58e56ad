"""Mechanics of an ice block on four springs and a moving surface: stick, slip and heat.

>>> from stickslip import Friction, Parameters, simulate
>>> run = simulate(Parameters(friction=Friction(mu_s=0.28, mu_k=0.21)), duration=5.0)
>>> run["x"].shape
(501,)
"""

from typing import TYPE_CHECKING, Any

from .lazy import lazy

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

# who only builds a unit needs no numpy
_named, _, __all__ = lazy(
    __name__,
    {
        ".effects": "EFFECTS",
        ".friction.law": "friction_coefficient",
        ".friction.parameters": "Friction",
        ".parameters": "Imperfections Initial Parameters Rig Solver Springs Surface",
        ".simulation": "simulate",
        ".trajectory": "Trajectory",
    },
)


def __getattr__(name: str) -> Any:
    """The effects' tables of parameters have their names here, too: VelocityWeakening, FilmDrag."""
    if name not in __all__ and name[:1].isupper() and name in _tables():
        return _tables()[name]
    return _named(name)


def _tables() -> dict[str, Any]:
    from .effects import EFFECTS

    return {effect.table.__name__: effect.table for effect in EFFECTS}


def __dir__() -> list[str]:
    return sorted({*__all__, *_tables()})

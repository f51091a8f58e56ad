"""Mechanics of an ice block on four springs and a moving surface: stick, slip and heat.

>>> from stickslip import Friction, Parameters, simulate
>>> run = simulate(Parameters(friction=Friction(mu_s=0.28, mu_k=0.21)), duration=5.0)
>>> run["x"].shape
(501,)
"""

from typing import Any

from .lazy import lazy

_named, _, __all__ = lazy(__name__, __file__)


def __getattr__(name: str) -> Any:
    """Import on first use: who only builds a unit needs no numpy.

    The effects' tables of parameters have their names here too: VelocityWeakening, FilmDrag, ...
    """
    if name[:1].isupper() and name not in __all__ and name in _tables():
        return _tables()[name]
    return _named(name)


def _tables() -> dict[str, Any]:
    from .effects import EFFECTS

    return {effect.table.__name__: effect.table for effect in EFFECTS}


def __dir__() -> list[str]:
    return sorted({*__all__, *_tables()})

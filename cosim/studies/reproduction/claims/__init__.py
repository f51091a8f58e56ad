"""The claims C1 to C18 of the source study, one function each that fills and judges it."""

from . import belt_length, friction_laws, friction_level, rotation, runs, trends, verification

__all__ = [
    "belt_length",
    "friction_laws",
    "friction_level",
    "rotation",
    "runs",
    "trends",
    "verification",
]

"""Mechanics of an ice block on four springs and a moving surface: stick, slip and heat.

>>> from stickslip import Friction, Parameters, simulate
>>> run = simulate(Parameters(friction=Friction(mu_s=0.28, mu_k=0.21)), duration=5.0)
>>> run["x"].shape
(501,)
"""

from .parameters import (
    Friction,
    Initial,
    LateralFriction,
    Parameters,
    Rig,
    Solver,
    Springs,
    Surface,
    TemperatureDependence,
    TurningSurface,
)
from .simulate import simulate
from .trajectory import Trajectory

__all__ = [
    "Friction",
    "Initial",
    "LateralFriction",
    "Parameters",
    "Rig",
    "Solver",
    "Springs",
    "Surface",
    "TemperatureDependence",
    "Trajectory",
    "TurningSurface",
    "simulate",
]

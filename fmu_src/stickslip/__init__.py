"""Mechanics of an ice block on four springs and a moving surface: stick, slip and heat.

>>> from stickslip import Friction, Parameters, simulate
>>> run = simulate(Parameters(friction=Friction(mu_s=0.28, mu_k=0.21)), duration=5.0)
>>> run["x"].shape
(501,)
"""

from .effects import (
    CATALOGUE,
    AsperityMelting,
    FilmDrag,
    LateralFriction,
    LoadDependence,
    MeltFilm,
    MixedLubrication,
    RateAndState,
    RunIn,
    SpeedRipple,
    SpringHardening,
    SpringMisalignment,
    StaticStrengthening,
    StickStiffness,
    StructuralDamping,
    SurfacePattern,
    SurfaceScatter,
    TemperatureDependence,
    ThermalWeakening,
    TurningSurface,
    VelocityWeakening,
)
from .friction_law import friction_coefficient
from .parameters import Friction, Imperfections, Initial, Parameters, Rig, Solver, Springs, Surface
from .simulate import simulate
from .trajectory import Trajectory

__all__ = [
    "AsperityMelting",
    "CATALOGUE",
    "FilmDrag",
    "Friction",
    "Imperfections",
    "Initial",
    "LateralFriction",
    "LoadDependence",
    "MeltFilm",
    "MixedLubrication",
    "Parameters",
    "RateAndState",
    "Rig",
    "RunIn",
    "Solver",
    "SpeedRipple",
    "SpringHardening",
    "SpringMisalignment",
    "Springs",
    "StaticStrengthening",
    "StickStiffness",
    "StructuralDamping",
    "Surface",
    "SurfacePattern",
    "SurfaceScatter",
    "TemperatureDependence",
    "ThermalWeakening",
    "Trajectory",
    "TurningSurface",
    "VelocityWeakening",
    "friction_coefficient",
    "simulate",
]

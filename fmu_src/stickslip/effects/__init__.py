"""The catalogue of effects: what each adds to the plain model, one file each.

An effect joins the house by one line in ``FILES``. Their order is that of the FMU's parameters and
of the terms that meet in one place of the kernel: append.
"""

from importlib import import_module

from .effect import Effect

FILES = (
    "friction.lateral_friction",
    "surface.turning_surface",
    "contact.static_strengthening",
    "friction.velocity_weakening",
    "friction.film_drag",
    "friction.thermal_weakening",
    "friction.run_in",
    "springs.spring_hardening",
    "springs.structural_damping",
    "surface.speed_ripple",
    "friction.surface_pattern",
    "friction.surface_scatter",
    "friction.load_dependence",
    "springs.spring_misalignment",
    "contact.stick_stiffness",
    "friction.temperature_dependence",
    "friction.asperity_melting",
    "friction.melt_film",
    "contact.rate_and_state",
    "friction.mixed_lubrication",
    "friction.viscoelastic_peak",
)
EFFECTS: tuple[Effect, ...] = tuple(import_module(f"{__name__}.{file}").EFFECT for file in FILES)

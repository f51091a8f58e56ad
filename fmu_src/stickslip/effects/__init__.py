"""The catalogue of effects: what each adds to the plain model, one file each.

An effect joins the house by one line in ``FILES``. Their order is that of the FMU's parameters and
of the terms that meet in one place of the kernel: append. A catalogue with custom effects behind
them is a value of its own (`stickslip.catalogue`); their files need no more than is named here.
"""

from collections.abc import Iterable
from importlib import import_module

from ..plugins.errors import PluginError as PluginError
from ..quantity import Table as Table
from ..quantity import quantity as quantity
from .effect import Candidate as Candidate
from .effect import Case as Case
from .effect import Effect as Effect
from .effect import FreeParameter as FreeParameter
from .effect import Scales as Scales
from .effect import State as State

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
    "melting.temperature_dependence",
    "melting.asperity_melting",
    "melting.melt_film",
    "contact.rate_and_state",
    "melting.mixed_lubrication",
    "friction.viscoelastic_peak",
)


def declared(files: Iterable[str]) -> tuple[Effect, ...]:
    """The effects that some files declare. Raises ValueError for none in a file, or one twice."""
    found: dict[str, Effect] = {}
    for file in files:
        effect = getattr(import_module(f"{__name__}.{file}"), "EFFECT", None)
        if not isinstance(effect, Effect):
            raise ValueError(f"effects/{file.replace('.', '/')}.py declares no Effect named EFFECT")
        if effect.id in found:
            raise ValueError(f"effect {effect.id}: declared twice, again by {file}")
        found[effect.id] = effect
    return tuple(found.values())


EFFECTS = declared(FILES)

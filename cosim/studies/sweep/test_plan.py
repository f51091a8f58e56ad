"""The full test plan: every priority of every parameter, 1306 combinations.

2 temperatures x 9 belts x 6 masses x 6 speeds x 2 kinds of guides = 1296, and 10 repeats of one
combination for its statistics: over a surface whose friction scatters, each with another seed.
Masses, speeds, temperatures and belts are the plan's.

The plan gives no friction coefficients of its belts, nor of the colder room: those here are
assumptions, levels that span what ice shows on such surfaces, so that the sweep has the plan's
shape and size. Put measured ones in with ``belts`` and ``per_kelvin``. In the mechanics alone the
temperature acts through the friction coefficients only.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from stickslip import Parameters

from .axis import axis, labelled_axis
from .combination import with_changes
from .grid import Grid, mechanics_of

ICE = 0.461  # kg, the sample without added mass
ADDED_MASSES = (0.0, 0.20, 0.40, 0.45, 0.65, 0.91)  # kg
SPEEDS = (0.15, 0.25, 0.37, 0.50, 0.63, 0.82)  # m/s
TEMPERATURES = (-8.0, -16.0)  # degC
GUIDES = {"along the belt": ("x",), "free in the plane": ("x", "y", "phi")}
REPEATS = 10

#: mu_k of the belts at -8 degC: sandpapers around the 0.21 found on concrete, metals below
BELTS = {
    "K40": 0.30,
    "K60": 0.27,
    "K80": 0.24,
    "K100": 0.21,
    "K120": 0.19,
    "K150": 0.17,
    "aluminium": 0.10,
    "steel": 0.08,
    "stainless steel": 0.05,
}
#: mu_s / mu_k of the published experiment
STATIC_RATIO = 0.2815 / 0.2086
#: part by which friction grows for each kelvin below -8 degC
PER_KELVIN = 0.02
#: scatter of friction over the surface in the repeats, where the case has none of its own
SCATTER = 0.05


def plan_grid(
    parameters: Parameters,
    belts: Mapping[str, float] = BELTS,
    per_kelvin: float = PER_KELVIN,
) -> Grid:
    """The plan's 1296 combinations around ``parameters``.

    belts: name -> mu_k at -8 degC; mu_s follows by `STATIC_RATIO`. per_kelvin: see `PER_KELVIN`.
    """
    growth = [{"growth": 1.0 + per_kelvin * (TEMPERATURES[0] - each)} for each in TEMPERATURES]
    axes = (
        labelled_axis("temperature", "temperature of the room", "degC", TEMPERATURES, growth),
        labelled_axis(
            "belt",
            "material of the belt",
            "1",
            list(belts),
            [{"mu_k": value} for value in belts.values()],
        ),
        axis("rig.mass", [round(ICE + added, 3) for added in ADDED_MASSES]),
        axis("surface.speed", SPEEDS),
        labelled_axis(
            "guides",
            "motion that the rig allows",
            "1",
            list(GUIDES),
            [{"rig.degrees_of_freedom": each} for each in GUIDES.values()],
        ),
    )
    return Grid(mechanics_of(parameters), axes, _with_friction)


def repeats_grid(parameters: Parameters) -> Grid:
    """Ten runs of ``parameters``, each over another place of a surface whose friction scatters."""
    deviation = parameters.surface_scatter.deviation or SCATTER
    base = with_changes(mechanics_of(parameters), {"surface_scatter.deviation": deviation})
    return Grid(base, (axis("surface_scatter.seed", range(1, REPEATS + 1)),))


def _with_friction(settings: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Friction out of belt and temperature; the other axes' settings as they are."""
    growth, belt, *others = settings
    mu_k = belt["mu_k"] * growth["growth"]
    changes = {"friction.mu_s": STATIC_RATIO * mu_k, "friction.mu_k": mu_k}
    for other in others:
        changes |= other
    return changes

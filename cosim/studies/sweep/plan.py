"""The published test plan as a grid: every priority of every parameter, 1306 combinations.

2 temperatures x 9 belts x 6 masses x 6 speeds x 2 kinds of guides = 1296, and 10 repeats of one
combination for its statistics: over a surface whose friction scatters, each with another seed.
`plan.toml` has them, and says what of them is assumed. In the mechanics alone the temperature
acts through the friction coefficients.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from stickslip import Parameters
from stickslip.packaged import packaged_tables

from .axis import axis, labelled_axis
from .combination import Run, with_changes
from .grid import Grid, mechanics_of, merged

PLAN = packaged_tables(__package__, "plan.toml")
#: mu_k at -8 degC
BELTS: dict[str, float] = PLAN["belts"]
#: mu_s / mu_k of the published experiment
STATIC_RATIO = PLAN["published"]["mu_s"] / PLAN["published"]["mu_k"]


def plan_grid(
    parameters: Parameters,
    belts: Mapping[str, float] = BELTS,
    per_kelvin: float = PLAN["per_kelvin"],
) -> Grid:
    """The plan's 1296 combinations around ``parameters``.

    belts: name -> mu_k at -8 degC; mu_s follows by `STATIC_RATIO`. per_kelvin: part by which
    friction grows for each kelvin below that. Measured ones take the place of the assumed.
    """
    temperatures, guides = PLAN["temperatures"], PLAN["guides"]
    growth = [{"growth": 1.0 + per_kelvin * (temperatures[0] - each)} for each in temperatures]
    friction = [{"mu_k": value} for value in belts.values()]
    free = [{"rig.degrees_of_freedom": tuple(each)} for each in guides.values()]
    axes = (
        labelled_axis("temperature", "temperature of the room", "degC", temperatures, growth),
        labelled_axis("belt", "material of the belt", "1", list(belts), friction),
        axis("rig.mass", [round(PLAN["ice"] + added, 3) for added in PLAN["added_masses"]]),
        axis("surface.speed", PLAN["speeds"]),
        labelled_axis("guides", "motion that the rig allows", "1", list(guides), free),
    )
    return Grid(mechanics_of(parameters), axes, Run().of(parameters), _with_friction)


def repeats_grid(parameters: Parameters) -> Grid:
    """Ten runs of ``parameters``, each over another place of a surface whose friction scatters."""
    deviation = parameters.surface_scatter.deviation or PLAN["scatter"]
    base = with_changes(mechanics_of(parameters), {"surface_scatter.deviation": deviation})
    seeds = axis("surface_scatter.seed", range(1, PLAN["repeats"] + 1))
    return Grid(base, (seeds,), Run().of(parameters))


def _with_friction(settings: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Friction out of belt and temperature; the other axes' settings as they are."""
    growth, belt, *others = settings
    mu_k = belt["mu_k"] * growth["growth"]
    return {"friction.mu_s": STATIC_RATIO * mu_k, "friction.mu_k": mu_k} | merged(others)

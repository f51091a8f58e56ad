"""For what real contact each law of friction holds, and what of it is assumed: for the page."""

from __future__ import annotations

import math
from dataclasses import dataclass

from stickslip.packing import GRAVITY

from .map import FrictionMap

#: From here on a contact has slid away before the warmth has spread as far as it is long.
LEAST_PECLET = 1.0


@dataclass(frozen=True)
class Law:
    """Of an effect, by its name: for which contact it holds, what that is here, its numbers."""

    name: str
    holds: str
    here: str
    numbers: str


def laws_of(found: FrictionMap) -> list[Law]:
    """Those of the scenario that are on."""
    laws = (_dry(found), _asperities(found), _film(found), _flooded(found))
    return [law for law in laws if law is not None]


def _dry(found: FrictionMap) -> Law | None:
    law = found.scenario.mechanics.temperature_dependence
    if law.sensitivity == 0.0:
        return None
    nothing_left = law.reference_degC + 1.0 / law.sensitivity
    fall = law.static_sensitivity * (nothing_left - law.reference_degC)
    static = found.scenario.mechanics.friction.mu_s * max(0.0, 1.0 - fall)
    return Law(
        "temperature_dependence",
        "a dry contact between two measured temperatures, by a straight line",
        f"nothing is left of mu_k at {nothing_left:.3g} °C; mu_s there is {static:.3g}",
        "assumed: sensitivity, reference_degC",
    )


def _asperities(found: FrictionMap) -> Law | None:
    mechanics = found.scenario.mechanics
    law = mechanics.asperity_melting
    if law.length == 0.0:
        return None
    load = mechanics.rig.mass * GRAVITY
    bears = load / law.hardness
    slow = LEAST_PECLET * diffusivity(found) / law.length
    speeds = [point.speed for point in found.points]
    below = sum(speed < slow for speed in speeds)
    slowest = min(speeds)
    share = conducted_share(found, slowest)
    return Law(
        "asperity_melting",
        "a real contact of N/H in patches of the length l, warmed one-dimensionally: a Péclet "
        "number v l/κ above 1. Slower, both bodies conduct, and Evans' term with 1/v would be "
        "added, which this law leaves out. At the melting point it leaves no kinetic friction at "
        "any speed, while mu_s stays",
        f"N/H = {1e6 * bears:.2g} mm², {_patches(bears, law.length)}; Péclet above 1 from "
        f"{slow:.2g} m/s on, {below or 'none'} of {len(speeds)} runs slower; the term with 1/v "
        f"would be {100.0 * share:.0f} % of this law's friction at {slowest:.2g} m/s and falls "
        f"with 1/√v; mu_s = {mechanics.friction.mu_s:g} at 0 °C, too",
        "assumed: length, hardness; computed: constant; of ice: effusivity",
    )


def _patches(area: float, length: float) -> str:
    """How a real contact and the length of its patches go together."""
    if length**2 > area:
        return f"a streak {1e3 * length:.3g} mm long and {1e3 * area / length:.2g} mm wide"
    return f"{area / length**2:.3g} patches {1e3 * length:.3g} mm long and wide"


def diffusivity(found: FrictionMap) -> float:
    """Of the block, m2/s."""
    ice = found.scenario.thermal.ice
    return ice.conductivity / (ice.density * ice.heat_capacity)


def conducted_share(found: FrictionMap, speed: float) -> float:
    """Evans' conduction into both bodies over the warming of the law, at a speed (m/s).

    A patch of the radius l/2 at the melting point gives 4 k (T_m - T) l/2 to a half-space; the
    law's own heat is C e (T_m - T) sqrt(v / l) times its area.
    """
    law = found.scenario.mechanics.asperity_melting
    thermal = found.scenario.thermal
    conductivity = thermal.ice.conductivity + thermal.belt.conductivity
    radius = 0.5 * law.length
    conducted = 4.0 * conductivity * radius / (math.pi * radius**2)
    warmed = law.constant * law.effusivity * math.sqrt(speed / law.length)
    return float(conducted / warmed)


def _film(found: FrictionMap) -> Law | None:
    mechanics = found.scenario.mechanics
    law = mechanics.melt_film
    if law.wetted_share == 0.0:
        return None
    wetted = law.wetted_share * math.pi * mechanics.rig.contact_radius**2
    pressure = mechanics.rig.mass * GRAVITY / wetted
    thickness = math.sqrt(
        2.0 * law.viscosity * max(p.speed for p in found.points) * law.length / law.latent_heat
    )
    return Law(
        "melt_film",
        "a wetted patch that bears the whole load, on a film that its own shear melts; no heat "
        "goes into the ice or the belt, so it holds near the melting point only",
        f"{1e6 * wetted:.2g} mm² at {1e-6 * pressure:.2g} MPa; film {1e6 * thickness:.2g} µm at "
        f"the fastest run",
        "assumed: wetted_share, length; of water: viscosity, latent_heat",
    )


def _flooded(found: FrictionMap) -> Law | None:
    law = found.scenario.mechanics.mixed_lubrication
    if law.share == 0.0:
        return None
    return Law(
        "mixed_lubrication",
        "a face that melts as a whole and floods the roughness of the surface",
        f"roughness {1e6 * law.roughness:.2g} µm",
        "assumed: share, roughness; of water: viscosity",
    )

"""For what real contact each law of friction holds, and what of it is assumed: for the page."""

from __future__ import annotations

import math
from dataclasses import dataclass

from stickslip.effects.melting.asperity_melting import carrying_speed, conducting
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
    share = 100.0 * conducted_share(found, slowest)
    conducts = f"{share:.0f} % of what the ice takes in passing at {slowest:.2g} m/s"
    if law.conductivity == 0.0:
        conducts = "left out (conductivity = 0)"
    carries = carrying_speed(law.length, law.roughness)
    return Law(
        "asperity_melting",
        "a real contact of N/H in patches of the length l, which are at the melting point: they "
        "warm the ice in passing, as 1/√v, from a Péclet number v l/κ of 1 on, and both bodies "
        "conduct, as 1/v, at any speed. Where its melt is thinner than the contact is rough, "
        "friction is the dry μ_k, at the melting point, too; measured dry friction itself falls "
        "towards melting (ice on rock: 0.02), which is temperature_dependence",
        f"N/H = {1e6 * bears:.2g} mm², {_patches(bears, law.length)}; Péclet above 1 from "
        f"{slow:.2g} m/s on, {below or 'none'} of {len(speeds)} runs slower; conduction: "
        f"{conducts}; "
        + (f"melt carries above {carries:.2g} m/s" if carries else "melt carries at any speed")
        + f"; mu_s = {mechanics.friction.mu_s:g} at 0 °C, too",
        "assumed: length, hardness, roughness; computed: constant; of ice: effusivity; of both "
        "bodies: conductivity",
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
    """What both bodies conduct, over what the ice takes in passing, at a speed (m/s)."""
    law = found.scenario.mechanics.asperity_melting
    root = conducting(law.length, law.effusivity, law.constant, law.conductivity)
    return root / math.sqrt(speed)


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

"""What stands beside a map: for what real contact each law of friction holds and what of it is
assumed; and measured friction of ice, the rig's own point and published values.

Laws stand in `laws.toml`, published values in `measured.toml`.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from stickslip import friction_coefficient
from stickslip.effects.melting.asperity_melting import carrying_speed, conducting
from stickslip.packaged import packaged_tables
from stickslip.packing import GRAVITY

from ...scenario import Scenario, packaged_scenarios, read_scenario

#: From here on a contact has slid away before the warmth has spread as far as it is long.
LEAST_PECLET = 1.0
LAWS = packaged_tables(__package__, "laws.toml")


def laws_of(scenario: Scenario, speeds: Sequence[float]) -> list[dict[str, str]]:
    """Those of a scenario that are on, as `laws.toml` has them: name, holds, here, numbers.

    speeds: of the runs, m/s.
    """
    of = {
        "temperature_dependence": _dry,
        "asperity_melting": _asperities,
        "melt_film": _film,
        "mixed_lubrication": _flooded,
    }
    return [
        law | {"name": name, "here": law["here"].format(**of[name](scenario, speeds))}
        for name, law in LAWS.items()
        if getattr(getattr(scenario.mechanics, name), law["on"]) != 0.0
    ]


def _dry(scenario: Scenario, speeds: Sequence[float]) -> dict[str, Any]:
    law = scenario.mechanics.temperature_dependence
    nothing_left = law.reference_degC + 1.0 / law.sensitivity
    fall = law.static_sensitivity * (nothing_left - law.reference_degC)
    static = scenario.mechanics.friction.mu_s * max(0.0, 1.0 - fall)
    return {"nothing_left": nothing_left, "static": static}


def _asperities(scenario: Scenario, speeds: Sequence[float]) -> dict[str, Any]:
    mechanics = scenario.mechanics
    law = mechanics.asperity_melting
    bears = mechanics.rig.mass * GRAVITY / law.hardness
    slow, slowest = LEAST_PECLET * diffusivity(scenario) / law.length, min(speeds)
    share = 100.0 * conducted_share(scenario, slowest)
    conducts = f"{share:.0f} % of what the ice takes in passing at {slowest:.2g} m/s"
    carries = carrying_speed(law.length, law.roughness)
    return {
        "bears": 1e6 * bears,
        "patches": _patches(bears, law.length),
        "slow": slow,
        "below": sum(speed < slow for speed in speeds) or "none",
        "runs": len(speeds),
        "conducts": conducts if law.conductivity else "left out (conductivity = 0)",
        "carries": f"above {carries:.2g} m/s" if carries else "at any speed",
        "mu_s": mechanics.friction.mu_s,
    }


def _patches(area: float, length: float) -> str:
    """How a real contact and the length of its patches go together."""
    if length**2 > area:
        return f"a streak {1e3 * length:.3g} mm long and {1e3 * area / length:.2g} mm wide"
    return f"{area / length**2:.3g} patches {1e3 * length:.3g} mm long and wide"


def diffusivity(scenario: Scenario) -> float:
    """Of the block, m2/s."""
    ice = scenario.thermal.ice
    return ice.conductivity / (ice.density * ice.heat_capacity)


def conducted_share(scenario: Scenario, speed: float) -> float:
    """What both bodies conduct, over what the ice takes in passing, at a speed (m/s)."""
    law = scenario.mechanics.asperity_melting
    root = conducting(law.length, law.effusivity, law.constant, law.conductivity)
    return root / math.sqrt(speed)


def _film(scenario: Scenario, speeds: Sequence[float]) -> dict[str, Any]:
    mechanics, fastest = scenario.mechanics, max(speeds)
    law, load = mechanics.melt_film, mechanics.rig.mass * GRAVITY
    wetted = law.wetted_share * math.pi * mechanics.rig.contact_radius**2
    thickness = math.sqrt(2.0 * law.viscosity * fastest * law.length / law.latent_heat)
    return {"wetted": 1e6 * wetted, "pressure": 1e-6 * load / wetted, "thickness": 1e6 * thickness}


def _flooded(scenario: Scenario, speeds: Sequence[float]) -> dict[str, Any]:
    return {"roughness": 1e6 * scenario.mechanics.mixed_lubrication.roughness}


#: Law and measurement that differ by more than this factor are told apart in words.
FACTOR = 2.0


@dataclass(frozen=True)
class Measured:
    """Measured friction at speeds (m/s) that grow.

    is_range: the speeds and the friction are the least and the largest of many runs, not pairs.
    ambient_degC: at which the law can be held against it; None where the runs were at many.
    """

    what: str
    conditions: str
    source: str
    speeds: Sequence[float]
    friction: Sequence[float]
    is_range: bool = False
    ambient_degC: float | None = None


PUBLISHED = [Measured(**one) for one in packaged_tables(__package__, "measured.toml")["published"]]


def own_point(scenario: Scenario) -> Measured | None:
    """What the source study's rig measured, where a packaged scenario has its block."""
    study = read_scenario("study")
    if scenario.name not in packaged_scenarios() or scenario.rig.mass != study.rig.mass:
        return None
    return Measured(
        "the source study's rig",
        f"{study.ambient.temperature_degC:g} °C, {study.rig.mass:g} kg".replace("-", "−"),
        "mean of its slips: μ_k of the scenario study",
        (study.surface.speed,),
        (study.mechanics.friction.mu_k,),
        ambient_degC=study.ambient.temperature_degC,
    )


def measured_beside(scenario: Scenario) -> list[Measured]:
    """What a block of ice has beside it; nothing where the block is of something else."""
    if scenario.thermal.ice.melting_point_degC > 0.0:
        return []
    own = own_point(scenario)
    return [*([own] if own else []), *PUBLISHED]


def differences(scenario: Scenario) -> str:
    """A sentence of where law and measurement differ by more than a factor; "" for nowhere."""
    told = []
    for each in measured_beside(scenario):
        if each.ambient_degC is None:
            continue
        law = friction_coefficient(scenario.mechanics, each.speeds, each.ambient_degC)
        for speed, mu, measured in zip(each.speeds, law, each.friction, strict=True):
            if not measured / FACTOR <= mu <= measured * FACTOR:
                told.append(
                    f"{mu:.3g} where {each.what} has {measured:.4g} "
                    f"({speed:g} m/s, {each.ambient_degC:g} °C)".replace(" -", " −")
                )
    if not told:
        return ""
    return f"Law and measurement differ by more than a factor of {FACTOR:g}: {'; '.join(told)}."

"""Measured friction of ice beside a map: the rig's own point, and published values.

Published values stand in `measured.toml`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from stickslip import friction_coefficient
from stickslip.packaged import packaged_tables

from cosim.scenario import packaged_scenarios, read_scenario

from .map import FrictionMap

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


def own_point(found: FrictionMap) -> Measured | None:
    """What the source study's rig measured, where a packaged scenario has its block."""
    scenario, study = found.scenario, read_scenario("study")
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


def measured_beside(found: FrictionMap) -> list[Measured]:
    """What a map of a block of ice has beside it; nothing where the block is of something else."""
    if found.scenario.thermal.ice.melting_point_degC > 0.0:
        return []
    own = own_point(found)
    return [*([own] if own else []), *PUBLISHED]


def differences(found: FrictionMap) -> str:
    """A sentence of where law and measurement differ by more than a factor; "" for nowhere."""
    told = []
    for each in measured_beside(found):
        if each.ambient_degC is None:
            continue
        law = friction_coefficient(found.scenario.mechanics, each.speeds, each.ambient_degC)
        for speed, mu, measured in zip(each.speeds, law, each.friction, strict=True):
            if not measured / FACTOR <= mu <= measured * FACTOR:
                told.append(
                    f"{mu:.3g} where {each.what} has {measured:.4g} "
                    f"({speed:g} m/s, {each.ambient_degC:g} °C)".replace(" -", " −")
                )
    if not told:
        return ""
    return f"Law and measurement differ by more than a factor of {FACTOR:g}: {'; '.join(told)}."

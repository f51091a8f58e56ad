"""For each effect a size that shows, and the rig in which it does."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from stickslip import Parameters

# a rig that sticks and slips from the start: pretensioned springs, friction along x
PLAIN = {
    "rig": {"spring_natural_length": 0.17},
    "surface": {"speed": 0.15},
    "initial": {"vx": 0.15},
}


@dataclass(frozen=True)
class Case:
    """The effect's parameters; what else differs from the plain rig, on both sides; the window."""

    effect: dict[str, Any]
    rig: dict[str, dict[str, Any]] = field(default_factory=dict)
    window: tuple[float, float] = (4.0, 8.0)

    def parameters(self, effect_id: str | None) -> Parameters:
        """The rig with the effect, or without it for None."""
        blocks = {name: PLAIN.get(name, {}) | self.rig.get(name, {}) for name in PLAIN | self.rig}
        if effect_id is not None:
            blocks[effect_id] = blocks.get(effect_id, {}) | self.effect
        return Parameters.model_validate(blocks)


ASKEW = {"initial": {"vx": 0.15, "y": 0.01, "phi": 0.2}}
SLOW = {
    "surface": {"speed": 1e-3},
    "initial": {"vx": 1e-3},
    "springs": {"stiffness": 300.0},
}
CASES = {
    "lateral_friction": Case({"ratio": 1.0}, ASKEW),
    "turning_surface": Case({"curvature": 4.0}, {"lateral_friction": {"ratio": 1.0}}),
    "static_strengthening": Case({"rate": 0.08}),
    "velocity_weakening": Case({"hyperbolic": 2.0}),
    "film_drag": Case({"coefficient": 0.5}, window=(0.0, 8.0)),
    "thermal_weakening": Case({"per_joule": 0.4}, window=(0.0, 8.0)),
    "run_in": Case({"change": -0.5}, window=(0.0, 8.0)),
    "spring_hardening": Case({"cubic": 3e4}),
    "structural_damping": Case({"coefficient": 0.5}, window=(0.0, 8.0)),
    "speed_ripple": Case({"amplitude": 0.3, "frequency": 0.7}),
    "surface_pattern": Case({"amplitude": 0.15, "wavelength": 0.3}),
    "surface_scatter": Case({"deviation": 0.08}),
    "load_dependence": Case({"exponent": 0.3}, {"rig": {"mass": 1.2}}),
    "spring_misalignment": Case({"angle_deg": 10.0}),
    "stick_stiffness": Case({"ratio": 0.25}),
    "rate_and_state": Case({"direct": 0.01, "evolution": 0.03, "distance": 1e-5}, SLOW),
    "temperature_dependence": Case({"sensitivity": 0.125, "reference_degC": -8.0}),
    "asperity_melting": Case({"length": 1e-3}),
    "melt_film": Case({"wetted_share": 0.01}, window=(0.0, 8.0)),
    "mixed_lubrication": Case({"share": 0.8}, window=(0.0, 8.0)),
}

"""The rig in which each effect is shown: without it, and with it at its case's size."""

from __future__ import annotations

from typing import Any

from stickslip import EFFECTS, Parameters
from stickslip.effects.effect import Case

#: A rig that sticks and slips from the start: pretensioned springs, friction along x.
PLAIN: dict[str, dict[str, Any]] = {
    "rig": {"spring_natural_length": 0.17},
    "surface": {"speed": 0.15},
    "initial": {"vx": 0.15},
}
CASES: dict[str, Case] = {effect.id: effect.case for effect in EFFECTS}


def case_parameters(effect_id: str, on: bool) -> Parameters:
    """The rig of an effect's case, with the effect or without."""
    case = CASES[effect_id]
    tables = {
        name: PLAIN.get(name, {}) | dict(case.rig.get(name, {})) for name in PLAIN | dict(case.rig)
    }
    if on:
        tables[effect_id] = tables.get(effect_id, {}) | dict(case.effect)
    return Parameters.model_validate(tables)

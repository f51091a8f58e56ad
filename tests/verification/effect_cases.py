"""Random sizes of every effect, and rigs in which every effect shows: what several tests draw on.

The range of a parameter is the "typical" one that its field states; the parameters that say where
or how an effect acts, and have no size of their own, get theirs here.
"""

from __future__ import annotations

import random

from stickslip import CATALOGUE, Parameters

IDS = tuple(effect.id for effect in CATALOGUE)
#: Those beside which a stick may creep.
BESIDE_CREEP = tuple(effect for effect in IDS if effect != "rate_and_state")
# log-uniform where both ends are positive, uniform else
ELSEWHERE = {
    "hold_time": (1e-3, 0.1),
    "saturation_time": (0.05, 2.0),
    "curvature": (-1.0, 1.0),
    "neutral_extension": (0.0, 0.03),
    "stribeck_speed": (0.01, 0.3),
    "distance": (0.1, 3.0),
    "phase_deg": (-180.0, 180.0),
    "second_phase_deg": (-180.0, 180.0),
    "correlation_length": (0.005, 0.1),
    "seed": (1, 10**6),
    "reference_force": (3.0, 12.0),
    "reference_degC": (-20.0, -1.0),
}


def draw_block(effect: str, draw: random.Random) -> dict[str, float]:
    """A random size of an effect within its typical ranges."""
    block = next(entry.block for entry in CATALOGUE if entry.id == effect)
    values = {}
    for name, field in block.model_fields.items():
        low, high = field.json_schema_extra.get("typical") or ELSEWHERE[name]
        if name == "seed":
            values[name] = draw.randint(low, high)
        elif low > 0.0:
            values[name] = low * (high / low) ** draw.random()
        else:
            values[name] = draw.uniform(low, high)
    return values


def with_stick_creep(parameters: Parameters, creep: float) -> Parameters:
    """The same, its sticks creeping, m/s."""
    friction = parameters.friction.model_copy(update={"stick_creep": creep})
    return parameters.model_copy(update={"friction": friction})


def draw_parameters(effects: tuple[str, ...], draw: random.Random, **changes) -> Parameters:
    """A random rig that moves in the plane, with the given effects on at random sizes."""
    mu_s = draw.uniform(0.1, 0.4)
    blocks = {
        "rig": {"mass": draw.uniform(0.4, 2.0), "spring_natural_length": draw.uniform(0.17, 0.2)},
        "springs": {"stiffness": draw.uniform(20.0, 140.0)},
        "friction": {"mu_s": mu_s, "mu_k": mu_s * draw.uniform(0.5, 0.95)},
        "lateral_friction": {"ratio": draw.choice([0.0, 1.0, draw.uniform(0.5, 1.0)])},
        "surface": {"speed": draw.uniform(0.05, 0.5), "run_up_time": draw.choice([0.0, 0.5])},
        "initial": {
            "x": draw.uniform(-0.01, 0.01),
            "y": draw.uniform(-0.005, 0.005),
            "phi": draw.uniform(-0.1, 0.1),
        },
    }
    blocks |= {effect: draw_block(effect, draw) for effect in effects}
    return Parameters(**(blocks | changes))

"""Random sizes of every effect, rigs in which every effect shows, and what holds of any rig.

The range of a parameter is the "typical" one that its field states, or the "tried" one of those
that say where or how an effect acts and have no size of their own.
"""

from __future__ import annotations

import random

import numpy as np
from stickslip import EFFECTS, Parameters, simulate
from stickslip.packing import GRAVITY

IDS = tuple(effect.id for effect in EFFECTS)
#: Those beside which a stick may creep.
BESIDE_CREEP = tuple(effect for effect in IDS if effect != "rate_and_state")


def draw_table(effect: str, draw: random.Random) -> dict[str, float]:
    """A random size of an effect within its typical ranges.

    Log-uniform where both ends are positive, uniform else.
    """
    table = next(entry.table for entry in EFFECTS if entry.id == effect)
    values: dict[str, float] = {}
    for name, field in table.model_fields.items():
        extra = field.json_schema_extra
        low, high = extra.get("typical") or extra["tried"]
        if field.annotation is int:
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


def with_transition(parameters: Parameters, speed: float, exponent: float = 1.0) -> Parameters:
    """The same, its friction falling from mu_s to mu_k over a speed, m/s."""
    law = {"transition_speed": speed, "transition_exponent": exponent}
    friction = parameters.friction.model_copy(update=law)
    return parameters.model_copy(update={"friction": friction})


def with_bristles(
    parameters: Parameters,
    distance: float,
    speed: float = 3e-3,
    exponent: float = 1.0,
    damping: float = 0.4,
) -> Parameters:
    """The same, its contact sheared by a distance (m) before it slides."""
    law = {"presliding_distance": distance, "bristle_damping": damping}
    friction = with_transition(parameters, speed, exponent).friction.model_copy(update=law)
    return parameters.model_copy(update={"friction": friction})


def draw_parameters(effects: tuple[str, ...], draw: random.Random, **changes) -> Parameters:
    """A random rig that moves in the plane, with the given effects on at random sizes."""
    mu_s = draw.uniform(0.1, 0.4)
    tables = {
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
    tables |= {effect: draw_table(effect, draw) for effect in effects}
    return Parameters(**(tables | changes))


def assert_ledger_is_closed(parameters, duration, falling):
    """A run of so many seconds, whose ledger closes; its heat falls by no more than a part.

    falling : of the scale of the run's energies; bristles give some of theirs back
    """
    run = simulate(parameters, duration)
    assert run.complete, run.reason
    limit = parameters.friction.mu_s * parameters.rig.mass * GRAVITY
    scale = run["heat"][-1] + limit**2 / (8.0 * parameters.springs.stiffness)
    assert np.max(np.abs(run["energy_residual"])) < 1e-9 * scale
    assert np.all(np.diff(run["heat"]) >= -falling * scale)
    return run


def assert_looking_changes_nothing(parameters, duration):
    """Looked at in the end alone or all along, events and end are the same to the last bit."""
    seldom, often = (simulate(parameters, duration, interval) for interval in (duration, 0.003))
    np.testing.assert_array_equal(seldom.events, often.events)
    for name in ("x", "y", "phi", "heat", "sliding_distance"):
        assert seldom[name][-1] == often[name][-1]

"""Random sizes of every effect, rigs in which every effect shows, and what holds of any rig.

The range of a parameter is the "typical" one that its field states, or the "tried" one of those
that say where or how an effect acts and have no size of their own.
"""

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


def with_friction(parameters: Parameters, **law: float) -> Parameters:
    """The same, some numbers of its friction others."""
    friction = parameters.friction.model_copy(update=law)
    return parameters.model_copy(update={"friction": friction})


def creeping(rig: Parameters, draw: random.Random) -> Parameters:
    """The same, its sticks creeping."""
    return with_friction(rig, stick_creep=draw.choice([1e-5, 1e-3, 2e-2]))


def falling(rig: Parameters, draw: random.Random) -> Parameters:
    """The same, its friction falling from mu_s to mu_k over a speed; some creep in stick, too."""
    return with_friction(
        rig,
        transition_speed=draw.choice([1e-4, 2e-3, 2e-2]),
        transition_exponent=draw.choice([1.0, draw.uniform(0.7, 3.0)]),
        stick_creep=draw.choice([0.0, 1e-3]),
    )


def sheared(rig: Parameters, draw: random.Random) -> Parameters:
    """The same, its contact sheared by a distance before it slides."""
    return with_friction(
        rig, presliding_distance=draw.choice([1e-5, 5e-5, 2e-4]),
        bristle_damping=draw.uniform(0.1, 1.0), transition_speed=10.0 ** draw.uniform(-3.0, -2.0),
        transition_exponent=draw.choice([1.0, draw.uniform(0.7, 3.0)]),
    )  # fmt: skip


def any_rig(contact, draw: random.Random, most: int = 3) -> Parameters:
    """A random rig of such a contact, with so many effects beside it at most."""
    beside = [each for each in BESIDE_CREEP if contact is not sheared or each != "stick_stiffness"]
    return contact(draw_parameters(tuple(draw.sample(beside, draw.randint(0, most))), draw), draw)


def draw_parameters(effects: tuple[str, ...], draw: random.Random, **changes) -> Parameters:
    """A random rig that moves in the plane, with the given effects on at random sizes."""
    mu_s = draw.uniform(0.1, 0.4)
    tables = {
        "rig": {"mass": draw.uniform(0.4, 2.0), "spring_natural_length": draw.uniform(0.17, 0.2)},
        "springs": {"stiffness": draw.uniform(20.0, 140.0)},
        "friction": {"mu_s": mu_s, "mu_k": mu_s * draw.uniform(0.5, 0.95)},
        "lateral_friction": {"ratio": draw.choice([0.0, 1.0, draw.uniform(0.5, 1.0)])},
        "surface": {"speed": draw.uniform(0.05, 0.5), "run_up_time": draw.choice([0.0, 0.5])},
        "initial": {"x": draw.uniform(-0.01, 0.01), "y": draw.uniform(-0.005, 0.005),
                    "phi": draw.uniform(-0.1, 0.1)},
    }  # fmt: skip
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

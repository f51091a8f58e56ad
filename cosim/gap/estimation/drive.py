"""What a run is set to, and what it truly is: surface speed, springs, friction of that day.

Nature does not repeat itself, and no rig is what its file says. A run's surface is a little faster
than its set-point, a set of springs a little stiffer than stated, and friction is another from run
to run. Each is a free parameter ``offset.*``, a part of the number that it belongs to.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
from scipy.interpolate import PchipInterpolator
from stickslip.effects import EFFECTS
from stickslip.effects.candidate import SECOND
from stickslip.kernel import layout
from stickslip.packing import GRAVITY

from cosim.gap.data import MeasuredRun

#: Part by which a run's surface is faster than its set-point.
SPEED_OFFSET = "offset.speed"
#: Logarithm by which mu_s and mu_k of a run are larger than the campaign's.
FRICTION_OFFSET = "offset.friction"
#: Logarithm by which the springs of a set-up (a mass and its springs) are stiffer than stated; the
#: number of the set-up follows.
STIFFNESS_OFFSET = "offset.stiffness_"
#: Logarithm by which the springs seem stiffer in one run.
SPRINGS_OFFSET = "offset.springs"
#: How much less static friction is where the load grows: c in mu_s (1 - c sqrt(r)), s^(1/2).
LOADING = "offset.loading"
#: The least that is left of static friction.
_LEAST_STATIC = 0.3
#: What friction of a run goes by.
SCATTERED = ("friction.mu_s", "friction.mu_k")
#: Speeds and coefficients of a table in place of mu_k, each with its number in brackets, and the
#: coefficients as parts of mu_k, which then says how large they are.
TABLE_SPEED, TABLE, TABLE_PART = (
    "friction.table_speed[",
    "friction.table_mu[",
    "friction.table_part[",
)

#: Travel of the surface in one period of a ripple that a roller makes, m: at another speed it has
#: another frequency.
RIPPLE_LENGTH = "speed_ripple.wavelength"
#: Exponent by which an effect's strength goes with a quantity, ``scaling.<quantity>.<effect>``, and
#: the value of the quantity, SI, at which the strength is what it says, ``reference.<quantity>``.
SCALING, REFERENCE = "scaling.", "reference."


def stiffness_offset(setup: int) -> str:
    """Key of a set-up's free parameter."""
    return f"{STIFFNESS_OFFSET}{setup}"


def model_parameters(set_point: float, values: Mapping[str, float]) -> dict[str, float]:
    """Values as the model has them.

    A ripple's wavelength is the frequency at that speed; a second harmonic has amplitude and phase;
    friction is that of the run.
    """
    flat = dict(values)
    for effect in ("speed_ripple", "surface_pattern"):
        keys = [f"{effect}.{part}" for part in SECOND]
        if all(key in flat for key in keys):
            in_phase, ahead = (flat.pop(key) for key in keys)
            flat[f"{effect}.second_amplitude"] = math.hypot(in_phase, ahead)
            flat[f"{effect}.second_phase_deg"] = math.degrees(math.atan2(ahead, in_phase))
    if RIPPLE_LENGTH in flat:
        flat["speed_ripple.frequency"] = abs(set_point) / flat.pop(RIPPLE_LENGTH)
    if FRICTION_OFFSET in flat:
        factor = math.exp(flat.pop(FRICTION_OFFSET))
        flat.update((key, factor * flat[key]) for key in SCATTERED if key in flat)
    for key in [key for key in flat if key.startswith(TABLE_PART)]:
        flat[TABLE + key.removeprefix(TABLE_PART)] = flat.pop(key) * flat["friction.mu_k"]
    return flat


def table(
    speeds: Sequence[float] | np.ndarray,
    values: Sequence[float] | np.ndarray,
    key: str = TABLE_PART,
) -> dict[str, float]:
    """Settings of a table over the sliding speed, m/s: parts of mu_k, or coefficients."""
    pairs = enumerate(zip(speeds, values, strict=True), 1)
    return {
        name: float(value)
        for number, pair in pairs
        for name, value in zip((f"{TABLE_SPEED}{number}]", f"{key}{number}]"), pair, strict=True)
    }


def parts_at(settings: Mapping[str, float], speeds: np.ndarray) -> np.ndarray:
    """mu at sliding speeds, m/s, as part of mu_k, by a model's settings: 1 without a table."""
    numbers = range(1, layout.CURVE_LIMIT + 1)
    points = [n for n in numbers if f"{TABLE_PART}{n}]" in settings]
    if not points:
        return np.ones(speeds.size)
    known = [settings[f"{TABLE_SPEED}{n}]"] for n in points]
    curve = PchipInterpolator(known, [settings[f"{TABLE_PART}{n}]"] for n in points])
    return curve(np.clip(speeds, known[0], known[-1]))


def strength_keys(effect: str) -> tuple[str, ...]:
    """What an effect's strength is: what turns it on, and the harmonic beside that."""
    return tuple(
        f"{effect}.{name}"
        for each in EFFECTS
        if each.id == effect
        for name in (*each.switch, *SECOND)
    )


def quantities_of(run: MeasuredRun) -> dict[str, float]:
    """What an effect's strength may go with, as it was set: kg, m/s, N/m."""
    return {"mass": run.mass, "speed": abs(run.surface_speed), "stiffness": run.stiffness}


def with_strengths_scaled(
    values: Mapping[str, float], quantities: Mapping[str, float]
) -> dict[str, float]:
    """Values without exponents: strengths s (q / q_0)^n as they are where q is of ``quantities``.

    quantities : mass, speed, stiffness -> value, SI; one without a reference counts from 1
    """
    flat = {k: v for k, v in values.items() if not k.startswith((SCALING, REFERENCE))}
    for key, exponent in values.items():
        if key.startswith(SCALING):
            quantity, effect = key.removeprefix(SCALING).split(".")
            part = abs(quantities[quantity]) / values.get(REFERENCE + quantity, 1.0)
            for strength in strength_keys(effect):
                if strength in flat:
                    flat[strength] *= part**exponent
    return flat


def rig_parameters(
    setup: int, known: Mapping[str, float], values: Mapping[str, float], set_point: float
) -> dict[str, float]:
    """Known numbers of a rig with the fitted ones; springs and static friction as they are."""
    flat = {k: v for k, v in values.items() if not k.startswith(STIFFNESS_OFFSET)}
    part = values.get(stiffness_offset(setup), 0.0) + flat.pop(SPRINGS_OFFSET, 0.0)
    if part != 0.0:
        flat["springs.stiffness"] = known["springs.stiffness"] * math.exp(part)
    return under_load({**known, **flat}, known["springs.stiffness"], known["rig.mass"], set_point)


def under_load(
    values: Mapping[str, float], stiffness: float, mass: float, set_point: float
) -> dict[str, float]:
    """Values with static friction as it is where a surface at ``set_point`` loads a stick.

    A contact whose friction falls with the sliding speed gives way before the load is mu_s N, as
    bristles are sheared the faster the closer it comes; to first order it lacks

        mu_s - mu = 2 sqrt(r Delta z_0 / (mu_s v_s)),     r = 4 k V / (m g),  1/s,

    with Delta = mu_s - mu_k, which falls over v_s, and z_0 the shear at mu_s. So does one that
    creeps by a law of its own. (From LuGre's law, Canudas de Wit et al. 1995, without inertia.)
    """
    flat = dict(values)
    lacking = flat.pop(LOADING, 0.0)
    if lacking:
        rate = 4.0 * stiffness * abs(set_point) / (mass * GRAVITY)
        part = max(1.0 - lacking * math.sqrt(rate), _LEAST_STATIC)
        mu_s = flat["friction.mu_s"]
        flat["friction.mu_s"] = max(part * mu_s, min(flat["friction.mu_k"], mu_s))
    return flat


def driven_speed(set_point: float, values: Mapping[str, float]) -> float:
    """Speed of the surface, m/s."""
    return set_point * (1.0 + values.get(SPEED_OFFSET, 0.0))

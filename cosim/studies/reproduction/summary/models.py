"""The motion of a run of which only figures are known, by either model, and figures of a motion.

The models: the exact one, and the source study's scheme as printed, with effects of the catalogue
under their usual names. The figures: what a report gives where the record is not public.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray
from stickslip import Parameters, simulate
from stickslip.packing import GRAVITY
from stickslip.reference.linearised import Scheme
from stickslip.reference.scheme_effects import SchemeEffects
from stickslip.reference.scheme_errors import PRINTED

from cosim.studies.reproduction.motion import BAND, Motion, time_mean

Array = NDArray[np.float64]

# half range below which nobody sees an oscillation in a plotted record, m
VISIBLE = 5e-4


def figures(motion: Motion) -> dict[str, float]:
    """The figures that a campaign's ``summary`` may hold; NaN for one that the motion has not.

    mean_x, mean_y, amplitude_x (half range), break_away_x, restick_x in m; frequency:
    oscillations of x per second; slip_share: of the time; slip_duration, stick_duration: means of
    whole phases, s; max_rotation_deg: either way.
    """
    half_range = 0.5 * float(np.ptp(motion.x))
    upward = _upward_crossings(motion.time, motion.x) if half_range > VISIBLE else np.empty(0)
    return {
        "mean_x": _cycle_mean(motion.time, motion.x, upward),
        "mean_y": time_mean(motion.time, motion.y),
        "amplitude_x": half_range,
        "frequency": _rate(upward),
        "max_rotation_deg": float(np.degrees(np.abs(motion.phi).max())),
    } | _phase_figures(motion)


def _phase_figures(motion: Motion) -> dict[str, float]:
    begin, end, mode = motion.phases.T
    lasting = end - begin
    inner = slice(1, -1)  # the first and the last are cut
    slips, sticks = mode[inner] == 1, mode[inner] == 0
    x_at = np.interp(begin[inner], motion.time, motion.x)
    return {
        "slip_share": float(lasting[mode == 1].sum() / lasting.sum()),
        "slip_duration": _mean(lasting[inner][slips]),
        "stick_duration": _mean(lasting[inner][sticks]),
        "break_away_x": _mean(x_at[slips]),
        "restick_x": _mean(x_at[sticks]),
    }


def _mean(values: Array) -> float:
    return float(values.mean()) if values.size else math.nan


def _cycle_mean(time: Array, x: Array, upward: Array) -> float:
    """Mean over whole oscillations, as a cut one would tilt it; else over all the time."""
    if len(upward) < 2:
        return time_mean(time, x)
    ends = upward[[0, -1]]
    first, last = np.interp(ends, time, x)
    inside = (time > ends[0]) & (time < ends[1])
    return time_mean(
        np.concatenate([ends[:1], time[inside], ends[1:]]),
        np.concatenate([[first], x[inside], [last]]),
    )


def _upward_crossings(time: Array, x: Array) -> Array:
    """Times at which x has risen through a band about its mean, one an oscillation."""
    away = x - time_mean(time, x)
    band = BAND * float(np.ptp(x))
    side = np.where(away > band, 1, np.where(away < -band, -1, 0))
    seen = np.flatnonzero(side)
    after = seen[1:][(side[seen[1:]] == 1) & (side[seen[:-1]] == -1)]
    # between two rows: a figure must not jump with the rows
    share = (band - away[after - 1]) / (away[after] - away[after - 1])
    return time[after - 1] + share * (time[after] - time[after - 1])


def _rate(upward: Array) -> float:
    """Oscillations per second; none where x does not come back."""
    return float((len(upward) - 1) / (upward[-1] - upward[0])) if len(upward) > 1 else 0.0


# a published run: speed ramp and settling, then what counts (s), and the rows in between
SETTLING, WINDOW, INTERVAL = 10.0, 20.0, 5e-3
# how far off its place a block is put down, standard deviation: m, rad
MISPLACED, TURNED = 1e-3, math.radians(1.0)


def exact_parameters(known: Mapping[str, Mapping], values: Mapping[str, float]) -> Parameters:
    """Tables of a run (`Campaign.parameters`) with ``block.parameter`` -> number laid over them."""
    tables = {block: dict(table) for block, table in known.items()}
    for key, value in values.items():
        block, name = key.split(".", 1)
        tables.setdefault(block, {})[name] = value
    tables["initial"] = {"vx": tables["surface"]["speed"]} | tables.get("initial", {})
    with warnings.catch_warnings(action="ignore"):  # a fit may pass through mu_k > mu_s
        return Parameters.model_validate(tables, strict=True)


def exact_motion(
    known: Mapping[str, Mapping], values: Mapping[str, float], seed: int | None
) -> Motion:
    """The last 20 s of a run of 30 s; the seed says how the block was put down, None: in its place.

    A run that the model gives up is returned as far as it came.
    """
    y, phi = 0.0, 0.0
    if seed is not None:
        y, phi = np.random.default_rng(seed).normal(0.0, (MISPLACED, TURNED)).tolist()
    free = known["rig"]["degrees_of_freedom"]
    start = {"initial.y": y if "y" in free else 0.0, "initial.phi": phi if "phi" in free else 0.0}
    run = simulate(exact_parameters(known, start | dict(values)), SETTLING + WINDOW, INTERVAL)
    motion = Motion.of_trajectory(run)
    return motion.between(min(SETTLING, 0.5 * float(motion.time[-1])))


# the scheme counts one spring of four in stick: in the catalogue's words, this part of the load
PRINTED_RATIO = 0.25
# standard deviation of mu_k over strips and samples; the study uses one and does not print it
SCATTER = 0.02
# the study's run: 10 cycles to settle, 15 that count; a slip is cut after LONGEST_SLIP (s)
CYCLES, STEADY, LONGEST_SLIP = 25, 0.6, 1.0

# parameter of the catalogue -> the scheme's number, and what it is multiplied by
NUMBERS = {
    "lateral_friction.ratio": ("lateral", 1.0),
    "static_strengthening.rate": ("ageing", 1.0),
    "static_strengthening.hold_time": ("hold_time", 1.0),
    "film_drag.coefficient": ("film", 1.0),
    "thermal_weakening.per_joule": ("weakening_per_joule", 1.0),
    "thermal_weakening.relaxation_time": ("relaxation", 1.0),
    "run_in.change": ("run_in", 1.0),
    "run_in.distance": ("run_in_distance", 1.0),
    "spring_hardening.cubic": ("cubic", 1.0),
    "structural_damping.coefficient": ("damping", 1.0),
    "structural_damping.rotational": ("damping_rotation", 1.0),
    "speed_ripple.amplitude": ("ripple", 1.0),
    "speed_ripple.frequency": ("ripple_rate", 2.0 * math.pi),
    "speed_ripple.phase_deg": ("ripple_phase", math.pi / 180.0),
    "surface_pattern.amplitude": ("pattern", 1.0),
    "surface_pattern.phase_deg": ("pattern_phase", math.pi / 180.0),
    "stick_stiffness.ratio": ("stick_springs", 4.0),
    "spring_misalignment.angle_deg": ("spring_angle", math.pi / 180.0),
    "spring_misalignment.lateral_offset": ("anchor_offset", 1.0),
}
# what the scheme takes elsewhere than among its effects
ELSEWHERE = (
    "friction.mu_s", "friction.mu_k", "rig.mass", "springs.stiffness", "surface.speed",
    "rig.spring_length", "rig.attachment_radius", "turning_surface.curvature",
    "velocity_weakening.linear", "surface_pattern.wavelength", "load_dependence.exponent",
    "load_dependence.reference_force",
)  # fmt: skip


def has_meaning(parameter: str) -> bool:
    """Does the scheme have a place for this parameter of the catalogue?"""
    return parameter in NUMBERS or parameter in ELSEWHERE


def scheme_of(values: Mapping[str, float]) -> Scheme:
    """The printed scheme for ``block.parameter`` -> number; KeyError for one without a meaning.

    velocity_weakening.linear is the study's own law of friction over speed.
    """
    unknown = [key for key in values if not has_meaning(key)]
    if unknown:
        raise KeyError(f"{unknown[0]} has no meaning in the study's scheme")
    mass = values["rig.mass"]
    load = mass * GRAVITY / values.get("load_dependence.reference_force", mass * GRAVITY)
    factor = load ** -values.get("load_dependence.exponent", 0.0)
    mu_k = factor * values["friction.mu_k"]
    weakening = values.get("velocity_weakening.linear", 0.0)
    return Scheme(
        mass=mass,
        stiffness=values["springs.stiffness"],
        speed=values["surface.speed"],
        mu_s=factor * values["friction.mu_s"],
        mu_k=mu_k,
        mu_slope=weakening * mu_k,
        mu_k_speed=0.0,
        scatter=SCATTER,
        curvature=values.get("turning_surface.curvature", 0.0),
        radius=values.get("rig.attachment_radius", 0.05),
        spring_length=values.get("rig.spring_length", 0.20),
        faults=PRINTED,
        effects=_effects(values),
    )


def _effects(values: Mapping[str, float]) -> SchemeEffects:
    numbers = {
        name: factor * values[key] for key, (name, factor) in NUMBERS.items() if key in values
    }
    if "surface_pattern.wavelength" in values:
        numbers["pattern_wavenumber"] = 2.0 * math.pi / values["surface_pattern.wavelength"]
    # counting springs otherwise needs none of the terms that cost time
    return SchemeEffects(on=bool(set(numbers) - {"stick_springs"}), **numbers)


def study_motion(known: Mapping[str, Mapping], values: Mapping[str, float], seed: int) -> Motion:
    """The steady part of the study's run: the last 60 % of 25 cycles from rest.

    known: tables of a run (`Campaign.parameters`); the scheme takes of the rig what it has a place
    for. The seed is that of the scatter. A cycle slips for at most a second, where the scheme cuts
    it, and sticks for at most twice the travel to break-away with one spring: the run ends where 25
    of those would.
    """
    mass, stiffness = known["rig"]["mass"], known["springs"]["stiffness"]
    speed, mu_s = known["surface"]["speed"], values["friction.mu_s"]
    numbers = dict(values) | {
        "rig.mass": mass,
        "springs.stiffness": stiffness,
        "surface.speed": speed,
        "rig.spring_length": known["rig"]["spring_length"],
        "rig.attachment_radius": known["rig"]["attachment_radius"],
    }
    stick = 2.0 * mu_s * mass * GRAVITY / (stiffness * abs(speed))
    duration = CYCLES * (LONGEST_SLIP + stick)
    run = scheme_of(numbers).run(cycles=CYCLES, duration=duration, seed=seed)
    motion = Motion.of_scheme(run)
    return motion.between((1.0 - STEADY) * float(motion.time[-1]))

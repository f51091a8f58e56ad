"""The source study's scheme as printed, with effects of the catalogue under their usual names."""

from __future__ import annotations

import math
from collections.abc import Mapping

from stickslip.packing import GRAVITY
from stickslip.reference.faults import PRINTED
from stickslip.reference.linearised import Scheme
from stickslip.reference.scheme_effects import SchemeEffects

from .motion import Motion

# the scheme counts one spring of four in stick: in the catalogue's words, this part of the load
PRINTED_RATIO = 0.25
# standard deviation of mu_k over strips and samples; the study uses one and does not print it
SCATTER = 0.02
# the study's run: 10 cycles to settle, 15 that count; a slip is cut after LONGEST_SLIP (s)
CYCLES, STEADY, LONGEST_SLIP = 25, 0.6, 1.0

# parameter of the catalogue -> the scheme's number, and what it is multiplied by
NUMBERS = {
    "lateral_friction.ratio": ("lateral", 1.0),
    "static_strengthening.rate": ("strengthening", 1.0),
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
    it, and sticks for at most twice the way to break-away with one spring: the run ends where 25
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
    return motion.since((1.0 - STEADY) * float(motion.time[-1]))

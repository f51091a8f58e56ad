"""The motion of a run of which only figures are known, by either model, and figures of a motion.

The models: the exact one, and the source study's scheme as printed, with effects of the catalogue
under their usual names. The figures: what a report gives where the record is not public.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np
from stickslip import Parameters, simulate
from stickslip.packaged import packaged_tables
from stickslip.packing import GRAVITY
from stickslip.reference.linearised import Scheme
from stickslip.reference.scheme_effects import SchemeEffects
from stickslip.reference.scheme_errors import PRINTED

from cosim.gap.data import Campaign, MeasuredRun

from ..cases import CYCLES, SAMPLE, SCATTER, SETTLING, STEADY, Case, longest
from ..motion import WINDOW, Motion
from ..motion import figures as read_off

Values = Mapping[str, float]  # block.parameter -> number

CATALOGUE = packaged_tables(__package__, "catalogue.toml")
SAID: dict[str, str] = CATALOGUE["said"]
# half range below which nobody sees an oscillation in a plotted record, m
VISIBLE = 5e-4
# how far off its place a block is put down, standard deviation: m, rad
MISPLACED, TURNED = 1e-3, math.radians(1.0)


def figures(motion: Motion) -> dict[str, float]:
    """The figures that a campaign's ``summary`` may hold; NaN for one that the motion has not.

    As `motion.figures` has them; a frequency of 0: x does not come back.
    """
    found = read_off(motion, between_rows=True, visible=VISIBLE)
    frequency = float(np.nan_to_num(found["frequency"]))
    return found | {"frequency": frequency, "max_rotation_deg": found["max_rotation"]}


def motion_of(campaign: Campaign, run: MeasuredRun, values: Values, seed: int | None) -> Motion:
    """The steady part of a run of the campaign's model.

    The seed is that of the scheme's scatter, or says how the exact model's block was put down;
    None: in its place.
    """
    known = campaign.parameters(run)
    if campaign.scheme == "study":
        return _study_motion(known, values, seed or 0)
    return _exact_motion(known, values, seed)


def _exact_motion(
    known: Mapping[str, Mapping[str, Any]], values: Values, seed: int | None
) -> Motion:
    """The last 20 s of a run of 30 s; one that the model gives up is taken as far as it came."""
    y, phi = 0.0, 0.0
    if seed is not None:
        y, phi = np.random.default_rng(seed).normal(0.0, (MISPLACED, TURNED)).tolist()
    free = known["rig"]["degrees_of_freedom"]
    start = {"initial.y": y if "y" in free else 0.0, "initial.phi": phi if "phi" in free else 0.0}
    tables: dict[str, dict[str, Any]] = {block: dict(table) for block, table in known.items()}
    for key, value in (start | dict(values)).items():
        block, name = key.split(".", 1)
        tables.setdefault(block, {})[name] = value
    tables["initial"] = {"vx": tables["surface"]["speed"]} | tables["initial"]
    with warnings.catch_warnings(action="ignore"):  # a fit may pass through mu_k > mu_s
        parameters = Parameters.model_validate(tables, strict=True)
    motion = Motion.of_trajectory(simulate(parameters, SETTLING + WINDOW, SAMPLE))
    return motion.between(min(SETTLING, 0.5 * float(motion.time[-1])))


def _study_motion(known: Mapping[str, Mapping[str, Any]], values: Values, seed: int) -> Motion:
    """The steady part of the study's run, from rest: of the rig what the scheme has a place for."""
    rig = {key: known["rig"][key] for key in ("mass", "spring_length", "attachment_radius")}
    numbers = dict(values) | {f"rig.{key}": value for key, value in rig.items()}
    numbers["springs.stiffness"] = known["springs"]["stiffness"]
    numbers["surface.speed"] = speed = known["surface"]["speed"]
    case = Case(rig["mass"], numbers["springs.stiffness"], abs(speed), values["friction.mu_s"])
    run = scheme_of(numbers).run(cycles=CYCLES, duration=longest(case), seed=seed)
    return Motion.of_scheme(run).last(STEADY)


def has_meaning(parameter: str) -> bool:
    """Does the scheme have a place for this parameter of the catalogue?"""
    return any(parameter in CATALOGUE[table] for table in ("scheme", "rig", "law"))


def scheme_of(values: Values) -> Scheme:
    """The printed scheme for ``block.parameter`` -> number; KeyError for one without a meaning.

    velocity_weakening.linear is the study's own law of friction over speed.
    """
    unknown = [key for key in values if not has_meaning(key)]
    if unknown:
        raise KeyError(f"{unknown[0]} has no meaning in the study's scheme")
    weight = values["rig.mass"] * GRAVITY
    load = weight / values.get("load_dependence.reference_force", weight)
    factor = load ** -values.get("load_dependence.exponent", 0.0)
    mu_k = factor * values["friction.mu_k"]
    effects, numbers = (
        {name: times * values[key] for key, (name, times) in table.items() if key in values}
        for table in (CATALOGUE["scheme"], CATALOGUE["rig"])
    )
    if "surface_pattern.wavelength" in values:
        effects["pattern_wavenumber"] = 2.0 * math.pi / values["surface_pattern.wavelength"]
    return Scheme(
        mu_s=factor * values["friction.mu_s"],
        mu_k=mu_k,
        mu_slope=values.get("velocity_weakening.linear", 0.0) * mu_k,
        mu_k_speed=0.0,
        scatter=SCATTER,
        faults=PRINTED,
        # counting springs otherwise needs none of the terms that cost time
        effects=SchemeEffects(on=bool(set(effects) - {"stick_springs"}), **effects),
        **numbers,
    )

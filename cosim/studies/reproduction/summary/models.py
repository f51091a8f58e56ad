"""The motion of a run of which only figures are known, by either model, and figures of a motion.

The models: the exact one, and the source study's scheme as printed, with effects of the catalogue
under their usual names. The figures: what a report gives where the record is not public.

What may be added to a model: every effect of the catalogue, with the ranges of its numbers.
"""

import math
import warnings
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Self

import numpy as np
from scipy.stats import truncnorm
from stickslip import Parameters, simulate
from stickslip.effects import EFFECTS
from stickslip.packaged import packaged_tables
from stickslip.packing import GRAVITY
from stickslip.quantity import details
from stickslip.reference.linearised import Scheme
from stickslip.reference.scheme_options import PRINTED, SchemeEffects

from ....gap.data import Campaign, MeasuredRun
from ....scenario.toml_file import changed_tables
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
    found = read_off(motion, visible=VISIBLE)
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
    moving = {"initial.vx": known["surface"]["speed"]}
    tables = changed_tables(known, moving | start | dict(values))
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


# the study's coefficients, the four figures that it prints; how well they are known it does not
# say, a tenth is what its scatter is taken to be
STUDY_FRICTION = {"mu_s": (0.2815, 0.028), "mu_k": (0.2086, 0.021)}
UNKNOWN_FRICTION = (0.02, 0.8)
FURTHEST = 3.0  # standard deviations that a known number may be off
# the scheme counts one spring of four in stick: in the catalogue's words, this part of the load
PRINTED_RATIO = 0.25
TABLES = {entry.id: entry.table for entry in EFFECTS}


@dataclass(frozen=True)
class Span:
    """A number that is searched: ``block.parameter`` and its range.

    prior: value and standard deviation where it is known. log: evenly over decades.
    """

    key: str
    low: float
    high: float
    prior: tuple[float, float] | None = None
    log: bool = False

    @property
    def of_friction(self) -> bool:
        """Is it a coefficient that every model has?"""
        return self.key.startswith("friction.")

    def at(self, share: float) -> float:
        """The number below which ``share`` (0 ... 1) of what is expected lies."""
        if self.prior:
            value, sd = self.prior
            low, high = (self.low - value) / sd, (self.high - value) / sd
            return float(truncnorm.ppf(share, low, high, value, sd))
        if self.log:
            return float(self.low * (self.high / self.low) ** share)
        return self.low + share * (self.high - self.low)


@dataclass(frozen=True)
class Candidate:
    """A model to try: the effects in it, the law's form, what is searched and what is set."""

    effects: tuple[str, ...]
    form: str
    spans: tuple[Span, ...]
    settings: Mapping[str, float] = field(default_factory=dict)

    @property
    def off(self) -> dict[str, float]:
        """Values of what is searched with which the last effect is not there."""
        pairs = [span.key.split(".") for span in self.spans]
        return {
            f"{block}.{name}": float(TABLES[block].model_fields[name].default)
            for block, name in pairs
            if block in self.effects[-1:]
        }

    def values(self, shares: Iterable[float]) -> dict[str, float]:
        """block.parameter -> number, of shares (p,) of the ranges; what is set, too."""
        pairs = zip(self.spans, shares, strict=True)
        found = dict(self.settings) | {span.key: float(span.at(share)) for span, share in pairs}
        # a contact at rest holds at least what it holds in sliding
        return found | {"friction.mu_k": min(found["friction.mu_k"], found["friction.mu_s"])}

    def surprise(self, values: Mapping[str, float]) -> float:
        """Squared distance of known numbers from what is known, in standard deviations."""
        known = [(values[span.key], *span.prior) for span in self.spans if span.prior]
        return sum(((number - value) / sd) ** 2 for number, value, sd in known)

    @property
    def added(self) -> int:
        """Numbers that it has beside friction."""
        return sum(not span.of_friction for span in self.spans)

    @property
    def free(self) -> Self:
        """The same model, with friction that nothing is known of."""
        spans = [_coefficient(span.key) if span.of_friction else span for span in self.spans]
        return replace(self, spans=tuple(spans))


def _coefficient(key: str, known: tuple[float, float] | None = None) -> Span:
    """One of friction; known: value and standard deviation."""
    if known is None:
        return Span(key, *UNKNOWN_FRICTION, log=True)
    value, reach = known[0], FURTHEST * known[1]
    return Span(key, max(value - reach, 1e-3), value + reach, prior=known)


def plain_candidate(campaign: Campaign) -> Candidate:
    """The model as it is; mu_s and mu_k known as the campaign says, or as the study does."""
    is_study = campaign.scheme == "study"
    known = (STUDY_FRICTION if is_study else {}) | dict(campaign.friction)
    spans = [_coefficient(f"friction.{name}", known.get(name)) for name in STUDY_FRICTION]
    settings = {"stick_stiffness.ratio": PRINTED_RATIO} if is_study else {}
    return Candidate((), "", tuple(spans), settings)


def extensions(campaign: Campaign, base: Candidate) -> tuple[Candidate, ...]:
    """``base`` with each effect that is not in it, in the catalogue's order, form by form."""
    left_out = {*base.effects, *not_felt(campaign)}
    if campaign.rig.surface == "slab":
        left_out.add("turning_surface")  # known: the rig says how far its centre is
    found = []
    for form in CATALOGUE["form"]:
        effect, settings = form["effect"], form.get("set", {})
        spans = tuple(_span(effect, number) for number in form.get("searched", ()))
        keys = [*(span.key for span in spans), *settings]
        told = campaign.scheme != "study" or all(map(has_meaning, keys))
        if told and effect not in left_out:
            kept = {key: value for key, value in base.settings.items() if key not in keys}
            effects = (*base.effects, effect)
            found.append(Candidate(effects, form["name"], base.spans + spans, kept | settings))
    return tuple(found)


def not_felt(campaign: Campaign) -> dict[str, str]:
    """Effects that no figure of the campaign can tell from none: id -> why."""
    found = {}
    if len({run.mass for run in campaign.runs if run.summary}) == 1:
        found["load_dependence"] = "all runs have one mass: the same as other coefficients"
    if campaign.scheme == "exact" and campaign.rig.degrees_of_freedom == ("x",):
        found |= dict.fromkeys(("lateral_friction", "turning_surface"), "the rig allows only x")
    return found


def _span(effect: str, number: str) -> Span:
    name, _, scale = number.partition(" ")
    key = f"{effect}.{name}"
    low, high = CATALOGUE["range"].get(key) or details(TABLES[effect].model_fields[name])["typical"]
    return Span(key, low, high, log=scale == "log")

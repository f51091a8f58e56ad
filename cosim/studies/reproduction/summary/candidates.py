"""What may be added to the model: every effect of the catalogue, with the ranges of its numbers.

The ranges are the catalogue's own (where an effect shows in a rig of this kind), so that nothing
here prefers one effect to another.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from scipy.stats import norm
from stickslip.effects import EFFECTS
from stickslip.quantity import details

from cosim.gap.data import Campaign

from .models import PRINTED_RATIO, has_meaning

# the study's coefficients, the four figures that it prints; how well they are known it does not
# say, a tenth is what its scatter is taken to be
STUDY_FRICTION = {"mu_s": (0.2815, 0.028), "mu_k": (0.2086, 0.021)}
UNKNOWN_FRICTION = (0.02, 0.8)
FURTHEST = 3.0  # standard deviations that a known number may be off


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

    def at(self, share: float) -> float:
        """The number below which ``share`` (0 ... 1) of what is expected lies."""
        if self.prior:
            value, sd = self.prior
            low, high = norm.cdf((self.low - value) / sd), norm.cdf((self.high - value) / sd)
            return float(value + sd * norm.ppf(low + share * (high - low)))
        if self.log:
            return math.exp(math.log(self.low) + share * math.log(self.high / self.low))
        return self.low + share * (self.high - self.low)

    def surprise(self, number: float) -> float:
        """Squared distance from what is known, in standard deviations; 0 where nothing is."""
        return ((number - self.prior[0]) / self.prior[1]) ** 2 if self.prior else 0.0


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
        blocks = {entry.id: entry.table for entry in EFFECTS}
        keys = [span.key.split(".") for span in self.spans] if self.effects else []
        return {
            f"{block}.{name}": float(blocks[block].model_fields[name].default)
            for block, name in keys
            if block == self.effects[-1]
        }

    @property
    def added(self) -> int:
        """Numbers that it has beside friction."""
        return sum(not span.key.startswith("friction.") for span in self.spans)


def friction_spans(campaign: Campaign) -> tuple[Span, ...]:
    """mu_s and mu_k: known as the campaign says, or as the study does; else free."""
    given = STUDY_FRICTION if campaign.scheme == "study" else {}
    spans = []
    for name, known in (given | dict(campaign.friction)).items():
        value, sd = known
        low, high = max(value - FURTHEST * sd, 1e-3), value + FURTHEST * sd
        spans.append(Span(f"friction.{name}", low, high, prior=(value, sd)))
    there = {span.key for span in spans}
    for name in ("mu_s", "mu_k"):
        if f"friction.{name}" not in there:
            spans.append(Span(f"friction.{name}", *UNKNOWN_FRICTION, log=True))
    return tuple(sorted(spans, key=lambda span: span.key, reverse=True))


def plain_candidate(campaign: Campaign) -> Candidate:
    """The model as it is, friction refitted within what is known of it."""
    settings = {}
    if campaign.scheme == "study":
        settings["stick_stiffness.ratio"] = PRINTED_RATIO
    return Candidate((), "", friction_spans(campaign), settings)


Form = tuple[tuple[str, ...], dict[str, float]]
#: effect -> forms: what is searched (log: evenly over decades), what is set
_ACROSS = {"lateral_friction.ratio": 1.0}
_FORMS: dict[str, dict[str, Form]] = {
    "lateral_friction": {"isotropic": ((), _ACROSS)},
    "turning_surface": {"disc friction": (("curvature",), _ACROSS)},
    "static_strengthening": {"logarithmic": (("rate log",), {})},
    "velocity_weakening": {"linear": (("linear",), {})},
    "film_drag": {"linear": (("coefficient log",), {})},
    "thermal_weakening": {"relaxing": (("per_joule log", "relaxation_time log"), {})},
    "run_in": {"exponential": (("change", "distance log"), {})},
    "spring_hardening": {"cubic": (("cubic log",), {})},
    "structural_damping": {
        "along": (("coefficient log",), {}),
        "in rotation": (("rotational log",), {}),
    },
    "speed_ripple": {"sine": (("amplitude", "frequency log"), {})},
    "surface_pattern": {"sine": (("amplitude", "wavelength log"), {})},
    "load_dependence": {"power law": (("exponent",), {})},
    "spring_misalignment": {"angle": (("angle_deg",), {}), "offset": (("lateral_offset",), {})},
    "stick_stiffness": {"part of the springs": (("ratio",), {})},
}
#: numbers for which the catalogue names no typical range, or one for another purpose
_RANGES = {
    "run_in.distance": (0.1, 10.0),
    # from the study's one spring to all four: whichever the model starts from
    "stick_stiffness.ratio": (PRINTED_RATIO, 1.0),
}


def extensions(campaign: Campaign, base: Candidate) -> tuple[Candidate, ...]:
    """``base`` with each effect that is not in it, in the catalogue's order, form by form."""
    found = []
    for effect in EFFECTS:
        if effect.id in base.effects:
            continue
        for form, (numbers, settings) in _FORMS.get(effect.id, {}).items():
            spans = tuple(_span(effect.id, number) for number in numbers)
            keys = [span.key for span in spans] + list(settings)
            if campaign.scheme == "study" and not all(map(has_meaning, keys)):
                continue
            if effect.id in not_felt(campaign):
                continue
            if effect.id == "turning_surface" and campaign.rig.surface == "slab":
                continue  # known: the rig says how far its centre is
            kept = {key: value for key, value in base.settings.items() if key not in keys}
            found.append(
                Candidate((*base.effects, effect.id), form, base.spans + spans, kept | settings)
            )
    return tuple(found)


def not_felt(campaign: Campaign) -> dict[str, str]:
    """Effects that no figure of the campaign can tell from none: id -> why."""
    found = {}
    if len({run.mass for run in campaign.runs if run.summary}) == 1:
        found["load_dependence"] = "all runs have one mass: the same as other coefficients"
    if campaign.scheme == "exact" and campaign.rig.degrees_of_freedom == ("x",):
        guided = "the rig allows only x"
        found |= dict.fromkeys(("lateral_friction", "turning_surface"), guided)
    return found


def free_candidate(candidate: Candidate) -> Candidate:
    """The same model, with friction that nothing is known of."""
    free = tuple(
        Span(s.key, *UNKNOWN_FRICTION, log=True) if s.key.startswith("friction.") else s
        for s in candidate.spans
    )
    return Candidate(candidate.effects, candidate.form, free, candidate.settings)


def _span(effect: str, number: str) -> Span:
    name, _, scale = number.partition(" ")
    key = f"{effect}.{name}"
    if key in _RANGES:
        return Span(key, *_RANGES[key], log=scale == "log")
    tables = {entry.id: entry.table for entry in EFFECTS}
    low, high = details(tables[effect].model_fields[name])["typical"]
    return Span(key, low, high, log=scale == "log")

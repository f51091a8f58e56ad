"""Laws of the catalogue in the rows of a planned campaign: one number says how much there is.

A law is followed along the nodes of its argument's curve (`cosim.gap.laws`), so that it is the
unknown by which the ladder would find it; so are waves and the trend with the load.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from stickslip.effects.effect import Candidate, Effect, no_candidates
from stickslip.quantity import details

from cosim.gap.laws import SHAPES, Context, scales_of
from cosim.gap.quantities import WORDS
from cosim.gap.rates import Option, option_of_wave
from cosim.gap.weak_form import periodic
from cosim.gap.weak_form.added import Added
from cosim.gap.weak_form.constants import HARMONICS, SCALES_ASKED
from cosim.gap.weak_form.system import System
from cosim.gap.weak_form.unknowns import Unknown

#: Turn of a wave's phase from one run to the next, rad: by the golden angle no two are alike.
GOLDEN = np.pi * (3.0 - np.sqrt(5.0))
#: Why an effect cannot be seen, where it is not the runs.
WHY: dict[str, str] = WORDS["not_planned"]
HEAT = "thermal_weakening.relaxation_time"


@dataclass(frozen=True)
class Law:
    """A law whose size is one number.

    Attributes
    ----------
    argument : by which the ladder knows it; candidate : as the catalogue has it
    neutral, most : values of its first free parameter where it is nothing, and at most
    unknown, sizes : whose columns times sizes(value) (q,) are what it does to the rows
    part : of friction, that a size of 1 stands for
    wave : how the ladder would find it where it is periodic
    unit : of that parameter
    """

    argument: str
    candidate: Candidate
    unknown: Unknown
    sizes: Callable[[float], np.ndarray]
    neutral: float
    most: float
    unit: str
    part: float = 1.0
    wave: Option | None = None

    @property
    def key(self) -> str:
        """`block.parameter` of its size."""
        return self.candidate.free_parameters[0].key

    @property
    def range(self) -> float:
        """How far from nothing its parameter may be."""
        return abs(self.most - self.neutral)

    def value(self, away: float) -> float:
        """The parameter so far from where it is nothing."""
        return self.neutral + float(np.copysign(away, self.most - self.neutral))

    def among(self, laws: Sequence[Law]) -> Law | None:
        """The same law in the rows of other runs; None where they cannot show it."""
        same = (law for law in laws if law.key == self.key and law.value(1.0) == self.value(1.0))
        return next(same, None)

    def blocks(self, value: float) -> dict[str, dict[str, float]]:
        """Tables of `Parameters` with the law at a value of its size."""
        given = _starts(self.candidate) | {self.key: value}
        if "memory" in self.unknown.settings:
            given[HEAT] = self.unknown.settings["memory"]
        blocks: dict[str, dict[str, float]] = {}
        for key, number in given.items():
            block, _, name = key.partition(".")
            blocks.setdefault(block, {})[name] = number
        return blocks

    def percent(self, value: float) -> float:
        """By which friction differs within these runs, percent of it; a constant is no change."""
        sizes = self.sizes(value)
        return 100.0 * self.part * float(np.ptp(sizes) if sizes.size > 1 else abs(sizes[0]))


def laws_of(system: System, unknowns: Mapping[str, Sequence[Unknown]]) -> list[Law]:
    """The simplest law of each effect in each direction, of those that the runs can show."""
    scales = scales_of(system.campaign, system.runs, system.level.kinetic)
    context = Context(system.campaign, scales, {"mu_s": system.level.static})
    found: dict[tuple[str, float], Law] = {}
    for effect in system.campaign.catalogue.effects:
        for candidate in effect.candidates(scales) if effect.offered else ():
            if not candidate.free_parameters:
                laws: Iterator[Law] = iter(())
            elif candidate.periodic:
                laws = _waves(system, effect, candidate)
            elif candidate.form == "power law":
                laws = _of_load(unknowns, effect, candidate)
            else:
                laws = _along_curves(system, unknowns, context, effect, candidate)
            for law in laws:
                way = float(np.sign(law.most - law.neutral))
                found.setdefault((candidate.periodic or effect.id, way), law)
    return list(found.values())


def silent(laws: Sequence[Law], effects: Sequence[Effect]) -> dict[str, str]:
    """effect -> why no size is told, of those that `gap` offers."""
    there = {law.candidate.effect for law in laws}
    offered = {one.id for one in effects if one.offered and one.candidates is not no_candidates}
    asked = [one.id for one in effects if one.id in offered | set(WHY)]
    return {one: WHY.get(one, "these runs cannot show it") for one in asked if one not in there}


def _starts(candidate: Candidate) -> dict[str, float]:
    """`block.parameter` -> what it is set to, or starts from; no phases of runs."""
    free = {one.key: one.start for one in candidate.free_parameters if not one.per_run}
    return {**free, **candidate.settings}


def _range(effect: Effect, candidate: Candidate) -> dict[str, Any]:
    """Of the size: where it is nothing, what the catalogue has as its most, and its unit."""
    free = candidate.free_parameters[0]
    field = effect.table.model_fields[free.key.rpartition(".")[2]]
    most = free.high if free.start > field.default else free.low
    return {"neutral": field.default, "most": most, "unit": details(field)["unit"]}


def _of_load(
    unknowns: Mapping[str, Sequence[Unknown]], effect: Effect, candidate: Candidate
) -> Iterator[Law]:
    """A power of the normal force is a trend with its logarithm."""
    for unknown in unknowns.get("load_dependence", ()):
        sizes = partial(np.multiply, np.array([-unknown.settings["span"]]))
        yield Law("load_dependence", candidate, unknown, sizes, **_range(effect, candidate))


def _along_curves(
    system: System, unknowns: Mapping[str, Sequence[Unknown]], context: Context,
    effect: Effect, candidate: Candidate,
) -> Iterator[Law]:  # fmt: skip
    """A law along the nodes of an argument's curve, of the variant that is nearest to it."""
    force = system.level.kinetic * context.scales.force
    starts = _starts(candidate)
    memory = starts.get(HEAT, 1.0)
    for name in unknowns:
        law = SHAPES[name](effect, context) if name in SHAPES else None
        fitting = [one for one in unknowns[name] if not one.settings.get("per_weight")]
        if law is None or not fitting or not context.allows(effect, candidate):
            continue
        unknown = min(fitting, key=lambda u: abs(np.log(u.settings.get("memory", memory) / memory)))
        if unknown.curve is None:
            continue
        nodes, unit = unknown.curve.nodes, force if unknown.curve.per == "N" else 1.0
        if name == "spring_hardening":
            stiffness = [run.track.run.total_stiffness for run in system.runs]
            unit = float(nodes[-1] * np.mean(stiffness))
        known = {key: field.default for key, field in effect.table.model_fields.items()}
        known |= {key.rpartition(".")[2]: value for key, value in starts.items()}
        known["relaxation_time"] = unknown.settings.get("memory", memory)
        size, own = _range(effect, candidate), candidate.free_parameters[0].key.rpartition(".")[2]
        sizes = partial(_curve, law, nodes, known, own, size["neutral"], unit)
        part = unit / force if unknown.curve.per == "N" else 1.0
        yield Law(name, candidate, unknown, sizes, part=part, **size)


def _curve(
    law: Callable[[np.ndarray, Mapping[str, float]], np.ndarray], nodes: np.ndarray,
    known: Mapping[str, float], own: str, neutral: float, unit: float, value: float,
) -> np.ndarray:  # fmt: skip
    """(q,) what a law's own number makes of it beyond a neutral one, in units of its curve."""
    there, nothing = (law(nodes, {**known, own: each}) for each in (value, neutral))
    return np.asarray((there - nothing) / unit)


def _waves(system: System, effect: Effect, candidate: Candidate) -> Iterator[Law]:
    """A cosine of the catalogue's first period, within what the scan looks at."""
    start = _starts(candidate)[candidate.periodic]
    in_time = candidate.periodic.endswith("frequency")
    phases = {run.track.run.name: GOLDEN * n for n, run in enumerate(system.runs)}
    for kind in periodic.kinds(system.level.kinetic):
        wavenumbers = periodic.wavenumbers_of(system.fitted, kind)
        if kind.name != effect.id or (kind.unit == "s") != in_time or not wavenumbers.size:
            continue
        wavenumber = float(np.clip(start if in_time else 1.0 / start, *wavenumbers[[0, -1]]))
        wave = periodic.Wave(kind, wavenumber, phases)
        first, speeds = np.eye(2 * HARMONICS)[0], periodic.speeds_of(system.rung(), kind)
        parts = [Added(one) for one in (wave.shape(), *wave.moves(first, system.fitted, speeds))]
        option, sizes = option_of_wave(parts, system, SCALES_ASKED), partial(np.multiply, first)
        size = _range(effect, candidate)
        yield Law(effect.id, candidate, parts[0].unknown, sizes, wave=option, **size)

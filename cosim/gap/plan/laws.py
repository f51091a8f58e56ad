"""Laws of the catalogue in the rows of a planned campaign: one number says how much there is.

A law is followed along the nodes of its argument's curve (`cosim.gap.laws`), so that it is the
unknown by which the ladder would find it; so are waves and the trend with the load.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import block_diag
from stickslip import EFFECTS
from stickslip.effects.candidate import Candidate, Scales
from stickslip.effects.effect import Effect, no_candidates

from cosim.gap.laws import SHAPES, Context, scales_of
from cosim.gap.rates import Option, factor_of, price_of_scan
from cosim.gap.weak_form import periodic
from cosim.gap.weak_form.constants import HARMONICS, SCALES_ASKED, SCAN_STEPS
from cosim.gap.weak_form.system import Added, System
from cosim.gap.weak_form.unknowns import Unknown

#: Turn of a wave's phase from one run to the next, rad: by the golden angle no two are alike.
GOLDEN = np.pi * (3.0 - np.sqrt(5.0))
#: Why an effect cannot be seen, where it is not the runs.
ACROSS = "told by y and phi, which are not planned"
WHY = {
    "load_dependence": "all runs have the same load",
    "static_strengthening": "hold times hardly differ, or nothing sticks",
    "stick_stiffness": "along x the same as another mu_s",
    **dict.fromkeys(("lateral_friction", "turning_surface", "spring_misalignment"), ACROSS),
}


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
    """

    argument: str
    candidate: Candidate
    neutral: float
    most: float
    unknown: Unknown
    sizes: Callable[[float], np.ndarray]
    part: float = 1.0
    wave: Option | None = None

    @property
    def key(self) -> str:
        """`block.parameter` of its size."""
        return self.candidate.free_parameters[0].key

    def value(self, away: float) -> float:
        """The parameter so far from where it is nothing."""
        return self.neutral + float(np.copysign(away, self.most - self.neutral))

    def blocks(self, value: float) -> dict[str, dict[str, float]]:
        """Tables of `Parameters` with the law at a value of its size."""
        free = self.candidate.free_parameters
        given = {one.key: one.start for one in free if not one.per_run}
        given |= {**self.candidate.settings, self.key: value}
        if "memory" in self.unknown.settings:
            given["thermal_weakening.relaxation_time"] = self.unknown.settings["memory"]
        blocks: dict[str, dict[str, float]] = {}
        for key, number in given.items():
            blocks.setdefault(key.partition(".")[0], {})[key.rpartition(".")[2]] = number
        return blocks

    def percent(self, value: float) -> float:
        """By which friction differs within these runs, percent of it; a constant is no change."""
        sizes = self.sizes(value)
        return 100.0 * self.part * float(np.ptp(sizes) if sizes.size > 1 else abs(sizes[0]))


Unknowns = Mapping[str, Sequence[Unknown]]


def _scales(system: System) -> Scales:
    return scales_of(system.campaign, system.runs, system.level.kinetic)


def laws_of(system: System, unknowns: Unknowns) -> list[Law]:
    """The simplest law of each effect in each direction, of those that the runs can show."""
    scales = _scales(system)
    found: dict[tuple[str, float], Law] = {}
    for effect in EFFECTS:
        if not effect.offered:
            continue
        for candidate in effect.candidates(scales):
            if not candidate.free_parameters or candidate.lateral:
                continue
            for law in _of(system, unknowns, effect, candidate):
                way = float(np.sign(law.most - law.neutral))
                found.setdefault((law.candidate.periodic or effect.id, way), law)
    return list(found.values())


def silent(laws: Sequence[Law]) -> dict[str, str]:
    """effect -> why no size is told, of those that `gap` offers."""
    there = {law.candidate.effect for law in laws}
    offered = [one for one in EFFECTS if one.offered and one.candidates is not no_candidates]
    return {one.id: WHY.get(one.id, "these runs cannot show it")
            for one in offered if one.id not in there}  # fmt: skip


def _of(system: System, unknowns: Unknowns, effect: Effect, candidate: Candidate) -> Iterator[Law]:
    if candidate.periodic:
        yield from _wave(system, effect, candidate)
    elif candidate.form == "power law":
        for unknown in unknowns.get("load_dependence", ()):
            span = unknown.settings["span"]
            yield _law("load_dependence", effect, candidate, unknown, _scaled(np.array([-span])))
    else:
        yield from _curve(system, unknowns, effect, candidate)


def _scaled(sizes: np.ndarray) -> Callable[[float], np.ndarray]:
    return lambda value: value * sizes


def _law(
    argument: str, effect: Effect, candidate: Candidate, unknown: Unknown,
    sizes: Callable[[float], np.ndarray], part: float = 1.0, wave: Option | None = None,
) -> Law:  # fmt: skip
    """Between where it is nothing and what the catalogue has as its most."""
    free = candidate.free_parameters[0]
    neutral = _defaults(effect)[free.key.rpartition(".")[2]]
    most = free.high if free.start > neutral else free.low
    return Law(argument, candidate, neutral, most, unknown, sizes, part, wave)


def _defaults(effect: Effect) -> dict[str, float]:
    return {name: field.default for name, field in effect.table.model_fields.items()}


def _curve(
    system: System, unknowns: Unknowns, effect: Effect, candidate: Candidate
) -> Iterator[Law]:
    """A law along the nodes of the argument's curve, of the variant that is nearest to it."""
    level, scales = system.level, _scales(system)
    force = level.kinetic * scales.force
    own = candidate.free_parameters[0].key.rpartition(".")[2]
    starts = {free.key: free.start for free in candidate.free_parameters}
    given = {**candidate.settings, **starts}
    memory = starts.get("thermal_weakening.relaxation_time", 1.0)
    for name, variants in unknowns.items():
        fitting = [
            one for one in variants
            if name in SHAPES and one.curve and not one.settings.get("per_weight")
            and Context(system.campaign, scales, one.settings).allows(name, effect, candidate)
        ]  # fmt: skip
        if not fitting:
            continue
        unknown = min(
            fitting, key=lambda one: abs(np.log(one.settings.get("memory", memory) / memory))
        )
        law = SHAPES[name](effect, Context(system.campaign, scales, {"mu_s": level.static}))
        if law is None or unknown.curve is None:
            continue
        nodes, unit = unknown.curve.nodes, force if unknown.curve.per == "N" else 1.0
        if name == "spring_hardening":
            stiffness = [run.track.run.total_stiffness for run in system.runs]
            unit = float(nodes[-1] * np.mean(stiffness))
        known = _defaults(effect) | {key.rpartition(".")[2]: one for key, one in given.items()}
        known["relaxation_time"] = unknown.settings.get("memory", memory)
        neutral = _defaults(effect)[own]

        def sizes(
            value: float, law=law, nodes=nodes, known=known, unit=unit, neutral=neutral
        ) -> np.ndarray:
            nothing = law(nodes, {**known, own: neutral})
            return np.asarray((law(nodes, {**known, own: value}) - nothing) / unit)

        part = unit / force if unknown.curve.per == "N" else 1.0
        yield _law(name, effect, candidate, unknown, sizes, part)


def _wave(system: System, effect: Effect, candidate: Candidate) -> Iterator[Law]:
    """A cosine of the catalogue's first period, within what the scan looks at."""
    if candidate.has_second:
        return
    start = {free.key: free.start for free in candidate.free_parameters}[candidate.periodic]
    in_time = candidate.periodic.endswith("frequency")
    for kind in periodic.kinds(system.level.kinetic):
        wavenumbers = periodic._wavenumbers(system.fitted, kind)
        if kind.name != effect.id or (kind.unit == "s") != in_time or not wavenumbers.size:
            continue
        wavenumber = float(np.clip(start if in_time else 1.0 / start, *wavenumbers[[0, -1]]))
        names = [run.track.run.name for run in system.runs]
        phases = {name: GOLDEN * number for number, name in enumerate(names)}
        wave = periodic.Wave(kind, wavenumber, phases)
        first = np.eye(2 * HARMONICS)[0]
        sd = 0.5 / SCAN_STEPS / max(np.ptp(kind.coordinate(run)) for run in system.fitted)
        parts = wave.shape(), wave.turned(first), wave.stretched(first, sd)
        runs = len(system.fitted)
        factor = block_diag(*(factor_of(Added(one), runs) for one in parts))
        option = Option(parts, (factor,), np.array(SCALES_ASKED), price_of_scan(wavenumbers.size))
        yield _law(effect.id, effect, candidate, parts[0], _scaled(first), wave=option)

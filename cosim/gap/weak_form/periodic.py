"""What is periodic: friction in the place on the surface, the surface's speed in time.

A wave of one shape in all runs, each with its own phase, as nobody marks the belt. Wave lengths are
scanned with what the rows leave; the best few are fitted as one shape, whose phases are linear
unknowns about where they were found, so that the evidence has their price in it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np
from scipy.signal import find_peaks
from stickslip.effects.periodic import MOST_HARMONIC

from cosim.gap.weak_form.added import Added
from cosim.gap.weak_form.constants import (
    ALIGNED,
    ALIKE,
    HARMONICS,
    LEAST_STEP,
    MOST_WAVES,
    PHASES_TRIED,
    ROUNDS,
    SCAN_STEPS,
    SHORTEST_WAVE,
    SPEEDS_TRIED,
    WAVES_FITTED,
)
from cosim.gap.weak_form.rig_unknowns import SPEED
from cosim.gap.weak_form.rows import Response, RunRows
from cosim.gap.weak_form.system import Rung
from cosim.gap.weak_form.unknowns import Unknown

#: run -> (n,) coordinate of the wave; and (run, (n, q) waves) -> what a wave of unit size does.
Coordinate = Callable[[RunRows], np.ndarray]
Effect = Callable[[RunRows, np.ndarray], Response]

ORDERS = np.arange(1, HARMONICS + 1)
#: Wavenumbers that are worked out together: what they need stays in the processor's cache.
TOGETHER = 64
#: Runs and waves are worked out beside one another, in numpy's loops.
THREADS = ThreadPoolExecutor(2)


@dataclass(frozen=True)
class Periodic:
    """A kind of wave.

    name : effect or other finding; unit : of the coordinate ("m", "s")
    """

    name: str
    variant: str
    coordinate: Coordinate
    effect: Effect
    unit: str

    @property
    def key(self) -> str:
        """Name and variant."""
        return f"{self.name} {self.variant}"


def kinds(level_of_friction: float) -> tuple[Periodic, ...]:
    """Friction over the place, the surface's speed over time or travel, friction over time."""

    def friction(run: RunRows, waves: np.ndarray) -> Response:
        unit = level_of_friction * run.weight
        static = unit * waves[[event.at for event in run.events]] if run.events else None
        return Response(force=unit * run.track.direction[:, None] * waves, static=static)

    def speed(run: RunRows, waves: np.ndarray) -> Response:
        return Response(speed=run.track.run.surface_speed * waves)

    def shaken(run: RunRows, waves: np.ndarray) -> Response:
        return Response(force=level_of_friction * run.weight * waves)

    def time(run: RunRows) -> np.ndarray:
        return run.track.time

    def travel(run: RunRows) -> np.ndarray:
        return abs(run.track.run.surface_speed) * run.track.time

    return (
        Periodic("surface_pattern", "", lambda run: run.track.surface_place, friction, "m"),
        Periodic("speed_ripple", "in time", time, speed, "s"),
        Periodic("speed_ripple", "in travel", travel, speed, "m"),
        Periodic("other.shaking", "", time, shaken, "s"),
    )


def offered(
    rung: Rung, kind: Periodic, least: float = -np.inf
) -> tuple[float, tuple[Added, ...]] | None:
    """ln evidence with the best wave of a kind, and what is added; None where none fits in.

    least : ln evidence that is asked for; no harmonic takes more than the strongest wave does
    """
    wavenumbers, gains = _scan(rung, kind)
    if rung.evidence + 0.5 * HARMONICS * gains.max(initial=0.0) < least:
        return None
    peaks = find_peaks(np.pad(gains, 1, constant_values=-np.inf))[0] - 1
    tops = wavenumbers[peaks[np.argsort(-gains[peaks])]][:WAVES_FITTED]
    if tops.size == 0:
        return None
    # bumps are strongest in a harmonic: twice and three times the strongest wave's length too
    longer = [tops[0] / part for part in (2.0, 3.0) if tops[0] / part >= wavenumbers[0]]
    found = list(THREADS.map(partial(_as_one_shape, rung, kind), map(float, (*tops, *longer))))
    best = _shortened(rung, max(found, key=lambda each: each.with_moves))
    return best.with_moves - price_of_scan(wavenumbers.size, len(longer)), best.added


def price_of_scan(wavenumbers: int, longer: int = 2) -> float:
    """ln of how many waves a scan chooses among. longer : of those that are fitted."""
    return float(np.log(wavenumbers / SCAN_STEPS * (WAVES_FITTED + longer)))


def price_of(wave: Wave, runs: Sequence[RunRows]) -> float:
    """The same of a wave that was found."""
    return price_of_scan(wavenumbers_of(runs, wave.kind).size)


def wavenumbers_of(runs: Sequence[RunRows], kind: Periodic) -> np.ndarray:
    """(w,) 1/m or 1/s, finely enough: from a wave seen twice in a run to what rows resolve."""
    spans = np.array([np.ptp(kind.coordinate(run)) for run in runs])
    swings = [np.ptp(run.track.time) * run.track.run.natural_frequency for run in runs]
    longest, finest = spans.max(initial=0.0), np.min(spans * SHORTEST_WAVE / swings, initial=np.inf)
    if longest / 2.0 <= finest:
        return np.empty(0)
    every = np.arange(2.0 / longest, 1.0 / finest, 1.0 / (SCAN_STEPS * longest))
    return every[: int(MOST_WAVES / max(run.track.time.size for run in runs))]


@dataclass(frozen=True)
class _Waves:
    """Rows of unit noise of cosines and sines of one run, (2, rows, w), and their products (w,).

    Of evenly spaced wavenumbers.
    """

    rows: np.ndarray
    products: tuple[np.ndarray, np.ndarray, np.ndarray]

    @classmethod
    def of(cls, run: RunRows, kind: Periodic, wavenumbers: np.ndarray) -> _Waves:
        at, rows = kind.coordinate(run), np.empty((2, len(run), wavenumbers.size), np.float32)
        # a product costs a tenth of an exponential
        fine = _turned(at, wavenumbers[:TOGETHER] - wavenumbers[:1])
        for first in range(0, wavenumbers.size, TOGETHER):
            count = min(TOGETHER, wavenumbers.size - first)
            turn = _turned(at, wavenumbers[first : first + 1]) * fine[:, :count]
            effect = kind.effect(run, np.hstack([turn.real, turn.imag]))
            made = run.respond(effect, 2 * count).reshape(-1, 2, count)
            rows[:, :, first : first + count] = made.transpose(1, 0, 2)
        pairs = ((rows[0], rows[0]), (rows[1], rows[1]), (rows[0], rows[1]))
        cc, ss, cs = (np.einsum("rw,rw->w", a, b).astype(float) for a, b in pairs)
        return cls(rows, (cc, ss, cs))

    def fitted(self, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(w,) what a wave of free phase and size takes of the rows' squares, and its phase."""
        (c, s), (cc, ss, cs) = rows.astype(np.float32) @ self.rows, self.products
        determinant = cc * ss - cs**2
        seen = determinant > 1e-6 * (cc + ss + 1e-30) ** 2
        safe = np.where(seen, determinant, np.inf)
        a, b = (ss * c - cs * s) / safe, (cc * s - cs * c) / safe
        return a * c + b * s, np.arctan2(b, a)


def _turned(at: np.ndarray, wavenumbers: np.ndarray) -> np.ndarray:
    """(n, w) exp(2 pi i k s)"""
    return np.asarray(np.exp(2j * np.pi * np.outer(at, wavenumbers)))


def _scan(rung: Rung, kind: Periodic) -> tuple[np.ndarray, np.ndarray]:
    """(w,) wavenumbers, and what waves of free phases and sizes take of all runs' squares."""
    system = rung.system
    if kind.key not in system.waves:
        wavenumbers = wavenumbers_of(system.fitted, kind)
        made = partial(_Waves.of, kind=kind, wavenumbers=wavenumbers)
        runs = list(THREADS.map(made, system.fitted))
        system.waves[kind.key] = (wavenumbers, runs)
    wavenumbers, runs = system.waves[kind.key]
    gains = np.zeros(wavenumbers.size)
    for run, waves in zip(system.fitted, runs, strict=True):
        gains += waves.fitted(rung.left(run))[0]
    return wavenumbers, gains


def _as_one_shape(rung: Rung, kind: Periodic, wavenumber: float) -> _Fit:
    """A wave of one shape: its phases, wavenumber and speeds as the rows have them."""
    runs, one = rung.system.fitted, np.array([wavenumber])
    speeds = speeds_of(rung, kind)
    phases = {run.track.run.name: float(_Waves.of(run, kind, one).fitted(rung.left(run))[1][0])
              for run in runs}  # fmt: skip
    faster = {name: mean for name, (mean, _) in speeds.items()}
    found = _Fit.of(rung, Wave(kind, wavenumber, phases, faster), speeds)
    other = _Fit.of(rung, _realigned(rung, found.wave, found.sizes, speeds), speeds)
    return _settled(rung, max(found, other, key=lambda fit: fit.evidence), speeds)


def _shortened(rung: Rung, found: _Fit) -> _Fit:
    """The same wave as one of a half, a third or a quarter of its length, of which that harmonic is
    the first: where that is as probable, or the first is too small for the model to have it.
    """
    wave, strength = found.wave, np.hypot(*np.split(found.sizes, 2))
    order = int(np.argmax(strength)) + 1
    if order == 1:
        return found
    phases = {name: order * phase for name, phase in wave.phases.items()}
    shorter = replace(wave, wavenumber=order * wave.wavenumber, phases=phases)
    speeds = speeds_of(rung, wave.kind)
    other = _settled(rung, _Fit.of(rung, shorter, speeds), speeds)
    is_none = strength[order - 1] > MOST_HARMONIC * strength[0]
    return other if is_none or other.with_moves > found.with_moves else found


def _settled(rung: Rung, found: _Fit, speeds: Mapping[str, tuple[float, float]]) -> _Fit:
    """Linear in all that moves it, a wave is moved by as much of that as makes it more probable.

    A longer wave on faster surfaces is nearly the same one, and whole steps would run away.
    """
    part = 1.0
    for _ in range(2 * ROUNDS if found.with_moves > rung.evidence else 0):
        other = _Fit.of(rung, found.moved(part), speeds)
        gain = other.evidence - found.evidence
        part = min(2.0 * part, 1.0) if gain > 0.0 else part / 3.0
        found = other if gain > 0.0 else found
        if 0.0 < gain < 0.1 * ALIKE or part < LEAST_STEP:
            break
    return found


@dataclass(frozen=True)
class _Fit:
    """A wave in the rows of a rung.

    evidence : ln, with its shape alone; with_moves : as well with what moves it; added : both;
    sizes : of its shape; turns, more, ahead : by how much phases, wavenumber and speeds would move
    """

    wave: Wave
    evidence: float
    with_moves: float
    added: tuple[Added, ...]
    sizes: np.ndarray
    turns: np.ndarray
    more: float
    ahead: np.ndarray

    @classmethod
    def of(cls, rung: Rung, wave: Wave, speeds: Mapping[str, tuple[float, float]]) -> _Fit:
        _, shape = rung.offered([wave.shape()])
        here = rung.with_more([shape])
        sizes = here.posterior[0][here.part_of(shape)]
        moves = [Added(each) for each in wave.moves(sizes, rung.system.fitted, speeds)]
        moving = rung.with_more([shape, *moves])
        # of speeds it is known beforehand how far they are from where the wave is now
        off = np.array([(mean - wave.faster[name]) / sd for name, (mean, sd) in speeds.items()])
        mean, covariance = moving.posterior
        parts = [moving.part_of(each) for each in moves]
        if speeds:
            mean = mean + covariance[:, parts[2]] @ off
        turns, more, *faster = (mean[part] for part in parts)
        ahead = faster[0] * [sd for _, sd in speeds.values()] if faster else np.zeros(turns.size)
        less = 0.5 * float(off @ off)
        return cls(wave, here.evidence - less, moving.evidence - less, (shape, *moves), sizes,
                   turns, float(more[0]), ahead)  # fmt: skip

    def moved(self, part: float) -> Wave:
        """By a part of what the rows ask for."""
        names = tuple(self.wave.phases)
        turns, ahead = (dict(zip(names, (part * each).tolist(), strict=True))
                        for each in (self.turns, self.ahead))  # fmt: skip
        return self.wave.moved(turns, part * self.more, ahead)


def speeds_of(rung: Rung, kind: Periodic) -> dict[str, tuple[float, float]]:
    """run -> by which part its surface is faster than stated, and standard deviation.

    Nothing where the wave is one of the time.
    """
    if kind.unit == "s":
        return {}
    mean, covariance = rung.posterior
    part = rung.part_of(next(each for each in rung.base if each.unknown.name == SPEED))
    pairs = zip(mean[part], np.sqrt(np.diag(covariance[part, part])), strict=True)
    names = [run.track.run.name for run in rung.system.fitted]
    return {name: (float(a), float(b)) for name, (a, b) in zip(names, pairs, strict=True)}


def _realigned(
    rung: Rung, wave: Wave, sizes: np.ndarray, speeds: Mapping[str, tuple[float, float]]
) -> Wave:
    """The wave with the phase and the speed, of all that are probable, that leave least of a run.

    The surface gets ahead of what is stated by whole waves where a set-point is off by a percent.
    """
    turns = 2.0 * np.pi * np.arange(PHASES_TRIED) / PHASES_TRIED
    angles = np.outer(ORDERS, turns)
    c, s = sizes[:HARMONICS, None], sizes[HARMONICS:, None]
    turned = np.vstack([c * np.cos(angles) - s * np.sin(angles),
                        c * np.sin(angles) + s * np.cos(angles)])  # fmt: skip
    for run in rung.system.fitted:
        name = run.track.run.name
        mean, sd = speeds.get(name, (0.0, 0.0))
        far = 2.0 * sd * 2.0 * np.pi * wave.wavenumber * _travel(run)[-1]
        count = min(int(far / ALIGNED), SPEEDS_TRIED)
        tried = mean + 2.0 * sd * np.arange(-count, count + 1) / max(count, 1)
        free = np.hstack([rung.system.columns_of(each.unknown, run) @ each.factor
                          for each in rung.unknowns])  # fmt: skip
        inner = np.eye(free.shape[1]) + free.T @ free
        best = (np.inf, 0.0, mean)
        for faster in tried:
            there = replace(wave, faster={**wave.faster, name: float(faster)})
            left = run.values[:, None] - there.shape().columns([run]) @ turned
            left = left - free @ np.linalg.solve(inner, free.T @ left)
            squares = np.einsum("rt,rt->t", left, left)
            at = int(np.argmin(squares))
            best = min(best, (float(squares[at]), float(turns[at]), float(faster)))
        wave = replace(wave, faster={**wave.faster, name: best[2]}).moved({name: best[1]})
    return wave


def _travel(run: RunRows) -> np.ndarray:
    """(n,) of the surface, as stated, m."""
    return abs(run.track.run.surface_speed) * run.track.time


@dataclass(frozen=True)
class Wave:
    """A wave with a phase of each run: cos and sin of harmonics of 2 pi wavenumber s - phase.

    faster : run -> by which part the surface travels farther than stated
    """

    kind: Periodic
    wavenumber: float
    phases: dict[str, float]
    faster: dict[str, float] = field(default_factory=dict)

    def waves(self, run: RunRows) -> np.ndarray:
        """(n, 2 HARMONICS) cosines, then sines."""
        name = run.track.run.name
        at = self.kind.coordinate(run) + self.faster.get(name, 0.0) * _travel(run)
        angle = 2.0 * np.pi * self.wavenumber * at - self.phases.get(name, 0.0)
        powers = np.cumprod(np.repeat(np.exp(1j * angle)[:, None], HARMONICS, axis=1), axis=1)
        return np.hstack([powers.real, powers.imag])

    def at_times(self, run: RunRows, sizes: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
        """The wave of one run as a function of the time, s."""
        values = self.waves(run) @ sizes
        return lambda time: np.interp(time, run.track.time, values)

    def shape(self) -> Unknown:
        """Sizes of the harmonics, smaller the higher."""
        sizes = np.tile(1.0 / ORDERS**1.5, 2)
        words = f"{1.0 / self.wavenumber:.3g} {self.kind.unit}"
        phases = {f"phase@{name}": phase for name, phase in self.phases.items()}
        return Unknown(
            self.kind.name, " ".join(filter(None, [self.kind.variant, words])),
            lambda run: self.kind.effect(run, self.waves(run)), np.diag(sizes**2),
            settings={"wavenumber": self.wavenumber, **phases}, wave=self,
        )  # fmt: skip

    def moves(
        self, sizes: np.ndarray, runs: Sequence[RunRows], speeds: Mapping[str, tuple[float, float]]
    ) -> list[Unknown]:
        """What phases, rad, another wavenumber, and speeds of the runs do to a wave of these sizes.

        Half a step of the scan is how far off a wavenumber may be.
        """

        slopes: dict[int, np.ndarray] = {}

        def slope(run: RunRows) -> np.ndarray:
            """(n,) derivative of the wave by its angle, which all three ask for."""
            if id(run) not in slopes:
                cosines, sines = np.hsplit(self.waves(run), 2)
                slopes[id(run)] = np.hstack([-ORDERS * sines, ORDERS * cosines]) @ sizes
            return slopes[id(run)]

        def turned(run: RunRows) -> Response:
            return self.kind.effect(run, -slope(run)[:, None])

        def stretched(run: RunRows) -> Response:
            longer = 2.0 * np.pi * self.kind.coordinate(run)
            return self.kind.effect(run, (longer * slope(run))[:, None])

        name = self.kind.name
        sd = 0.5 / SCAN_STEPS / max(np.ptp(self.kind.coordinate(run)) for run in runs)
        even = np.pi**2 / 3.0 * np.eye(1)  # of a phase of which nothing is known
        moves = [
            Unknown(f"{name}: phase", "", turned, even, per_run=True),
            Unknown(f"{name}: wavenumber", "", stretched, sd**2 * np.eye(1)),
        ]

        def faster(run: RunRows) -> Response:
            ahead = speeds[run.track.run.name][1] * 2.0 * np.pi * self.wavenumber * _travel(run)
            return self.kind.effect(run, (ahead * slope(run))[:, None])

        if speeds:
            moves.append(Unknown(f"{name}: speed", "", faster, np.eye(1), per_run=True))
        return moves

    def moved(
        self, turns: Mapping[str, float], more: float = 0.0, faster: Mapping[str, float] = {}
    ) -> Wave:
        """With phases turned by so much, rad, another wavenumber, and surfaces faster by a part."""
        ahead = {name: self.faster.get(name, 0.0) + more for name, more in faster.items()}
        phases = {
            name: self.phases.get(name, 0.0)
            + (turns.get(name, 0.0) + np.pi) % (2.0 * np.pi)
            - np.pi
            for name in {**self.phases, **turns}
        }
        return replace(
            self, wavenumber=self.wavenumber + more, phases=phases, faster={**self.faster, **ahead}
        )

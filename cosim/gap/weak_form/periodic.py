"""What is periodic: friction in the place on the surface, the surface's speed in time.

A wave of one shape in all runs, each with its own phase, as nobody marks the belt. Wave lengths are
scanned with what the rows leave; the best few are fitted as one shape, whose phases are linear
unknowns about where they were found, so that the evidence has their price in it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from cosim.gap.weak_form.constants import (
    HARMONICS,
    MOST_WAVES,
    PHASE_ROUNDS,
    PHASE_SD,
    PHASES_TRIED,
    SCAN_STEPS,
    SHORTEST_WAVE,
    WAVES_FITTED,
)
from cosim.gap.weak_form.rows import Response, RunRows
from cosim.gap.weak_form.system import Added, Rung
from cosim.gap.weak_form.unknowns import Unknown

#: run -> (n,) coordinate of the wave; and (run, (n, q) waves) -> what a wave of unit size does.
Coordinate = Callable[[RunRows], np.ndarray]
Effect = Callable[[RunRows, np.ndarray], Response]


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


def kinds(level_of_friction: float, has_events: bool = True) -> tuple[Periodic, ...]:
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


def offered(rung: Rung, kind: Periodic) -> tuple[float, tuple[Added, ...]] | None:
    """ln evidence with the best wave of a kind, and what is added; None where none fits in."""
    wavenumbers, gains = _scan(rung, kind)
    if wavenumbers.size == 0:
        return None
    best: tuple[float, tuple[Added, ...]] | None = None
    tops = wavenumbers[_peaks(gains)[:WAVES_FITTED]]
    # bumps are strongest in a harmonic: twice and three times the strongest wave's length too
    longer = [tops[0] / part for part in (2.0, 3.0) if tops[0] / part >= wavenumbers[0]]
    for wavenumber in (*tops, *longer):
        found = _as_one_shape(rung, kind, float(wavenumber))
        if best is None or found[0] > best[0]:
            best = found
    if best is None:
        return None
    shapes = WAVES_FITTED + len(longer)
    return best[0] - float(np.log(wavenumbers.size / SCAN_STEPS * shapes)), best[1]


def _wavenumbers(runs: Sequence[RunRows], kind: Periodic) -> np.ndarray:
    """(w,) 1/m or 1/s, finely enough: from a wave seen twice in a run to what rows resolve."""
    longest, finest = 0.0, np.inf
    for run in runs:
        at = kind.coordinate(run)
        longest = max(longest, float(np.ptp(at)))
        resolved = SHORTEST_WAVE / run.track.run.natural_frequency
        finest = min(finest, float(np.ptp(at)) * resolved / np.ptp(run.track.time))
    if longest / 2.0 <= finest:
        return np.empty(0)
    every = np.arange(2.0 / longest, 1.0 / finest, 1.0 / (SCAN_STEPS * longest))
    return every[: int(MOST_WAVES / max(run.track.time.size for run in runs))]


@dataclass(frozen=True)
class _Waves:
    """Rows of unit noise of cosines and sines of one run, (rows, w), and their products (w,)."""

    cosines: np.ndarray
    sines: np.ndarray

    @classmethod
    def of(cls, run: RunRows, kind: Periodic, wavenumbers: np.ndarray) -> _Waves:
        turn = np.exp(2j * np.pi * np.outer(kind.coordinate(run), wavenumbers))
        return cls(
            run.respond(kind.effect(run, turn.real), wavenumbers.size).astype(np.float32),
            run.respond(kind.effect(run, turn.imag), wavenumbers.size).astype(np.float32),
        )

    def fitted(self, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(w,) what a wave of free phase and size takes of the rows' squares, and its phase."""
        c, s = rows @ self.cosines, rows @ self.sines
        cc, ss, cs = self.products
        determinant = cc * ss - cs**2
        seen = determinant > 1e-6 * (cc + ss + 1e-30) ** 2
        safe = np.where(seen, determinant, 1.0)
        a, b = (ss * c - cs * s) / safe, (cc * s - cs * c) / safe
        return np.where(seen, a * c + b * s, 0.0), np.where(seen, np.arctan2(b, a), 0.0)

    @cached_property
    def products(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        pairs = ((self.cosines, self.cosines), (self.sines, self.sines), (self.cosines, self.sines))
        cc, ss, cs = (np.einsum("rw,rw->w", a, b).astype(float) for a, b in pairs)
        return cc, ss, cs


def _scan(rung: Rung, kind: Periodic) -> tuple[np.ndarray, np.ndarray]:
    """(w,) wavenumbers, and what waves of free phases and sizes take of all runs' squares."""
    system = rung.system
    if kind not in system.waves:
        wavenumbers = _wavenumbers(system.fitted, kind)
        runs = [_Waves.of(run, kind, wavenumbers) for run in system.fitted]
        system.waves[kind] = (wavenumbers, runs)
    wavenumbers, runs = system.waves[kind]
    gains = np.zeros(wavenumbers.size)
    for run, waves in zip(system.fitted, runs, strict=True):
        gains += waves.fitted(rung.left(run).astype(np.float32))[0]
    return wavenumbers, gains


def _phases(
    rung: Rung, kind: Periodic, wavenumber: float, runs: Sequence[RunRows]
) -> dict[str, float]:
    """run -> phase of the wave that fits best what is left of it, rad."""
    one = np.array([wavenumber])
    return {
        run.track.run.name: float(_Waves.of(run, kind, one).fitted(rung.left(run))[1][0])
        for run in runs
    }


def _peaks(gains: np.ndarray) -> list[int]:
    """Numbers of local maxima, the largest first."""
    padded = np.concatenate([[-np.inf], gains, [-np.inf]])
    tops = np.flatnonzero((padded[1:-1] >= padded[:-2]) & (padded[1:-1] > padded[2:]))
    return [int(top) for top in tops[np.argsort(-gains[tops])]]


def _as_one_shape(rung: Rung, kind: Periodic, wavenumber: float) -> tuple[float, tuple[Added, ...]]:
    """ln evidence with a wave of one shape, and its unknowns: shape, phases, wavenumber."""
    phases = _phases(rung, kind, wavenumber, rung.system.fitted)
    names = list(phases)
    wave = Wave(kind, wavenumber, phases)
    best: tuple[float, tuple[Added, ...]] | None = None
    for number in range(PHASE_ROUNDS):
        _, shape = rung.offered([wave.shape()])
        here = rung.system.rung([*rung.added, shape], *rung.kinds)
        mean = here.posterior[0][here.part_of(shape)]
        sd = 0.5 / SCAN_STEPS / max(np.ptp(kind.coordinate(run)) for run in rung.system.fitted)
        turn, stretch = Added(wave.turned(mean)), Added(wave.stretched(mean, sd))
        moving = rung.system.rung([*rung.added, shape, turn, stretch], *rung.kinds)
        if best is None or moving.evidence > best[0]:
            best = (moving.evidence, (shape, turn, stretch))
        turns = moving.posterior[0][moving.part_of(turn)]
        more = float(moving.posterior[0][moving.part_of(stretch)][0])
        wave = wave.moved(dict(zip(names, turns, strict=True)), more)
        if number < PHASE_ROUNDS // 2:
            wave = _rephased(rung, wave, mean)
    assert best is not None
    return best[0], _with_held_out(rung, best[1])


def _rephased(rung: Rung, wave: Wave, sizes: np.ndarray) -> Wave:
    """The wave with the phases, of all over a turn, that leave least of each run's rows."""
    turns = 2.0 * np.pi * np.arange(PHASES_TRIED) / PHASES_TRIED
    best = {}
    for run in rung.system.fitted:
        columns = [each.unknown.columns([run]) @ each.factor for each in rung.unknowns]
        free = np.hstack(columns)
        waves = np.column_stack([wave.rows(run, sizes, turn) for turn in turns])
        left = run.values[:, None] - waves
        inner = np.eye(free.shape[1]) + free.T @ free
        left = left - free @ np.linalg.solve(inner, free.T @ left)
        best[run.track.run.name] = turns[int(np.argmin(np.einsum("rt,rt->t", left, left)))]
    return wave.moved(best, 0.0)


def _with_held_out(rung: Rung, added: tuple[Added, ...]) -> tuple[Added, ...]:
    """The same wave, with the phases of runs that were held out read off these."""
    shape, *others = added
    if not rung.system.held_out:
        return added
    wave: Wave = shape.unknown.wave
    here = rung.system.rung([*rung.added, *added], *rung.kinds)
    sizes = here.posterior[0][here.part_of(shape)]
    lag = float(np.arctan2(sizes[HARMONICS], sizes[0]))
    found = _phases(rung, wave.kind, wave.wavenumber, rung.system.held_out)
    wave.phases.update({name: phase - lag for name, phase in found.items()})
    return (shape, *others)


@dataclass(frozen=True)
class Wave:
    """A wave with a phase of each run: cos and sin of harmonics of 2 pi wavenumber s - phase."""

    kind: Periodic
    wavenumber: float
    phases: dict[str, float]

    @property
    def settings(self) -> dict[str, float]:
        return {"wavenumber": self.wavenumber, **{f"phase@{n}": p for n, p in self.phases.items()}}

    def angle(self, run: RunRows) -> np.ndarray:
        """(n,) rad"""
        phase = self.phases.get(run.track.run.name, 0.0)
        return 2.0 * np.pi * self.wavenumber * self.kind.coordinate(run) - phase

    def at_times(self, run: RunRows, sizes: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
        """The wave of one run as a function of the time, s."""
        angle = self.angle(run)

        def at(time: np.ndarray) -> np.ndarray:
            angles = np.outer(np.interp(time, run.track.time, angle), np.arange(1, HARMONICS + 1))
            return np.asarray(np.hstack([np.cos(angles), np.sin(angles)]) @ sizes)

        return at

    def shape(self) -> Unknown:
        """Sizes of the harmonics, smaller the higher."""

        def respond(run: RunRows) -> Response:
            angle = np.outer(self.angle(run), np.arange(1, HARMONICS + 1))
            return self.kind.effect(run, np.hstack([np.cos(angle), np.sin(angle)]))

        sizes = np.tile(1.0 / np.arange(1, HARMONICS + 1) ** 1.5, 2)
        words = f"{1.0 / self.wavenumber:.3g} {self.kind.unit}"
        variant = " ".join(filter(None, [self.kind.variant, words]))
        return Unknown(
            self.kind.name, variant, respond, np.diag(sizes**2), settings=self.settings, wave=self
        )

    def rows(self, run: RunRows, sizes: np.ndarray, turn: float) -> np.ndarray:
        """(rows,) of unit noise of the wave in one run, its phase turned by so much, rad."""
        name = run.track.run.name
        shape = self.moved({name: turn}, 0.0).shape()
        return shape.columns([run]) @ sizes

    def turned(self, sizes: np.ndarray) -> Unknown:
        """What a turn of a run's phase, rad, does to a wave of these sizes (2 HARMONICS,)."""

        def respond(run: RunRows) -> Response:
            return self.kind.effect(run, -self._slope(run, sizes)[:, None])

        name = f"{self.kind.name}: phase"
        return Unknown(name, "", respond, PHASE_SD**2 * np.eye(1), per_run=True)

    def stretched(self, sizes: np.ndarray, sd: float) -> Unknown:
        """What another wavenumber does to it; sd : by how much it may be off."""

        def respond(run: RunRows) -> Response:
            longer = 2.0 * np.pi * self.kind.coordinate(run)
            return self.kind.effect(run, (longer * self._slope(run, sizes))[:, None])

        return Unknown(f"{self.kind.name}: wavenumber", "", respond, sd**2 * np.eye(1))

    def _slope(self, run: RunRows, sizes: np.ndarray) -> np.ndarray:
        """(n,) derivative of the wave by its angle."""
        orders = np.arange(1, HARMONICS + 1)
        angle = np.outer(self.angle(run), orders)
        return np.hstack([-orders * np.sin(angle), orders * np.cos(angle)]) @ sizes

    def moved(self, turns: dict[str, float], more: float) -> Wave:
        """With phases turned by so much, rad, and another wavenumber."""
        phases = {
            name: phase + (turns.get(name, 0.0) + np.pi) % (2.0 * np.pi) - np.pi
            for name, phase in self.phases.items()
        }
        return Wave(self.kind, self.wavenumber + more, phases)

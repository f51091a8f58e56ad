"""How a surface's speed varies, seen where the block moves with it.

A block that sticks on a surface whose speed swings by more than the noise would be taken for one
that slips: the swing is looked for first, in wide sticks, and the tracks are smoothed anew with it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.weak_form import periodic
from cosim.gap.weak_form.added import Added
from cosim.gap.weak_form.constants import (
    ALIKE,
    CONTACT_SPEED,
    LEAST_GAIN,
    PHASES_TRIED,
    RIPPLE_BANDS,
)
from cosim.gap.weak_form.rows import STICK, Response, RunRows, rows_of
from cosim.gap.weak_form.system import System
from cosim.gap.weak_form.track import GridTrack, SmoothTrack

#: Times (n,), s -> the part by which a surface is faster than its set-point.
Varies = Callable[[np.ndarray], np.ndarray]


def tracks_of(campaign: Campaign, runs: Sequence[MeasuredRun]) -> list[SmoothTrack]:
    """Smoothed tracks, relative to the surface as it moves."""
    grids = [GridTrack.of(run) for run in runs]
    varies: dict[str, Varies] = {}
    for band in RIPPLE_BANDS:
        tracks = [grid.smoothed(varies.get(grid.run.name), band) for grid in grids]
        found = _ripple(campaign, [rows_of(track, campaign.rig) for track in tracks])
        if not found:
            break
        varies = found
    return [grid.smoothed(varies.get(grid.run.name)) for grid in grids]


def _ripple(campaign: Campaign, rows: list[RunRows]) -> dict[str, Varies]:
    """run -> the part by which its surface is faster at times; {} where none is."""
    system = System(campaign, [run.only(STICK) for run in rows])
    if not system.rows.any():
        return {}
    rung = system.rung()
    best: tuple[float, tuple[Added, ...]] = (rung.evidence + LEAST_GAIN - ALIKE, ())
    for kind in periodic.kinds(system.level.kinetic):
        least = best[0] + ALIKE
        offer = periodic.offered(rung, kind, least) if kind.name == "speed_ripple" else None
        if offer and offer[0] > least:
            best = offer
    if not best[1]:
        return {}
    after, shape = system.rung(best[1]), best[1][0]
    sizes, wave = after.posterior[0][after.part_of(shape)], shape.unknown.wave
    phased = periodic.THREADS.map(lambda run: best_phase(campaign, run, wave, sizes), system.runs)
    return {
        run.track.run.name: one.at_times(run, sizes)
        for run, one in zip(system.runs, phased, strict=True)
    }


def best_phase(
    campaign: Campaign, run: RunRows, wave: periodic.Wave, sizes: np.ndarray
) -> periodic.Wave:
    """The wave with the phase of one run that leaves least: where it seldom sticks, slips tell."""
    name, grid = run.track.run.name, GridTrack.of(run.track.run)
    step = 2.0 * np.pi / PHASES_TRIED
    for width in (step, step / 6.0):  # over a turn, then about the best
        half = PHASES_TRIED // 2
        tried = [wave.moved({name: width * n}) for n in range(-half, half)]
        wave = min(tried, key=lambda w: _left(campaign, grid, w.at_times(run, sizes)))
    return wave


def _left(campaign: Campaign, grid: GridTrack, varies: Varies) -> float:
    """Mean square of a run's slips and sticks beside one coefficient, a zero and a fall at low
    speeds."""
    rows = rows_of(grid.smoothed(varies), campaign.rig, events=())
    if not len(rows):
        return 0.0
    track, run = rows.track, grid.run
    friction = rows.weight * track.direction
    slow = friction * np.exp(-np.abs(track.sliding) / CONTACT_SPEED)
    forces = np.column_stack([friction, slow, run.total_stiffness * np.ones_like(slow)])
    faster = (run.surface_speed * varies(track.time))[:, None]
    left = rows.values - rows.respond(Response(speed=faster), 1)[:, 0]
    columns = rows.respond(Response(force=forces), 3)
    solution = np.linalg.lstsq(columns, left, rcond=None)[0]
    return float(np.mean((left - columns @ solution) ** 2))

"""How a surface's speed varies, seen where the block moves with it.

A block that sticks on a surface whose speed swings by more than the noise would be taken for one
that slips: the swing is looked for first, in wide sticks, and the tracks are smoothed anew with it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.weak_form import periodic
from cosim.gap.weak_form.constants import RIPPLE_BANDS, RIPPLE_GAIN
from cosim.gap.weak_form.rows import STICK, RunRows, rows_of
from cosim.gap.weak_form.system import System
from cosim.gap.weak_form.track import SmoothTrack, smooth


def tracks_of(campaign: Campaign, runs: Sequence[MeasuredRun]) -> list[SmoothTrack]:
    """Smoothed tracks, relative to the surface as it moves."""
    varies: dict[str, Callable[[np.ndarray], np.ndarray]] = {}
    for band in RIPPLE_BANDS:
        tracks = [smooth(run, varies.get(run.name), band) for run in runs]
        found = _ripple(campaign, [rows_of(track, campaign.rig) for track in tracks])
        if not found:
            break
        varies = found
    return [smooth(run, varies.get(run.name)) for run in runs]


def _ripple(
    campaign: Campaign, rows: list[RunRows]
) -> dict[str, Callable[[np.ndarray], np.ndarray]]:
    """run -> the part by which its surface is faster at times; {} where none is."""
    system = System(campaign, [run.only(STICK) for run in rows])
    if not system.rows.any():
        return {}
    rung = system.rung()
    best: tuple[float, tuple] | None = None
    for kind in periodic.kinds(system.level.kinetic):
        if kind.name == "speed_ripple":
            offer = periodic.offered(rung, kind)
            if offer and (best is None or offer[0] > best[0]):
                best = offer
    if best is None or best[0] - rung.evidence < RIPPLE_GAIN:
        return {}
    after = system.rung(best[1])
    sizes = after.posterior[0][after.part_of(best[1][0])]
    wave = best[1][0].unknown.wave
    return {run.track.run.name: wave.at_times(run, sizes) for run in system.runs}

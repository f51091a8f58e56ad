"""Residual analysis by regime: how large the misfit of each channel is and on what it depends."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from cosim.gap.diagnostics.dependence import Dependence, log10_chance, nodes_of, shares
from cosim.gap.diagnostics.model_track import ModelTrack
from cosim.gap.diagnostics.response import Answer, Normal
from cosim.gap.diagnostics.sources import Source, sources
from cosim.gap.diagnostics.spectrum import (
    COORDINATES,
    Period,
    pattern_wavelength,
    phase_of,
    ripple_frequency,
)
from cosim.gap.diagnostics.variables import VARIABLES, variables_of


@dataclass(frozen=True)
class Region:
    """The misfit of one channel in one regime.

    Attributes
    ----------
    channel, regime, quantity, unit : what it is
    runs : names of the runs in which it is seen
    value, error : (r,) mean misfit of each of these runs and its standard error
    rms : root mean square of the misfit's effect in units of the noise; 1 is noise
    log10_p : logarithm of the probability that means so far from zero are chance
    explained : for each run, how much of its sum of squares the misfit that is described here
        (by its run's mean, or by the variable that tells most) makes up, in units of the noise
    dependences : on each variable that can be told, the most certain one first
    """

    channel: str
    regime: str
    quantity: str
    unit: str
    runs: tuple[str, ...]
    value: np.ndarray = field(repr=False)
    error: np.ndarray = field(repr=False)
    rms: float
    log10_p: float
    explained: Mapping[str, float]
    dependences: tuple[Dependence, ...]

    @property
    def most_certain(self) -> float:
        """log10 of the smallest probability of its tests, uncorrected."""
        return min([self.log10_p, *(found.log10_p for found in self.dependences)])


@dataclass(frozen=True)
class RegimeAnalysis:
    """The misfit of a model, everywhere.

    Attributes
    ----------
    regions : channel by channel, regime by regime
    rms_residual : root mean square residual of all samples in units of the noise
    ripple, pattern : the strongest period of the misfit in time (in stick) and along the surface
        (in slip); None where there is none beyond chance
    """

    regions: tuple[Region, ...]
    rms_residual: float
    ripple: Period | None = None
    pattern: Period | None = None

    @property
    def tests(self) -> int:
        """How many questions were asked of the data."""
        return sum(1 + len(region.dependences) for region in self.regions)


def analyse_residuals(tracks: Sequence[ModelTrack]) -> RegimeAnalysis:
    """The residual analysis of a fitted model, before or after an effect was added."""
    tracks = list(tracks)
    variables = [variables_of(track) for track in tracks]
    every = sources(tracks)
    found = {
        "time_phase": ripple_frequency(tracks, every),
        "surface_phase": pattern_wavelength(tracks, every),
    }
    periods = {name: period for name, period in found.items() if period and period.certain}
    for name, period in periods.items():
        for i, track in enumerate(tracks):
            variables[i][name] = phase_of(period, COORDINATES[name](track), i)
    regions = tuple(_region(source, tracks, variables, periods) for source in every)
    residuals = [track.residual(channel) for track in tracks for channel in track.channels]
    rms = float(np.sqrt(np.nanmean(np.concatenate(residuals) ** 2)))
    return RegimeAnalysis(regions, rms, periods.get("time_phase"), periods.get("surface_phase"))


def _region(
    source: Source,
    tracks: list[ModelTrack],
    variables: list[dict[str, np.ndarray]],
    periods: Mapping[str, Period],
) -> Region:
    present = np.unique(source.tracks)
    normals = source.normals(lambda piece: _one_hot(piece, present))
    sums = _sum(normals)
    answer = sums.solve()
    gain = _gains(normals, answer, source.tracks, present)
    log10_p = _log10_p(sums.total, answer.misfit, answer.count, sums.freedom)
    dependences = []
    for name in variables[0]:
        if name in source.unsuited:
            continue
        found = _dependence(source, variables, name, present)
        if found is not None:
            dependences.append(_allowing_for_choice(found, periods.get(name)))
    dependences.sort(key=lambda pair: pair[0].log10_p)
    if dependences and dependences[0][0].log10_p < log10_p:
        gain = dependences[0][1]
    return Region(
        source.channel, source.regime, source.quantity, source.unit,
        runs=tuple(tracks[i].run.name for i in present),
        value=answer.values,
        error=_errors(answer, sums),
        rms=float(np.sqrt(sums.total / max(sums.freedom, 1))),
        log10_p=log10_p,
        explained={tracks[i].run.name: float(g) for i, g in zip(present, gain, strict=True)},
        dependences=tuple(found for found, _ in dependences),
    )  # fmt: skip


def _allowing_for_choice(
    found: tuple[Dependence, np.ndarray], period: Period | None
) -> tuple[Dependence, np.ndarray]:
    """A period was chosen among many: the dependence on its phase is no more certain than it."""
    if period is None:
        return found
    dependence, gain = found
    return replace(dependence, log10_p=max(dependence.log10_p, period.log10_p)), gain


def _one_hot(piece, present: np.ndarray) -> np.ndarray:
    return np.tile((present == piece.track).astype(float), (len(piece.rows), 1))


def _dependence(
    source: Source, variables: Sequence[Mapping[str, np.ndarray]], name: str, present: np.ndarray
) -> tuple[Dependence, np.ndarray] | None:
    """Dependence on a variable, and what it explains of each run; None where it has one value."""
    values, kind = source.at_samples(variables, name), VARIABLES[name].kind
    nodes = nodes_of(values, kind)
    if len(nodes) < 2:
        return None
    normals = source.normals(
        lambda piece: shares(variables[piece.track][name][piece.rows], nodes, kind),
        level=VARIABLES[name].follows,
    )
    sums = _sum(normals)
    curve, level = sums.solve(), sums.solve(np.ones((len(nodes), 1)))
    if curve.count < 2:
        return None
    freedom = (curve.count - level.count, sums.freedom - curve.count)
    statistic = _ratio(level.misfit - curve.misfit, curve.misfit, freedom)
    known = curve.known
    found = Dependence(
        name, nodes[known], curve.values[known], _errors(curve, sums)[known],
        statistic, freedom, log10_chance(statistic, freedom),
    )  # fmt: skip
    return found, _gains(normals, curve, source.tracks, present)


def _errors(answer: Answer, sums: Normal) -> np.ndarray:
    """Standard errors; where more than noise is left, that scatter counts."""
    left = answer.misfit / max(sums.freedom - answer.count, 1)
    return np.sqrt(np.diag(answer.covariance) * max(left, 1.0))


def _sum(normals: Sequence[Normal]) -> Normal:
    total = normals[0]
    for normal in normals[1:]:
        total = total + normal
    return total


def _gains(
    normals: Sequence[Normal], answer: Answer, owners: np.ndarray, present: np.ndarray
) -> np.ndarray:
    """What the answer takes off the sum of squares of each run."""
    values = np.nan_to_num(answer.values)
    taken = np.array(
        [2.0 * values @ normal.right - values @ normal.square @ values for normal in normals]
    )
    return np.array([np.sum(taken[owners == run]) for run in present])


def _log10_p(total: float, misfit: float, count: int, freedom: int) -> float:
    """Of all run means being zero."""
    pair = (count, freedom - count)
    return log10_chance(_ratio(total - misfit, misfit, pair), pair)


def _ratio(taken: float, misfit: float, freedom: tuple[int, int]) -> float:
    """F; the noise is not taken for smaller than it is said to be."""
    if min(freedom) <= 0:
        return 0.0
    return max(taken, 0.0) / freedom[0] / max(misfit / freedom[1], 1.0)

"""What the gap workflow says of a campaign: plain data, for whoever draws or writes it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from cosim.gap.camera.faults import is_fault
from cosim.gap.data import Campaign
from cosim.gap.diagnostics.model_track import ModelTrack
from cosim.gap.diagnostics.regimes import RegimeAnalysis
from cosim.gap.diagnostics.where import Where
from cosim.gap.estimation.drive import model_parameters

#: What can be said of a campaign.
VERDICTS = ("named", "class", "none", "unknown")


@dataclass(frozen=True)
class Ranked:
    """An effect tried on top of the plain model.

    Attributes
    ----------
    effect, form : id of the catalogue, and which of its laws, in a word
    held_out_gap, fit_gap : root mean square residual in units of the noise
    delta_bic : BIC of the plain model less that of this one; positive speaks for the effect
    parameters : `block.parameter` -> fitted value, SI
    intervals : `block.parameter` -> 95 % interval (low, high); of those that have one
    """

    effect: str
    form: str
    held_out_gap: float
    fit_gap: float
    delta_bic: float
    parameters: Mapping[str, float]
    intervals: Mapping[str, tuple[float, float]]


@dataclass(frozen=True)
class FittedRun:
    """What a fitted model makes of one run.

    Attributes
    ----------
    track : the model at the data's times, with the measured run: x, y, phi (m, m, rad; the
        tracker's zero included), vx (m/s), mode, segment; `residual` in units of the noise
    start : x, y, phi, vx, vy, omega at the first sample, in the rig's frame (m, rad, m/s, rad/s)
    own : parameters of this run alone (phases), `block.parameter` -> value
    gap : root mean square residual of the run in units of the noise, over all channels
    """

    track: ModelTrack
    start: tuple[float, float, float, float, float, float]
    gap: float
    own: Mapping[str, float] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """Of the run."""
        return self.track.run.name

    def residuals(self) -> np.ndarray:
        """(r,) of all channels one after the other, missing samples left out."""
        rows = np.concatenate([self.track.residual(name) for name in self.track.channels])
        return rows[np.isfinite(rows)]


@dataclass(frozen=True)
class FittedModel:
    """A model, fitted to the runs for fitting and simulated in all.

    Attributes
    ----------
    values : `block.parameter` -> fitted value; also `offset.x`, `offset.y`, the tracker's zero, m,
        and its faults, `measurement.*`
    settings : parameters that are set, not fitted, where they differ from what is known of the rig
    intervals : `block.parameter` -> 95 % interval (low, high); of those that have one
    degrees_of_freedom : motions that the model has
    runs : in the campaign's order
    gap : (fit, held out), root mean square residual in units of the noise
    """

    values: Mapping[str, float]
    settings: Mapping[str, float]
    intervals: Mapping[str, tuple[float, float]]
    degrees_of_freedom: tuple[str, ...]
    runs: tuple[FittedRun, ...]
    gap: tuple[float, float]

    def of(self, name: str) -> FittedRun:
        """The run of that name; KeyError when there is none."""
        for run in self.runs:
            if run.name == name:
                return run
        raise KeyError(name)

    def parameters(self, run: FittedRun) -> dict[str, float]:
        """`block.parameter` -> value for one run: fitted, set, its own; not the tracker's."""
        every = {**self.settings, **self.values, **run.own}
        every = model_parameters(run.track.run.surface_speed, every)
        return {
            key: value
            for key, value in every.items()
            if not (key.startswith("offset.") or is_fault(key))
        }


@dataclass(frozen=True)
class Gap:
    """The answer.

    Attributes
    ----------
    verdict : one of `VERDICTS`
    effects : ids in the order found; for "class" its members
    classes : groups of effects that this campaign cannot tell apart
    where : channel, regime and runs of the plain model's misfit, and a sentence
    ranking : every effect tried on top of the plain model, best first
    gap_before, gap_after : (fit, held out), units of the noise; after is before where nothing
        was added
    plain : the plain model, refitted
    extended : with what was found (for "class": the member that fits best); None: nothing added
    chance : "p" of the best of the catalogue under the plain model, "draws" that it rests on
    determined : plain parameter -> (value, low, high), as far as the data determine it
    seed : of everything that was drawn
    analysis : of the plain model's misfit by regime, what ``where`` was read off
    next_experiment : the run that would tell most, or None
    empirical : the formula proposed where the catalogue has no name, or None
    remarks : what the reader should know, a line each; the campaign's own are in the campaign
    """

    campaign: Campaign
    verdict: str
    effects: tuple[str, ...]
    classes: tuple[tuple[str, ...], ...]
    where: Where
    ranking: tuple[Ranked, ...]
    gap_before: tuple[float, float]
    gap_after: tuple[float, float]
    plain: FittedModel
    extended: FittedModel | None
    chance: Mapping[str, float]
    determined: Mapping[str, tuple[float, float, float]]
    seed: int = 0
    analysis: RegimeAnalysis | None = None
    next_experiment: Mapping[str, Any] | None = None
    empirical: Mapping[str, Any] | None = None
    remarks: tuple[str, ...] = ()

    @property
    def model(self) -> FittedModel:
        """The best model that there is: the extended one, or the plain one."""
        return self.extended if self.extended is not None else self.plain

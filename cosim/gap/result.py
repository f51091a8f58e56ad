"""What the gap workflow says of a campaign: plain data, for whoever draws or writes it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np

from cosim.gap.camera.faults import is_fault
from cosim.gap.curves.curve import Curve
from cosim.gap.data import Campaign
from cosim.gap.diagnostics.model_track import ModelTrack
from cosim.gap.diagnostics.regimes import RegimeAnalysis
from cosim.gap.diagnostics.where import Where
from cosim.gap.doubts.doubt import Doubt, unbelieved
from cosim.gap.estimation.drive import (
    model_parameters,
    quantities_of,
    rig_parameters,
    with_strengths_scaled,
)

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

#: What an answer is drawn by, which knows the answer: asked for by name, by who wants it drawn, so
#: that nothing here waits for matplotlib.
SHOWN = "cosim.gap.shown"

#: What can be said of a campaign.
VERDICTS = ("named", "class", "none", "partial", "unknown")


@dataclass(frozen=True)
class Ranked:
    """An effect tried on top of the plain model.

    Attributes
    ----------
    effect, form : id of the catalogue, and which of its laws, in a word
    held_out_gap, fit_gap : root mean square residual in units of the noise; None where screening
        ruled it out and nothing was fitted
    delta_bic : BIC of the plain model less that of this one, or, of runs with tracks, -2 ln of the
        evidence, which a BIC approximates; positive speaks for the effect. None where no period
        of a wave stood out of noise
    parameters : `block.parameter` -> fitted value, SI
    intervals : `block.parameter` -> 95 % interval (low, high); of those that have one
    probability : that the effect is what is missing, were nothing or one effect of those tried
        missing, either as probable beforehand; None where it was not worked out
    undetermined : those of ``parameters`` whose interval is all that they may be
    """

    effect: str
    form: str
    held_out_gap: float | None
    fit_gap: float | None
    delta_bic: float | None
    parameters: Mapping[str, float]
    intervals: Mapping[str, tuple[float, float]]
    probability: float | None = None
    undetermined: tuple[str, ...] = ()


@dataclass(frozen=True)
class Step:
    """A model of the ladder: plain, with one effect, with two, ...

    Attributes
    ----------
    effects : in the order found
    gain : in -2 ln evidence over the step before
    fit_gap, held_out_gap : root mean square residual, units of the noise
    share : part of the plain model's misfit, in -2 ln evidence, that is gone so far
    members : what does as well in the last effect's place, itself included -> its probability
    """

    effects: tuple[str, ...]
    gain: float
    fit_gap: float
    held_out_gap: float
    share: float
    members: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Power:
    """By which power of a quantity an effect's strength goes, beyond what the catalogue's law says.

    Attributes
    ----------
    effect, quantity : id, and mass, speed or stiffness
    value, low, high : the exponent and its 90 % interval
    p : probability of so large a one where strengths do not go with the quantity
    stated : whether it is part of the model
    instead : quantities that vary with this one: these runs cannot tell which it is
    """

    effect: str
    quantity: str
    value: float
    low: float
    high: float
    p: float
    stated: bool
    instead: tuple[str, ...] = ()


@dataclass(frozen=True)
class Law:
    """An effect's law as a free curve over its axis; effect "": of no effect that was named.

    in_model : the curve is the table of friction of the extended model
    """

    effect: str
    curve: Curve
    in_model: bool = False


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
    setup : number of the mass and springs that it was made with
    stretch : mu_s and mu_k in the stretch up to where the model starts anew, parts of the run's
    """

    track: ModelTrack
    start: tuple[float, float, float, float, float, float]
    gap: float
    own: Mapping[str, float] = field(default_factory=dict)
    setup: int = 0
    stretch: tuple[float, float] = (1.0, 1.0)

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
    at_bound : those of ``values`` that the fit would turn further -> the bound that they are at
    undetermined : those of ``values`` whose interval is all that they may be: the data say nothing
        of them, and the value is only where the fit ended
    """

    values: Mapping[str, float]
    settings: Mapping[str, float]
    intervals: Mapping[str, tuple[float, float]]
    degrees_of_freedom: tuple[str, ...]
    runs: tuple[FittedRun, ...]
    gap: tuple[float, float]
    at_bound: Mapping[str, float] = field(default_factory=dict)
    undetermined: tuple[str, ...] = ()

    def of(self, name: str) -> FittedRun:
        """The run of that name; KeyError when there is none."""
        for run in self.runs:
            if run.name == name:
                return run
        raise KeyError(name)

    def parameters(self, run: FittedRun) -> dict[str, float]:
        """`block.parameter` -> value for one run: fitted, set, its own; not the tracker's."""
        measured = run.track.run
        every = {**self.settings, **self.values, **run.own}
        every = with_strengths_scaled(every, quantities_of(measured))
        every = model_parameters(measured.surface_speed, every)
        known = {"springs.stiffness": measured.stiffness, "rig.mass": measured.mass}
        every = rig_parameters(run.setup, known, every, measured.surface_speed)
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
    effects : ids in the order found; for "class" its members; of "partial" what surely helps
    classes : groups of effects that this campaign cannot tell apart
    where : channel, regime and runs of the plain model's misfit, and a sentence
    ranking : every effect tried on top of the plain model, best first
    gap_before, gap_after : (fit, held out), units of the noise; after is before where nothing
        was added
    plain : the plain model, refitted
    extended : with what was found (for "class": the member that fits best); None: nothing added
    ladder : plain, one effect, two, ..., each with what it gains and leaves
    share : part of the plain model's misfit, in -2 ln evidence, that the last step takes away
    reasons : what the last step needs and a rig as stated does not have, a line each
    spreads : what differs from run to run, and within one, by itself -> standard deviation
    powers : by what powers of mass, speed and stiffness the strengths of what was found go
    laws : free curves, of what was found, or of what comes nearest to it
    remains : where the extended model's misfit is; None where nothing was added
    quantisation : step (m), share of the samples on it, p; None where no step is felt
    determined : plain parameter -> (value, low, high), as far as the data determine it
    analysis : of the plain model's misfit by regime, what ``where`` was read off
    next_experiment : the run that would tell most, or None
    empirical : the formula proposed where the catalogue has no name, or None
    remarks : what the reader should know, a line each; the campaign's own are in the campaign
    lacks : what the data lack where no model fits, a line each
    doubts : what of the record, or of the numbers stated, is not as it should be
    believed : False where the verdict is "unknown" for a doubt alone, whatever was found
    searched : False where no effect was looked for, as nothing could explain that doubt
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
    determined: Mapping[str, tuple[float, float, float]]
    ladder: tuple[Step, ...] = ()
    share: float = 0.0
    reasons: tuple[str, ...] = ()
    spreads: Mapping[str, float] = field(default_factory=dict)
    powers: tuple[Power, ...] = ()
    laws: tuple[Law, ...] = ()
    remains: Where | None = None
    quantisation: Mapping[str, float] | None = None
    analysis: RegimeAnalysis | None = None
    next_experiment: Mapping[str, Any] | None = None
    empirical: Mapping[str, Any] | None = None
    remarks: tuple[str, ...] = ()
    lacks: tuple[str, ...] = ()
    doubts: tuple[Doubt, ...] = ()
    believed: bool = True
    searched: bool = True

    @property
    def has_held_out(self) -> bool:
        """Whether some run was kept from the fit; else held-out gaps are those of the fit."""
        return any(run.track.run.hold_out for run in self.plain.runs)

    @property
    def explaining(self) -> tuple[str, ...]:
        """Effects that may be the reason of a doubt: what fits, with numbers that are the data's.

        What takes a part of the misfit alone, or stands at a bound, explains no figure.
        """
        if self.verdict not in ("named", "class"):
            return ()
        bounds = self.extended.at_bound if self.extended is not None else {}
        return tuple(
            effect for effect in self.effects
            if not any(key == effect or key.startswith(f"{effect}.") for key in bounds)
        )  # fmt: skip

    def doubted(self, doubts: tuple[Doubt, ...]) -> Gap:
        """The answer beside these doubts: "unknown" where one of them leaves nothing to believe.

        The ladder and the ranking stay, as what was found; nothing is added to the model.
        """
        with_doubts = replace(self, doubts=doubts)
        if self.verdict == "unknown" or not unbelieved(doubts, self.explaining):
            return with_doubts
        return replace(
            with_doubts, verdict="unknown", effects=(), classes=(), extended=None, laws=(),
            powers=(), remains=None, next_experiment=None, gap_after=self.gap_before,
            believed=False,
        )  # fmt: skip

    def __repr__(self) -> str:
        """Verdict and gap in one line; everything else is in its attributes."""
        named = f" {', '.join(self.effects)}" if self.effects else ""
        (fit, _), (left, _) = self.gap_before, self.gap_after
        return f"<Gap of {self.campaign.name}: {self.verdict}{named}; fit {fit:.3g} -> {left:.3g}>"

    def to_xarray(self) -> xarray.Dataset:
        """Every run as measured and as the models have it over ``sample`` (n,), with units, and
        figures of each run over ``run`` (r,); all of `gap.json` as the attribute `gap`."""
        dataset: xarray.Dataset = import_module(SHOWN).gap_dataset(self)
        return dataset

    def plot(self, figure: str = "gaps") -> Figure:
        """One of the figures of the page: gaps, ranking, overlay_x, residuals, ladder, ...

        Raises ValueError for a name that is none, with the nearest that there is.
        """
        drawn: Figure = import_module(SHOWN).figure_of(self, figure)
        return drawn

    @property
    def model(self) -> FittedModel:
        """The best model that there is: the extended one, or the plain one."""
        return self.extended if self.extended is not None else self.plain

"""What the workflow says of a campaign: plain data, for whoever draws or writes it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from cosim.gap.data import Campaign
from cosim.gap.windows.fitted import Fitted
from cosim.result import Result

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

#: What draws; loaded when asked for.
NOTEBOOK, NUMBERS = "cosim.gap.notebook", "cosim.gap.show.numbers"
FILES = "cosim.gap.show.files"
#: Standard deviations to either side in which a number lies with 90 %.
NINETY = 1.645
#: Powers that differ by less make forces that differ by a tenth over a decade.
SAME_POWER = 0.05
#: What can be said of a campaign.
VERDICTS = ("named", "class", "none", "partial", "unknown")


@dataclass(frozen=True)
class Score:
    """Root mean square residual in units of the tracker's noise: 1 is noise.

    held_out : of the runs kept from every fit; None where none was
    """

    fit: float
    held_out: float | None

    @property
    def of_verdict(self) -> float:
        """Of held-out runs; of fitted ones where none was held out."""
        return self.fit if self.held_out is None else self.held_out

    @property
    def worst(self) -> float:
        """Of either."""
        return max(self.fit, self.of_verdict)


@dataclass(frozen=True)
class Rung:
    """A model of the ladder, each with one finding more than the one before.

    Attributes
    ----------
    name : "user's model", "contact", "scatter", an effect's id, or a measurement fault
    text : what it is, with its number, in a sentence
    gap : of the simulated model over windows of several cycles
    weak : of the equation of motion tested against the tracks (`weak_form`)
    share : part of the user's model's misfit that is gone so far, 0 to 1, by fitted runs' windows
    evidence : ln of how much more probable the rows are than on the rung before; None on the first
    """

    name: str
    text: str
    gap: Score
    weak: Score
    share: float
    evidence: float | None = None


@dataclass(frozen=True)
class Ranked:
    """An effect tried in the place of what was found first.

    Attributes
    ----------
    effect, form : id, and which of its laws or settings, in words
    evidence : ln of how much more probable the rows are with it than without
    probability : that it is what is missing, were one of those tried missing, all as probable
        beforehand but for faults and what has no name, a twentieth; where nothing was named,
        nothing is among them, by e^6, or e^3 times the best from there on
    gap : over windows, of the model with it; None where that model was not simulated
    parameters, intervals : `block.parameter` -> value, 90 % interval (low, high)
    undetermined : those of ``parameters`` of which the data say nothing
    """

    effect: str
    form: str
    evidence: float
    probability: float
    gap: Score | None = None
    parameters: Mapping[str, float] = field(default_factory=dict)
    intervals: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    undetermined: tuple[str, ...] = ()


@dataclass(frozen=True)
class Rejected:
    """An effect that the regression asked for and simulated runs did not confirm.

    evidence, simulated : ln of how much more probable the rows, and the simulated runs, are with
        it; None where the model has no such effect to simulate
    """

    effect: str
    evidence: float
    simulated: float | None


@dataclass(frozen=True)
class Law:
    """A named effect's law as a free curve over its argument, and the catalogue's that follows it.

    Attributes
    ----------
    effect : id, or the name of another finding
    quantity, unit : of the argument; per : of the values ("mu_k" parts of it, "mu_s", "N")
    at : (q,) arguments; mean, sd : (q,) of the curve there
    points : (p, 3) argument, value and standard deviation: what each run says by itself, of those
        that say something; run : (p,) their names
    form : the law of the catalogue that follows it, in words; "" where none does
    law : (q,) its values
    in_model : whether the curve itself is the law of the extended model
    """

    effect: str
    quantity: str
    unit: str
    per: str
    at: np.ndarray = field(repr=False)
    mean: np.ndarray = field(repr=False)
    sd: np.ndarray = field(repr=False)
    points: np.ndarray = field(repr=False)
    run: tuple[str, ...] = ()
    form: str = ""
    law: np.ndarray | None = field(default=None, repr=False)
    in_model: bool = False


@dataclass(frozen=True)
class Exponent:
    """By which power of a quantity an effect's force goes.

    quantity : sliding speed, mass, ...; value, low, high : and 90 % interval; catalogue : the power
    of the catalogue's own law
    """

    effect: str
    quantity: str
    value: float
    low: float
    high: float
    catalogue: float

    @property
    def holds(self) -> bool:
        """Whether the catalogue's power is in the interval, or as good as the one found."""
        near = abs(self.value - self.catalogue) < SAME_POWER
        return near or self.low <= self.catalogue <= self.high


@dataclass(frozen=True)
class RigNumber:
    """What the runs say of a number that the campaign states.

    name : in words ("surface speed of run03"); stated, stated_sd, value, sd : SI; unit
    at_bound : whether the runs ask for more than what is stated allows
    """

    name: str
    unit: str
    stated: float
    stated_sd: float
    value: float
    sd: float
    at_bound: bool = False


@dataclass(frozen=True)
class Rates:
    """The decision made again on campaigns of this design: truth -> answer -> how often.

    each : campaigns simulated of every truth
    """

    each: int
    table: Mapping[str, Mapping[str, int]]


@dataclass(frozen=True)
class Doubt:
    """What of the record, or of the numbers stated, is not as it should be.

    check : in a word; text : a line; runs : names; severe : nothing can be concluded beside it
    """

    check: str
    text: str
    runs: tuple[str, ...] = ()
    severe: bool = False


@dataclass(frozen=True)
class Where:
    """Where the user's model misses most.

    channel : x, y, phi; regime : stick, slip, break-away, across; runs : the worst first; text
    """

    channel: str
    regime: str
    runs: tuple[str, ...]
    text: str


@dataclass(frozen=True)
class Gap(Result):
    """The answer.

    Attributes
    ----------
    verdict : one of `VERDICTS`
    effects : ids in the order found; for "class" its members
    sentence : the answer in a sentence
    classes : groups of effects that this campaign cannot tell apart
    where : of the misfit of the user's model
    ladder : the user's model first, then each finding
    ranking : every effect tried, most probable first; rejected : not confirmed by simulated runs
    plain, extended : user's model and the last of the ladder, simulated over the same windows
    laws, exponents : of what was found
    scatter : of friction from run to run: (value, low, high), parts of it; None: nothing to tell by
    rig : what the runs say of the rig's stated numbers
    rates : how often this design would answer what; None where it was not asked
    next_experiment : of a class: the run that would separate it; None of a name, which these runs
        tell from every other already
    doubts : of the data, a line each
    """

    campaign: Campaign
    verdict: str
    effects: tuple[str, ...]
    sentence: str
    classes: tuple[tuple[str, ...], ...]
    where: Where
    ladder: tuple[Rung, ...]
    ranking: tuple[Ranked, ...]
    plain: Fitted
    extended: Fitted
    laws: tuple[Law, ...] = ()
    exponents: tuple[Exponent, ...] = ()
    scatter: tuple[float, float, float] | None = None
    rig: tuple[RigNumber, ...] = ()
    rates: Rates | None = None
    next_experiment: Mapping[str, Any] | None = None
    doubts: tuple[Doubt, ...] = ()
    rejected: tuple[Rejected, ...] = ()

    def __repr__(self) -> str:
        """Verdict and gap in one line; everything else is in its attributes."""
        named = f" {', '.join(self.effects)}" if self.effects else ""
        fit, left = self.before.fit, self.after.fit
        return f"<Gap of {self.campaign.name}: {self.verdict}{named}; fit {fit:.3g} -> {left:.3g}>"

    def to_xarray(self) -> xarray.Dataset:
        """Every run as measured and as the models have it over ``sample`` (n,), with units, and
        figures of each run over ``run`` (r,); all of `gap.json` as the attribute `gap`."""
        return cast("xarray.Dataset", import_module(NOTEBOOK).gap_dataset(self))

    def plot(self, figure: str = "ladder") -> Figure:
        """One of the figures of the page: ladder, curve, run, residuals, overlay_x, ...

        Raises ValueError for a name that is none, with the nearest that there is.
        """
        return cast("Figure", import_module(NOTEBOOK).figure_of(self, figure))

    def summary(self) -> dict[str, Any]:
        """What `gap.json` holds."""
        return dict(import_module(NUMBERS).as_data(self, ""))

    def _answer(self) -> tuple[str, Sequence[tuple[str, str]]]:
        fit = f"{self.before.fit:.3g} → {self.after.fit:.3g}"
        figures = [("verdict", self.verdict), ("gap, 1 is noise", fit)]
        if self.before.held_out is not None and self.after.held_out is not None:
            held_out = f"{self.before.held_out:.3g} → {self.after.held_out:.3g}"
            figures.append(("of runs held out", held_out))
        return self.sentence, figures

    def _page(self) -> str:
        return str(import_module(FILES).page_text(self))

    def _write(self, folder: Path) -> None:
        files = import_module(FILES)
        files.write_data(self, folder / "gap.json", folder / "model.toml")
        corrected = files.write_corrected(self, folder)
        files.write_page(self, folder, folder / "report.html", lambda: None, corrected)

    @property
    def before(self) -> Score:
        """The gap of the user's model."""
        return self.ladder[0].gap

    @property
    def after(self) -> Score:
        """The gap of the last model of the ladder."""
        return self.ladder[-1].gap

    @property
    def share(self) -> float:
        """Part of the user's model's misfit that the ladder takes away."""
        return self.ladder[-1].share

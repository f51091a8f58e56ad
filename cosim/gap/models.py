"""The models of the ladder, each fitted over the same windows."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from cosim.gap.data import Campaign
from cosim.gap.extended import Part, contact_numbers, scatter_numbers, started_from
from cosim.gap.rates import scatter_of
from cosim.gap.report_of_findings import text_of
from cosim.gap.result import Rung, Score
from cosim.gap.weak_form.constants import SCATTER_PRIOR
from cosim.gap.weak_form.system import Rung as Rows
from cosim.gap.weak_form.system import System
from cosim.gap.windows import Fitted, Number, fit, user_model, windows_of_campaign
from cosim.gap.windows.run_model import BREAK_AWAY
from cosim.gap.windows.windows import Windows

#: A nuisance is a finding where it takes this part of the fitted runs' misfit or more, or brings
#: their gap down by a hundredth of noise.
FELT_PART, FELT_GAP = 0.02, 0.01
#: Gap up to which noise is all that is left: fitted starts take 1 or 2 % of it.
ONLY_NOISE = 1.02


@dataclass
class Models:
    """The ladder's models, each fitted over the same windows.

    starts : labels -> values from which runs' own numbers start; jobs : runs simulated at a time
    fits, ladder : one a rung; free : its numbers, its settings and how much friction scatters
    scatter : of friction, with its 90 % interval
    """

    campaign: Campaign
    windows: Mapping[str, Windows]
    parts: Sequence[Part]
    starts: dict[str, float]
    jobs: int
    fits: list[Fitted] = field(default_factory=list)
    free: list[tuple[list[Number], dict[str, float], float]] = field(default_factory=list)
    ladder: list[Rung] = field(default_factory=list)
    scatter: tuple[float, float, float] | None = None

    @classmethod
    def fitted(
        cls, campaign: Campaign, system: System, rows: Rows, parts: Sequence[Part], *,
        step: Callable[[], None], jobs: int, others: Models | None = None,
    ) -> Models:  # fmt: skip
        """The user's model, then the findings, then contact and scatter where they are felt.

        others : whose windows and user's model these have as well
        """
        starts = {label: value for part in parts for label, value in part.starts.items()}
        windows = others.windows if others else windows_of_campaign(campaign)
        models = cls(campaign, windows, parts, starts, jobs)
        numbers, settings = user_model(campaign)
        weak = system.rung(contact=False, scatter=False)
        first = others.fits[0] if others else None
        models._add("user's model", "the model as stated", numbers, settings, weak, None, first)
        step()
        added, last = [], weak.evidence
        for part in parts:
            added += [*part.finding.added]
            rung = system.rung(added, contact=False, scatter=False)
            numbers, settings = [*part.numbers, *numbers], {**settings, **part.settings}
            models._add(part.effect, text_of(part), numbers, settings, rung, rung.evidence - last)
            last = rung.evidence
        step()
        fastest = max(float(np.percentile(np.abs(run.track.sliding), 99)) for run in system.runs)
        rung = system.rung(added, scatter=False)
        contact = contact_numbers(campaign, fastest)
        if models._try("contact", "the contact is not a switch", [*numbers, *contact], settings,
                       rung, rung.evidence - last):  # fmt: skip
            numbers, last = [*numbers, *contact], rung.evidence
        step()
        models.scatter = scatter_of(rows)
        spread = models.scatter[2]  # a run may lie at the far end of what is probable
        rung = system.rung(added)
        text = f"friction scatters from run to run by {100.0 * models.scatter[0]:.2g} %"
        settings = {**settings, BREAK_AWAY: SCATTER_PRIOR}
        if models._try("scatter", text, [*numbers, *scatter_numbers(campaign, spread)], settings,
                       rung, rung.evidence - last, spread):  # fmt: skip
            sticks = 100.0 * models.fits[-1].stick_scatter
            text += f", from stick to stick by {sticks:.2g} %"
            models.ladder[-1] = replace(models.ladder[-1], text=text)
        return models

    @property
    def unscattered(self) -> Score:
        """The gap before friction may scatter."""
        return [rung for rung in self.ladder if rung.name != "scatter"][-1].gap

    def gained(self, part: Part) -> float:
        """ln of how much more probable the runs are with a finding beside all that the ladder has.

        From where the ladder ended. A number that is less known with the finding is less probable
        beforehand, in every run.
        """
        (numbers, settings, scatter), near = self.free[-1], self.fits[-1]
        found = fit(
            self.campaign, self.windows, [*part.numbers, *numbers], {**settings, **part.settings},
            scatter, [{**near.values, **part.starts}], near, self.jobs,
        )  # fmt: skip
        known = {number.key: number.prior for number in numbers}
        wider = sum(
            math.log(number.prior / before) for number in part.numbers
            if number.prior and (before := known.get(number.key))
        )  # fmt: skip
        return found.gain_over(near) - len(near.runs) * wider

    def _fit(self, numbers: list[Number], settings: dict, scatter: float, rows: Rows) -> Fitted:
        before = {**self.starts, **(self.fits[-1].values if self.fits else {})}
        starts = [{**before, **started_from(self.campaign, rows)}, before]
        near = self.fits[-1] if self.fits else None
        return fit(self.campaign, self.windows, numbers, settings, scatter, starts, near, self.jobs)

    def _add(
        self, name: str, text: str, numbers: list[Number], settings: dict, rows: Rows,
        evidence: float | None, fitted: Fitted | None = None, scatter: float = 0.0,
    ) -> None:  # fmt: skip
        fitted = fitted or self._fit(numbers, settings, scatter, rows)
        self.fits.append(fitted)
        self.free.append((numbers, settings, scatter))
        gap = score_of(fitted)
        first = self.ladder[0].gap if self.ladder else gap
        missing = max(first.fit**2 - 1.0, 1e-9)
        share = min(max(1.0 - (gap.fit**2 - 1.0) / missing, 0.0), 1.0) if self.ladder else 0.0
        weak = Score(rows.gap, rows.held_out_gap)
        self.ladder.append(Rung(name, text, gap, weak, share, evidence))

    def _try(
        self, name: str, text: str, numbers: list[Number], settings: dict, rows: Rows,
        evidence: float, scatter: float = 0.0,
    ) -> bool:  # fmt: skip
        """Add what is felt; where noise is all that is left nothing can be."""
        before = self.ladder[-1].gap
        if max(before.fit, before.held_out or 0.0) < ONLY_NOISE:
            return False
        fitted = self._fit(numbers, settings, scatter, rows)
        after = score_of(fitted)
        gained = before.fit**2 - after.fit**2
        felt = gained > FELT_PART * max(before.fit**2 - 1.0, 0.0) and (
            before.fit - after.fit > FELT_GAP
        )
        if scatter and before.held_out and after.held_out:
            felt = felt or before.held_out - after.held_out > FELT_GAP
        if felt:
            self._add(name, text, numbers, settings, rows, evidence, fitted, scatter)
        return felt


def score_of(fitted: Fitted) -> Score:
    """Its gap."""
    fit, held_out = fitted.gap
    return Score(fit, None if math.isnan(held_out) else held_out)

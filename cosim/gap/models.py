"""The models of the ladder, each fitted over the same windows."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from cosim.gap.data import Campaign
from cosim.gap.extended import (
    ROUNDING,
    TRANSITION_SPEED,
    Part,
    contact_numbers,
    rounding_of,
    scatter_numbers,
    started_from,
)
from cosim.gap.judge import ONLY_NOISE
from cosim.gap.report_of_findings import text_of
from cosim.gap.result import Rung, Score
from cosim.gap.scatter import Scatter, averaged_over, scatter_text
from cosim.gap.weak_form.added import Added
from cosim.gap.weak_form.constants import LEAST_GAIN, STICK_SCATTER
from cosim.gap.weak_form.system import Rung as Rows
from cosim.gap.weak_form.system import System
from cosim.gap.windows import Fitted, Number, fit, user_model, windows_of_campaign
from cosim.gap.windows.fit import judge
from cosim.gap.windows.run_model import BREAK_AWAY
from cosim.gap.windows.score_test import ScoreTest
from cosim.gap.windows.windows import Windows

#: A nuisance is a finding where it takes this part of the fitted runs' misfit or more, or brings
#: their gap down by a hundredth of noise.
FELT_PART, FELT_GAP = 0.02, 0.01
#: Findings that make the gap of the user's model so many times as large are none; a right law has
#: raised it by a twentieth before the contact was fitted.
LOST = 1.5
#: Part of a finding with which a fit sets out from the model without it: at 0 the motion does not
#: feel what else its law has.
HARDLY = 0.02

#: Numbers of a model, and its settings.
_Free = tuple[list[Number], dict[str, float]]


@dataclass
class Work:
    """simulated : samples of runs (see `RunModel`)"""

    simulated: int = 0


@dataclass
class Models:
    """The ladder's models, each fitted over the same windows.

    system : rows of the fitted runs; jobs : runs simulated at a time
    fits, ladder : one a rung; free : its numbers, its settings and how much friction scatters
    scatter : of friction, with its 90 % interval, as the rows alone have it
    last : ln evidence of the last rung's rows
    is_scattered : whether friction has been let scatter, if it is to
    known : what was fitted to these windows before, by its numbers, settings and scatter
    set_out_from : the model from next to which that has been fitted, too
    tests : id of a fit of this ladder -> its score test
    work : of all fits to these windows
    """

    campaign: Campaign
    system: System
    windows: Mapping[str, Windows]
    parts: Sequence[Part]
    jobs: int
    fits: list[Fitted] = field(default_factory=list)
    free: list[tuple[list[Number], dict[str, float], float]] = field(default_factory=list)
    ladder: list[Rung] = field(default_factory=list)
    scatter: tuple[float, float, float] | None = None
    last: float | None = None
    is_scattered: bool = False
    known: dict[frozenset[object], Fitted] = field(default_factory=dict)
    set_out_from: dict[frozenset[object], Fitted] = field(default_factory=dict)
    tests: dict[int, ScoreTest] = field(default_factory=dict)
    work: Work = field(default_factory=Work)

    @classmethod
    def fitted(
        cls, campaign: Campaign, system: System, parts: Sequence[Part], *,
        step: Callable[[], None], jobs: int, others: Models | None = None, is_shown: bool = True,
    ) -> Models:  # fmt: skip
        """The user's model, then the findings, then a contact where it is felt.

        others : whose windows and fits these have as well; is_shown :
        each finding by itself; else all of them and a contact in one rung
        """
        windows = others.windows if others else windows_of_campaign(campaign)
        models = cls(campaign, system, windows, parts, jobs, known=others.known if others else {})
        models.work = others.work if others else models.work
        models._add_plain()
        step()
        if is_shown:
            models._add_parts()
            step()
            models.is_scattered = models.is_lost  # no contact makes up for that
            if not models.is_lost:
                models._try_contact()
        else:
            models._add_at_once()
        step()
        return models

    def _add_plain(self) -> None:
        """The user's model; where numbers are written in coarse steps, before and after these."""
        rows = self.system.rung(contact=False, scatter=False)
        text, grazing = "the model as stated", [n for n, w in self.windows.items() if w.grazes]
        if grazing:
            text += "; where the block reaches the surface's speed without a stick to be seen, it"
            text += f" is followed anew from there on ({', '.join(grazing)})"
        self._add("user's model", text, user_model(self.campaign), rows)
        rounding = rounding_of(self.campaign)
        if rounding is None:
            return
        fitted, first = self.fits[0], self.ladder[0]
        self.fits[0] = fitted.in_stated_units()
        gap = score_of(self.fits[0])
        larger, held_out = gap.fit / first.gap.fit, first.weak.held_out
        weak = Score(larger * first.weak.fit, held_out and larger * held_out)
        self.ladder[0] = replace(first, gap=gap, weak=weak)
        # of the fitted runs' residuals, in units of the one noise and of the other
        gain = sum(
            float(np.sum(0.5 * run.residuals**2 * (run.rounding**2 - 1.0) - np.log(run.rounding)))
            for run in fitted.runs if not run.hold_out
        )  # fmt: skip
        numbers, settings, _ = self.free[0]
        text = f"{text_of(rounding)}; what rounding adds counts as noise from here on"
        self._add(rounding.effect, text, (numbers, settings), rows, fitted, across=gain)

    @property
    def _plain(self) -> int:
        """Number of the rung before the findings."""
        return int(any(rung.name == ROUNDING for rung in self.ladder))

    def let_scatter(self) -> None:
        """Once: friction scatters, as the rows with all findings have it, where that is felt."""
        if not self.is_scattered:
            self.is_scattered = True
            self._try_scatter(Scatter.of(self.system.rung(self._added)))

    @property
    def _added(self) -> list[Added]:
        return [one for part in self.parts for one in part.finding.added]

    def _add_parts(self) -> None:
        added: list[Added] = []
        for part in self.parts:
            added += part.finding.added
            numbers, settings, _ = self.free[-1]
            more = [*part.numbers, *numbers], {**settings, **part.settings}
            rung = self.system.rung(added, contact=False, scatter=False)
            across = 0.0 if part.finding.added else part.finding.gain
            self._add(part.effect, text_of(part), more, rung, across=across)

    def _add_at_once(self) -> None:
        numbers, settings, _ = self.free[-1]
        numbers = [*(number for part in self.parts for number in part.numbers), *numbers]
        for part in self.parts:
            settings = {**settings, **part.settings}
        free = self._with_contact(numbers, settings)
        self._add("contact", "", free, self.system.rung(self._added, scatter=False))

    def _try_contact(self) -> None:
        numbers, settings, _ = self.free[-1]
        rung = self.system.rung(self._added, scatter=False)
        text = "the contact is not ideal: friction falls gradually, and it creeps under load"
        self._try("contact", text, self._with_contact(numbers, settings), rung)

    def _with_contact(self, numbers: Sequence[Number], settings: dict[str, float]) -> _Free:
        fastest = max(
            float(np.percentile(np.abs(run.track.sliding), 99)) for run in self.system.runs
        )
        return [*numbers, *contact_numbers(self.campaign, fastest)], settings

    def _try_scatter(self, scatter: Scatter) -> None:
        self.scatter = scatter.seen
        spread = scatter.expected[2]  # a run may lie at the far end of what is probable
        text = scatter_text(scatter.seen)
        numbers, settings, _ = self.free[-1]
        more = [*numbers, *scatter_numbers(self.campaign, spread)]
        settings = {**settings, BREAK_AWAY: STICK_SCATTER}
        if self._try("scatter", text, (more, settings), self.system.rung(self._added), spread):
            sticks = 100.0 * self.fits[-1].stick_scatter
            text += f", from stick to stick by {f'{sticks:.2g}' if sticks > 0.1 else '< 0.1'} %"
            self.ladder[-1] = replace(self.ladder[-1], text=text)

    @property
    def is_lost(self) -> bool:
        """Whether the findings make it much worse."""
        return self.unscattered.fit > LOST * self.ladder[self._plain].gap.fit

    def is_lost_beside(self, other: Models) -> bool:
        """Whether it is much worse than another, in fitted runs or in those that judge."""
        here, there = self.unscattered, other.unscattered
        return here.fit > LOST * there.fit or here.of_verdict > LOST * there.of_verdict

    @property
    def is_felt(self) -> bool:
        """Whether the findings take anything of the gap by themselves."""
        first = self._plain
        before, after = (self.ladder[n].gap.fit for n in (first, first + len(self.parts)))
        return before**2 - after**2 > FELT_PART * max(before**2 - 1.0, 0.0)

    @property
    def unscattered(self) -> Score:
        """The gap before friction may scatter."""
        return [rung for rung in self.ladder if rung.name != "scatter"][-1].gap

    def gained(self, part: Part, over: Part | None = None) -> float:
        """ln of how much more probable the runs are with a finding beside all that the ladder has.

        over : than with this one in its place; else than without it. Scatters of friction and of
        zeros are averaged over.
        """
        found, wider = self._beside(part)
        near, before = self._beside(over) if over else (self.fits[-1], 0.0)
        scatter, expected = self.free[-1][2], self.campaign.errors.friction
        less, more = (averaged_over(each, scatter, expected) for each in (near, found))
        return found.gain_over(near) - len(near.runs) * (wider - before) + more - less

    def nearer(self, part: Part) -> float:
        """The same by the runs' distances and what is stated alone: no scatter is averaged over."""
        return self._beside(part)[0].gain_over(self.fits[-1])

    def runs_with(self, fault: str) -> list[str]:
        """Names of the runs in which a fault of the last model is.

        As it has them, but those which it follows better by e^6 the other way round, of what all
        runs share as it is.
        """
        (numbers, settings, _), last, found = self.free[-1], self.fits[-1], []
        measured = {run.name: run for run in self.campaign.runs}
        for run in last.runs:
            key, near = f"{fault}_in@{run.name}", {run.name: run.states}
            without, with_it = (
                judge(
                    self.campaign, self.windows, numbers, {**settings, **last.values, key: there},
                    runs=[measured[run.name]], starts=[last.values], near=near, jobs=self.jobs,
                )
                for there in (0.0, 1.0)
            )  # fmt: skip
            gained = with_it.gain_over(without)
            is_in = gained > 0.0 if abs(gained) > LEAST_GAIN else settings[key] > 0.0
            found += [run.name] if is_in else []
        return found

    def promised(self, parts: Sequence[Part]) -> list[float | None]:
        """The same of several to first order, from derivatives at the last model (`ScoreTest`)."""
        (numbers, settings, _), last = self.free[-1], self.fits[-1]
        if id(last) not in self.tests:
            test = ScoreTest.at(self.campaign, self.windows, numbers, settings, last, self.jobs)
            self.tests[id(last)] = test
        test = self.tests[id(last)]
        return [test.promised(part.numbers, part.settings, part.starts) for part in parts]

    def _beside(self, part: Part) -> tuple[Fitted, float]:
        """With one more finding, from where the ladder ended; and ln of how much less probable
        every run is beforehand, where a number of it is less known with the finding."""
        (numbers, settings, scatter), near = self.free[-1], self.fits[-1]
        rows = self.system.rung([*self._added, *part.finding.added])
        as_rows = {**near.values, **part.starts, **self._by_rows(rows, part)}
        inside = {**near.values, **part.starts, **_next_to_nothing(part.numbers)}
        free = [*part.numbers, *numbers], {**settings, **part.settings}
        known = {number.key: number.prior for number in numbers}
        wider = sum(
            math.log(number.prior / before) for number in part.numbers
            if number.prior and (before := known.get(number.key))
        )  # fmt: skip
        found = self._fitted_once(free, scatter, [as_rows], near)
        if found.cost > near.cost:
            found = self._from_inside(found, free, scatter, inside, lambda fitted: fitted.cost)
        return found, wider

    def _fit(self, free: _Free, scatter: float, rows: Rows) -> Fitted:
        near = self.fits[-1] if self.fits else None
        own = {label: value for part in self.parts for label, value in part.starts.items()}
        before = {**own, **(near.values if near else {})}
        starts = [{**before, **self._by_rows(rows)}, before]
        found = self._fitted_once(free, scatter, starts, near)
        if near and found.gap[0] > near.gap[0] + FELT_GAP:
            held = {number.key for number in self.free[-1][0]}
            new = [number for number in free[0] if number.key not in held]
            inside = {**before, **_next_to_nothing(new)}
            found = self._from_inside(found, free, scatter, inside, lambda fitted: fitted.gap[0])
        return found

    def _from_inside(
        self, found: Fitted, free: _Free, scatter: float, inside: dict[str, float],
        measure: Callable[[Fitted], float],
    ) -> Fitted:  # fmt: skip
        """A fit that came out worse than the last model, though it holds that, or from next to it:
        the better of the two."""
        near, same = self.fits[-1], _same(*free, scatter)
        if self.set_out_from.get(same) is not near:  # asked again, it has been done
            again = self._solved(free, scatter, [inside], near)
            self.known[same] = min(found, again, key=measure)
            self.set_out_from[same] = near
        return self.known[same]

    def _by_rows(self, rows: Rows, *more: Part) -> dict[str, float]:
        """label -> value of the rig's numbers as the rows have them beside the laws."""
        starts = started_from(self.campaign, rows)
        for part in [*self.parts, *more]:
            for label in part.shifts.keys() & starts.keys():
                starts[label] += part.shifts[label]
        return starts

    def _fitted_once(
        self, free: _Free, scatter: float, starts: Sequence[dict[str, float]], near: Fitted | None
    ) -> Fitted:
        """The same numbers are fitted once, wherever the rows would have them set out from."""
        same = _same(*free, scatter)
        if same not in self.known:
            self.known[same] = self._solved(free, scatter, starts, near)
        return self.known[same]

    def _solved(
        self, free: _Free, scatter: float, starts: Sequence[dict[str, float]], near: Fitted | None
    ) -> Fitted:
        fitted = fit(self.campaign, self.windows, *free, scatter, starts, near, self.jobs)
        self.work.simulated += fitted.simulated
        return fitted

    def _add(
        self, name: str, text: str, free: _Free, rows: Rows, fitted: Fitted | None = None,
        scatter: float = 0.0, across: float = 0.0,
    ) -> None:  # fmt: skip
        """across : ln evidence of what moves the block across, which rows along x have not"""
        fitted = fitted or self._fit(free, scatter, rows)
        self.fits.append(fitted)
        self.free.append((*free, scatter))
        gap, share, evidence = score_of(fitted), 0.0, None
        if self.last is not None:
            missing = max(self.ladder[0].gap.fit ** 2 - 1.0, 1e-9)
            share = min(max(1.0 - (gap.fit**2 - 1.0) / missing, 0.0), 1.0)
            evidence = rows.evidence - self.last + across
        self.last = rows.evidence
        weak = Score(rows.gap, rows.held_out_gap)
        self.ladder.append(Rung(name, text, gap, weak, share, evidence))

    def _try(self, name: str, text: str, free: _Free, rows: Rows, scatter: float = 0.0) -> bool:
        """Add what is felt; where noise is all that is left nothing can be."""
        before = self.ladder[-1].gap
        if before.worst < ONLY_NOISE:
            return False
        fitted = self._fit(free, scatter, rows)
        after = score_of(fitted)
        gained = before.fit**2 - after.fit**2
        felt = gained > FELT_PART * max(before.fit**2 - 1.0, 0.0) and (
            before.fit - after.fit > FELT_GAP
        )
        if scatter and before.held_out and after.held_out:
            felt = felt or before.held_out - after.held_out > FELT_GAP
        if felt:
            self._add(name, text, free, rows, fitted, scatter)
        return felt


def _next_to_nothing(numbers: Sequence[Number]) -> dict[str, float]:
    """key -> value from which a model is next to the one without these numbers."""
    slight = {n.key: HARDLY * n.start for n in numbers if n.may_vanish}
    sudden = {n.key: n.low for n in numbers if n.key == TRANSITION_SPEED}
    return slight | sudden


def _same(
    numbers: Sequence[Number], settings: Mapping[str, float], scatter: float
) -> frozenset[object]:
    """What tells one least-squares problem from another: a start alone does not."""
    terms = ((n.key, n.scope, n.low, n.high, n.prior and (n.start, n.prior)) for n in numbers)
    return frozenset([*terms, *settings.items(), scatter])


def score_of(fitted: Fitted) -> Score:
    """Its gap."""
    fit, held_out = fitted.gap
    return Score(fit, None if math.isnan(held_out) else held_out)

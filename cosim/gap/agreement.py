"""What the rows of a campaign and its simulated runs agree on."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace

from cosim.gap import judge
from cosim.gap.data import Campaign
from cosim.gap.extended import Part, as_points, part_of, rounding_of
from cosim.gap.laws import LawFit
from cosim.gap.models import Models
from cosim.gap.naming import Named, Naming
from cosim.gap.result import Rejected, Score
from cosim.gap.weak_form.camera_faults import SMOOTHING, likeliest_filters
from cosim.gap.weak_form.constants import ALIKE, LEAST_GAIN, MOST_FINDINGS
from cosim.gap.weak_form.ladder import Finding, price_of
from cosim.gap.windows.run_model import LOADING

#: Name -> what it would put into the model, and ln of how much more probable simulated runs are
#: with it than with the finding that it is a rival of.
_Rivals = Mapping[str, tuple[Part, float]]


@dataclass(frozen=True)
class Agreed:
    """Findings of the rows that the simulated runs ask for too, and the models with them.

    rejected : what the rows ask for and the simulated runs do without; left_without : what is
    missing without any finding, where the models with them do not explain the runs
    """

    named: Named
    parts: list[Part]
    models: Models
    rejected: tuple[Rejected, ...] = ()
    left_without: Score | None = None


def confirmed_findings(campaign: Campaign, fitting: Fitting) -> Agreed:
    """What rows and simulated runs both ask for.

    Rows are read off a smoothed track, and a contact that is no switch may pretend something in
    them; simulated runs have other faults. What they do without is not asked of the rows again.
    """
    naming = Naming.of(campaign)
    fitting.step()
    rejected: list[Rejected] = []
    rounds = iter(judge.findings_by_rounds())
    while True:
        named = naming.named([one.effect for one in rejected], next(rounds, 0))
        agreed = fitting.agreed(named)
        if isinstance(agreed, Agreed):
            return replace(agreed, rejected=tuple(rejected))
        rejected += agreed


@dataclass
class Fitting:
    """Models of findings, fitted over the same windows.

    known : what was fitted already, and whether each finding by itself
    """

    campaign: Campaign
    step: Callable[[], None]
    jobs: int
    known: list[tuple[Models, bool]] = field(default_factory=list)

    def agreed(self, named: Named) -> Agreed | Sequence[Rejected]:
        """Findings that the simulated runs ask for, too, or those that they do without."""
        if unsure := self.unsure(named):
            return unsure
        named = self.with_likeliest_filter(named)
        parts = [self.part(named, finding) for finding in named.findings]
        if self.is_beyond_all(named):
            return Agreed(named, parts, self.fitted(named, parts))
        most = max((part.finding.gain for part in parts), default=0.0)
        faint = {part.finding.name for part in parts
                 if judge.may_be_spurious(part.finding, part.finding.gain == most)}  # fmt: skip
        if outdone := self.outdone(parts, named, faint):
            return outdone
        if doubted := self.lost(parts, named, faint) or self.rejected(parts, named, faint):
            return [doubted]
        along = {part.finding.name for part in parts if part.finding.added}
        before, (parts, named) = parts, self.further(parts, named)
        if len(parts) > len(before):  # beside it a lesser one may be needless
            new = parts[-1].finding.gain
            lesser = {part.finding.name for part in before if part.finding.gain < new}
            if doubted := self.rejected(parts, named, lesser & along):
                return [doubted]
        found, models = self.best_of(parts, named)
        is_near = judge.explains(models.ladder) and models.is_felt
        if not is_near and (doubted := self.rejected(parts, named, along - faint)):
            return [doubted]
        rivals = self.rivals(parts, named, models)
        if doubted := self.overruled(parts, named, rivals):
            return [doubted]
        named = self.told_apart(named, rivals)
        found = [replace(part, finding=finding)
                 for part, finding in zip(found, named.findings, strict=True)]  # fmt: skip
        return Agreed(named, found, models, left_without=self.left_without(found, models, named))

    def part(self, named: Named, finding: Finding, law: LawFit | None = None) -> Part:
        """What a finding puts into the model."""
        return part_of(self.campaign, named.system, named.rung, finding, law)

    def with_likeliest_filter(self, named: Named) -> Named:
        """With a tracker's filter of the kind, and in the runs, that simulated runs prefer.

        Rows are told of it by corners alone: these hardly tell kinds from one another, and nothing
        of runs whose sticks are shorter than the filter.
        """
        if [finding.name for finding in named.findings] != [SMOOTHING]:
            return named
        (finding,), rows = named.findings, named.ladder.system.rung()
        offers = likeliest_filters(rows, named.unknowns[SMOOTHING])
        forms = [_with(named, replace(finding, gain=gain, added=(added,)))
                 for gain, added in offers if gain > finding.gain - judge.TURNED]  # fmt: skip

        def missed(form: Named) -> float:
            parts = [self.part(form, form.findings[0])]
            return self.fitted(form, parts, is_shown=False, scatters=False).unscattered.worst

        chosen = min(forms, key=missed)
        rung = named.ladder.system.rung(chosen.findings[0].added)
        return replace(chosen, ladder=replace(named.ladder, findings=chosen.findings, rung=rung))

    def is_beyond_all(self, named: Named) -> bool:
        """Whether no doubt of single findings leads to a name: runs miss something, too."""
        return judge.is_beyond_all(named.findings, named.ladder.rung.gap) and judge.leaves(
            self.fitted(named, [], is_shown=False).ladder[-1].gap
        )

    def unsure(self, named: Named) -> list[Rejected]:
        """Beside coarse steps, whose errors go together from sample to sample, what is not sure."""
        if rounding_of(self.campaign) is None:
            return []
        return [Rejected(one.name, one.gain, None)
                for one in named.findings if one.added and one.gain < judge.SURE]  # fmt: skip

    def further(self, parts: list[Part], named: Named) -> tuple[list[Part], Named]:
        """With one more finding along x that simulated runs are much more probable with.

        The contact's numbers and scatter may leave rows next to nothing of it. Not beside coarse
        steps, whose errors go together (`unsure`).
        """
        beside = len(named.ladder.findings) + 1
        if rounding_of(self.campaign) is not None or beside >= MOST_FINDINGS:
            return parts, named
        without, found = self.fitted(named, parts), []
        for part in self._promising(named, without):
            gained = without.gained(part) - price_of(part.finding.name)
            if judge.is_hidden(gained) and judge.runs_ask(without.nearer(part)):
                found.append(replace(part, finding=replace(part.finding, gain=gained)))
        if not found:
            return parts, named
        part = max(found, key=lambda one: one.finding.gain)
        others = {one.finding.name: one.finding.gain - part.finding.gain
                  for one in found if one is not part}  # fmt: skip
        finding = replace(part.finding, others=others)
        return [*parts, replace(part, finding=finding)], _with(named, *named.findings, finding)

    def _promising(self, named: Named, without: Models) -> list[Part]:
        """What the simulated runs' derivatives promise to gain by, the most promising first."""
        parts, rows = {}, {}
        for name, (evidence, added) in named.ladder.further_offers.items():
            finding = Finding(name, added, 0.0)
            part = self.part(_with(named, *named.findings, finding), finding)
            if part.in_kernel and not name.startswith("other."):
                parts[name], rows[name] = part, evidence - named.ladder.rung.evidence
        promised = dict(zip(parts, without.promised(list(parts.values())), strict=True))
        sooner, is_lone = without.fits[-1].values.get(LOADING, 0.0), not named.ladder.findings
        left = without.ladder[-1].gap
        names = judge.promising(promised, rows, left, is_lone, sooner)
        return [parts[name] for name in names]

    def _gained(self, part: Part, without: Models, named: Named) -> float:
        """ln of how much more probable simulated runs are with a finding.

        Laws that follow a curve alike move the block differently: where the first brings neither
        enough nor as much less, another form of it counts with which they are much more so.
        """
        first = without.gained(part)
        if abs(first) <= LEAST_GAIN + price_of(part.finding.name):
            for law in part.rivals(self.campaign):
                if law.effect == part.effect:
                    gained = without.gained(self.part(named, part.finding, law))
                    if judge.much_more(gained):
                        return gained
        return first

    def best_of(self, parts: list[Part], named: Named) -> tuple[list[Part], Models]:
        """With laws that follow the curves, or with the curves where the runs ask for them.

        Where laws of two effects follow a curve, as one of the user's own and the catalogue's may,
        it is the one with which runs come out better that no fit has seen.
        """
        models = self.fitted(named, parts)
        for part in parts:
            for law in part.rivals(self.campaign):
                if law.effect == part.effect and judge.explains(models.ladder):
                    continue  # another form of it hardly tells
                other = self.part(named, part.finding, law)
                swapped = [other if one.finding is part.finding else one for one in parts]
                others = self.fitted(named, swapped)
                if others.ladder[-1].gap.of_verdict < models.ladder[-1].gap.of_verdict:
                    parts, models = swapped, others
        if not judge.explains(models.ladder):  # a law may be near its curve, and not near enough
            points = [as_points(self.campaign, named.system, part) for part in parts]
            if points != parts:
                others = self.fitted(named, points)
                if others.ladder[-1].gap.of_verdict < models.ladder[-1].gap.of_verdict:
                    return points, others
        return parts, models

    def rejected(
        self, parts: Sequence[Part], named: Named, asked: Collection[str]
    ) -> Rejected | None:
        """The least of the findings asked for that the simulated runs do without.

        The least first: what a greater one leaves may pretend a small one, and with it gone the
        greater one is seldom in doubt; but before it those that the model has not, beside which
        simulated runs tell nothing. What a finding takes of the gap is asked only where the runs
        ask for all of them: beside one that is none, no other does well.
        """
        least_first = sorted(parts, key=lambda part: (part.in_kernel, part.finding.gain))
        for is_needed in (self._is_asked_for, self._makes_up):
            for part in least_first:
                if part.finding.name in asked and not is_needed(part, parts, named):
                    without = self._without(part, parts, named)
                    gained = self._gained(part, without, named) if part.in_kernel else None
                    return Rejected(part.finding.name, part.finding.gain, gained)
        return None

    def outdone(
        self, parts: Sequence[Part], named: Named, asked: Collection[str]
    ) -> list[Rejected]:
        """Of several lesser findings those asked for, where the greatest explains the runs alone.

        One by one they would all go (see `rejected`), each after fits of its own; not so where
        simulated runs are sure of one.
        """
        greatest = _greatest(parts)
        lesser = [part for part in parts if part is not greatest and part.finding.name in asked]
        if greatest is None or len(lesser) < 2 or any(p.finding.gain >= judge.SURE for p in lesser):
            return []
        alone = self.fitted(named, [greatest], is_shown=False, scatters=False)
        if alone.unscattered.of_verdict > judge.EXPLAINED:
            return []
        alone.let_scatter()
        gained = [alone.gained(part) if part.in_kernel else None for part in lesser]
        if any(gain is not None and gain >= judge.SURE for gain in gained):
            return []
        return [Rejected(part.finding.name, part.finding.gain, gain)
                for part, gain in zip(lesser, gained, strict=True)]  # fmt: skip

    def lost(self, parts: Sequence[Part], named: Named, asked: Collection[str]) -> Rejected | None:
        """The greatest finding, where simulated runs are much worse with it alone, and ask for it
        by no more than e^30 beside contact and scatter: nothing is built upon it."""
        greatest = _greatest(parts)
        if greatest is None or greatest.finding.name not in asked or not greatest.in_kernel:
            return None
        alone = self.fitted(named, [greatest], is_shown=False, scatters=False)
        without = self.fitted(named, [], is_shown=False, scatters=False)
        if not alone.is_lost_beside(without):
            return None
        without.let_scatter()
        gained = self._gained(greatest, without, named)
        if judge.much_more(gained - price_of(greatest.finding.name)):
            return None
        return Rejected(greatest.finding.name, greatest.finding.gain, gained)

    def _without(self, part: Part, parts: Sequence[Part], named: Named) -> Models:
        return self.fitted(named, [other for other in parts if other is not part], is_shown=False)

    def _is_asked_for(self, part: Part, parts: Sequence[Part], named: Named) -> bool:
        """Whether the simulated runs are more probable with a finding beside the others.

        A lesser one below e^500, in rows and runs, is no more than what a law leaves that is not
        quite the greater one's, where the others explain the runs and friction need not scatter.
        """
        without = self._without(part, parts, named)
        is_lesser = part.finding.gain < max(other.finding.gain for other in parts)
        gained = self._gained(part, without, named) if part.in_kernel else 0.0
        is_sure = max(part.finding.gain, gained) >= judge.SURE
        if is_lesser and not is_sure and without.unscattered.of_verdict <= judge.EXPLAINED:
            return False
        if not part.in_kernel:
            return judge.leaves(
                without.ladder[-1].gap, judge.EXPLAINED if is_lesser else judge.NOTHING_MISSING
            )
        name = part.finding.name
        return judge.runs_ask(gained - price_of(name)) and judge.not_by_scatter_alone(
            name, gained, without.nearer(part)
        )

    def _makes_up(self, part: Part, parts: Sequence[Part], named: Named) -> bool:
        """Whether it takes what is missing without it, or half of that; or half before scatter.

        What makes the runs e^500 times as probable is a part of what is missing, also where the
        contact or a friction that may scatter from run to run have taken it up; a trend over the
        runs beside a greater one, which scatter takes up, where it makes them e^12 times as so.
        """
        without = self._without(part, parts, named)
        is_missed = judge.leaves(before := without.ladder[-1].gap)
        if not part.in_kernel:
            return True
        found = self.fitted(named, parts)
        if found.is_lost:
            return False
        is_lone, gained = len(parts) == 1, without.gained(part)
        if judge.needs_no_misfit(part.finding.name, gained, is_lone) or (is_lone and not is_missed):
            return True
        after = found.ladder[-1].gap
        if is_missed and (not judge.leaves(after) or judge.halves(after, before)):
            return True
        left = without.unscattered
        return judge.leaves(left) and judge.halves(found.unscattered, left)

    def left_without(self, parts: Sequence[Part], models: Models, named: Named) -> Score | None:
        """What the runs miss without any finding; None where the model with them is near enough."""
        if not parts or judge.explains(models.ladder):
            return None
        return self.fitted(named, [], is_shown=False).ladder[-1].gap

    def rivals(self, parts: Sequence[Part], named: Named, models: Models) -> _Rivals:
        """Of a lone finding along x what the rows would nearly have in its place, simulated.

        What no effect stands for is no more than the model without it.
        """
        lone = _lone(parts)
        if lone is None:
            return {}
        finding = lone.finding
        near = judge.rivals_of(finding, judge.explains(models.ladder))
        rivals = {name: self._in_place(named, name) for name in near}
        if not rivals:
            return {}
        without = self._without(lone, parts, named)
        return {name: (rival, self._more(rival, lone, without, named))
                for name, rival in rivals.items() if rival.in_kernel}  # fmt: skip

    def _more(self, rival: Part, lone: Part, without: Models, named: Named) -> float:
        """ln of how much more probable simulated runs are with a rival than with the finding.

        By any form of its law, where rows hardly tell it.
        """
        finding, forms = lone.finding, [rival]
        if finding.others[rival.finding.name] > -ALIKE:
            there = _with(named, rival.finding)
            forms += [self.part(there, rival.finding, law) for law in rival.rivals(self.campaign)
                      if law.effect == rival.effect]  # fmt: skip
        over, price = (lone, price_of(finding.name)) if lone.in_kernel else (None, 0.0)
        return (
            max(without.gained(form, over) for form in forms) - price_of(rival.finding.name) + price
        )

    def overruled(self, parts: Sequence[Part], named: Named, rivals: _Rivals) -> Rejected | None:
        """A lone finding that simulated runs put so far behind a rival that the rows must err.

        Runs that no fit has seen must come out better with the rival, too; and be explained by it
        in place of what no effect stands for.
        """
        lone = _lone(parts)
        if lone is None:
            return None
        for name, (rival, more) in rivals.items():
            if judge.overrules(lone.finding.others[name], more):
                in_place = [rival if part is lone else part for part in parts]
                with_it, own = (self.fitted(named, some) for some in (in_place, parts))
                is_better = with_it.ladder[-1].gap.of_verdict < own.ladder[-1].gap.of_verdict
                if is_better and (lone.in_kernel or judge.explains(with_it.ladder)):
                    without = self._without(lone, parts, named)
                    gained = without.gained(lone) if lone.in_kernel else None
                    return Rejected(lone.finding.name, lone.finding.gain, gained)
        return None

    def told_apart(self, named: Named, rivals: _Rivals) -> Named:
        """A lone finding with its rivals as rows and simulated runs have them.

        One that the rows do not tell from it goes where simulated runs do; one that they put behind
        it stays as probable where simulated runs put it before.
        """
        if not rivals:
            return named
        *across, finding = named.findings
        others = dict(finding.others)
        for name, (_, more) in rivals.items():
            others[name] = judge.told_by_both(finding, name, more)
        return replace(named, findings=(*across, replace(finding, others=others)))

    def _in_place(self, named: Named, name: str) -> Part:
        """What another explanation would put into the model."""
        finding = Finding(name, named.ladder.first_offers[name][1], 0.0)
        return self.part(_with(named, finding), finding)

    def fitted(
        self, named: Named, parts: Sequence[Part], is_shown: bool = True, scatters: bool = True
    ) -> Models:
        """Models of these findings; of what no page shows friction need not scatter."""
        ids = list(map(id, parts))
        known = (models for models, was_shown in self.known
                 if list(map(id, models.parts)) == ids and (was_shown or not is_shown))  # fmt: skip
        models = next(known, None)
        if models is None:
            models = Models.fitted(
                self.campaign, named.system, parts, step=self.step, jobs=self.jobs,
                others=self.known[0][0] if self.known else None, is_shown=is_shown,
            )  # fmt: skip
            self.known.append((models, is_shown))
        if scatters:
            models.let_scatter()
        return models


def _with(named: Named, *findings: Finding) -> Named:
    """The same rows with these findings in place of its own."""
    added = [one for finding in findings for one in finding.added]
    return replace(named, findings=findings, rung=named.system.rung(added))


def _lone(parts: Sequence[Part]) -> Part | None:
    """The only finding along x, beside what moves the block across."""
    along = [part for part in parts if part.finding.added]
    return along[0] if len(along) == 1 else None


def _greatest(parts: Sequence[Part]) -> Part | None:
    return max(parts, key=lambda part: part.finding.gain, default=None)

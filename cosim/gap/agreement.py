"""What the rows of a campaign and its simulated runs agree on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from cosim.gap import judge
from cosim.gap.data import Campaign
from cosim.gap.extended import Part, rounding_of
from cosim.gap.fitting import Fitting
from cosim.gap.models import Models
from cosim.gap.naming import Named, Naming
from cosim.gap.rejection import lost, outdone, plainly_needed, rejected, unpromising, unsure
from cosim.gap.result import Rejected, Score
from cosim.gap.rivals import overruled, rivals_of, told_apart
from cosim.gap.weak_form.camera_faults import SMOOTHING, filter_among, likeliest_filters
from cosim.gap.weak_form.constants import MOST_FINDINGS
from cosim.gap.weak_form.ladder import Finding, price_of
from cosim.gap.windows.run_model import LOADING


@dataclass(frozen=True)
class Agreed:
    """Findings of the rows that the simulated runs ask for too, and the models with them.

    rejected : what the rows ask for and the simulated runs do without; left_without : what is
    missing without any finding, where the models with them do not explain the runs; is_cut :
    whether the search ended early
    """

    named: Named
    parts: list[Part]
    models: Models
    rejected: tuple[Rejected, ...] = ()
    left_without: Score | None = None
    is_cut: bool = False


def confirmed_findings(campaign: Campaign, fitting: Fitting) -> Agreed:
    """What rows and simulated runs both ask for.

    Rows are read off a smoothed track, and a contact that is no switch may pretend something in
    them; simulated runs have other faults. What they do without is not asked of the rows again.
    """
    naming = Naming.of(campaign)
    fitting.step()
    rejected: list[Rejected] = []
    rounds = iter(judge.findings_by_rounds())

    def asked(most: int) -> tuple[Agreed | None, bool]:
        """What both agree on; or None, and whether no finding along x is left."""
        named = naming.named([one.effect for one in rejected], most)
        found = agreement_on(fitting, named)
        if isinstance(found, Agreed):
            return found, False
        rejected.extend(found)
        return None, len(found) == sum(bool(each.added) for each in named.findings)

    while True:
        agreed, none_is_left = asked(0 if fitting.is_too_long else next(rounds, 0))
        if none_is_left:  # simulated runs choose from what the rows hint at
            hinted, _ = asked(0)
            agreed = hinted if hinted and hinted.parts else None
        if agreed:
            return replace(agreed, rejected=tuple(rejected), is_cut=fitting.is_too_long)


def agreement_on(fitting: Fitting, named: Named) -> Agreed | Sequence[Rejected]:
    """Findings that the simulated runs ask for, too, or those that they do without."""
    named = _with_likeliest_filter(fitting, named)
    if doubts := unsure(fitting, named):
        return doubts
    parts = [fitting.part(named, finding) for finding in named.findings]
    if _is_beyond_all(fitting, named):
        return Agreed(named, parts, fitting.fitted(named, parts))
    most = max((part.finding.gain for part in parts), default=0.0)
    faint = {part.finding.name for part in parts
             if judge.may_be_spurious(part.finding, part.finding.gain == most)}  # fmt: skip
    faint -= plainly_needed(fitting, parts, named, faint)
    if doubts := unpromising(fitting, parts, named, faint) or outdone(fitting, parts, named, faint):
        return doubts
    if doubted := lost(fitting, parts, named, faint) or rejected(fitting, parts, named, faint):
        return [doubted]
    along = {part.finding.name for part in parts if part.finding.added}
    before, (parts, named) = parts, _further(fitting, parts, named)
    if len(parts) > len(before):  # beside it a lesser one may be needless
        new = parts[-1].finding.gain
        lesser = {part.finding.name for part in before if part.finding.gain < new}
        if doubted := rejected(fitting, parts, named, lesser & along):
            return [doubted]
    found, models = fitting.best_of(parts, named)
    is_near = judge.explains(models.ladder) and models.is_felt
    if not is_near and (doubted := rejected(fitting, parts, named, along - faint)):
        return [doubted]
    rivals = rivals_of(fitting, found, named, models)
    if doubted := overruled(fitting, found, named, rivals):
        return [doubted]
    named = told_apart(named, rivals)
    found = [replace(part, finding=finding)
             for part, finding in zip(found, named.findings, strict=True)]  # fmt: skip
    return Agreed(named, found, models, left_without=_left_without(fitting, found, models, named))


def _with_likeliest_filter(fitting: Fitting, named: Named) -> Named:
    """With a tracker's filter of the kind, and in the runs, that simulated runs prefer.

    Rows are told of it by corners alone: these hardly tell kinds from one another, nothing of runs
    whose sticks are shorter than the filter, and a long one spoils the rows of other findings: the
    runs are nearer to the model with these or with it.
    """
    filtered = named.filtered or named
    if [finding.name for finding in filtered.findings] != [SMOOTHING]:
        return named
    (finding,), rows = filtered.findings, filtered.ladder.system.rung()
    offers = likeliest_filters(rows, filtered.unknowns[SMOOTHING])
    forms = [_with_filter(filtered, replace(finding, gain=gain, added=(added,)))
             for gain, added in offers if gain > finding.gain - judge.TURNED]  # fmt: skip
    if named.filtered:
        forms.append(named)

    def models(form: Named) -> Models:
        parts = [fitting.part(form, each) for each in form.findings]
        return fitting.fitted(form, parts, is_shown=False, scatters=False)

    tried = [(form, models(form)) for form in forms]
    chosen, best = min(tried, key=lambda each: each[1].unscattered.worst)
    # corners of fast runs, whose sticks are shorter than the filter, tell nothing of it
    some = [] if chosen is named else best.runs_with(SMOOTHING)
    if not some:
        return chosen
    among = filter_among(rows, chosen.findings[0].main.unknown, some)
    evidence, added = rows.offered([among])
    found = replace(finding, gain=evidence - rows.evidence, added=(added,))
    moved = _with_filter(filtered, found)
    return moved if models(moved).unscattered.worst < best.unscattered.worst else chosen


def _with_filter(named: Named, finding: Finding) -> Named:
    rung = named.ladder.system.rung(finding.added)
    ladder = replace(named.ladder, findings=(finding,), rung=rung)
    return replace(named.with_findings(finding), ladder=ladder)


def _is_beyond_all(fitting: Fitting, named: Named) -> bool:
    """Whether no doubt of single findings leads to a name: runs miss something, too."""
    return judge.is_beyond_all(named.findings, named.ladder.rung.gap) and judge.leaves(
        fitting.fitted(named, [], is_shown=False).ladder[-1].gap
    )


def _further(fitting: Fitting, parts: list[Part], named: Named) -> tuple[list[Part], Named]:
    """With one more finding along x that simulated runs are much more probable with.

    The contact's numbers and scatter may leave rows next to nothing of it. Not beside coarse
    steps, whose errors go together (`unsure`), nor beside a fault of the camera: that has one of a
    few courses, and what they leave of it is no noise either.
    """
    is_full = fitting.is_too_long or len(named.ladder.findings) + 1 >= MOST_FINDINGS
    is_faulty = rounding_of(fitting.campaign) is not None or any(
        one.name.startswith("measurement.") for one in named.findings
    )
    if is_full or is_faulty:
        return parts, named
    without = fitting.fitted(named, parts)
    tried = [_simulated(part, without) for part in _promising(fitting, named, without)]
    greatest = max((part.finding.gain for part in parts), default=0.0)
    hidden = [part for part in tried if judge.is_hidden(part.finding.gain, greatest)]
    found = [part for part in hidden if _is_nearer(part, without)]
    if not found:
        return parts, named
    most = max(part.finding.gain for part in found)
    near = [part for part in found if judge.may_be_ahead(part.finding.gain, most)]
    if len(near) > 1:  # by which law each is tried decides then
        found = [_best_form(fitting, part, without, named) for part in near]
    part = max(found, key=lambda one: one.finding.gain)
    others = {one.finding.name: one.finding.gain - part.finding.gain
              for one in found if one is not part}  # fmt: skip
    finding = replace(part.finding, others=others)
    return [*parts, replace(part, finding=finding)], named.with_findings(*named.findings, finding)


def _is_nearer(part: Part, without: Models) -> bool:
    """Whether runs ask for a finding also without what a scatter may be worth."""
    finding, nearer = part.finding, without.nearer(part)
    return judge.runs_ask(nearer) and judge.not_by_scatter_alone(finding.name, finding.gain, nearer)


def _simulated(part: Part, without: Models) -> Part:
    """A finding with what simulated runs gain by it, less its price."""
    gained = without.gained(part) - price_of(part.finding.name)
    return replace(part, finding=replace(part.finding, gain=gained))


def _best_form(fitting: Fitting, part: Part, without: Models, named: Named) -> Part:
    """A finding by that law of its effect with which simulated runs gain most."""
    there = named.with_findings(*named.findings, part.finding)
    forms = (_simulated(form, without) for form in fitting.forms(part, there))
    return max(forms, key=lambda form: form.finding.gain)


def _promising(fitting: Fitting, named: Named, without: Models) -> list[Part]:
    """What the simulated runs' derivatives promise to gain by, the most promising first."""
    parts, rows = {}, {}
    for name, (evidence, added) in named.ladder.further_offers.items():
        if name.startswith("other.") or added[0].unknown.wave is not None:
            continue  # nothing in the model stands for it, or takes it up
        finding = Finding(name, added, 0.0)
        part = fitting.part(named.with_findings(*named.findings, finding), finding)
        if part.in_kernel:
            parts[name], rows[name] = part, evidence - named.ladder.rung.evidence
    gains = without.promised(list(parts.values()))
    promised = {name: gain or 0.0 for name, gain in zip(parts, gains, strict=True)}
    sooner, left = without.fits[-1].values.get(LOADING, 0.0), without.ladder[-1].gap
    names = judge.promising(promised, rows, left, sooner)
    return [parts[name] for name in names]


def _left_without(
    fitting: Fitting, parts: Sequence[Part], models: Models, named: Named
) -> Score | None:
    """What the runs miss without any finding; None where the model with them is near enough."""
    if not parts or judge.explains(models.ladder):
        return None
    return fitting.fitted(named, [], is_shown=False).ladder[-1].gap

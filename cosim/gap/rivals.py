"""What rows would nearly have in the place of a lone finding, told from it by simulated runs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from cosim.gap import judge
from cosim.gap.extended import Part
from cosim.gap.fitting import Fitting
from cosim.gap.models import Models
from cosim.gap.naming import Named
from cosim.gap.result import Rejected
from cosim.gap.weak_form.constants import ALIKE
from cosim.gap.weak_form.ladder import Finding, price_of

#: Name -> what it would put into the model, and ln of how much more probable simulated runs are
#: with it than with the finding that it is a rival of.
Rivals = Mapping[str, tuple[Part, float]]


def rivals_of(fitting: Fitting, parts: Sequence[Part], named: Named, models: Models) -> Rivals:
    """Of a lone finding along x what the rows would nearly have in its place, simulated.

    What no effect stands for is no more than the model without it. No model is fitted with a rival
    of which derivatives promise too little.
    """
    lone = _lone(parts)
    if lone is None or fitting.is_too_long:
        return {}
    does_explain = judge.explains(models.ladder)
    tried = [
        _in_place(fitting, named, name) for name in judge.rivals_of(lone.finding, does_explain)
    ]
    rivals = [rival for rival in tried if rival.in_kernel]
    if not rivals:
        return {}
    without = fitting.without(lone, parts, named)
    (own,) = without.promised([lone]) if does_explain and lone.in_kernel else [None]
    found = {}
    for rival in rivals:
        forms = [rival]
        if lone.finding.others[rival.finding.name] > -ALIKE:  # by any form of its law
            forms = [*fitting.forms(rival, named.with_findings(rival.finding))]
        more = None if own is None else _promised(forms, own, without)
        found[rival.finding.name] = rival, _more(forms, lone, without) if more is None else more
    return found


def _promised(forms: Sequence[Part], own: float, without: Models) -> float | None:
    """ln of how much less probable derivatives have the best form of a rival, if they tell.

    own : what they promise of the finding
    """
    promised = without.promised(list(forms))
    known = [gain for gain in promised if gain is not None]
    return judge.promises_less(max(known), own) if len(known) == len(forms) else None


def _more(forms: Sequence[Part], lone: Part, without: Models) -> float:
    """ln of how much more probable simulated runs are with a rival than with the finding."""
    over, price = (lone, price_of(lone.finding.name)) if lone.in_kernel else (None, 0.0)
    gained = max(without.gained(form, over) for form in forms)
    return gained - price_of(forms[0].finding.name) + price


def overruled(
    fitting: Fitting, parts: Sequence[Part], named: Named, rivals: Rivals
) -> Rejected | None:
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
            with_it, own = (fitting.fitted(named, some) for some in (in_place, parts))
            is_better = with_it.ladder[-1].gap.of_verdict < own.ladder[-1].gap.of_verdict
            if is_better and (lone.in_kernel or judge.explains(with_it.ladder)):
                without = fitting.without(lone, parts, named)
                gained = without.gained(lone) if lone.in_kernel else None
                return Rejected(lone.finding.name, lone.finding.gain, gained)
    return None


def told_apart(named: Named, rivals: Rivals) -> Named:
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


def _lone(parts: Sequence[Part]) -> Part | None:
    """The only finding along x, beside what moves the block across."""
    along = [part for part in parts if part.finding.added]
    return along[0] if len(along) == 1 else None


def _in_place(fitting: Fitting, named: Named, name: str) -> Part:
    """What another explanation would put into the model."""
    finding = Finding(name, named.ladder.first_offers[name][1], 0.0)
    return fitting.part(named.with_findings(finding), finding)

"""The verdict, in ten sentences.

 1. Rows of unit noise are made of every run, also of those that are held out from fits: the
    equation of motion inside slips, the surface's speed in sticks, the spring force at break-aways
    (`weak_form`).
 2. What every rig has unknown is in the rows with its stated error: both coefficients, springs,
    zeros, set-points, the contact's own transition, friction that scatters from run to run.
 3. Whatever friction may depend on is an argument with one free curve; all have the same evidence,
    of which a fault, and what no effect stands for, needs e^3 times as much.
 4. An argument is a finding where the rows are e^6 times as probable with it (e^3 the first), and,
    beside others, it takes more than a small part of what was missing at first, or, where contact
    and scatter had taken all of that, e^12 times, or goes from run to run as scatter does; the best
    joins, all others are asked again, three are the most.
 5. Findings within e^3 of one another in the same place cannot be told apart, nor within e^6 where
    of campaigns drawn with the second more than a tenth are given the name of the first: a class,
    of effects alone where two are in its place. Of a lone finding three rivals are simulated that
    rows put within e^12 of it (e^200 below e^500; a 200th of its own if it does not explain the
    runs; if it does, derivatives alone tell where they promise at most half as much, by e^12):
    one that these put e^6 behind is told from it, one within e^12 that they prefer is not. Where
    they prefer one by e^500, or e^200 if rows do not tell the two apart, and held-out runs come out
    better with it, the first goes, if no effect stands for it only where the second explains the
    runs. A tracker's filter that corners ask for by more than rows do for any finding takes the
    place of all where simulated runs are nearer to the model with it; these tell which of them have
    it, too, by e^6.
 6. A finding that no effect of the catalogue stands for, or a third one, makes it `unknown`; with
    three that leave twice the noise in the rows, and runs that miss something without them, no
    single one is doubted.
 7. The kernel is fitted with the findings over windows of three cycles, or up to where a block
    reaches the surface's speed without a stick, and judged in such windows of runs that no fit has
    seen, though rows of them have helped to find the name; 1 is noise.
 8. A finding goes, and rows are asked again without it: beside coarse steps, below e^500; below
    e^500 or beside a greater one, if derivatives of the simulated runs ask for it by less than e
    and these are left at 1.1 without any (not ageing, and no trend); the greatest, below e^500, if
    alone it leaves half as much again and they ask for it by e^30 at most; and below e^500, beside
    a greater one, or where runs are not explained or findings take nothing of the gap, if
    - simulated runs are not e^6 times as probable with it (a fault e^9), or e^30 by another of its
      laws, and e^3 times without what a scatter may be worth or e^50 with it (a trend needs neither
      of these; ageing, e^100 and e^12),
    - or it is below e^500 and another, and the others explain the runs before friction scatters,
    - or it takes neither all nor half of what they miss without it, at last or before friction may
      scatter, unless they miss nothing and it is alone, or are e^500 times as probable with it
      (e^12: a trend beside others); of what the model cannot have, if they miss nothing without it,
    - or all findings leave half as much again as the user's model.
    For being faint none is doubted, trends excepted, that leaves runs at 1.3 at most where they are
    beyond 2 without it, friction repeating itself. Where none is left, the runs choose from what
    rows ask for less, as beside a finding. So for four rounds; then rows are asked for one finding
    alone, and then for none; after 150 million simulated samples at once. Beside fewer than two
    findings, no fault of the camera and no coarse steps, what rows ask for by e^6, or derivatives
    of the simulated runs by e^25 where these are left at 1.1 at most, and static friction over the
    hold time where the contact lets go by 10 ms sooner, is found where the runs are e^50 times as
    probable with it (by a 200th of what rows gain by another), and e^6 without what a scatter may
    be worth (ageing, e^100 and e^12); of several that gain 0.6 of the greatest, or are within e^200
    of it, every law is tried. `none` is no finding left, and fitted runs and held-out ones at 1.1
    at most, each taken together; without any held out nothing tells.
 9. `named`, or `class`: findings, and the last model leaves held-out runs (fitted ones where there
    are none) at 1.3 at most and better than the user's model does, or held-out ones at 1.02 with
    most of the misfit gone, and fitted ones at 1.3, too, or most of their misfit gone; `partial`
    where it is better, but not so, and most of the misfit is gone, and half of what is missing with
    contact and scatter alone. All but `partial` want friction to scatter by less than twice what is
    stated where it is scatter that explains the runs; that wants half gone before scatter.
10. Everything else is `unknown`, and all that is in severe doubt; coarse steps of the tracker are
    named beside other names (not a class), or alone where nothing else is missing.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from cosim.gap.rates import confirmed
from cosim.gap.result import Rates, Rung, Score
from cosim.gap.weak_form.constants import (
    ALIKE,
    CONTACT_DELAY,
    LEAST_GAIN,
    MOST_FINDINGS,
    NEARLY_ALIKE,
    UNDECIDED,
)
from cosim.gap.weak_form.ladder import TRENDS, Finding, price_of

#: Gap up to which nothing is missing: noise of a window's rows, whose states are free, and what
#: windows of three cycles add up of a scatter that was not foreseen.
NOTHING_MISSING = 1.1
#: Gap up to which noise is all that is left: fitted starts take 1 or 2 % of it.
ONLY_NOISE = 1.02
#: Gap up to which what is named explains the runs.
EXPLAINED = 1.3
#: Gap of rows with three findings beyond which something is missing that no part of them is: in 48
#: campaigns with known answers findings leave the rows at 0.9 to 1.4, in fresh unknown ones at 9.5.
BEYOND = 2.0
#: ln of a Bayes factor beyond which a finding is no slip of the contact's description: rows of
#: foreign contacts (bristles, Iwan) have pretended up to 206.
SURE = 500.0
#: ln of a Bayes factor up to which a contact may have turned rows, or, of what is sure and does not
#: explain the runs, a part of its own: a law followed to 7 % leaves so much of its squares. And how
#: many rivals are tried.
TURNED, TURNED_PART, RIVALS = 200.0, 5e-3, 3
#: Rounds in which rows are asked for what simulated runs do not confirm: after three no second one
#: of two findings has ever been confirmed, in 164 campaigns with known answers.
ROUNDS = 4
#: A contact that lets go by more than this sooner, s, is asked for ageing: half of what contacts do
#: (`constants.CONTACT_DELAY`).
SOONER = 0.5 * CONTACT_DELAY
AGEING = "static_strengthening"
#: ln of a Bayes factor of simulated runs for another form of a law than rows ask for; for what
#: these do not miss: one effect beside another has made e^216 and more; and for ageing, asked for
#: by whomever: contacts that creep, or rebuild their strength within 10 ms, have pretended up to
#: e^70 where there is none, and true ageing has made e^51 to e^1008: below the limit it is missed.
MUCH_MORE, HIDDEN, IMITATED = 30.0, 50.0, 100.0
#: What derivatives must promise of what a fit must find (`HIDDEN`): half, as they have promised
#: e^401 of e^661. And so many effects are fitted, the most promising first.
PROMISED, HINTS = 0.5 * HIDDEN, 3
#: Samples of simulated runs after which nothing more is asked for: some minutes. What was named
#: rightly on 70 campaigns took 2 to 130 million.
LONGEST = 1.5e8
#: Scatter of friction from run to run, the least that is probable in what is stated of it, beyond
#: which it stands for something that is missing.
STRAINED = 2.0
#: Gap beyond which what is missing is no matter of a contact, or of friction that scatters.
PLAIN = 2.0
#: Part of the misfit of an unscattered contact that may be left where a finding is needed.
TAKEN = 0.5
#: Part of the greatest gain from which another law of an effect may be ahead: rows' curve of a
#: softening spring has brought 0.73 of what its cubic law does.
NEARLY = 0.6
#: Part of the misfit that a finding must take to be named as a part of what is missing, or where
#: fitted runs are left above noise: one of them may have another fault.
MOST = 0.8


@dataclass(frozen=True)
class Verdict:
    """verdict : as `result.VERDICTS`; effects : its names; classes : groups that are alike"""

    verdict: str
    effects: tuple[str, ...]
    classes: tuple[tuple[str, ...], ...]


def judge(
    findings: Sequence[Finding], names: Sequence[str], ladder: Sequence[Rung], physics: set[str],
    rates: Rates | None = None, without: Score | None = None, strained: bool = False,
) -> Verdict:  # fmt: skip
    """names : of the findings, by the laws that follow them; physics : what has a name at all.

    rates : what this design would answer, were something else true
    without : what contact and scatter leave without any finding, where that is asked
    strained : whether only a scatter far beyond what is stated explains the runs
    """
    before, after = ladder[0].gap.of_verdict, ladder[-1].gap.of_verdict
    if not findings:
        told = not leaves(ladder[-1].gap) and ladder[-1].gap.held_out is not None
        return Verdict("none" if told and not strained else "unknown", (), ())
    classes = tuple(
        group for finding, name in zip(findings, names, strict=True)
        if len(group := _alike(finding, name, rates)) > 1
    )  # fmt: skip
    if not set(names) <= physics or len(findings) >= MOST_FINDINGS:
        return Verdict("unknown", (), classes)
    takes_most, told = ladder[-1].share >= MOST, ladder[-1].gap.held_out is not None
    improves = after < before or (takes_most and told and after <= ONLY_NOISE)
    explained = after <= EXPLAINED and (ladder[-1].gap.fit <= EXPLAINED or takes_most)
    if improves and explained and not strained:
        if classes:  # two names for one thing: what cannot be told apart is one answer
            return Verdict("class", _members(names, classes, physics), classes)
        return Verdict("named", tuple(names), classes)
    own = without is None or halves(ladder[-1].gap, without)
    own = own and (not strained or ladder[-2].share >= TAKEN)
    if improves and own and takes_most:
        return Verdict("partial", tuple(names), classes)
    return Verdict("unknown", (), classes)


def _members(
    names: Sequence[str], classes: Sequence[tuple[str, ...]], physics: set[str]
) -> tuple[str, ...]:
    """All that is found, and what cannot be told from it: of that, effects where two are."""
    members: list[str] = []
    for name in names:
        group = next((each for each in classes if each[0] == name), (name,))
        known = [each for each in group if each in physics]
        members += known if len(known) > 1 else group
    return tuple(dict.fromkeys(members))


def with_steps(verdict: Verdict, name: str) -> Verdict:
    """With coarse steps of the tracker, by this name, where nothing else is missing or unknown."""
    if verdict.verdict in ("unknown", "class"):
        return verdict
    named = "named" if verdict.verdict == "none" else verdict.verdict
    return replace(verdict, verdict=named, effects=(name, *verdict.effects))


def is_strained(
    ladder: Sequence[Rung], scatter: tuple[float, float, float] | None, stated: float
) -> bool:
    """Whether only a scatter of friction far beyond what is stated explains the runs.

    Something that differs between the runs is then missing. scatter : value and 90 % interval
    """
    if scatter is None or ladder[-1].name != "scatter":
        return False
    return scatter[1] > STRAINED * stated and ladder[-2].gap.of_verdict > EXPLAINED


def is_beyond_all(findings: Sequence[Finding], left: float) -> bool:
    """Whether no doubt of single findings can lead to a name.

    left : gap of the rows with all findings, noise units
    """
    return len(findings) >= MOST_FINDINGS and left > BEYOND


def explains(ladder: Sequence[Rung]) -> bool:
    """Whether the last model is near enough to the runs."""
    return ladder[-1].gap.of_verdict <= EXPLAINED


def findings_by_rounds() -> tuple[int, ...]:
    """How many findings rows are asked for, each time that one goes: all, the first of all, none"""
    return (*[MOST_FINDINGS] * ROUNDS, 1, 0)


def may_be_spurious(finding: Finding, greatest: bool) -> bool:
    """Whether a contact that is no switch, or what another finding leaves, may make the rows ask.

    Not of what moves the block across, which nothing along x does. greatest : of those found
    """
    return bool(finding.added) and (finding.gain < SURE or not greatest)


def is_too_long(simulated: float) -> bool:
    """Whether a search ends: nothing further is asked of the rows, no rival and no hint tried.

    simulated : samples of all runs so far
    """
    return simulated > LONGEST


def runs_ask(gained: float) -> bool:
    """Whether simulated runs ask for a finding as the rows do.

    gained : ln of how much more probable they are with it
    """
    return gained > LEAST_GAIN


def promise_nothing(promised: float | None, name: str) -> bool:
    """Whether derivatives of the simulated runs ask for nothing of a finding, to first order.

    Of what scatter takes up from run to run, and of ageing, which a contact that lets go sooner is
    to first order, they tell nothing. promised : ln as of `promising`; None: nothing is told
    """
    return promised is not None and promised < 1.0 and name not in (*TRENDS, AGEING)


def is_asked_for_ageing(sooner: float) -> bool:
    """Whether a contact follows the loading rate far. sooner : by which time it lets go, s"""
    return sooner > SOONER


def promising(
    promised: Mapping[str, float], rows: Mapping[str, float], left: Score, sooner: float,
) -> list[str]:  # fmt: skip
    """What simulated runs are asked for beside the findings, the most promising first.

    What rows ask for and hardly miss; and, where contact and scatter leave nothing, what these may
    have taken up so that rows do not see it.

    promised, rows : name -> ln of how much more probable runs would be with it, to first order, and
    rows are; left : gap of the model without it; sooner : by which time the contact lets go, s:
    that is all that ageing does to first order
    """
    asked = {name: gain for name, gain in rows.items() if gain > LEAST_GAIN}
    for name, gain in promised.items():
        if gain - price_of(name) > PROMISED and not leaves(left):
            asked[name] = max(gain - price_of(name), asked.get(name, 0.0))
    if AGEING in rows and is_asked_for_ageing(sooner):
        asked[AGEING] = math.inf
    return sorted(asked, key=lambda name: -asked[name])[:HINTS]


def is_hidden(gained: float, greatest: float = 0.0) -> bool:
    """Whether simulated runs find what rows do not miss: contact or scatter have taken it up.

    And it is no part that the law of another may leave. greatest : what rows gain by any other
    """
    return gained > max(HIDDEN, TURNED_PART * greatest)


def may_be_ahead(gained: float, most: float) -> bool:
    """Whether other laws of a hidden finding are tried, as one may bring it beyond the greatest."""
    return gained > min(NEARLY * most, most - TURNED)


def not_by_scatter_alone(name: str, gained: float, nearer: float) -> bool:
    """Whether simulated runs ask for a finding by their distances, too.

    What only a smaller scatter makes probable may be a matter of where a fit ended: of contacts
    with nothing hidden up to e^36, with distances of e^2. A trend over the runs is what scatter
    takes up. Ageing, which contacts imitate, must be far beyond that. nearer : of `Models.nearer`
    """
    if name == AGEING:
        return gained > IMITATED and nearer > UNDECIDED
    return name in TRENDS or is_hidden(gained) or nearer > ALIKE


def much_more(gained: float) -> bool:
    """Whether simulated runs ask for what rows do not, or for another form of what they do."""
    return gained > MUCH_MORE


def needs_no_misfit(name: str, gained: float, is_lone: bool) -> bool:
    """Whether simulated runs need a finding also where nuisances have taken what it takes."""
    return gained > (UNDECIDED if name in TRENDS and not is_lone else SURE)


def explains_half(left: Score, before: Score) -> bool:
    """Whether the runs are explained with a finding, by half of what is missing without it.

    left, before : with the finding, and without, of friction that repeats itself
    """
    return not leaves(left, EXPLAINED) and halves(left, before)


def halves(left: Score, before: Score) -> bool:
    """Whether a finding takes half of what a contact leaves whose friction may not scatter.

    Of fitted runs and of those that judge. left, before : with the finding, and without
    """
    pairs = ((left.fit, before.fit), (left.of_verdict, before.of_verdict))
    return all(one**2 - 1.0 <= TAKEN * max(other**2 - 1.0, 0.0) for one, other in pairs)


def leaves(score: Score, most: float = NOTHING_MISSING) -> bool:
    """Whether something is missing that the model does not hold: what has no law may be it."""
    return score.worst > most


def rivals_of(finding: Finding, does_explain: bool) -> list[str]:
    """What else the rows ask for in a finding's place, and a contact may have put behind it.

    does_explain : whether the model with the finding is near enough to the runs
    """
    within = max(UNDECIDED, 0.0 if does_explain else TURNED_PART * finding.gain)
    within = TURNED if finding.gain < SURE else within
    near = {name: less for name, less in finding.others.items()
            if less > -within and finding.gain + less > ALIKE}  # fmt: skip
    return sorted(near, key=lambda name: -near[name])[:RIVALS]


def promises_less(promised: float, of_finding: float) -> float | None:
    """ln of how much less probable derivatives of the simulated runs have a rival than a finding.

    Where they promise at most half as much, and plainly tell; else None.
    """
    if promised > TAKEN * of_finding:
        return None
    return promised - of_finding if promised - of_finding < -UNDECIDED else None


def overrules(rows: float, simulated: float) -> bool:
    """Whether a rival takes a finding's place: ln of how much more probable each is with it."""
    return simulated > (TURNED if rows > -ALIKE else SURE)


def told_by_both(finding: Finding, name: str, simulated: float) -> float:
    """ln of how much more probable a rival is: as rows have it, 0 where simulated runs prefer it.

    What the rows do not tell apart simulated runs may; and what they do not decide these may
    contradict.
    """
    rows = finding.others[name]
    if simulated < -LEAST_GAIN:
        return min(rows, simulated)
    return 0.0 if simulated > 0.0 and -UNDECIDED < rows <= -ALIKE else rows


def _alike(finding: Finding, name: str, rates: Rates | None) -> tuple[str, ...]:
    """What explains the rows as well in a finding's place, itself first.

    Also what these runs would too often call by this name, if it explains them nearly as well.
    """
    confused = confirmed(rates, finding.name)[1:] if rates is not None else ()
    near = sorted(finding.others, key=lambda other: -finding.others[other])
    return (
        name,
        *(
            other for other in near if other != name
            and finding.others[other] > (-NEARLY_ALIKE if other in confused else -ALIKE)
        ),
    )  # fmt: skip

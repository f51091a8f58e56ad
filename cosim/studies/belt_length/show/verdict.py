"""The answer in plain words: of an own rig, or of the study's, whether 1 m of belt does."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from cosim.report.material import of_material

from ..changes import NO_HELP
from ..drift import CAMERA
from ..lengths import LONGEST, metres, rounded_up
from ..result import Row, Study
from ..uncertainty import Uncertainty
from .answer import answered
from .wording import outside, percent, span, why_outside

ONE_METRE = 1.0
#: A change helps that leaves less than this part of a rise.
_HELPS = 0.95


def verdict(study: Study) -> list[str]:
    """Some sentences; what is said holds for the cases that were computed."""
    if not (study.rows or study.answers):
        return ["Nothing was computed, so nothing can be said."]
    said = [sentence for answer in study.answers for sentence in answered(answer)]
    parts = _OF_OWN_RIG if study.answers else _OF_THE_STUDY
    said += [sentence for part in parts if study.rows for sentence in part(study)]
    return [of_material(sentence, study.material) for sentence in said]


def _by_speed(rows: Iterable[Row]) -> list[tuple[float, list[Row]]]:
    rows = list(rows)
    speeds = sorted({row.case.speed for row in rows})
    return [(speed, [row for row in rows if row.case.speed == speed]) for speed in speeds]


def _doubts(rows: Iterable[Row]) -> list[Uncertainty]:
    return [row.uncertainty for row in rows if row.uncertainty is not None]


def _one_metre(study: Study) -> list[str]:
    """Does 1 m do? By speed, the other choices taken together; all speeds in one sentence first."""
    limit, said = study.options.limit, []
    speeds_of: dict[str, list[str]] = {}
    for speed, rows in _by_speed(row for row in study.rows if row.case.length == ONE_METRE):
        drifts, known = [row.drift.run for row in rows], _doubts(rows)
        word = "suffices in some of the cases"
        if max(drifts) <= limit:
            word = "suffices"
        elif min(drifts) > limit:
            word = "does not suffice"
        speeds_of.setdefault(word, []).append(f"{speed:g}")
        doubt = ""
        if known:
            low, high = min(one.low for one in known), max(one.high for one in known)
            promise = ", so nobody can promise it" if low < limit < high else ""
            doubt = f" ({span((low, high))} K over what is not known of the rig{promise})"
        said.append(
            f"At {speed:g} m/s {ONE_METRE:g} m of belt {word}: after"
            f" {rows[0].case.protocol.in_words()} it meets the ice {span(drifts)} K warmer than"
            f" the air{doubt}."
        )
    if not said:
        return [f"A belt of {ONE_METRE:g} m was not among the lengths asked for."]
    words = "; ".join(f"{word} at {', '.join(speeds)} m/s" for word, speeds in speeds_of.items())
    summary = f"For a belt that meets the ice less than {limit:g} K above the air,"
    return [f"{summary} {ONE_METRE:g} m: {words}.", *said]


def _limit(study: Study) -> list[str]:
    if study.options.limit != CAMERA:
        return []
    return [
        f"The limit of {CAMERA:g} K is a choice, which --limit changes: the figure in the data"
        " sheet of the source study's thermal camera; the study's own test of it told 1 K"
        " apart, and not 0.01 K."
    ]


def _shortest(study: Study) -> list[str]:
    """Does the belt come round cold? The shortest belts, by speed."""
    return [
        f"At {speed:g} m/s a belt that comes round less than {study.options.limit:g} K warm takes"
        f" {_lengths(rows, 'shortest_run')} for the runs, and {_lengths(rows, 'shortest_steady')}"
        " for ever."
        for speed, rows in _by_speed(study.rows)
    ]


def _lengths(rows: list[Row], name: str, longest: str = f"more than {LONGEST:g} m") -> str:
    found = [getattr(row, name) for row in rows]
    known = [length for length in found if length is not None]
    if not known:
        return longest
    if known == found and all(getattr(row, name) <= row.case.shortest for row in rows):
        return "any belt"
    low, high = (rounded_up(length)[0] for length in (min(known), max(known)))
    belts = metres(min(known)) if low == high else f"{low} to {high} m (rounded up to two digits)"
    return belts if known == found else f"{belts}, in some cases {longest},"


def _doubted(study: Study) -> list[str]:
    """The shortest belts at levels of the doubt, by speed; nominal rises outside of theirs."""
    doubted, said, beyond = study.shortest_in_doubt(), [], []
    for speed, rows in _by_speed(row for row in study.rows if row.uncertainty):
        found = [doubted[case] for case in dict.fromkeys(row.case.with_length(1.0) for row in rows)]
        half, most, steady_half, steady_most = (
            ", ".join(dict.fromkeys(one[rise][level].in_words or "?" for one in found))
            for rise in ("run", "interface")
            for level in ("median", "high")
        )
        said.append(
            f"At {speed:g} m/s, over what is not known of the rig, the belt comes round that cold"
            f" in half of the rigs on {half}, in 95 % of them on {most}; the interface is that"
            f" steady in half on {steady_half}, in 95 % on {steady_most} (between the lengths"
            " asked for, rounded up to two digits; none is reported beyond)."
        )
    for row in study.rows:
        if (u := row.uncertainty) is not None:
            d, where = row.drift, f"on {row.case.length:g} m at {row.case.speed:g} m/s"
            off = outside("the rise at entry", d.run, u.low, u.high, "K")
            ends = u.interface_low, u.interface_high
            off += outside("the interface's rise", d.interface_drift, *ends, "K")
            beyond += [f"{one} {where}" for one in off]
    return said + why_outside(beyond, study.rows[0].case)


def _interface(study: Study) -> list[str]:
    """Is the interface steady? The ice warms itself, whatever the belt."""
    limit, said = study.options.limit, []
    for speed, rows in _by_speed(study.rows):
        drifts, known = [row.drift.interface_drift for row in rows], _doubts(rows)
        doubt = steady = ""
        if known:
            ends = min(u.interface_low for u in known), max(u.interface_high for u in known)
            doubt = f", {span(ends)} K at constant speed over what is not known of the rig"
        if max(drifts) > limit:
            endless = span(row.drift.interface_drift_endless for row in rows)
            steady = (
                f"; on a belt that never comes round it would be {endless} K, and below {limit:g} K"
                f" it is on {_lengths(rows, 'shortest_interface', 'no belt')}"
            )
        said.append(
            f"At {speed:g} m/s the interface warms by {span(drifts)} K at constant speed"
            f" ({span(row.drift.interface_run for row in rows)} K from the start) on the belts"
            f" asked for{doubt}{steady}."
        )
    return said


def _wait(study: Study) -> list[str]:
    """How long to wait before the next run, by speed."""
    pauses, already, said = [], [], []
    never = "; ".join(sorted({r.wait.reason for r in study.rows if r.wait.begin is None}))
    for speed, rows in _by_speed(study.rows):
        known = [row.wait.begin for row in rows if row.wait.begin is not None]
        if known and max(known) == 0.0:
            already.append(f"{speed:g}")
        elif known:
            pauses.append(f"{span(known)} s at {speed:g} m/s")
    if not (pauses or already):
        return [f"No pause makes a later run as cold as the first: {never}."]
    iced = "lifted" if study.rows[0].case.protocol.lifted else "resting"
    near = f"Belt and ice are within {study.options.limit:g} K of the air"
    if already:
        said.append(f"{near} when the runs end at {', '.join(already)} m/s: no wait is needed.")
    if pauses:
        after = f"the belt at a standstill and the ice {iced}, after {', '.join(pauses)}"
        said.append(f"{near} again, {after}.")
    return [*said, f"In other cases never: {never}."] if never else said


def _helps(study: Study) -> list[str]:
    """What helps most, in the case that drifts most, by one change alone; nothing where none is
    needed."""
    row, said = study.worst, []
    start, *rest = (one for one in row.changes if one.what not in NO_HELP)
    for name, what in (
        ("run", "the belt enters {:.2g} K warm"),
        ("interface_drift", "the interface warms by {:.2g} K at constant speed"),
    ):
        rise = getattr(start, name)
        left = sorted((abs(getattr(one, name)), one.what) for one in rest)
        helps = [f"{kelvin:.2g} K with {one}" for kelvin, one in left if kelvin < _HELPS * rise]
        if rise > study.options.limit and helps:
            said.append(
                f"On {row.case.length:g} m at {row.case.speed:g} m/s {what.format(rise)};"
                f" one change alone leaves at best {', '.join(helps[:3])}."
            )
    return said


def _study_number(study: Study) -> list[str]:
    above = [row.drift for row in study.rows if row.drift.run > study.options.limit]
    if not above:
        return []
    return [
        f"Where the drift is above the limit, the source study's single-pass number is"
        f" {span(drift.run / drift.study for drift in above)} times too small: it counts one pass"
        " of many, and a rate of cooling of 0.25 1/s that was a conductivity."
    ]


def _influence(study: Study) -> list[str]:
    """Which unknown matters most, in the case that drifts most."""
    row = study.most_doubted
    if row is None or (doubt := row.uncertainty) is None:
        return []
    words = {one.key: one.says for one in doubt.single_changes}
    shares = ", ".join(f"{words[one.key]} {one.total:.0%}" for one in doubt.influences[:4])
    return [
        f"The doubt on {row.case.length:g} m at {row.case.speed:g} m/s, {doubt.low:.2g} to"
        f" {doubt.high:.2g} K, is made of (shares of the variance, with what each does together"
        f" with others): {shares}."
    ]


def _melting(study: Study) -> list[str]:
    """Of what may be meant, in how many rigs the ice melts in a run; of what is said, for ever."""
    said = []
    if most := max((one.melts for one in _doubts(study.rows)), default=0.0):
        share = percent(most) if most >= 0.01 else "less than 1 %"
        said.append(
            f"In {share} of the sampled rigs the ice comes to melt within the runs. Their rises"
            " are told as if it did not, which is more than they are, for melting takes heat that"
            " the belt does not get then; and less friction on the water is left out."
        )
    if melts := sum(row.drift.steady_melts for row in study.rows):
        said.append(
            f"In {melts} of {len(study.rows)} cases the ice face comes to melt and stays at 0"
            " degC; the water between ice and belt is left out of these drifts."
        )
    return said


Part = Callable[[Study], list[str]]
_OF_OWN_RIG: tuple[Part, ...] = (_wait, _helps, _influence, _melting)
_OF_THE_STUDY: tuple[Part, ...] = (
    *(_one_metre, _limit, _shortest, _doubted, _interface),
    *(_wait, _helps, _study_number, _influence, _melting),
)

"""The answer in plain words: of an own rig, or of the study's, whether 1 m of belt does."""

from __future__ import annotations

import math

from cosim.report.material import of_material

from ..case import Case
from ..changes import NO_HELP
from ..drift import CAMERA
from ..lengths import LONGEST, metres, rounded_up
from ..required_length import NOT_ASKED, Answer, Question
from ..result import Row, Study

ONE_METRE = 1.0
#: Part of the variance that polynomials may miss without a word.
MISSED = 0.1
#: Beyond this part they say nothing.
_WORTHLESS = 1.0
#: Two heat transfers to the air that differ by less than this part are the same.
_SAME = 0.01
#: K, s or m: less is not told from nothing.
_NOTHING = 1e-4
#: A change helps that leaves less than this part of a rise.
_HELPS = 0.95


def verdict(study: Study) -> list[str]:
    """Some sentences; what is said holds for the cases that were computed."""
    return [of_material(sentence, study.material) for sentence in _verdict(study)]


def _verdict(study: Study) -> list[str]:
    if not study.rows:
        if study.answers:
            return _answered(study)
        return ["Nothing was computed, so nothing can be said."]
    if study.answers:
        return [
            *_answered(study),
            *_wait(study),
            *_helps(study),
            *_influence(study),
            *_melting(study),
        ]
    rows = [row for row in study.rows if row.case.length == ONE_METRE]
    return [
        *_one_metre(study, rows),
        *_limit(study),
        *_shortest(study),
        *_doubted(study),
        *_interface(study),
        *_wait(study),
        *_helps(study),
        *_study_number(study),
        *_influence(study),
        *_melting(study),
    ]


def _answered(study: Study) -> list[str]:
    """Of an own rig: what is needed, what the belt that is there does, for ever, the interface."""
    return [sentence for answer in study.answers for sentence in answered(answer)]


def answered(answer: Answer) -> list[str]:
    """The answer for one drive, the shortest first, in the words of ice."""
    run, where = answer.run, f"At {answer.case.speed:g} m/s"
    cold = f"comes round less than {answer.limit:g} K above the air"
    return [
        f"{where} {_belt(run.shortest, answer)} {cold} after"
        f" {answer.case.protocol.in_words()}{_interval(run)}.",
        f"The belt of {answer.case.length:g} m meets the ice {_on_own(run)}.",
        f"For ever, {_for_ever(run)} {cold}.",
        f"The interface warms by less than {answer.limit:g} K at constant speed on"
        f" {_needed(answer.interface.shortest, answer)}"
        f"{_interval(answer.interface)}; on {answer.case.length:g} m it gets"
        f" {_on_own(answer.interface)}.",
        *_how_sure(answer),
        _film(answer.case),
    ]


def _film(case: Case) -> str:
    """Which heat transfer to the air was taken, and why; a coupled run may take another."""
    gives = f"The belt of {case.length:g} m gives {case.film:.2g} W/m2K to the air on each face"
    if case.h is not None:
        return f"{gives}, as given."
    runs = case.rig.belt.film
    same = (
        "`stickslip run` takes the same"
        if abs(runs / case.film - 1.0) < _SAME
        else f"`stickslip run` takes {runs:.2g} W/m2K, which is what belt.air_heat_transfer is"
        " unless a scenario gives it, or belt.still_air_speed, which makes both the same"
    )
    return (
        f"{gives}, as a belt at {case.speed:g} m/s through still air does that is as warm as it is"
        f" after the runs, {case.lasting.film:.2g} W/m2K as warm as for ever. {same}."
    )


def _needed(nominal: float | None, answer: Answer) -> str:
    """The length that is needed, at its nominal value."""
    if nominal is None:
        return f"no length up to {LONGEST:g} m"
    if nominal <= answer.case.shortest:
        return f"any belt with room for contact and rollers, from {metres(nominal)}"
    return f"{metres(nominal)}"


def _belt(nominal: float | None, answer: Answer) -> str:
    """The same for a sentence that begins with it."""
    said = _needed(nominal, answer)
    return said if said.startswith(("no ", "any ")) else f"a belt of {said}"


def _interval(question: Question) -> str:
    """The same over what is not known; nothing where there is no doubt."""
    if not (question.low and question.median and question.high):
        return ""
    return (
        f" as the rig is given; over what is not known of it on {question.low.in_words} in 5 % of"
        f" the rigs, on {question.median.in_words} in half and on {question.high.in_words} in 95 %"
    )


def _on_own(question: Question) -> str:
    if question.rises is None or question.share is None:
        return f"{question.rise:.2g} K warmer"
    low, _, high = question.rises
    return (
        f"{question.rise:.2g} K warmer ({_span(low, high)} K), below the limit in"
        f" {_percent(question.share)} of the rigs"
    )


def _percent(share: float) -> str:
    return f"{100.0 * share:.0f} %"


def _for_ever(run: Question) -> str:
    if run.for_ever is None:
        return f"no belt up to {LONGEST:g} m"
    return f"a belt of {metres(run.for_ever)}"


def _how_sure(answer: Answer) -> list[str]:
    """What is still warm on a belt of any length, and where the polynomials miss something."""
    said = _why_outside(_out_of_answer(answer), answer.case)
    if answer.reason not in ("", NOT_ASKED):
        said.append(f"No interval is told: {answer.reason}, and then the answer is another.")
    for question, why in (
        (answer.run, "what does not come round with the belt stays: warm rollers, a warm sample"),
        (answer.interface, "the ice warms itself, whatever the belt"),
    ):
        if question.high is not None and question.high.length is None:
            said.append(f"A longer belt does not help all rigs: {question.high.reason}; {why}.")
    if (missed := max(answer.unexplained)) > MISSED:
        said.append(
            f"The intervals are {'rough' if missed < _WORTHLESS else 'worth nothing'}: their"
            f" polynomials miss {_percent(missed)} of the variance of unseen runs; more --samples"
            " make them better."
        )
    return said


def outside(name: str, value: float, low: float, high: float, unit: str) -> str:
    """A figure of the nominal rig that lies beyond its interval, or "" where it does not."""
    if low <= value <= high:
        return ""
    return f"{name} ({_span(value, value)} {unit}, interval {_span(low, high)} {unit})"


def _out_of_answer(answer: Answer) -> list[str]:
    """Nominal figures of an answer that lie beyond their intervals."""
    found = []
    for question, rise, length in (
        (answer.run, "the rise at entry", "the belt that comes round cold"),
        (answer.interface, "the interface's rise", "the belt with a steady interface"),
    ):
        if question.rises is not None:
            found.append(outside(rise, question.rise, question.rises[0], question.rises[2], "K"))
        low, high = question.low, question.high
        if question.shortest is None or not (low and high):
            continue
        # beyond the belts looked at an interval is open
        least = 0.0 if low.says.startswith("<") else low.length or 0.0
        found.append(outside(length, question.shortest, least, high.length or math.inf, "m"))
    return [one for one in found if one]


def _why_outside(found: list[str], case: Case) -> list[str]:
    """Why nominal figures lie outside of their intervals, by what the rigs have and it has not."""
    if not found:
        return []
    belt = case.rig.belt
    more = [
        what
        for what, there in (
            ("rollers", belt.rollers > 0),
            ("rollers up to 0.5 K warmer than the air", belt.rollers == 0 or belt.roller_rise > 0),
            ("a railing that rubs", belt.railing_friction > 0.0),
        )
        if not there
    ]
    why = (
        f"the rig as given has none of {', '.join(more)}, and the rigs of the interval do"
        if more
        else "what is in doubt of the rig acts to one side of what is given"
    )
    return [f"Outside of their own intervals are, as the rig is given: {'; '.join(found)}: {why}."]


def _by_speed(rows: list[Row]) -> list[tuple[float, list[Row]]]:
    speeds = sorted({row.case.speed for row in rows})
    return [(speed, [row for row in rows if row.case.speed == speed]) for speed in speeds]


def _one_metre(study: Study, rows: list[Row]) -> list[str]:
    """Does 1 m do? By speed, the other choices taken together."""
    limit = study.options.limit
    if not rows:
        return [f"A belt of {ONE_METRE:g} m was not among the lengths asked for."]
    said, words = [], {}
    for speed, some in _by_speed(rows):
        drifts = [row.drift.run for row in some]
        low, high = min(drifts), max(drifts)
        word = words[speed] = (
            "suffices"
            if high <= limit
            else "does not suffice"
            if low > limit
            else "suffices in some of the cases"
        )
        said.append(
            f"At {speed:g} m/s {ONE_METRE:g} m of belt {word}: after"
            f" {some[0].case.protocol.in_words()} it meets the ice {_span(low, high)} K warmer than"
            f" the air{_doubt(some, limit)}."
        )
    return [_summary(words, limit), *said]


def _summary(words: dict[float, str], limit: float) -> str:
    """All speeds in one sentence; words: by speed."""
    by_word = {
        word: [f"{speed:g}" for speed in words if words[speed] == word]
        for word in dict.fromkeys(words.values())
    }
    said = "; ".join(f"{word} at {', '.join(speeds)} m/s" for word, speeds in by_word.items())
    return (
        f"For a belt that meets the ice less than {limit:g} K above the air,"
        f" {ONE_METRE:g} m: {said}."
    )


def _limit(study: Study) -> list[str]:
    if study.options.limit != CAMERA:
        return []
    return [
        f"The limit of {CAMERA:g} K is a choice, which --limit changes: the figure in the data"
        " sheet of the source study's thermal camera; the study's own test of it told 1 K"
        " apart, and not 0.01 K."
    ]


def _doubt(rows: list[Row], limit: float) -> str:
    """The interval of the drifts of some rows, when it was computed."""
    known = [row.uncertainty for row in rows if row.uncertainty]
    if not known:
        return ""
    low, high = min(one.low for one in known), max(one.high for one in known)
    return (
        f" ({_span(low, high)} K over what is not known of the rig"
        f"{', so nobody can promise it' if low < limit < high else ''})"
    )


def _doubted(study: Study) -> list[str]:
    """The shortest belts at levels of the doubt, by speed."""
    doubted, said = study.shortest_in_doubt(), []
    for speed, rows in _by_speed([row for row in study.rows if row.uncertainty]):
        found = [doubted[case] for case in dict.fromkeys(row.case.with_length(1.0) for row in rows)]

        def words(rise: str, level: str, found=found) -> str:
            known = [one[rise][level] for one in found]
            return ", ".join(dict.fromkeys(one.in_words if one.says else "?" for one in known))

        said.append(
            f"At {speed:g} m/s, over what is not known of the rig, the belt comes round that cold"
            f" in half of the rigs on {words('run', 'median')}, in 95 % of them on"
            f" {words('run', 'high')}; the interface is that steady in half on"
            f" {words('interface', 'median')}, in 95 % on {words('interface', 'high')}"
            " (between the lengths asked for, rounded up to two digits; none is reported beyond)."
        )
    if not said:
        return []
    beyond = [
        f"{one} on {row.case.length:g} m at {row.case.speed:g} m/s"
        for row in study.rows
        if (doubt := row.uncertainty) is not None
        for one in (
            outside("the rise at entry", row.drift.run, doubt.low, doubt.high, "K"),
            outside(
                "the interface's rise",
                row.drift.interface_drift,
                doubt.interface_low,
                doubt.interface_high,
                "K",
            ),
        )
        if one
    ]
    return said + _why_outside(beyond, study.rows[0].case)


def _shortest(study: Study) -> list[str]:
    """Does the belt come round cold? The shortest belts, by speed."""
    limit, said = study.options.limit, []
    for speed, rows in _by_speed(study.rows):
        run, steady = (_lengths(rows, name) for name in ("shortest_run", "shortest_steady"))
        said.append(
            f"At {speed:g} m/s a belt that comes round less than {limit:g} K warm takes"
            f" {run} for the runs, and {steady} for ever."
        )
    return said


def _lengths(rows: list[Row], name: str, longest: str = f"more than {LONGEST:g} m") -> str:
    found = [(getattr(row, name), row.case.shortest) for row in rows]
    known = [length for length, _ in found if length is not None]
    if not known:
        return longest
    if all(length is not None and length <= shortest for length, shortest in found):
        return "any belt"
    shortest, longest_needed = (rounded_up(length)[0] for length in (min(known), max(known)))
    span = (
        metres(min(known))
        if shortest == longest_needed
        else f"{shortest} to {longest_needed} m (rounded up to two digits)"
    )
    return span if len(known) == len(found) else f"{span}, in some cases {longest},"


def _interface(study: Study) -> list[str]:
    """Is the interface steady? The ice warms itself, whatever the belt."""
    limit, said = study.options.limit, []
    for speed, rows in _by_speed(study.rows):
        drifts = [row.drift.interface_drift for row in rows]
        wholes = [row.drift.interface_run for row in rows]
        endless = [row.drift.interface_drift_endless for row in rows]
        steady = (
            ""
            if max(drifts) <= limit
            else (
                "; on a belt that never comes round it would be "
                f"{_span(min(endless), max(endless))} K, and below {limit:g} K it is on "
                f"{_lengths(rows, 'shortest_interface', 'no belt')}"
            )
        )
        said.append(
            f"At {speed:g} m/s the interface warms by {_span(min(drifts), max(drifts))} K at"
            f" constant speed ({_span(min(wholes), max(wholes))} K from the start) on the belts"
            f" asked for{_interface_doubt(rows)}{steady}."
        )
    return said


def _interface_doubt(rows: list[Row]) -> str:
    known = [row.uncertainty for row in rows if row.uncertainty]
    if not known:
        return ""
    low, high = min(u.interface_low for u in known), max(u.interface_high for u in known)
    return f", {_span(low, high)} K at constant speed over what is not known of the rig"


def _wait(study: Study) -> list[str]:
    """How long to wait before the next run, by speed."""
    pauses, reasons, already = [], set(), []
    for speed, rows in _by_speed(study.rows):
        known = [row.wait.begin for row in rows if row.wait.begin is not None]
        reasons |= {row.wait.reason for row in rows if row.wait.begin is None}
        if known and max(known) == 0.0:
            already.append(f"{speed:g}")
        elif known:
            pauses.append(f"{_span(min(known), max(known))} s at {speed:g} m/s")
    if not (pauses or already):
        return [f"No pause makes a later run as cold as the first: {'; '.join(sorted(reasons))}."]
    iced = "lifted" if study.rows[0].case.protocol.lifted else "resting"
    near = f"Belt and ice are within {study.options.limit:g} K of the air"
    said = []
    if already:
        said.append(f"{near} when the runs end at {', '.join(already)} m/s: no wait is needed.")
    if pauses:
        said.append(
            f"{near} again, the belt at a standstill and the ice {iced}, after {', '.join(pauses)}."
        )
    return [*said, *[f"In other cases never: {'; '.join(sorted(reasons))}."] * bool(reasons)]


def _helps(study: Study) -> list[str]:
    """What helps most, in the case that drifts most, by one change alone; nothing where none is
    needed."""
    row, limit = study.worst, study.options.limit
    start, *rest = (one for one in row.changes if one.what not in NO_HELP)
    said = []
    for name, what in (
        ("run", "the belt enters {:.2g} K warm"),
        ("interface_drift", "the interface warms by {:.2g} K at constant speed"),
    ):
        rise = getattr(start, name)
        left = sorted((abs(getattr(one, name)), one.what) for one in rest)
        helps = [f"{kelvin:.2g} K with {one}" for kelvin, one in left if kelvin < _HELPS * rise]
        if rise > limit and helps:
            said.append(
                f"{what.format(rise)}; one change alone leaves at best {', '.join(helps[:3])}"
            )
    where = f"On {row.case.length:g} m at {row.case.speed:g} m/s"
    return [f"{where} {one}." for one in said]


def _study_number(study: Study) -> list[str]:
    factors = [
        row.drift.run / row.drift.study for row in study.rows if row.drift.run > study.options.limit
    ]
    if not factors:
        return []
    return [
        f"Where the drift is above the limit, the source study's single-pass number is"
        f" {_span(min(factors), max(factors))} times too small: it counts one pass of many,"
        " and a rate of cooling of 0.25 1/s that was a conductivity."
    ]


def _influence(study: Study) -> list[str]:
    """Which unknown matters most, in the case that drifts most."""
    known = [(row, row.uncertainty) for row in study.rows if row.uncertainty is not None]
    if not known:
        return []
    row, doubt = max(known, key=lambda one: one[0].drift.run)
    words = {one.key: one.says for one in doubt.single_changes}
    shares = ", ".join(f"{words[one.key]} {one.total:.0%}" for one in doubt.influences[:4])
    return [
        f"The doubt on {row.case.length:g} m at {row.case.speed:g} m/s, {doubt.low:.2g} to"
        f" {doubt.high:.2g} K, is made of (shares of the variance, with what each does together"
        f" with others): {shares}."
    ]


def _melting(study: Study) -> list[str]:
    said = _melting_rigs(study)
    melts = sum(row.drift.steady_melts for row in study.rows)
    if not melts:
        return said
    return [
        *said,
        f"In {melts} of {len(study.rows)} cases the ice face comes to melt and stays at 0 degC;"
        " the water between ice and belt is left out of these drifts.",
    ]


def _melting_rigs(study: Study) -> list[str]:
    """Of what may be meant, not of what is said: in how many of the rigs the ice melts in a run."""
    most = max((row.uncertainty.melts for row in study.rows if row.uncertainty), default=0.0)
    if not most:
        return []
    share = _percent(most) if most >= 0.01 else "less than 1 %"
    return [
        f"In {share} of the sampled rigs the ice comes to melt within the runs. Their rises"
        " are told as if it did not, which is more than they are, for melting takes heat that the"
        " belt does not get then; and less friction on the water is left out."
    ]


def two_digits(value: float) -> str:
    """A figure whose doubt is a factor of 0.75 to 2; below 0.1 mK a rise is nothing."""
    if abs(value) < _NOTHING:
        return "0"
    return f"{float(f'{value:.2g}'):g}"


def _span(low: float, high: float) -> str:
    one, other = two_digits(low), two_digits(high)
    return one if one == other else f"{one} to {other}"

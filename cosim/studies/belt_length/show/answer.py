"""The answer for a drive of an own rig, in sentences: what is needed, what its belt does."""

from __future__ import annotations

import math

from ..case import Case
from ..lengths import LONGEST, metres
from ..required_length import NOT_ASKED, Answer, Question
from .wording import outside, percent, span, why_outside

#: Part of the variance that polynomials may miss without a word; beyond the other they say nothing.
_MISSED, _WORTHLESS = 0.1, 1.0
#: Two heat transfers to the air that differ by less than this part are the same.
_SAME = 0.01


def answered(answer: Answer) -> list[str]:
    """The answer for one drive, the shortest first, in the words of ice."""
    case, run, interface, limit = answer.case, answer.run, answer.interface, answer.limit
    needed = _needed(run, case)
    belt = needed if needed.startswith(("no ", "any ")) else f"a belt of {needed}"
    ever = f"none up to {LONGEST:g} m" if run.for_ever is None else f"one of {metres(run.for_ever)}"
    return [
        f"At {case.speed:g} m/s {belt} comes round less than {limit:g} K above the air after"
        f" {case.protocol.in_words()}, for ever {ever}{_interval(run, ' after the runs')}.",
        f"The belt of {case.length:g} m meets the ice {_on_own(run)}.",
        f"The interface warms by less than {limit:g} K at constant speed on"
        f" {_needed(interface, case)}{_interval(interface)}; on {case.length:g} m it gets"
        f" {_on_own(interface)}.",
        _film(case),
        *_how_sure(answer),
    ]


def _film(case: Case) -> str:
    """Which heat transfer to the air was taken, and why; a coupled run may take another."""
    gives = f"The belt of {case.length:g} m gives {case.film:.2g} W/m2K to the air on each face"
    if case.h is not None:
        return f"{gives}, as given."
    takes = (
        f"{gives}, as a belt at {case.speed:g} m/s through still air does that is as warm as it is"
        f" after the runs, {case.lasting.film:.2g} W/m2K as warm as for ever. `stickslip run` takes"
    )
    runs = case.rig.belt.film
    if abs(runs / case.film - 1.0) < _SAME:
        return f"{takes} the same."
    return (
        f"{takes} {runs:.2g} W/m2K, by belt.air_heat_transfer (15 where a scenario does not say) or"
        f" belt.still_air_speed: `--set belt.still_air_speed={case.speed:g}` makes it take the"
        f" same, `--h {runs:.3g}` this study."
    )


def _needed(question: Question, case: Case) -> str:
    """The length that is needed, at its nominal value."""
    if question.shortest is None:
        return f"no length up to {LONGEST:g} m"
    room = "any belt with room for contact and rollers, from "
    return room * (question.shortest <= case.shortest) + metres(question.shortest)


def _interval(question: Question, when: str = "") -> str:
    """The same over what is not known; nothing where there is no doubt."""
    if not (question.low and question.median and question.high):
        return ""
    return (
        f", as the rig is given; over what is not known of it{when} on {question.low.in_words} in"
        f" 5 % of the rigs, on {question.median.in_words} in half and on {question.high.in_words}"
        " in 95 %"
    )


def _on_own(question: Question) -> str:
    said = f"{question.rise:.2g} K warmer"
    if question.rises is None or question.share is None:
        return said
    rigs = percent(question.share)
    return f"{said} ({span(question.rises)} K), below the limit in {rigs} of the rigs"


def _how_sure(answer: Answer) -> list[str]:
    """What is still warm on a belt of any length, and where the polynomials miss something."""
    said = why_outside(_out_of_interval(answer), answer.case)
    if answer.reason not in ("", NOT_ASKED):
        said.append(f"No interval is told: {answer.reason}, and then the answer is another.")
    for question, why in (
        (answer.run, "what does not come round with the belt stays: warm rollers, a warm sample"),
        (answer.interface, "the ice warms itself, whatever the belt"),
    ):
        if question.high is not None and question.high.length is None:
            said.append(f"A longer belt does not help all rigs: {question.high.reason}; {why}.")
    if (missed := max(answer.unexplained)) > _MISSED:
        said.append(
            f"The intervals are {'rough' if missed < _WORTHLESS else 'worth nothing'}: their"
            f" polynomials miss {percent(missed)} of the variance of unseen runs; more --samples"
            " make them better."
        )
    return said


def _out_of_interval(answer: Answer) -> list[str]:
    """Nominal figures of an answer that lie beyond their intervals."""
    found = []
    for question, rise, length in (
        (answer.run, "the rise at entry", "the belt that comes round cold"),
        (answer.interface, "the interface's rise", "the belt with a steady interface"),
    ):
        if question.rises is not None:
            found += outside(rise, question.rise, question.rises[0], question.rises[2], "K")
        low, high = question.low, question.high
        if question.shortest is not None and low and high:
            # beyond the belts looked at an interval is open
            least = 0.0 if low.says.startswith("<") else low.length or 0.0
            found += outside(length, question.shortest, least, high.length or math.inf, "m")
    return found

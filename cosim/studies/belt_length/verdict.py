"""Claim C13, "1 m of belt is enough", judged in plain words from the rows of a study."""

from __future__ import annotations

from .drift import CAMERA, RUN
from .shortest import LONGEST, SHORTEST
from .study import Row, Study

CLAIMED_LENGTH = 1.0


def verdict(study: Study) -> list[str]:
    """Some sentences; what is said holds for the cases that were computed."""
    if not study.rows:
        return ["Nothing was computed, so nothing can be said."]
    rows = [row for row in study.rows if row.case.length == CLAIMED_LENGTH]
    return [*_claim(rows), *_shortest(study), *_study_number(study), *_influence(study),
            *_melting(study)]


def _claim(rows: list[Row]) -> list[str]:
    """Does 1 m do? By speed, the other choices taken together."""
    if not rows:
        return [f"A belt of {CLAIMED_LENGTH:g} m was not among the lengths: no verdict on C13."]
    said, words = [], {}
    for speed in sorted({row.case.speed for row in rows}):
        drifts = [row.drift.run for row in rows if row.case.speed == speed]
        low, high = min(drifts), max(drifts)
        word = words[speed] = (
            "suffices" if high <= CAMERA else "does not suffice" if low > CAMERA
            else "suffices in some of the cases")
        said.append(
            f"At {speed:g} m/s {CLAIMED_LENGTH:g} m of belt {word}: after {RUN:g} s it meets the"
            f" ice {_span(low, high)} K warmer than the air{_doubt(rows, speed)}; the camera sees"
            f" {CAMERA:g} K.")
    return [_summary(words), *said]


def _summary(words: dict[float, str]) -> str:
    """The claim in one sentence; words: by speed."""
    holds = [speed for speed, word in words.items() if word == "suffices"]
    if len(holds) == len(words):
        return f'C13, "{CLAIMED_LENGTH:g} m of belt is enough": holds at the speeds asked for.'
    if not holds:
        return (f'C13, "{CLAIMED_LENGTH:g} m of belt is enough": does not hold at any of the speeds'
                " asked for in all cases.")
    return (f'C13, "{CLAIMED_LENGTH:g} m of belt is enough": holds at'
            f" {', '.join(f'{speed:g}' for speed in holds)} m/s, not at"
            f" {', '.join(f'{speed:g}' for speed in words if speed not in holds)} m/s.")


def _doubt(rows: list[Row], speed: float) -> str:
    """The interval of a speed's drifts, when it was computed."""
    known = [row.uncertainty for row in rows if row.case.speed == speed and row.uncertainty]
    if not known:
        return ""
    low, high = min(one.low for one in known), max(one.high for one in known)
    return (f" ({_span(low, high)} K over what is not known of air, belt and contact"
            f"{', so nobody can promise it' if low < CAMERA < high else ''})")


def _shortest(study: Study) -> list[str]:
    """The shortest belts, by speed."""
    limit, said = study.options.limit, []
    for speed in sorted({row.case.speed for row in study.rows}):
        rows = [row for row in study.rows if row.case.speed == speed]
        run, steady = (
            _lengths([getattr(row, name) for row in rows])
            for name in ("shortest_run", "shortest_steady"))
        said.append(f"At {speed:g} m/s a drift below {limit:g} K takes {run} for {RUN:g} s, and"
                    f" {steady} for a belt that runs for ever.")
    return said


def _lengths(lengths: list[float | None]) -> str:
    known = [length for length in lengths if length is not None]
    if not known:
        return f"more than {LONGEST:g} m"
    if max(known) <= SHORTEST:
        return "any belt"
    span = f"{_span(min(known), max(known))} m"
    return span if len(known) == len(lengths) else f"{span}, in some cases more than {LONGEST:g} m,"


def _study_number(study: Study) -> list[str]:
    factors = [row.drift.run / row.drift.study for row in study.rows if row.drift.run > CAMERA]
    if not factors:
        return []
    return [f"Where the camera sees the drift, the study's single-pass number is"
            f" {_span(min(factors), max(factors))} times too small: it counts one pass of many,"
            " and a rate of cooling of 0.25 1/s that was a conductivity."]


def _influence(study: Study) -> list[str]:
    """Which unknown matters most, in the case that drifts most."""
    known = [row for row in study.rows if row.uncertainty is not None]
    if not known:
        return []
    row = max(known, key=lambda one: one.drift.run)
    first = row.uncertainty.influences[0]
    words = {"h": "heat transfer to the air", "conductivity": "conductivity of the belt",
             "conductance": "conductance of the contact"}
    return [f"Of what is not known the {words[first.key]} matters most ({first.total:.0%} of the"
            f" variance of the drift on {row.case.length:g} m at {row.case.speed:g} m/s, which lies"
            f" between {row.uncertainty.low:.2g} and {row.uncertainty.high:.2g} K)."]


def _melting(study: Study) -> list[str]:
    melts = sum(row.drift.steady_melts for row in study.rows)
    if not melts:
        return []
    return [f"In {melts} of {len(study.rows)} cases the ice face comes to melt and stays at 0 degC;"
            " the water between ice and belt is left out of these drifts."]


def _span(low: float, high: float) -> str:
    one, other = f"{low:.2g}", f"{high:.2g}"
    return one if one == other else f"{one} to {other}"

"""In which range of one number a rig sticks and slips: from rest, riding, and from a speed ramp."""

from __future__ import annotations

from collections.abc import Callable
from itertools import groupby, pairwise
from typing import Any

from stickslip.steady_motion import numbers as rig
from stickslip.steady_motion.borders import FARTHEST, all_borders, follower
from stickslip.steady_motion.regimes import STICK_SLIP
from stickslip.steady_motion.starts import RAMP, REST, disturbed, other_starts

from cosim.report.page import sentences, texts

from .maps import MAPPED, Case, NotAMotion, run_length

#: From one value to another; None is beyond what was searched.
Window = tuple[float | None, float | None]
#: What the command line calls the numbers of `numbers.numbers_of`.
NUMBERS = {
    "speed": rig.SPEED,
    "ramp": rig.RAMP,
    "damping": rig.DAMPING,
    "pretension": rig.PRETENSION,
    "ratio": rig.RATIO,
}


def stick_slip_range(
    case: Case, word: str, look: Callable[[], object] = lambda: None
) -> dict[str, Any]:
    """``key``, ``unit``, ``value``, ``searched`` (two values), ``ramp`` (s) and ``stick_slip``.

    The last is start -> windows (from, to) in which the block sticks and slips, the scenario's own
    start first; None is beyond what was searched. Every border of such a window is bisected to a
    ten-thousandth. word: of `NUMBERS`. NotAMotion for a number that the rig does not have. look:
    called after each step.
    """
    known = {number.key: number for number in rig.numbers_of(case.parameters)}
    if NUMBERS[word] not in known:
        has = ", ".join(name for name, key in NUMBERS.items() if key in known)
        raise NotAMotion(f"{case.name}: --border {word}: this rig has none; allowed is {has}")
    number = known[NUMBERS[word]]
    starts = other_starts(case.parameters)
    windows = {}
    has_ramp = case.parameters.surface.run_up_time > 0.0
    first = sorted(MAPPED, key=lambda start: start != (RAMP if has_ramp else REST))
    for start in (RAMP,) if number.key == rig.RAMP else first:
        parameters = disturbed(starts[start])
        duration = run_length(parameters)
        borders = all_borders(parameters, number, duration, case.interface, look)
        steady = duration - parameters.surface.run_up_time
        does = follower(parameters, number, steady, case.interface)
        lowest = borders[0].below if borders else does(number.value)
        windows[start] = _windows(lowest[0], [(one.value, one.above[0]) for one in borders])
    own = number.value - number.least or number.first
    return {
        "key": number.key,
        "unit": number.unit,
        "value": number.value,
        "searched": [number.least + own / FARTHEST, number.least + own * FARTHEST],
        "ramp": starts[RAMP].surface.run_up_time,
        "stick_slip": windows,
    }


def _windows(lowest: str, borders: list[tuple[float, str]]) -> list[Window]:
    """Where the block sticks and slips: by its regime at the least value and above each border."""
    names = [lowest, *(name for _, name in borders)]
    between = zip(names, pairwise([None, *(value for value, _ in borders), None]), strict=True)
    windows = []
    for sticks, neighbours in groupby(between, key=lambda one: one[0] == STICK_SLIP):
        ends = [end for _, pair in neighbours for end in pair]
        if sticks:
            windows.append((ends[0], ends[-1]))
    return windows


def range_sentence(found: dict[str, Any]) -> str:
    """The answer in a line: "... sticks and slips from rest up to 0.1812 m/s; riding ..."."""
    return " ".join(sentences(texts("stability.txt.j2", __package__ or "", {}).range(found)))

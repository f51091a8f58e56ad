"""C13 and C15: the check of the belt's length, single pass, repeated passes, finite elements."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

from cosim.studies.belt_length import Case, Protocol
from thermal.belt.single_pass import FROM_FACTORS, PRINTED, SinglePass

from ..claim import Claim
from ..drawing import COLOURS, Curve, Panel
from ..sheet import STUDY, Sheet

#: Lengths of belt, m, and the temperature after one pass that the study prints of each, degC.
TABLE = {float(length): STUDY[f"belt_{length}"].number for length in (1, 2, 3, 4)}
#: Lengths for which the finite elements run: what the claim is about, and the longest.
EXACT_LENGTHS = (1.0, 4.0)
RUN, RAMP = 20.0, 10.0  # s at constant speed; of speed ramp, §3.4.3
SPEED, SLOWEST = 0.82, 0.15
# a rise is the table's where it is no further off than by a half
AS_TOLD = 1.5
# of each face of the belt, W/m2K: still air to a light draught
HEAT_TRANSFER, STILL_AIR = 15.0, 7.0
# the study's camera, K: by its data sheet; what it saw and did not see when it was tried
SENSITIVITY, TRIED = 0.07, {"seen": 1.0, "unseen": 0.01}


def repeated(check: SinglePass, length: float, duration: float = RUN) -> float:
    """Temperature where the belt meets the ice again after all passes of a run, degC.

    Every pass adds its rise; on the way round a part exp(-kappa t) of all that is there is kept.
    """
    kept = math.exp(-check.cooling_rate * (length - check.contact_length) / check.speed)
    passes = math.floor(duration * check.speed / length)
    return check.ambient_degC + check.rise * sum(kept**n for n in range(1, passes + 1))


def belt_case(length: float, h: float = HEAT_TRANSFER, speed: float = SPEED, ramp: float = 0.0):
    """The case of `stickslip belt-length`; h W/m2K, ramp: s before the run."""
    return Case(length, speed, h=h, protocol=Protocol(ramp=ramp, run=RUN))


@cache
def finite_elements(length: float, **of_case: float) -> tuple[float, float]:
    """Rise where the belt meets the ice after a run, K, and the belt's share of the heat."""
    case = belt_case(length, **of_case)
    end = case.follow(case.sliding())[1]
    return end.entry, end.belt_share_so_far


def all_mended(length: float) -> float:
    """Rise after a run by the study's kind of check without its faults, K.

    Every pass counts; the belt takes its share of the heat, on the belt that passes, and cools at
    the rate that a heat transfer on both faces gives it.
    """
    check = belt_case(length).single_pass()
    share = finite_elements(length)[1]
    return repeated(replace(check, friction_force=share * check.friction_force), length) - (
        check.ambient_degC
    )


def judge_length() -> Claim:
    """C13: whether the rise on a belt of 1 m goes unseen."""
    sheet, ambient = Sheet("C13"), PRINTED.ambient_degC
    rises: dict[float, list[float | None]] = {}
    for length, told in TABLE.items():
        known = length in EXACT_LENGTHS
        ours = [all_mended(length), finite_elements(length)[0]] if known else [None, None]
        rises[length] = [PRINTED.temperature_degC(length) - ambient, *ours]
        sheet.row("rise", rises[length], derived=round(told - ambient, 4), length=length)
    sheet.row("camera")
    table, exact = round(TABLE[1.0] - ambient, 4), finite_elements(1.0)[0]
    # the scheme as printed is the table
    sheet.check("table", [None, *rises[1.0][1:]], limit=AS_TOLD * table, table=table)
    _other_runs(sheet)
    sheet.check("camera", rises[1.0], limit=SENSITIVITY)
    for name, limit in TRIED.items():
        sheet.turn(name, exact, sound=exact < limit)
    _other_runs(sheet)
    levels = {"camera's sensitivity": SENSITIVITY}
    sheet.picture("C13_belt", [[Panel(_curves(rises), levels=levels)]])
    rate = belt_case(1.0).single_pass().cooling_rate
    return sheet.claim(
        passes=math.floor(RUN * SPEED),
        repeated=repeated(FROM_FACTORS, 1.0) - ambient,
        faster=PRINTED.cooling_rate / rate,
        ramped=finite_elements(1.0, ramp=RAMP)[0],
    )


def _other_runs(sheet: Sheet) -> None:
    """1 m of belt in other air, after a speed ramp, at the slowest speed."""
    runs = {
        "still": {"h": STILL_AIR},
        "ramped": {"ramp": RAMP},
        "slow": {"speed": SLOWEST},
        "slow_ramped": {"speed": SLOWEST, "ramp": RAMP},
    }
    for name, of_case in runs.items():
        sheet.turn(name, finite_elements(1.0, **of_case)[0])


def _curves(rises: dict[float, list[float | None]]) -> list[Curve]:
    """Rises over the length; no line over lengths that were not computed."""
    curves = []
    for i, name in enumerate(("one pass, as printed", "mended check", "finite elements")):
        known = {length: one[i] for length, one in rises.items() if one[i] is not None}
        joined = "-" if len(known) == len(rises) else ""
        style = {"marker": "o", "linestyle": joined, "color": COLOURS[i], "label": name}
        curves.append(Curve(list(known), list(known.values()), style))
    return curves


def judge_table() -> Claim:
    """C15: the printed table, from the printed force, from its factors, and accumulated."""
    sheet, off = Sheet("C15"), [0.0, 0.0]
    for length, printed in TABLE.items():
        ours = [check.temperature_degC(length) for check in (PRINTED, FROM_FACTORS)]
        off = [max(so_far, abs(one - printed)) for so_far, one in zip(off, ours, strict=True)]
        study = f"belt_{length:.0f}"
        sheet.row("temperature", [*ours, None], study=study, length=length)
    sheet.row("force", [PRINTED.friction_force, FROM_FACTORS.friction_force, None])
    sheet.row("rise", [PRINTED.rise, FROM_FACTORS.rise, None])
    sheet.check("table", [*off, None], faults=("F11",))
    sheet.turn("misprint", off[0])
    accumulated = [f"{length:.0f} m {repeated(FROM_FACTORS, length):.4f}" for length in TABLE]
    return sheet.claim(accumulated=", ".join(accumulated))

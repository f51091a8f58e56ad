"""C13 and C15: the check of the belt's length, single pass, repeated passes, finite elements."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np

from cosim.studies.belt_length import Case, Protocol
from thermal.belt.single_pass import FROM_FACTORS, PRINTED, SinglePass

from ..claim import Claim
from ..drawing import Panel, by_model
from ..sheet import STUDY, Sheet

#: Lengths of belt, m, and the temperature after one pass that the study prints of each, degC.
TABLE = {float(length): STUDY[f"belt_{length}"].number for length in (1, 2, 3, 4)}
RUN, RAMP, SPEED = 20.0, 10.0, 0.82  # s at constant speed; s of speed ramp, §3.4.3; m/s
# a rise is the table's where it is no further off than by a half
AS_TOLD = 1.5
HEAT_TRANSFER = 15.0  # of each face of the belt in a light draught, W/m2K
SENSITIVITY = 0.07  # of the study's camera by its data sheet, K


def repeated(check: SinglePass, length: float, duration: float = RUN) -> float:
    """Temperature where the belt meets the ice again after all passes of a run, degC.

    Every pass adds its rise; on the way round a part exp(-kappa t) of all that is there is kept.
    """
    kept = math.exp(-check.cooling_rate * (length - check.contact_length) / check.speed)
    passes = math.floor(duration * check.speed / length)
    return check.ambient_degC + check.rise * sum(kept**n for n in range(1, passes + 1))


def belt_case(
    length: float, h: float = HEAT_TRANSFER, speed: float = SPEED, ramp: float = 0.0
) -> Case:
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
    check, share = belt_case(length).single_pass(), finite_elements(length)[1]
    mended = replace(check, friction_force=share * check.friction_force)
    return repeated(mended, length) - check.ambient_degC


def judge_length() -> Claim:
    """C13: whether the rise on a belt of 1 m goes unseen."""
    sheet, ambient = Sheet("C13"), PRINTED.ambient_degC
    told = [round(printed - ambient, 4) for printed in TABLE.values()]
    rises = [
        (PRINTED.temperature_degC(one) - ambient, all_mended(one), finite_elements(one)[0])
        for one in TABLE
    ]
    for length, derived, ours in zip(TABLE, told, rises, strict=True):
        sheet.row("rise", ours, derived=derived, length=length)
    sheet.row("camera")
    # the scheme as printed is the table
    sheet.check("table", (None, *rises[0][1:]), limit=AS_TOLD * told[0], table=told[0])
    _turn_runs(sheet)
    sheet.check("camera", rises[0], limit=SENSITIVITY)
    for name, limit in sheet.turns("limit").items():
        sheet.turn(name, rises[0][2], sound=rises[0][2] < limit)
    _turn_runs(sheet)
    curves = by_model(list(TABLE), np.transpose(rises))
    sheet.picture("C13_belt", [[Panel(curves, levels={"camera's sensitivity": SENSITIVITY})]])
    return sheet.claim(
        passes=math.floor(RUN * SPEED),
        repeated=repeated(FROM_FACTORS, 1.0) - ambient,
        faster=PRINTED.cooling_rate / belt_case(1.0).single_pass().cooling_rate,
        ramped=finite_elements(1.0, ramp=RAMP)[0],
    )


def _turn_runs(sheet: Sheet) -> None:
    """1 m of belt in other air, after a speed ramp, at the slowest speed."""
    for name, run in sheet.turns("run").items():
        sheet.turn(name, finite_elements(1.0, **run)[0])


def judge_table() -> Claim:
    """C15: the printed table, from the printed force, from its factors, and accumulated."""
    sheet, checks = Sheet("C15"), (PRINTED, FROM_FACTORS)
    found = np.array([[check.temperature_degC(length) for check in checks] for length in TABLE])
    for length, ours in zip(TABLE, found, strict=True):
        sheet.row("temperature", ours, study=f"belt_{length:.0f}", length=length)
    off = np.abs(found.T - list(TABLE.values())).max(axis=1)
    sheet.row("force", [PRINTED.friction_force, FROM_FACTORS.friction_force])
    sheet.row("rise", [PRINTED.rise, FROM_FACTORS.rise])
    sheet.check("table", off, faults=("F11",))
    sheet.turn("misprint", off[0])
    accumulated = [f"{length:.0f} m {repeated(FROM_FACTORS, length):.4f}" for length in TABLE]
    return sheet.claim(accumulated=", ".join(accumulated))

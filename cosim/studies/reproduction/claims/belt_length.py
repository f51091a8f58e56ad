"""C13 and C15: the check of the belt's length, single pass, repeated passes, finite elements."""

import math
from dataclasses import replace
from functools import cache

import numpy as np

from cosim.studies.belt_length import Case, Protocol
from thermal.belt.single_pass import FROM_FACTORS, PRINTED, SinglePass

from ..claim import STUDY, Claim
from ..drawing import Panel, add_picture, by_model

#: Lengths of belt, m, and the temperature after one pass that the study prints of each, degC.
TABLE: dict[float, float] = {float(one): STUDY[f"belt_{one}"].value for one in (1, 2, 3, 4)}
AMBIENT = PRINTED.ambient_degC
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


def rises(length: float) -> tuple[float, float, float]:
    """Rise of the belt after a run, K: as printed, by the same check mended, by finite elements.

    Mended, every pass counts; the belt takes its share of the heat, on the belt that passes, and
    cools at the rate that a heat transfer on both faces gives it.
    """
    check, (rise, share) = belt_case(length).single_pass(), finite_elements(length)
    mended = replace(check, friction_force=share * check.friction_force)
    printed = PRINTED.temperature_degC(length) - AMBIENT
    return printed, repeated(mended, length) - check.ambient_degC, rise


def judge_length(claim: Claim) -> dict[str, float]:
    """Whether the rise on a belt of 1 m goes unseen."""
    told = [round(printed - AMBIENT, 4) for printed in TABLE.values()]
    found = [rises(length) for length in TABLE]
    claim.row_each("rise", np.transpose(found), derived=told, length=[*TABLE])
    claim.row("camera")
    # the scheme as printed is the table
    claim.check("table", (None, *found[0][1:]), limit=AS_TOLD * told[0], table=told[0])
    # 1 m of belt in other air, after a speed ramp, at the slowest speed
    others = {name: finite_elements(1.0, **run)[0] for name, run in claim.changes("run").items()}
    for name, rise in others.items():
        claim.turn(name, rise)
    claim.check("camera", found[0], limit=SENSITIVITY)
    for name, limit in claim.changes("limit").items():
        claim.turn(name, found[0][2], sound=found[0][2] < limit)
    for name, rise in others.items():
        claim.turn(name, rise)
    curves = by_model(list(TABLE), np.transpose(found))
    add_picture(claim, "C13_belt", [[Panel(curves, levels={"camera's sensitivity": SENSITIVITY})]])
    return {
        "passes": math.floor(RUN * SPEED),
        "repeated": repeated(FROM_FACTORS, 1.0) - AMBIENT,
        "faster": PRINTED.cooling_rate / belt_case(1.0).single_pass().cooling_rate,
        "ramped": finite_elements(1.0, ramp=RAMP)[0],
    }


def judge_table(claim: Claim) -> dict[str, str]:
    """The printed table, from the printed force, from its factors, and accumulated."""
    checks = PRINTED, FROM_FACTORS
    found = np.array([[check.temperature_degC(length) for length in TABLE] for check in checks])
    names = [f"belt_{length:.0f}" for length in TABLE]
    claim.row_each("temperature", found, study=names, length=[*TABLE])
    off = np.abs(found - list(TABLE.values())).max(axis=1)
    claim.row("force", [check.friction_force for check in checks])
    claim.row("rise", [check.rise for check in checks])
    claim.check("table", off, faults=("F11",))
    claim.turn("misprint", off[0])
    accumulated = [f"{length:.0f} m {repeated(FROM_FACTORS, length):.4f}" for length in TABLE]
    return {"accumulated": ", ".join(accumulated)}

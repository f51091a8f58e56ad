"""C13 and C15: the check of the belt's length, single pass, repeated passes, finite elements."""

from __future__ import annotations

import math
from functools import cache

from cosim.studies.drawing import panels, picture
from thermal import Belt, BeltIceModel, ThermalParameters
from thermal.single_pass import FROM_FACTORS, PRINTED, SinglePass

from ..claim import Check, Claim, Row
from ..drawing import COLOURS, LABELS, study_line

#: Temperature of the belt after one pass, degC, as printed; length in m
TABLE = {1.0: -7.9435, 2.0: -7.9583, 3.0: -7.9693, 4.0: -7.9774}
DIGIT = 1e-4
RUN = 20.0  # s at constant speed
SPEED = 0.82
# what the study's camera sees; the study asks for less than can be measured
SENSITIVITY = 0.07
MACRO_STEP = 0.02


def repeated(check: SinglePass, length: float, duration: float = RUN) -> float:
    """Temperature where the belt meets the ice again after all passes of a run, degC.

    Every pass adds its rise; on the way round a part exp(-kappa t) of all that is there is kept.
    """
    kept = math.exp(-check.cooling_rate * (length - check.contact_length) / check.speed)
    passes = math.floor(duration * check.speed / length)
    rise = check.rise * sum(kept**n for n in range(1, passes + 1))
    return check.ambient_degC + rise


#: Lengths for which the finite elements run, m: what the claim is about, and the longest
EXACT_LENGTHS = (1.0, 4.0)


@cache
def finite_elements(length: float) -> float:
    """Temperature of the belt where it meets the ice after a run, degC; the ice takes its part."""
    model = BeltIceModel(ThermalParameters(belt=Belt(length=length)))
    force = FROM_FACTORS.friction_force
    for _ in range(round(RUN / MACRO_STEP)):
        model.step(MACRO_STEP, force * SPEED * MACRO_STEP, SPEED * MACRO_STEP)
    return model.outputs()["belt_entry_temperature"]


def judge_length() -> Claim:
    """C13: whether the rise on a belt of 1 m goes unseen."""
    ambient = PRINTED.ambient_degC
    rises = {
        length: (
            PRINTED.temperature_degC(length) - ambient,
            repeated(FROM_FACTORS, length) - ambient,
            finite_elements(length) - ambient if length in EXACT_LENGTHS else None,
        )
        for length in TABLE
    }
    return Claim(
        "C13", "1 m of belt is enough",
        tuple(
            Row(f"rise where the belt meets the ice, {length:.0f} m", "K",
                round(TABLE[length] - ambient, 4), *rises[length])
            for length in TABLE
        ),
        (
            Check(f"the rise on 1 m stays below what the camera sees, {SENSITIVITY} K",
                  *(rise < SENSITIVITY for rise in rises[1.0]), faults=("F9",)),
        ),
        remarks=(
            "As printed: one pass. Mended: the same check, its force from its own factors, over "
            f"all {math.floor(RUN * SPEED)} passes that a run of {RUN:.0f} s makes on 1 m. Exact: "
            "finite elements, heat shared with the ice, cooling by the air.",
        ),
        assumed=("finite elements: belt, air and contact as in the thermal model's defaults",),
        pictures=(_draw(rises),),
    )


def judge_table() -> Claim:
    """C15: the printed table, from the printed force, from its factors, and accumulated."""
    rows, checks = [], []
    for length, printed in TABLE.items():
        ours = PRINTED.temperature_degC(length)
        mended = FROM_FACTORS.temperature_degC(length)
        rows.append(Row(f"belt after one pass, {length:.0f} m", "degC", printed, ours, mended,
                        digits=6))
        checks.append((abs(ours - printed) < DIGIT, abs(mended - printed) < DIGIT))
    rows.append(Row("friction force", "N", 4.1261, PRINTED.friction_force,
                    FROM_FACTORS.friction_force, digits=5))
    rows.append(Row("rise in the pass", "K", 0.0748, PRINTED.rise, FROM_FACTORS.rise))
    passes = {length: repeated(FROM_FACTORS, length) for length in TABLE}
    return Claim(
        "C15", "the table of belt temperatures after one pass", tuple(rows),
        (
            Check("the four temperatures to 1e-4 K", all(one for one, _ in checks),
                  all(one for _, one in checks), None, faults=("F11",)),
        ),
        remarks=(
            "0.3 · 1.371 kg · 9.81 m/s² is 4.0349 N, not 4.1261 N; the table follows from the "
            "misprint. Repeated passes of a 20 s run, same check: "
            + ", ".join(f"{length:.0f} m {t:.4f}" for length, t in passes.items()) + " degC.",
        ),
    )


@picture("C13_belt", "Rise of the belt where it meets the ice, over its length, after 20 s at "
         "0.82 m/s. Study: table 3.5.")
def _draw(rises: dict[float, tuple[float | None, ...]]):
    figure, axes = panels(1, 1, height=2.8, width=5.5)
    ax = axes[0, 0]
    names = ("one pass, as printed", "all passes, same check", "finite elements")
    for i, (model, name) in enumerate(zip(LABELS, names, strict=True)):
        known = {length: one[i] for length, one in rises.items() if one[i] is not None}
        ax.plot(list(known), list(known.values()), "o-", color=COLOURS[model], label=name)
    study_line(ax, SENSITIVITY, "camera's sensitivity")
    ax.set_xlabel("length of the belt, m")
    ax.set_ylabel("rise, K")
    ax.set_ylim(bottom=0.0)
    figure.legend(*ax.get_legend_handles_labels(), ncols=2, loc="outside upper center")
    return figure

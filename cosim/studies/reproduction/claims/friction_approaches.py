"""C17: whether slips last longer where friction falls with the sliding speed."""

from __future__ import annotations

from functools import cache

from stickslip.reference.scheme_errors import MENDED, PRINTED

from ..cases import (
    DATASET_1,
    DATASET_2,
    GUIDED,
    GUIDED_ASSUMED,
    SCATTER_ASSUMED,
    SPEEDS,
    WEAKENING,
    Case,
    exact_figures,
    scheme_figures,
)
from ..claim import OPEN, Check, Claim, Margin, Row, Turn

#: Falls of mu_k over the study's speeds that are tried in place of the assumed one.
OTHER_FALLS = (0.2, 0.6)


@cache
def slip_times(case: Case) -> tuple[float, float, float]:
    """Mean duration of a slip as printed, mended, exact with the block guided along x, s."""
    return (
        scheme_figures(case, PRINTED).slip_time,
        scheme_figures(case, MENDED).slip_time,
        exact_figures(case, rig=GUIDED).slip_time,
    )


def falling(case: Case, fall: float = WEAKENING) -> Case:
    """The same with friction that falls with the sliding speed."""
    return case.changed(weakening=fall)


def judge() -> Claim:
    """Mean slip times of the two approaches to friction, in three models."""
    steady, fell = slip_times(DATASET_1), slip_times(falling(DATASET_1))
    return Claim(
        "C17",
        "slips last longer where friction falls with the sliding speed",
        (
            Row("mean slip time, friction by mean and scatter", "s", None, *steady),
            Row("mean slip time, friction falling with speed", "s", None, *fell),
        ),
        (
            Check(
                "a slip lasts longer with friction that falls with the speed",
                *(later > before for before, later in zip(steady, fell, strict=True)),
                margin=Margin(
                    "slip time with falling friction by that with steady, exact",
                    fell[2] / steady[2],
                    1.0,
                ),
                turns=tuple(_turns()),
            ),
        ),
        remarks=(
            "Less friction in slip means a longer way to the next stick, and so longer slips; but "
            "it also leaves more between µ_s and friction, which shortens them. Which of the two "
            "is more depends on speed and law, of which the study prints neither for its figure.",
        ),
        place="§4.4.3, fig. 4.12",
        rests="case and law of the figure, which are not printed",
        assumed=(
            SCATTER_ASSUMED,
            f"falling: by {100.0 * WEAKENING:.0f} % of µ_k between 0.15 and 0.82 m/s; m 0.67 kg, "
            "k 20.17 N/m, v 0.15 m/s",
            GUIDED_ASSUMED,
        ),
    )


def _turns() -> list[Turn]:
    """Other speeds, the other dataset, other falls: the figure's case is not printed."""
    cases = [
        (f"at {speed} instead of {SPEEDS[0]} m/s", DATASET_1.changed(speed=speed), WEAKENING)
        for speed in (SPEEDS[2], SPEEDS[-1])
    ]
    cases.append(("dataset #2 instead of #1", DATASET_2, WEAKENING))
    cases += [
        (f"a fall of {100.0 * fall:.0f} instead of {100.0 * WEAKENING:.0f} %", DATASET_1, fall)
        for fall in OTHER_FALLS
    ]
    turns = []
    for change, case, fall in cases:
        before, later = (
            exact_figures(one, rig=GUIDED).slip_time for one in (case, falling(case, fall))
        )
        figure = f"exact: {before:.3f} s steady, {later:.3f} s falling"
        turns.append(Turn(change, figure, later > before, OPEN))
    return turns

"""C7: dataset #1 rotates up to 150 degrees, dataset #2 stays within 20."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure
from stickslip.reference.scheme_errors import MENDED, PRINTED, Faults

from cosim.report.live import live_of
from cosim.report.style import panels, picture
from cosim.studies.reproduction.cases import STUDY

from ..cases import (
    DATASET_1,
    DATASET_2,
    EXACT_START,
    RIG_ASSUMED,
    SCATTER_ASSUMED,
    Case,
    exact_motion,
    exact_parameters,
    scheme_motion,
)
from ..claim import FAR, OPEN, Check, Claim, Margin, Row, Turn, responsible
from ..drawing import COLOURS, LABELS, study_line
from ..motion import Motion, MotionFigures, figures
from ..readings import AS_PRINTED, MARKS, READINGS, outcome, outcomes, reading_figures

SEEDS = tuple(range(8))
FAR_TURN = STUDY["rotation_dataset_1"].number
MEASURED = STUDY["rotation_measured"].number
# the motion is chaotic: the largest angle of one run and of another differ by as much
FACTOR = 1.5


#: Dataset -> figures as printed, mended and exact.
Found = dict[str, tuple[MotionFigures, MotionFigures, MotionFigures]]
CASES = {"#1": DATASET_1, "#2": DATASET_2}


def _farthest(case: Case, faults: Faults) -> Motion:
    """The run of several seeds that turns farthest."""
    runs = [scheme_motion(case, faults, seed) for seed in SEEDS]
    return max(runs, key=lambda one: float(np.abs(one.phi).max()))


def _largest(case: Case, faults: Faults) -> MotionFigures:
    return figures(_farthest(case, faults))


def _turns_still(faults: Faults) -> bool:
    """Turns by more than chance could make of 150 degrees, once and again."""
    return _largest(DATASET_1, faults).max_rotation > FAR_TURN / FACTOR**2


def _stays(ours: MotionFigures) -> bool:
    return ours.max_rotation < FACTOR * MEASURED


def judge() -> Claim:
    """Largest rotation and angular speed over several seeds."""
    found = {
        name: (
            _largest(case, PRINTED),
            _largest(case, MENDED),
            figures(exact_motion(exact_parameters(case))),
        )
        for name, case in CASES.items()
    }
    smaller = found["#2"][0].max_rotation < found["#1"][0].max_rotation
    return Claim(
        "C7",
        "dataset #1 rotates up to 150°, dataset #2 stays within 20°",
        _rows(found),
        _checks(found),
        remarks=(
            f"As printed, dataset #2 turns {'less' if smaller else 'no less'} than dataset #1, by "
            f"{found['#2'][0].max_rotation:.0f}°: not within the {MEASURED:.0f}° that the study "
            "takes for measured. In the mended scheme and in the exact model it stays within, for "
            "there nothing turns: neither does dataset #1.",
            f"{found['#1'][0].max_rotation:.0f}° is the farthest of {len(SEEDS)} whole runs. The "
            "table of readings has three runs, and of each the 20 s after ten cycles: "
            f"{reading_figures(AS_PRINTED, 1).max_rotation:.0f}°.",
            "Both rotations alone, to within half: "
            + ("; ".join(_readings_with_both()) or "no reading")
            + f". None of the {len(READINGS)} readings has the datasets' other marks, too.",
            "The study's angular speeds are the angle of a swing by its duration; so are ours.",
        ),
        place="§4.6.4, fig. 4.21, eq. 4.26",
        rests="the readings of the scheme, of which none gives both datasets",
        assumed=(
            SCATTER_ASSUMED.replace(
                "mean of three seeds, last 60 % of 25 cycles",
                f"largest of {len(SEEDS)} seeds, 25 cycles",
            ),
            RIG_ASSUMED,
        ),
        pictures=(_draw(),),
    )


def _rows(found: Found) -> tuple[Row, ...]:
    """Angle and swing of each dataset, by model."""
    rows = []
    for name, models in found.items():
        angle, rate = (STUDY[f"{what}_dataset_{name[1:]}"] for what in ("rotation", "swing"))
        rows.append(
            Row(
                f"largest rotation, dataset {name}, of {len(SEEDS)} runs{EXACT_START}",
                "deg",
                angle,
                *(one.max_rotation for one in models),
            )
        )
        rows.append(
            Row(
                f"angle by duration of the fastest swing, dataset {name}",
                "deg/s",
                rate,
                *(one.swing_rate for one in models),
            )
        )
    return tuple(rows)


def _checks(found: Found) -> tuple[Check, ...]:
    """How far each dataset turns, and whether one model does both."""
    far = [one.max_rotation > FAR_TURN / FACTOR for one in found["#1"]]
    near = [_stays(one) for one in found["#2"]]
    both = [one and other for one, other in zip(far, near, strict=True)]
    loose = {
        name: figures(exact_motion(exact_parameters(case, pretension=0.0)))
        for name, case in CASES.items()
    }
    return (
        Check(
            f"dataset #1 turns by more than {FAR_TURN / FACTOR:.0f}°",
            *far,
            faults=responsible(_turns_still),
            margin=Margin(
                "largest rotation #1, exact, its start",
                found["#1"][2].max_rotation,
                FAR_TURN / FACTOR,
                "°",
            ),
        ),
        Check(
            f"dataset #2 stays within {FACTOR * MEASURED:.0f}°",
            *near,
            margin=Margin(
                "largest rotation #2, exact, its start",
                found["#2"][2].max_rotation,
                FACTOR * MEASURED,
                "°",
            ),
        ),
        Check(
            f"one and the same model makes both datasets: all {len(MARKS)} of their printed marks",
            *both,
            margin=Margin(
                "marks of the two datasets met by the best reading",
                max(sum(one.met) for one in outcomes()),
                len(MARKS),
            ),
            turns=(_without_pretension(loose), *_readings()),
        ),
    )


def _both(first: MotionFigures, second: MotionFigures) -> bool:
    return first.max_rotation > FAR_TURN / FACTOR and _stays(second)


def _without_pretension(loose: dict[str, MotionFigures]) -> Turn:
    return Turn(
        "exact: no pretension",
        f"#1 {loose['#1'].max_rotation:.1f}°, #2 {loose['#2'].max_rotation:.1f}°",
        _both(loose["#1"], loose["#2"]),
        OPEN,
    )


def _readings() -> list[Turn]:
    """The scheme in all its readings; what some passage of the study says, it may mean."""
    turns = []
    for reading in READINGS:
        pair = reading_figures(reading, 1), reading_figures(reading, 2)
        turns.append(
            Turn(
                f"the scheme read otherwise: {reading.name}",
                f"{sum(outcome(reading).met)} of {len(MARKS)} marks; "
                f"#1 {pair[0].max_rotation:.0f}°, #2 {pair[1].max_rotation:.0f}°",
                all(outcome(reading).met),
                OPEN if reading.place else FAR,
            )
        )
    return turns


def _readings_with_both() -> list[str]:
    """Names of the readings in which #1 turns far and #2 does not, whatever else they do."""
    return [
        reading.name
        for reading in READINGS
        if _both(reading_figures(reading, 1), reading_figures(reading, 2))
    ]


@picture(
    "C7_rotation",
    "φ(t) of datasets #1 and #2 as printed and mended (of eight runs each the "
    "one that turns farthest) and in the exact model. Study: figure 4.21.",
    live=live_of,
)
def _draw() -> Figure:
    figure, axes = panels(1, 2, height=2.7)
    for ax, (name, case) in zip(axes[0], CASES.items(), strict=True):
        runs: dict[str, Motion] = {
            "printed": _farthest(case, PRINTED),
            "mended": _farthest(case, MENDED),
            "exact": exact_motion(exact_parameters(case)),
        }
        for model, run in runs.items():
            style = {"color": COLOURS[model], "label": LABELS[model], "lw": 1.0}
            ax.plot(run.time, np.degrees(run.phi), **style)
        for sign in (1, -1):
            study = STUDY[f"rotation_dataset_{name[1:]}"].number
            study_line(ax, sign * study, "study's largest" if sign == 1 else "_")
        largest = np.degrees(np.abs(runs["printed"].phi).max())
        ax.set_title(f"dataset {name}: as printed up to {largest:.0f}°")
        ax.set_xlabel("time, s")
        ax.set_ylabel("φ, °")
        ax.set_xlim(0.0, runs["printed"].time[-1])
    figure.legend(*axes[0, 0].get_legend_handles_labels(), ncols=4, loc="outside upper center")
    return figure

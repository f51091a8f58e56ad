"""C7: dataset #1 rotates up to 150 degrees, dataset #2 stays within 20."""

from __future__ import annotations

import numpy as np
from stickslip.reference.faults import MENDED, PRINTED, Faults

from cosim.studies.drawing import panels, picture

from ..cases import (
    DATASET_1,
    DATASET_2,
    RIG_ASSUMED,
    SCATTER_ASSUMED,
    Case,
    exact_motion,
    exact_parameters,
    scheme_motion,
)
from ..claim import Check, Claim, Row, responsible
from ..drawing import COLOURS, LABELS, study_line
from ..motion import Motion, MotionFigures, figures

SEEDS = tuple(range(8))
STUDY = {"#1": (150.0, 880.0), "#2": (20.0, 56.0)}
# the motion is chaotic: the largest angle of one run and of another differ by as much
FACTOR = 1.5


def _largest(case: Case, faults: Faults) -> MotionFigures:
    """The run of several seeds that turns farthest."""
    runs = [figures(scheme_motion(case, faults, seed)) for seed in SEEDS]
    return max(runs, key=lambda one: one.max_rotation)


def _turns_still(faults: Faults) -> bool:
    """Turns by more than chance could make of 150 degrees, once and again."""
    return _largest(DATASET_1, faults).max_rotation > STUDY["#1"][0] / FACTOR**2


def _stays(ours: MotionFigures) -> bool:
    return ours.max_rotation < FACTOR * STUDY["#2"][0]


def judge() -> Claim:
    """Largest rotation and angular speed over several seeds."""
    rows, found = [], {}
    for name, case in (("#1", DATASET_1), ("#2", DATASET_2)):
        exact = figures(exact_motion(exact_parameters(case)))
        found[name] = (_largest(case, PRINTED), _largest(case, MENDED), exact)
        angle, rate = STUDY[name]
        rows.append(Row(f"largest rotation, dataset {name}", "deg", angle,
                        *(one.max_rotation for one in found[name])))
        rows.append(Row(f"largest angular speed, dataset {name}", "deg/s", rate,
                        *(one.max_rotation_rate for one in found[name])))
    far = [one.max_rotation > STUDY["#1"][0] / FACTOR for one in found["#1"]]
    near = [_stays(one) for one in found["#2"]]
    smaller = found["#2"][0].max_rotation < found["#1"][0].max_rotation
    return Claim(
        "C7", "dataset #1 rotates up to 150°, dataset #2 stays within 20°", tuple(rows),
        (
            Check(f"dataset #1 turns by more than {STUDY['#1'][0] / FACTOR:.0f}°", *far,
                  faults=responsible(_turns_still)),
            Check(f"dataset #2 stays within {FACTOR * STUDY['#2'][0]:.0f}°", *near),
        ),
        remarks=(
            f"As printed, dataset #2 turns {'less' if smaller else 'no less'} than dataset #1; "
            "the study's angular speeds are swings divided by their duration, ours are the largest "
            "momentary ones.",
        ),
        assumed=(
            SCATTER_ASSUMED.replace("mean of three seeds, last 60 % of 25 cycles",
                                    f"largest of {len(SEEDS)} seeds, 25 cycles"),
            RIG_ASSUMED,
        ),
        pictures=(_draw(),),
    )


@picture("C7_rotation", "φ(t) of datasets #1 and #2 as printed, mended and in the exact model. "
         "Study: figure 4.21.")
def _draw():
    figure, axes = panels(1, 2, height=2.7)
    for ax, name, case in ((axes[0, 0], "#1", DATASET_1), (axes[0, 1], "#2", DATASET_2)):
        runs: dict[str, Motion] = {
            "printed": scheme_motion(case, PRINTED), "mended": scheme_motion(case, MENDED),
            "exact": exact_motion(exact_parameters(case)),
        }
        for model, run in runs.items():
            style = {"color": COLOURS[model], "label": LABELS[model], "lw": 1.0}
            ax.plot(run.time, np.degrees(run.phi), **style)
        for sign in (1, -1):
            study_line(ax, sign * STUDY[name][0], "study's largest" if sign == 1 else "_")
        ax.set_title(f"dataset {name}")
        ax.set_xlabel("time, s")
        ax.set_ylabel("φ, °")
        ax.set_xlim(0.0, 30.0)
    figure.legend(*axes[0, 0].get_legend_handles_labels(), ncols=4, loc="outside upper center")
    return figure

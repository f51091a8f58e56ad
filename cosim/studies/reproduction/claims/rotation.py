"""C5 and C7: what turns the block; the four treatments of the spring angles, the two datasets."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from stickslip.reference.scheme_errors import MENDED, PRINTED, Faults
from stickslip.reference.spring_angles import TREATMENTS

from cosim.report.style import SERIES

from ..cases import DATASET_1, DATASETS, Case, exact_motion, scheme, scheme_motion
from ..claim import FAR, OPEN, Claim, responsible, responsible_pairs
from ..drawing import COLOURS, LABELS, Panel, figure_of, over_time
from ..motion import Motion, figures
from ..readings import AS_PRINTED, MARKS, READINGS, onset, outcome, reading_figures
from ..sheet import STUDY, Sheet

CYCLES, SEED = 40, 0
ROTATES = 30.0  # deg: half of "three times" the measured 20
SIDES = CYCLES // 10  # y comes back: more changes of its sign than one in every ten cycles
#: Drawn: of `Motion`, the label of its axis, its scale.
QUANTITIES = (("x", "x, cm", 100.0), ("phi_deg", "φ, °", 1.0), ("y", "y, cm", 100.0))
EXACT_DURATION, SHOWN = 40.0, 20.0  # s
#: What the study leaves open of the exact rig: pretension, m, and rotation at the start, deg.
FREER = ((0.0, 1.0), (0.0, 5.0), (0.004, 5.0))


def treated(faults: Faults, **changes: Any) -> dict[str, Motion]:
    """Dataset #1 under each treatment of the spring angles."""
    return {
        name: Motion.of_scheme(
            scheme(DATASET_1, faults, treatment=name, **changes).run(cycles=CYCLES, seed=SEED)
        )
        for name in TREATMENTS
    }


def _only_updated_rotates(runs: dict[str, Motion]) -> bool:
    others = max(run.rotation for name, run in runs.items() if name != "updated")
    return runs["updated"].rotation > ROTATES and others < 0.1 * ROTATES


def _only_updated_comes_back(runs: dict[str, Motion]) -> bool:
    """With constant angles y moves away for good; with updated ones it comes back."""
    away = max(_sides(runs["constant"]), _sides(runs["opposed"]))
    return _sides(runs["updated"]) > SIDES >= away


def _sides(run: Motion) -> int:
    """How often y changes sign."""
    return int(np.sum(np.diff(np.sign(run.y[run.y != 0.0])) != 0))


@cache
def _parts(faults: Faults) -> tuple[bool, bool]:
    """Whether only the updated angles rotate, and whether with them alone y comes back."""
    runs = treated(faults)
    return _only_updated_rotates(runs), _only_updated_comes_back(runs)


def _apart(runs: dict[str, Motion]) -> float:
    """Largest difference of break-away places between treatments before rotation sets in, m."""
    until = np.nan_to_num(onset(runs["updated"]), nan=np.inf)
    peaks = []
    for run in runs.values():
        ends = run.phases[(run.phases[:, 2] == 0) & (run.phases[:, 1] < until), 1]
        peaks.append(np.interp(ends, run.time, run.x))
    count = min(len(one) for one in peaks)
    return float(np.ptp([one[:count] for one in peaks], axis=0).max()) if count else 0.0


def judge_treatments() -> Claim:
    """C5: all four treatments, as printed and mended, beside the exact geometry."""
    sheet, printed, mended = Sheet("C5"), treated(PRINTED), treated(MENDED)
    exact = exact_motion(DATASET_1, EXACT_DURATION)
    loose = exact_motion(DATASET_1, EXACT_DURATION, pretension=0.0)
    for name in TREATMENTS:
        models = [printed[name], mended[name], exact if name == "updated" else None]
        turned = "rotation_updated" if name == "updated" else "rotation"
        sheet.row(turned, [one.rotation if one else None for one in models], name=name)
        farthest_y = [float(np.abs(one.y).max()) if one else None for one in models]
        sheet.row("sideways", farthest_y, name=name)
    sheet.row("sets_in", [onset(printed["updated"]), onset(mended["updated"]), None])
    apart = [_apart(printed), _apart(mended), None]
    sheet.row("apart", apart)
    sheet.check("agree", [one and 1e3 * one for one in apart])
    free, back = max(exact.rotation, loose.rotation), treated(MENDED.only("F1", "F13"))["updated"]
    sheet.check(
        "rotates",
        answers=[_parts(PRINTED)[0], _parts(MENDED)[0], free > ROTATES],
        margin=free,
        limit=ROTATES,
        faults=responsible(lambda faults: _parts(faults)[0]),
    )
    for pretension, start in FREER:
        run = exact_motion(
            DATASET_1, EXACT_DURATION, pretension=pretension, initial={"phi": np.radians(start)}
        )
        sheet.turn("freer", run.rotation, pretension=1e3 * pretension, start=start)
    sheet.turn("put_back", back.rotation)
    alone = responsible(lambda faults: _parts(faults)[1])
    sheet.check(
        "comes_back",
        answers=[_parts(PRINTED)[1], _parts(MENDED)[1], None],
        margin=max(_sides(mended[name]) for name in ("constant", "opposed")),
        limit=SIDES,
        faults=alone,
        together=() if alone else responsible_pairs(lambda faults: _parts(faults)[1]),
    )
    scattered = treated(MENDED, scatter=0.2)
    sound = _only_updated_comes_back(scattered)
    sheet.turn("scatter", _sides(scattered["updated"]), sound=sound)
    schemes = {"as printed": printed, "mended": mended}
    sheet.picture("C5_spring_angles", _draw_treatments, schemes, live=True)
    return sheet.claim(back=back.rotation, loose=loose.rotation, y=100 * np.abs(loose.y).max())


def _draw_treatments(schemes: dict[str, dict[str, Motion]]) -> Figure:
    """A row a quantity, a column a scheme; a line a treatment."""
    # thinner one by one: those that coincide are all seen
    widths = np.linspace(3.0, 0.8, len(TREATMENTS))
    rows: list[list[Panel]] = []
    for name, label, scale in QUANTITIES:
        rows.append([])
        for title, runs in schemes.items():
            lines = [
                over_time(run, name, scale, end=SHOWN, color=colour, lw=width, label=treatment)
                for (treatment, run), colour, width in zip(
                    runs.items(), SERIES, widths, strict=False
                )
            ]
            above = f"scheme {title}" if name == "x" else ""
            rows[-1].append(Panel(lines, "time, s", label, above, end=SHOWN))
    return figure_of(rows, legend=4, height=2.0, sharex="col", sharey="row")


RUNS = tuple(range(8))
FAR_TURN = STUDY["rotation_dataset_1"].number
MEASURED = STUDY["rotation_measured"].number
# the motion is chaotic: the largest angle of one run and of another differ by as much
FACTOR = 1.5


def farthest(case: Case, faults: Faults) -> Motion:
    """The run of several seeds that turns farthest."""
    return max((scheme_motion(case, faults, seed) for seed in RUNS), key=lambda run: run.rotation)


def turns_far_and_near(first: float, second: float) -> bool:
    """Whether #1 turns by the study's 150 degrees, and #2 stays within the measured 20."""
    return first > FAR_TURN / FACTOR and second < FACTOR * MEASURED


def judge_datasets() -> Claim:
    """C7: largest rotation and angular speed over several seeds."""
    sheet = Sheet("C7")
    runs = {
        dataset: [farthest(case, PRINTED), farthest(case, MENDED), exact_motion(case)]
        for dataset, case in DATASETS.items()
    }
    turned = {dataset: [one.rotation for one in three] for dataset, three in runs.items()}
    for dataset, three in runs.items():
        swings = [figures(one).swing_rate for one in three]
        study = f"rotation_dataset_{dataset}", f"swing_dataset_{dataset}"
        sheet.row("rotation", turned[dataset], study=study[0], dataset=dataset)
        sheet.row("swing", swings, study=study[1], dataset=dataset)
    # once by more than chance could make of 150 degrees, and again
    least = FAR_TURN / FACTOR**2
    sheet.check(
        "far",
        turned[1],
        limit=FAR_TURN / FACTOR,
        faults=responsible(lambda faults: farthest(DATASET_1, faults).rotation > least),
    )
    sheet.check("near", turned[2], limit=FACTOR * MEASURED)
    sheet.check(
        "both",
        answers=[turns_far_and_near(*pair) for pair in zip(turned[1], turned[2], strict=True)],
        margin=max(sum(outcome(reading).met) for reading in READINGS),
        limit=len(MARKS),
    )
    loose = [exact_motion(case, pretension=0.0).rotation for case in DATASETS.values()]
    sheet.turn("loose", sound=turns_far_and_near(*loose), first=loose[0], second=loose[1])
    with_both = []
    for reading in READINGS:
        first, second = (reading_figures(reading, dataset).max_rotation for dataset in DATASETS)
        sheet.turn(
            "reading",
            sum(outcome(reading).met),
            weight=OPEN if reading.place else FAR,
            name=reading.name,
            first=first,
            second=second,
        )
        if turns_far_and_near(first, second):
            with_both.append(reading.name)
    sheet.picture("C7_rotation", _draw_datasets, runs, live=True)
    return sheet.claim(
        first=turned[1][0],
        second=turned[2][0],
        compared="less" if turned[2][0] < turned[1][0] else "no less",
        window=reading_figures(AS_PRINTED, 1).max_rotation,
        with_both="; ".join(with_both) or "no reading",
        readings=len(READINGS),
    )


def _draw_datasets(runs: dict[int, list[Motion]]) -> Figure:
    row = []
    for dataset, three in runs.items():
        study = STUDY[f"rotation_dataset_{dataset}"].number
        row.append(
            Panel(
                [
                    over_time(run, "phi_deg", color=colour, label=label, lw=1.0)
                    for run, colour, label in zip(three, COLOURS, LABELS, strict=True)
                ],
                "time, s",
                "φ, °",
                f"dataset #{dataset}: as printed up to {three[0].rotation:.0f}°",
                {"study's largest": study, "_": -study},
                end=three[0].time[-1],
            )
        )
    return figure_of([row], legend=4, height=2.7)

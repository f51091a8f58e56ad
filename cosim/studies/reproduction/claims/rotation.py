"""C5 and C7: what turns the block; the four treatments of the spring angles, the two datasets."""

from functools import cache
from typing import Any

import numpy as np
from stickslip.reference.scheme_options import MENDED, PRINTED, Faults
from stickslip.reference.study_rig import TREATMENTS

from cosim.report.palette import SERIES

from ..cases import DATASET_1, DATASETS, PRETENSION, Case, exact_motion, scheme, scheme_motion
from ..claim import STUDY, Claim, responsible, responsible_pairs
from ..drawing import LABELS, Panel, add_picture, models_over_time, over_time
from ..motion import Motion, figures
from ..readings import AS_PRINTED, MARKS, READINGS, onset, outcome
from ..readings import rotation as turned_by

CYCLES, SEED = 40, 0
ROTATES = 30.0  # deg: half of "three times" the measured 20
SIDES = CYCLES // 10  # y comes back: more changes of its sign than one in every ten cycles
EXACT_DURATION, SHOWN = 40.0, 20.0  # s


def treated(faults: Faults, **changes: Any) -> dict[str, Motion]:
    """Dataset #1 under each treatment of the spring angles."""
    schemes = [scheme(DATASET_1, faults, treatment=name, **changes) for name in TREATMENTS]
    runs = [Motion.of_scheme(one.run(cycles=CYCLES, seed=SEED)) for one in schemes]
    return dict(zip(TREATMENTS, runs, strict=True))


def _sides(run: Motion) -> int:
    """How often y changes sign."""
    return int(np.sum(np.diff(np.sign(run.y[run.y != 0.0])) != 0))


def _away(runs: dict[str, Motion]) -> int:
    """The most changes of side with constant angles: few where y moves away for good."""
    return max(_sides(runs["constant"]), _sides(runs["opposed"]))


def _comes_back(runs: dict[str, Motion]) -> bool:
    """With constant angles y moves away for good; with updated ones it comes back."""
    return _sides(runs["updated"]) > SIDES >= _away(runs)


@cache
def parts(faults: Faults) -> tuple[bool, bool]:
    """Whether only the updated angles rotate, and whether with them alone y comes back."""
    runs = treated(faults)
    others = max(run.rotation for name, run in runs.items() if name != "updated")
    return runs["updated"].rotation > ROTATES and others < 0.1 * ROTATES, _comes_back(runs)


def _apart(runs: dict[str, Motion]) -> float:
    """Largest difference of break-away places between treatments before rotation sets in, m."""
    until = np.nan_to_num(onset(runs["updated"]), nan=np.inf)
    peaks = []
    for run in runs.values():
        ends = run.phases[(run.phases[:, 2] == 0) & (run.phases[:, 1] < until), 1]
        peaks.append(np.interp(ends, run.time, run.x))
    count = min(map(len, peaks))
    return float(np.ptp([one[:count] for one in peaks], axis=0).max()) if count else 0.0


def judge_treatments(claim: Claim) -> dict[str, float]:
    """All four treatments, as printed and mended, beside the exact geometry."""
    printed, mended = schemes = treated(PRINTED), treated(MENDED)
    exact, loose = (
        exact_motion(DATASET_1, EXACT_DURATION, pretension=p) for p in (PRETENSION, 0.0)
    )
    for name in TREATMENTS:
        models, row = [printed[name], mended[name]], "rotation"
        if name == "updated":
            models, row = [*models, exact], "rotation_updated"
        claim.row(row, [one.rotation for one in models], name=name)
        claim.row("sideways", [np.abs(one.y).max() for one in models], name=name)
    claim.row("sets_in", [onset(runs["updated"]) for runs in schemes])
    apart = np.array([_apart(runs) for runs in schemes])
    claim.row("apart", apart)
    claim.check("agree", 1e3 * apart)
    free, back = max(exact.rotation, loose.rotation), treated(MENDED.only("F1", "F13"))["updated"]
    rotates, comes_back = zip(parts(PRINTED), parts(MENDED), strict=True)
    faults = responsible(lambda faults: parts(faults)[0])
    claim.check("rotates", [*rotates, free > ROTATES], margin=free, limit=ROTATES, faults=faults)
    for name, (pretension, start) in claim.changes("start").items():
        begin = {"phi": np.radians(start)}
        run = exact_motion(DATASET_1, EXACT_DURATION, pretension=pretension, initial=begin)
        claim.turn(name, run.rotation)
    claim.turn("put_back", back.rotation)
    alone = responsible(lambda faults: parts(faults)[1])
    pairs = () if alone else responsible_pairs(lambda faults: parts(faults)[1])
    away = _away(mended)
    claim.check("comes_back", comes_back, margin=away, limit=SIDES, faults=alone, together=pairs)
    scattered = treated(MENDED, scatter=0.2)
    claim.turn("scatter", _sides(scattered["updated"]), sound=_comes_back(scattered))
    add_picture(claim, "C5_spring_angles", _drawn(*schemes))
    return {"back": back.rotation, "loose": loose.rotation, "y": 100 * np.abs(loose.y).max()}


def _drawn(*schemes: dict[str, Motion]) -> list[list[Panel]]:
    """A row a quantity, a column a scheme; a line a treatment."""
    # thinner one by one: those that coincide are all seen
    looks = list(zip(SERIES, np.linspace(3.0, 0.8, len(TREATMENTS)), strict=False))

    def panel(runs: dict[str, Motion], title: str, quantity: str, scale: float) -> Panel:
        lines = [
            over_time(run, quantity, scale, 0.0, SHOWN, color=colour, lw=width, label=name)
            for (name, run), (colour, width) in zip(runs.items(), looks, strict=True)
        ]
        return Panel(lines, title if quantity == "x" else "", end=SHOWN)

    titled = list(zip(schemes, LABELS, strict=False))
    return [
        [panel(*one, quantity, scale) for one in titled]
        for quantity, scale in (("x", 100.0), ("phi_deg", 1.0), ("y", 100.0))
    ]


RUNS = range(8)
FAR_TURN, MEASURED = STUDY["rotation_dataset_1"].value, STUDY["rotation_measured"].value
# the motion is chaotic: the largest angle of one run and of another differ by as much
FACTOR = 1.5


def farthest(case: Case, faults: Faults) -> Motion:
    """The run of several seeds that turns farthest."""
    return max((scheme_motion(case, faults, seed) for seed in RUNS), key=lambda run: run.rotation)


def turns_far_and_near(first: Any, second: Any) -> Any:
    """Whether #1 turns by the study's 150 degrees, and #2 stays within the measured 20."""
    return (first > FAR_TURN / FACTOR) & (second < FACTOR * MEASURED)


def judge_datasets(claim: Claim) -> dict[str, Any]:
    """Largest rotation and angular speed over several seeds."""
    runs = {
        dataset: [farthest(case, PRINTED), farthest(case, MENDED), exact_motion(case)]
        for dataset, case in DATASETS.items()
    }
    for dataset, three in runs.items():
        for name, figure in (("rotation", "max_rotation"), ("swing", "swing_rate")):
            ours = [figures(one)[figure] for one in three]
            claim.row(name, ours, study=f"{name}_dataset_{dataset}", dataset=dataset)
    first, second = turned = np.array([[one.rotation for one in three] for three in runs.values()])
    # once by more than chance could make of 150 degrees, and again
    least = FAR_TURN / FACTOR**2
    faults = responsible(lambda faults: farthest(DATASET_1, faults).rotation > least)
    claim.check("far", first, limit=FAR_TURN / FACTOR, faults=faults)
    claim.check("near", second, limit=FACTOR * MEASURED)
    met = {reading: sum(outcome(reading)["met"]) for reading in READINGS}
    claim.check("both", turns_far_and_near(*turned), margin=max(met.values()), limit=len(MARKS))
    loose = [exact_motion(case, pretension=0.0).rotation for case in DATASETS.values()]
    claim.turn("loose", sound=turns_far_and_near(*loose), turned=loose)
    with_both = []
    for one in READINGS:
        pair = [turned_by(one, dataset) for dataset in DATASETS]
        claim.turn("reading", met[one], weight=one.weight, name=one.name, turned=pair)
        with_both += [one.name] if turns_far_and_near(*pair) else []
    add_picture(claim, "C7_rotation", [[_turned(*of_dataset) for of_dataset in runs.items()]])
    return {
        "first": first[0],
        "second": second[0],
        "compared": "less" if second[0] < first[0] else "no less",
        "window": turned_by(AS_PRINTED, 1),
        "with_both": "; ".join(with_both) or "no reading",
        "readings": len(READINGS),
    }


def _turned(dataset: int, runs: list[Motion]) -> Panel:
    study = STUDY[f"rotation_dataset_{dataset}"].value
    title = f"dataset #{dataset}: as printed up to {runs[0].rotation:.0f}°"
    levels = {"study's largest": study, "_": -study}
    return Panel(models_over_time(runs, "phi_deg"), title, levels, end=runs[0].time[-1])

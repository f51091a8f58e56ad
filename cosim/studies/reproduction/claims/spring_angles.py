"""C5: the four spring-angle treatments agree in x until `updated` begins to rotate."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure
from stickslip.reference.scheme_errors import MENDED, PRINTED, Faults
from stickslip.reference.spring_angles import TREATMENTS

from cosim.report.live import live_of
from cosim.report.style import SERIES, panels, picture
from cosim.studies.reproduction.cases import STUDY

from ..cases import (
    DATASET_1,
    EXACT_START,
    RIG_ASSUMED,
    SCATTER_ASSUMED,
    exact_motion,
    exact_parameters,
    scheme,
)
from ..claim import OPEN, Check, Claim, Margin, Row, Turn, responsible, responsible_pairs
from ..motion import Motion

CYCLES = 40
SEED = 0
# rotation has set in at a degree; below it cos alpha differs from 1 by less than 2e-4
SET_IN = np.radians(1.0)
ROTATES = 30.0  # deg: half of "three times" the measured 20
# break-away and re-stick fall on a 10 ms grid: x differs by what the surface moves in one cell
AGREE = 0.15 * 0.01 * 2.0
EXACT_DURATION = 40.0
LARGER_START = np.radians(5.0)
SHOWN = 20.0


def _runs(faults: Faults) -> dict[str, Motion]:
    return {
        name: Motion.of_scheme(
            scheme(DATASET_1, faults, treatment=name).run(cycles=CYCLES, seed=SEED)
        )
        for name in TREATMENTS
    }


def _rotation(motion: Motion) -> float:
    return float(np.degrees(np.abs(motion.phi).max()))


def _disagreement(runs: dict[str, Motion]) -> float:
    """Largest difference of break-away places between treatments before rotation sets in, m."""
    turned = np.flatnonzero(np.abs(runs["updated"].phi) > SET_IN)
    updated = runs["updated"]
    until = updated.time[turned[0]] if len(turned) else updated.time[-1]
    peaks = []
    for run in runs.values():
        ends = run.phases[(run.phases[:, 2] == 0) & (run.phases[:, 1] < until), 1]
        peaks.append(np.interp(ends, run.time, run.x))
    count = min(len(one) for one in peaks)
    return float(np.ptp([one[:count] for one in peaks], axis=0).max()) if count else 0.0


def _only_updated_rotates(runs: dict[str, Motion]) -> bool:
    turns = {name: _rotation(run) for name, run in runs.items()}
    others = max(value for name, value in turns.items() if name != "updated")
    return turns["updated"] > ROTATES and others < 0.1 * ROTATES


def _sides(run: Motion) -> int:
    """How often y changes sign."""
    y = run.y[run.y != 0.0]
    return int(np.sum(np.diff(np.sign(y)) != 0))


def _comes_back(run: Motion) -> bool:
    """y changes sign again and again, more than once in every ten cycles."""
    return _sides(run) > CYCLES // 10


def _only_updated_bounded(runs: dict[str, Motion]) -> bool:
    """With constant angles y moves away for good; with updated ones it comes back."""
    return _comes_back(runs["updated"]) and not (
        _comes_back(runs["constant"]) or _comes_back(runs["opposed"])
    )


def _bounded(faults: Faults) -> bool:
    return _only_updated_bounded(_runs(faults))


def judge() -> Claim:
    """All four treatments, as printed and mended, beside the exact geometry."""
    printed, mended = _runs(PRINTED), _runs(MENDED)
    exact = exact_motion(exact_parameters(DATASET_1), EXACT_DURATION)
    loose = exact_motion(exact_parameters(DATASET_1, pretension=0.0), EXACT_DURATION)
    back = _put_back()
    return Claim(
        "C5",
        "the treatments agree in x until `updated` begins to rotate",
        _rows(printed, mended, exact),
        _checks(printed, mended, max(_rotation(exact), _rotation(loose)), back),
        remarks=(
            "F2 makes the printed scheme rotate, and is not needed for it: "
            f"{back.change} gives a {back.figure}.",
            f"Exact model without pretension: {_rotation(loose):.1f}° and |y| up to "
            f"{100 * np.abs(loose.y).max():.1f} cm within {EXACT_DURATION:.0f} s, from a start "
            "turned by 1°.",
        ),
        assumed=(
            SCATTER_ASSUMED.replace(
                "mean of three seeds, last 60 % of 25 cycles", f"seed {SEED}, {CYCLES} cycles"
            ),
            RIG_ASSUMED,
        ),
        pictures=(_draw(printed, mended),),
        leading=2 * TREATMENTS.index("updated"),
        place="§4.3.1 to 4.3.3, fig. 4.6 and 4.7",
        rests="dataset #1 as printed; the readings table, for dataset #2 cannot be had from it",
    )


def _rows(printed: dict[str, Motion], mended: dict[str, Motion], exact: Motion) -> tuple[Row, ...]:
    """Rotation and y of each treatment, when rotation sets in, and how far x is apart."""
    rows = []
    for name in TREATMENTS:
        updated = name == "updated"
        rows.append(
            Row(
                f"largest rotation, {name}" + (EXACT_START if updated else ""),
                "deg",
                None,
                _rotation(printed[name]),
                _rotation(mended[name]),
                _rotation(exact) if updated else None,
                derived=60.0 if updated else None,
                how="three times 20°, §4.3.1" if updated else "",
            )
        )
        rows.append(
            Row(
                f"largest |y|, {name}",
                "m",
                None,
                float(np.abs(printed[name].y).max()),
                float(np.abs(mended[name].y).max()),
                float(np.abs(exact.y).max()) if updated else None,
            )
        )
    rows.append(
        Row(
            "rotation sets in (1°), updated",
            "s",
            STUDY["rotation_sets_in"],
            _sets_in(printed["updated"]),
            _sets_in(mended["updated"]),
        )
    )
    apart = _disagreement(printed), _disagreement(mended)
    rows.append(Row("treatments apart in x at break-away, before rotation", "m", None, *apart))
    return tuple(rows)


def _checks(
    printed: dict[str, Motion], mended: dict[str, Motion], free: float, back: Turn
) -> tuple[Check, ...]:
    """Agreement in x, rotation, and what y does; free: rotation of the exact model, deg."""
    apart = _disagreement(printed), _disagreement(mended)
    rotates = _only_updated_rotates(printed), _only_updated_rotates(mended)
    bounded = _only_updated_bounded(printed), _only_updated_bounded(mended)
    alone = responsible(_bounded)
    return (
        Check(
            "all treatments agree in x until rotation sets in",
            apart[0] < AGREE,
            apart[1] < AGREE,
            None,
            margin=Margin("apart in x, mended", 1e3 * apart[1], 1e3 * AGREE, "mm"),
        ),
        Check(
            f"only the updated angles rotate, by more than {ROTATES:.0f}°",
            *rotates,
            free > ROTATES,
            faults=responsible(lambda faults: _only_updated_rotates(_runs(faults))),
            margin=Margin(
                "largest rotation, exact, with or without pretension", free, ROTATES, "°"
            ),
            turns=(*_freer(), back),
        ),
        Check(
            "y moves away for good with constant angles, comes back with updated ones",
            *bounded,
            None,
            faults=alone,
            together=() if alone else responsible_pairs(_bounded),
            margin=Margin(
                "changes of side in y with constant angles, mended, at most",
                max(_sides(mended[name]) for name in ("constant", "opposed")),
                CYCLES // 10,
            ),
            turns=(_bounded_by_scatter(),),
        ),
    )


def _sets_in(motion: Motion) -> float | None:
    turned = np.flatnonzero(np.abs(motion.phi) > SET_IN)
    return float(motion.time[turned[0]]) if len(turned) else None


def _freer() -> list[Turn]:
    """The exact rig in what the study leaves open: no pretension, and a start that is more awry."""
    turns = []
    for pretension, start in ((0.0, SET_IN), (0.0, LARGER_START), (0.004, LARGER_START)):
        run = exact_motion(
            exact_parameters(DATASET_1, pretension=pretension, initial={"phi": start}),
            EXACT_DURATION,
        )
        turns.append(
            Turn(
                f"exact: {1e3 * pretension:.0f} mm of pretension, start turned by "
                f"{np.degrees(start):.0f}°",
                f"largest rotation {_rotation(run):.1f}°",
                _rotation(run) > ROTATES,
                OPEN,
            )
        )
    return turns


def _put_back() -> Turn:
    """The mended scheme with the faults of the springs put back, F2 apart."""
    turned = _rotation(_runs(MENDED.only("F1", "F13"))["updated"])
    return Turn("mended: F1 and F13 put back", f"largest rotation {turned:.0f}°", turned > ROTATES)


def _bounded_by_scatter() -> Turn:
    """The mended scheme under ten times the scatter: does what keeps y at bay show then?"""
    runs = {
        name: Motion.of_scheme(
            scheme(DATASET_1, MENDED, treatment=name, scatter=0.2).run(cycles=CYCLES, seed=SEED)
        )
        for name in TREATMENTS
    }
    return Turn(
        "mended: scatter of 0.2 instead of 0.02",
        f"{_sides(runs['updated'])} changes of side in y with updated angles",
        _only_updated_bounded(runs),
        OPEN,
    )


@picture(
    "C5_spring_angles",
    "x, φ and y of the four spring-angle treatments (m 0.67 kg, k 20.17 "
    "N/m, v 0.15 m/s); left as printed, right mended. Study: figures 4.6 and 4.7.",
    live=live_of,
)
def _draw(printed: dict[str, Motion], mended: dict[str, Motion]) -> Figure:
    figure, axes = panels(3, 2, height=2.0, sharex="col", sharey="row")
    for column, (title, runs) in enumerate((("as printed", printed), ("mended", mended))):
        # thinner one by one, so that those that coincide are all seen
        widths = np.linspace(3.0, 0.8, len(runs))
        for colour, width, (name, run) in zip(SERIES, widths, runs.items(), strict=False):
            n = int(run.time.searchsorted(SHOWN))
            axes[0, column].plot(run.time[:n], 100 * run.x[:n], color=colour, label=name, lw=width)
            axes[1, column].plot(run.time[:n], np.degrees(run.phi[:n]), color=colour, lw=width)
            axes[2, column].plot(run.time[:n], 100 * run.y[:n], color=colour, lw=width)
        axes[0, column].set_title(f"scheme {title}")
        axes[0, column].set_xlim(0.0, SHOWN)
        axes[2, column].set_xlabel("time, s")
    for row, label in enumerate(("x, cm", "φ, °", "y, cm")):
        axes[row, 0].set_ylabel(label)
    figure.legend(*axes[0, 0].get_legend_handles_labels(), ncols=4, loc="outside upper center")
    return figure

"""C14: three runs in which the block jumps from slip to stick."""

from __future__ import annotations

from functools import cache

import numpy as np
from matplotlib.figure import Figure
from stickslip.reference.scheme_errors import MENDED, PRINTED, Faults

from cosim.report.live import live_of
from cosim.report.style import INK, panels, picture
from cosim.studies.reproduction.cases import ASSUMED, CASE, STUDY, cases

from ..cases import CYCLES, Case, exact_motion, exact_parameters, longest, many, scheme
from ..claim import OPEN, Check, Claim, Margin, Row, Turn, responsible
from ..drawing import COLOURS

NAMED = tuple(CASE.changed(stiffness=68.22, mass=2.03, speed=v) for v in (0.50, 0.63, 0.82))
# a block of 10 ms changes x' by at most 10 ms of the largest acceleration, omega v; a jump is more
JUMP = 2.0
# runs in which each fault is mended in turn
WITNESSES = 12
OTHER_WEAKENINGS = (0.36, 0.37, 0.38, 0.39, 0.41, 0.42, 0.43, 0.44)
RARE = len(NAMED)  # the study: three times in the entire dataset


def _threshold(case: Case) -> float:
    """Jump of x' that one block of the scheme cannot bring, m/s."""
    omega = np.sqrt(4.0 * case.stiffness / case.mass)
    return JUMP * 0.01 * omega * case.speed


@cache
def _jumps(case: Case, faults: Faults) -> int:
    """Slips that end in stick with a jump of the velocity."""
    slips = scheme(case, faults).run(cycles=CYCLES, duration=longest(case)).slip_phases
    return int(np.sum(np.abs(slips[:, 4]) > _threshold(case)))


def judge() -> Claim:
    """Jumps in the three named runs and in all runs of the study's plan."""
    plan = cases()
    jumping = [c for c, n in zip(plan, many(_jumps, plan, PRINTED), strict=True) if n]
    mended = sum(n > 0 for n in many(_jumps, plan, MENDED))
    witnesses = jumping[:WITNESSES]
    faults = responsible(
        lambda faults: sum(many(_jumps, witnesses, faults)) > 0 if witnesses else False
    )
    exact = _exact_jump()
    before = sum(_jumps(case, PRINTED) for case in witnesses)
    left = {f: sum(many(_jumps, witnesses, PRINTED.without(f))) for f in ("F6", "F14")}
    return Claim(
        "C14",
        "jumps to stick in mid-slip (k 68.22, m 2.03, v ≥ 0.50) are an anomaly of the model",
        _rows(len(plan), len(jumping), mended, exact),
        _checks(plan, len(jumping), mended, exact),
        remarks=(
            f"Faults whose mending alone ends the jumps of {len(witnesses)} runs that have them: "
            f"{', '.join(faults) or 'none'}. Jumps in these runs: {before} as printed, "
            f"{left['F6']} with events located (F6 mended), {left['F14']} with slips never cut "
            "(F14 mended).",
            "Which part stands: that the jumps are the scheme's own. Which runs jump does not "
            "follow from what is printed.",
            "Which runs jump is a matter of chance: the rotation that keeps x' below the "
            "surface's speed for a second grows from rounding.",
        ),
        assumed=ASSUMED,
        pictures=(_draw(jumping[-1] if jumping else NAMED[0]),),
        leading=len(NAMED),
        first="The listing as printed does not make the study's own figures (see the table of "
        "readings): what is counted here are the jumps of the listing, with the slope of µ_k "
        "assumed, not those of the study's runs.",
        place="§5.1, fig. 5.2d and 5.5",
        rests=f"chance in which run it is; on 0 jumps in {len(plan)} runs of the mended scheme",
    )


def _rows(plan: int, jumping: int, mended: int, exact: int) -> tuple[Row, ...]:
    """Jumps in the named runs, by model, and how many runs of the plan have some."""
    rows = [
        Row(
            f"jumps to stick in 25 cycles, v {case.speed:.2f} m/s",
            "1",
            None,
            float(_jumps(case, PRINTED)),
            float(_jumps(case, MENDED)),
            float(exact),
            derived="1 or more",
            how="a run is named for its jump, §5.1",
        )
        for case in NAMED
    ]
    rows.append(
        Row(
            f"runs with a jump, of {plan}",
            "1",
            STUDY["runs_with_a_jump"],
            float(jumping),
            float(mended),
        )
    )
    return tuple(rows)


def _checks(plan: list[Case], jumping: int, mended: int, exact: int) -> tuple[Check, ...]:
    """Whose the jumps are, which runs have them, and how many."""
    return (
        Check(
            "the jumps are an anomaly of the model: the scheme has some, a sound model none",
            jumping > 0,
            mended == 0 and jumping > 0,
            exact == 0 and jumping > 0,
            margin=Margin("jumps, exact, in the named runs", exact, 0.0),
        ),
        *(
            Check(
                f"the run at {case.speed:.2f} m/s is one that jumps",
                _jumps(case, PRINTED) > 0,
                None,
                None,
                margin=Margin(f"jumps at {case.speed:.2f} m/s", _jumps(case, PRINTED), 1.0),
                turns=(*_other_laws(case), _located(case)),
            )
            for case in NAMED
        ),
        Check(
            f"no more than {RARE} of the {len(plan)} runs jump",
            jumping <= RARE,
            None,
            None,
            margin=Margin("runs with a jump", jumping, RARE),
            turns=(_no_rotation(plan), *_plan_under_other_laws(plan)),
        ),
    )


def _other_laws(case: Case) -> list[Turn]:
    """A named run under laws of friction that the study's drawing cannot be told from."""
    counts = many(_jumps, [case.changed(weakening=part) for part in OTHER_WEAKENINGS], PRINTED)
    return [
        Turn(f"v {case.speed:.2f} m/s: {_slope(part)}", f"{count} jumps", count > 0, OPEN)
        for part, count in zip(OTHER_WEAKENINGS, counts, strict=True)
    ]


def _slope(weakening: float) -> str:
    return f"µ_k falling by {100 * weakening:.0f} % instead of {100 * CASE.weakening:.0f} %"


def _plan_under_other_laws(plan: list[Case]) -> list[Turn]:
    """The whole plan under the outermost of them."""
    turns = []
    for part in (OTHER_WEAKENINGS[0], OTHER_WEAKENINGS[-1]):
        runs = sum(n > 0 for n in many(_jumps, [c.changed(weakening=part) for c in plan], PRINTED))
        turns.append(Turn(_slope(part), f"{runs} runs with a jump", runs <= RARE, OPEN))
    return turns


def _exact_jump() -> int:
    """Re-sticks of the exact model in which x' jumps between samples 5 ms apart."""
    jumps = 0
    for case in NAMED:
        motion = exact_motion(exact_parameters(case))
        speed = np.diff(motion.x) / np.diff(motion.time)
        jumps += int(np.sum(np.abs(np.diff(speed)) > _threshold(case)))
    return jumps


def _located(case: Case) -> Turn:
    count = _jumps(case, PRINTED.without("F6"))
    return Turn(
        f"v {case.speed:.2f} m/s: re-sticks of the printed scheme located (F6 mended)",
        f"{count} jumps",
        count > 0,
    )


def _no_rotation(plan: list[Case]) -> Turn:
    """The whole plan with the r that one of the study's equations has, and its listing has not."""
    counts = many(_jumps, plan, PRINTED.without("F2"))
    runs = [case for case, n in zip(plan, counts, strict=True) if n]
    named = sum(case in NAMED for case in runs)
    return Turn(
        "r in the rise, as in eq. 4.6 (F2 mended)",
        f"{len(runs)} runs with a jump, {named} of them named",
        len(runs) <= RARE,
        OPEN,
    )


@picture(
    "C14_jump",
    "x' in a run with jumps, as printed and mended; black marks: slips that "
    "end in a jump to the surface's speed; dotted: the run is over with its 25th slip. "
    "Study: figure 5.5.",
    live=live_of,
)
def _draw(case: Case) -> Figure:
    figure, axes = panels(2, 1, height=1.9, sharex=True, sharey=True)
    for ax, name, faults in ((axes[0, 0], "printed", PRINTED), (axes[1, 0], "mended", MENDED)):
        run = scheme(case, faults).run(cycles=CYCLES, duration=longest(case))
        ax.plot(run.time, run.velocity[:, 0], color=COLOURS[name], lw=0.8)
        if run.slips >= CYCLES:
            ax.axvline(run.time[-1], color=INK, ls=":", lw=1.0)
            ax.annotate(
                f"run over:\n{CYCLES} slips",
                (run.time[-1], -0.9 * case.speed),
                xytext=(4, 0),
                textcoords="offset points",
                fontsize=8.0,
            )
        ends = run.slip_phases[np.abs(run.slip_phases[:, 4]) > _threshold(case), 1]
        ax.plot(ends, np.full(len(ends), case.speed), "x", color=INK, ms=7, label="jump to stick")
        ax.set_title(
            f"scheme {'as printed' if name == 'printed' else name}, k {case.stiffness:.2f} N/m, "
            f"m {case.mass:.2f} kg, v {case.speed:.2f} m/s"
        )
        ax.set_ylabel("x', m/s")
        ax.set_xlim(0.0, 16.0)
    axes[-1, 0].set_xlabel("time, s")
    return figure

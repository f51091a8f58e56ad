"""C12 and C14: what a run of the scheme costs, and runs that jump from slip to stick."""

from __future__ import annotations

import timeit
from collections.abc import Callable
from functools import cache, partial
from statistics import median
from typing import Any

import numpy as np
from stickslip.reference.interpreted_scheme import interpreted_run
from stickslip.reference.linearised import Scheme, SchemeRun
from stickslip.reference.scheme_errors import MENDED, PRINTED, Faults

from cosim.report.style import INK

from ..cases import CASE, CYCLES, DATASET_1, Case, exact_motion, longest, plan, scheme
from ..claim import Claim, judges, responsible
from ..drawing import LINES, Curve, Panel, add_picture

# one stick and one slip, then the next ones begin: what a script needs grows with the slips
DURATION = 0.7
WHOLE = 20.0
COMPARED_CYCLES = 40  # the runs that the study compares


KINDS = ("updated", "zero")


def _seconds(call: Callable[[], object]) -> float:
    return median(timeit.repeat(call, number=1, repeat=3))


@judges("C12")
def judge_run_times(claim: Claim) -> dict[str, Any]:
    """What updating the spring angles costs: as a script, and compiled."""
    plain = [Scheme(scatter=0.0, treatment=kind) for kind in KINDS]
    updated, zero = (_seconds(partial(interpreted_run, DURATION, one)) for one in plain)
    schemes = [scheme(DATASET_1, PRINTED, treatment=kind) for kind in KINDS]
    compiled = [_seconds(partial(one.run, duration=WHOLE)) for one in schemes]
    ratios = [updated / zero, compiled[0] / compiled[1]]
    claim.row("updated", [COMPARED_CYCLES * updated / 60.0])
    claim.row("zero", [COMPARED_CYCLES * zero])
    claim.row("script", ratios[:1])
    claim.row("compiled", [None, ratios[1]])
    claim.check("ratio")
    return {"ratios": ratios}


NAMED = CASE.changed(stiffness=68.22, mass=2.03).over("speed", (0.50, 0.63, 0.82))
# a block of 10 ms changes x' by at most 10 ms of the largest acceleration, omega v; a jump is more
JUMP = 2.0 * 0.01
# runs in which each fault is mended in turn
WITNESSES = 12
OTHER_WEAKENINGS = (0.36, 0.37, 0.38, 0.39, 0.41, 0.42, 0.43, 0.44)


def _threshold(case: Case) -> float:
    """Jump of x' that one block of the scheme cannot bring, m/s."""
    return JUMP * case.speed * float(np.sqrt(4.0 * case.stiffness / case.mass))


def _run(case: Case, faults: Faults) -> tuple[SchemeRun, np.ndarray]:
    """A run, and when its slips end in stick with a jump of the velocity, s."""
    run = scheme(case, faults).run(cycles=CYCLES, duration=longest(case))
    slips = run.slip_phases
    return run, slips[np.abs(slips[:, 4]) > _threshold(case), 1]


@cache
def jumps(case: Case, faults: Faults) -> int:
    """Slips of a run that end in stick with a jump of the velocity."""
    return len(_run(case, faults)[1])


def _jumping(cases: list[Case], faults: Faults) -> list[Case]:
    """The runs with a jump."""
    return [case for case in cases if jumps(case, faults)]


def _exact_jumps(case: Case) -> int:
    """Re-sticks of the exact model in which x' jumps between samples 5 ms apart."""
    motion = exact_motion(case)
    steps = np.diff(np.diff(motion.x) / np.diff(motion.time))
    return int(np.sum(np.abs(steps) > _threshold(case)))


@judges("C14")
def judge_jumps(claim: Claim) -> dict[str, Any]:
    """Jumps in the three named runs and in all runs of the study's plan."""
    cases = plan()
    jumping, mended = _jumping(cases, PRINTED), len(_jumping(cases, MENDED))
    exact = sum(map(_exact_jumps, NAMED))
    for case in NAMED:
        claim.row("jumps", [jumps(case, PRINTED), jumps(case, MENDED), exact], v=case.speed)
    claim.row("runs", [len(jumping), mended], plan=len(cases))
    some = len(jumping) > 0
    claim.check("anomaly", [some, some and not mended, some and not exact], margin=exact)
    for case in NAMED:
        claim.check("named", [jumps(case, PRINTED)], v=case.speed)
        # laws of friction that the study's drawing cannot be told from
        for other in case.over("weakening", OTHER_WEAKENINGS):
            claim.turn("slope", jumps(other, PRINTED), part=100.0 * other.weakening)
        claim.turn("located", jumps(case, PRINTED.without("F6")))
    claim.check("rare", [len(jumping)], plan=len(cases))
    with_r = _jumping(cases, PRINTED.without("F2"))
    claim.turn("with_r", len(with_r), named=sum(case in NAMED for case in with_r))
    for part in (OTHER_WEAKENINGS[0], OTHER_WEAKENINGS[-1]):
        changed = [case.changed(weakening=part) for case in cases]
        claim.turn("plan_slope", len(_jumping(changed, PRINTED)), part=100.0 * part)
    witnesses = jumping[:WITNESSES]
    faults = responsible(lambda faults: any(jumps(case, faults) for case in witnesses))
    printed, located, uncut = (
        sum(jumps(case, one) for case in witnesses)
        for one in (PRINTED, PRINTED.without("F6"), PRINTED.without("F14"))
    )
    shown = (jumping or NAMED)[-1]
    models = zip((PRINTED, MENDED), LINES, strict=False)
    add_picture(claim, "C14_jump", [[_panel(shown, faults, line)] for faults, line in models])
    said = {"n": len(witnesses), "faults": ", ".join(faults) or "none", "plan": len(cases)}
    return said | {"printed": printed, "located": located, "uncut": uncut}


def _panel(case: Case, faults: Faults, line: dict[str, Any]) -> Panel:
    """x' of a run, and where it jumps."""
    run, ends = _run(case, faults)
    marks = {"marker": "x", "ls": "", "color": INK, "ms": 7, "label": "jump to stick"}
    curves = [
        Curve(run.time, run.velocity[:, 0], {"lw": 0.8} | line),
        Curve(ends, np.full(len(ends), case.speed), marks),
    ]
    numbers = f"k {case.stiffness:.2f} N/m, m {case.mass:.2f} kg, v {case.speed:.2f} m/s"
    return Panel(curves, f"{line['label']}, {numbers}", end=16.0)

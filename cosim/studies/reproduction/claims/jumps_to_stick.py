"""C14: three runs in which the block jumps from slip to stick."""

from __future__ import annotations

from functools import cache

import numpy as np
from stickslip.reference.linearised import SchemeRun
from stickslip.reference.scheme_errors import MENDED, PRINTED, Faults

from cosim.report.style import INK

from ..cases import CASE, CYCLES, Case, exact_motion, longest, plan, scheme
from ..claim import Claim, responsible
from ..drawing import COLOURS, LABELS, Curve, Panel
from ..sheet import Sheet

NAMED = CASE.changed(stiffness=68.22, mass=2.03).over("speed", (0.50, 0.63, 0.82))
# a block of 10 ms changes x' by at most 10 ms of the largest acceleration, omega v; a jump is more
JUMP = 2.0 * 0.01
# runs in which each fault is mended in turn
WITNESSES = 12
OTHER_WEAKENINGS = (0.36, 0.37, 0.38, 0.39, 0.41, 0.42, 0.43, 0.44)


def _threshold(case: Case) -> float:
    """Jump of x' that one block of the scheme cannot bring, m/s."""
    return JUMP * case.speed * float(np.sqrt(4.0 * case.stiffness / case.mass))


def _run(case: Case, faults: Faults) -> SchemeRun:
    return scheme(case, faults).run(cycles=CYCLES, duration=longest(case))


def _ends(case: Case, run: SchemeRun) -> np.ndarray:
    """When slips end in stick with a jump of the velocity, s."""
    slips = run.slip_phases
    return np.asarray(slips[np.abs(slips[:, 4]) > _threshold(case), 1])


@cache
def jumps(case: Case, faults: Faults) -> int:
    """Slips of a run that end in stick with a jump of the velocity."""
    return len(_ends(case, _run(case, faults)))


def _jumping(cases: list[Case], faults: Faults) -> list[Case]:
    """The runs with a jump."""
    return [case for case in cases if jumps(case, faults)]


def _exact_jumps(case: Case) -> int:
    """Re-sticks of the exact model in which x' jumps between samples 5 ms apart."""
    motion = exact_motion(case)
    steps = np.diff(np.diff(motion.x) / np.diff(motion.time))
    return int(np.sum(np.abs(steps) > _threshold(case)))


def judge() -> Claim:
    """Jumps in the three named runs and in all runs of the study's plan."""
    sheet, cases = Sheet("C14"), plan()
    jumping, mended = _jumping(cases, PRINTED), len(_jumping(cases, MENDED))
    exact = sum(map(_exact_jumps, NAMED))
    for case in NAMED:
        sheet.row("jumps", [jumps(case, PRINTED), jumps(case, MENDED), exact], v=case.speed)
    sheet.row("runs", [len(jumping), mended, None], plan=len(cases))
    some = len(jumping) > 0
    sheet.check("anomaly", answers=[some, some and not mended, some and not exact], margin=exact)
    for case in NAMED:
        _check_named(sheet, case)
    sheet.check("rare", [len(jumping)], plan=len(cases))
    with_r = _jumping(cases, PRINTED.without("F2"))
    sheet.turn("with_r", len(with_r), named=sum(case in NAMED for case in with_r))
    for part in (OTHER_WEAKENINGS[0], OTHER_WEAKENINGS[-1]):
        changed = [case.changed(weakening=part) for case in cases]
        sheet.turn("plan_slope", len(_jumping(changed, PRINTED)), part=100.0 * part)
    witnesses = jumping[:WITNESSES]
    faults = responsible(lambda faults: any(jumps(case, faults) for case in witnesses))
    printed, located, uncut = (
        sum(jumps(case, one) for case in witnesses)
        for one in (PRINTED, PRINTED.without("F6"), PRINTED.without("F14"))
    )
    models = zip((PRINTED, MENDED), LABELS, COLOURS, strict=False)
    sheet.picture("C14_jump", [[_panel((jumping or NAMED)[-1], *model)] for model in models])
    return sheet.claim(
        n=len(witnesses),
        faults=", ".join(faults) or "none",
        plan=len(cases),
        printed=printed,
        located=located,
        uncut=uncut,
    )


def _check_named(sheet: Sheet, case: Case) -> None:
    """A named run, and under laws of friction that the study's drawing cannot be told from."""
    sheet.check("named", [jumps(case, PRINTED)], v=case.speed)
    for other in case.over("weakening", OTHER_WEAKENINGS):
        sheet.turn("slope", jumps(other, PRINTED), part=100.0 * other.weakening)
    sheet.turn("located", jumps(case, PRINTED.without("F6")))


def _panel(case: Case, faults: Faults, label: str, colour: str) -> Panel:
    """x' of a run, and where it jumps."""
    run = _run(case, faults)
    ends = _ends(case, run)
    marks = {"marker": "x", "ls": "", "color": INK, "ms": 7, "label": "jump to stick"}
    curves = [
        Curve(run.time, run.velocity[:, 0], {"color": colour, "lw": 0.8, "label": label}),
        Curve(ends, np.full(len(ends), case.speed), marks),
    ]
    numbers = f"k {case.stiffness:.2f} N/m, m {case.mass:.2f} kg, v {case.speed:.2f} m/s"
    return Panel(curves, f"{label}, {numbers}", end=16.0)

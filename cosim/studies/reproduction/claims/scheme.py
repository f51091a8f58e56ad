"""C1 to C4, C12 and C14: the scheme itself, its matrices and verification runs, costs, jumps."""

import math
import timeit
from collections.abc import Callable
from functools import cache, partial
from statistics import median
from typing import Any

import numpy as np
from stickslip import simulate
from stickslip.reference.interpreted_scheme import interpreted_run
from stickslip.reference.linearised import GRAVITY, Scheme, SchemeRun
from stickslip.reference.scheme_options import MENDED, PRINTED, Faults
from stickslip.reference.study_rig import ATTACHMENT_RADIUS, fixed_angles, stiffness_matrix

from cosim.report.palette import INK

from .. import cases
from ..cases import CASE, DATASET_1, Case, scheme
from ..claim import STUDY, Claim, responsible
from ..drawing import LINES, Curve, Panel, add_picture
from ..motion import rate, upward_crossings

Run = tuple[np.ndarray, np.ndarray]  # time s, x m

DURATION = 20.0  # s
#: Attachment radii above the study's that are tried, m.
RADII = ATTACHMENT_RADIUS + 1e-5 * np.arange(1, 1000)


def judge_matrices(claim: Claim) -> dict[str, float]:
    """Every printed entry against K = k sum g gT; entries that are not listed are printed 0."""
    for treatment in ("zero", "constant", "opposed"):
        angles = fixed_angles(treatment)
        said: Any = {"treatment": treatment}
        ours, printed = stiffness_matrix(angles), np.zeros((3, 3))
        for name in filter(lambda name: name.startswith(treatment), STUDY):
            i, j = map("xyφ".index, name[-2:])
            printed[i, j] = printed[j, i] = STUDY[name].value
            kind = f"entry_{(i == 2) + (j == 2)}"
            claim.row(kind, [ours[i, j]] * 2, study=name, axes=name[-2:], **said)
        claim.check("entries", [np.abs(ours - printed).max()] * 2, **said)
        # the least radius with which a printed digit changes
        for radius in RADII:
            matrix = stiffness_matrix(angles, radius)
            off = np.abs(matrix - printed).max()
            if not claim.passes(off):
                break
        claim.turn("radius", off, radius=1e3 * radius, entry=matrix[2, 2])
    return {}


def _exact(case: Case, duration: float, vx: float = 0.0, **model: Any) -> Run:
    """The exact model from rest against the frame, or riding on the surface."""
    run = simulate(cases.exact_parameters(case, **{"initial": {"vx": vx}} | model), duration, 1e-3)
    return run.time, run["x"]


def _runs(
    case: Case, duration: float, x0: float = 0.0, scatter: float = 0.0, **model: Any
) -> list[Run]:
    """Slip alone, as printed and mended, and the exact model."""
    schemes = [scheme(case, faults, scatter=scatter) for faults in (PRINTED, MENDED)]
    slides = [one.slide(duration, x0=x0) for one in schemes]
    return [*((run.time, run.q[:, 0]) for run in slides), _exact(case, duration, **model)]


def judge_no_stiffness(claim: Claim) -> dict[str, float]:
    """k = 0 under constant friction; x = mu_k g t2 / 2 in slip, the belt's speed the limit."""
    case = DATASET_1.changed(stiffness=0.0)
    runs = [*_runs(case, DURATION), _exact(case.changed(stiffness=1.0), DURATION)]
    halves, ends = np.transpose([np.interp((DURATION / 2, DURATION), *run) for run in runs])
    *growth, sprung = ends / halves
    claim.row("travel", ends[:3], derived=0.5 * case.mu_k * GRAVITY * DURATION**2)
    claim.check("drifts", growth)
    claim.turn("sprung", sprung)
    return {"meets": case.speed / (case.mu_k * GRAVITY), "speed": case.speed, "ridden": ends[2]}


def judge_stiff(claim: Claim) -> dict[str, float]:
    """k = 9999 N/m; the displacement is below what the camera sees."""
    case, duration = DATASET_1.changed(stiffness=9999.0), 10.0
    runs = [*_runs(case, duration, scatter=0.02), _exact(case, duration, case.speed)]
    *largest, riding = (np.abs(x).max() for _, x in runs)
    claim.row("largest", largest)
    claim.check("pixel", [1e3 * one for one in largest])
    claim.turn("riding", 1e3 * riding)
    return {}


OFFSET, LARGE_OFFSET = 0.02, 0.05  # m
HARDENING = 40.0  # 1/m2; §6.2 of the study: linear for the first couple of centimetres only


def judge_no_friction(claim: Claim) -> dict[str, float]:
    """No friction; free vibration at sqrt(4k/m)."""
    case, at_rest = DATASET_1.changed(mu_s=0.0, mu_k=0.0), {"vx": 0.0, "phi": 0.0}
    expected = math.sqrt(4.0 * case.stiffness / case.mass) / (2.0 * math.pi)
    wide = {"x": LARGE_OFFSET} | at_rest
    cubic = {"cubic": HARDENING * case.stiffness, "neutral_extension": cases.PRETENSION}
    runs = _runs(case, DURATION, OFFSET, initial={"x": OFFSET} | at_rest)
    hardened = _exact(case, DURATION, initial=wide, spring_hardening=cubic)
    rates = [rate(upward_crossings(*run)) for run in (*runs, hardened)]
    *off, off_hardened = (abs(one / expected - 1.0) for one in rates)
    last = [x[time > DURATION - 1.0].max() for time, x in runs]
    claim.row("frequency", rates[:3], derived=expected)
    claim.row("amplitude", last, derived=OFFSET)
    claim.check("frequency", off)
    claim.turn("hardened", off_hardened, part=HARDENING * LARGE_OFFSET**2)
    claim.check("undamped", [abs(value / OFFSET - 1.0) for value in last])
    loose = simulate(cases.exact_parameters(case, pretension=0.0, initial=wide), 3 * DURATION, 1e-2)
    return {"rotation": np.degrees(np.abs(loose["phi"]).max())}


# one stick and one slip, then the next ones begin: what a script needs grows with the slips
SCRIPT = 0.7
COMPARED_CYCLES = 40  # the runs that the study compares


def _seconds(call: Callable[[], object]) -> float:
    return median(timeit.repeat(call, number=1, repeat=3))


def judge_run_times(claim: Claim) -> dict[str, Any]:
    """What updating the spring angles costs: as a script, and compiled."""
    kinds = ("updated", "zero")
    plain = [Scheme(scatter=0.0, treatment=kind) for kind in kinds]
    updated, zero = (_seconds(partial(interpreted_run, SCRIPT, one)) for one in plain)
    schemes = [scheme(DATASET_1, PRINTED, treatment=kind) for kind in kinds]
    compiled = [_seconds(partial(one.run, duration=DURATION)) for one in schemes]
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


def _jumping_run(case: Case, faults: Faults) -> tuple[SchemeRun, np.ndarray]:
    """A run, and when its slips end in stick with a jump of the velocity, s."""
    run = cases.scheme_run(case, faults)
    slips = run.slip_phases
    return run, slips[np.abs(slips[:, 4]) > _threshold(case), 1]


@cache
def jumps(case: Case, faults: Faults) -> int:
    """Slips of a run that end in stick with a jump of the velocity."""
    return len(_jumping_run(case, faults)[1])


def _jumping(series: list[Case], faults: Faults) -> list[Case]:
    """The runs with a jump."""
    return [case for case in series if jumps(case, faults)]


def _exact_jumps(case: Case) -> int:
    """Re-sticks of the exact model in which x' jumps between samples 5 ms apart."""
    motion = cases.exact_motion(case)
    steps = np.diff(np.diff(motion.x) / np.diff(motion.time))
    return int(np.sum(np.abs(steps) > _threshold(case)))


def judge_jumps(claim: Claim) -> dict[str, Any]:
    """Jumps in the three named runs and in all runs of the study's plan."""
    series, located = cases.plan(), PRINTED.without("F6")
    jumping, mended = _jumping(series, PRINTED), len(_jumping(series, MENDED))
    exact, some = sum(map(_exact_jumps, NAMED)), len(jumping) > 0
    for case in NAMED:
        claim.row("jumps", [jumps(case, PRINTED), jumps(case, MENDED), exact], v=case.speed)
    claim.row("runs", [len(jumping), mended], plan=len(series))
    claim.check("anomaly", [some, some and not mended, some and not exact], margin=exact)
    for case in NAMED:
        claim.check("named", [jumps(case, PRINTED)], v=case.speed)
        # laws of friction that the study's drawing cannot be told from
        for other in case.over("weakening", OTHER_WEAKENINGS):
            claim.turn("slope", jumps(other, PRINTED), part=100.0 * other.weakening)
        claim.turn("located", jumps(case, located))
    claim.check("rare", [len(jumping)], plan=len(series))
    with_r = _jumping(series, PRINTED.without("F2"))
    claim.turn("with_r", len(with_r), named=sum(case in NAMED for case in with_r))
    for part in OTHER_WEAKENINGS[:: len(OTHER_WEAKENINGS) - 1]:
        changed = [case.changed(weakening=part) for case in series]
        claim.turn("plan_slope", len(_jumping(changed, PRINTED)), part=100.0 * part)
    witnesses, shown = jumping[:WITNESSES], (jumping or NAMED)[-1]
    faults = responsible(lambda faults: any(jumps(case, faults) for case in witnesses))
    told = {"printed": PRINTED, "located": located, "uncut": PRINTED.without("F14")}
    models = zip((PRINTED, MENDED), LINES, strict=False)
    add_picture(claim, "C14_jump", [[_panel(shown, faults, line)] for faults, line in models])
    said = {name: sum(jumps(case, one) for case in witnesses) for name, one in told.items()}
    said |= {"n": len(witnesses), "plan": len(series)}
    return said | {"faults": ", ".join(faults) or "none"}


def _panel(case: Case, faults: Faults, line: dict[str, Any]) -> Panel:
    """x' of a run, and where it jumps."""
    run, ends = _jumping_run(case, faults)
    marks = {"marker": "x", "ls": "", "color": INK, "ms": 7, "label": "jump to stick"}
    speed = Curve(run.time, run.velocity[:, 0], {"lw": 0.8} | line)
    numbers = f"k {case.stiffness:.2f} N/m, m {case.mass:.2f} kg, v {case.speed:.2f} m/s"
    jumped = Curve(ends, np.full(len(ends), case.speed), marks)
    return Panel([speed, jumped], f"{line['label']}, {numbers}", end=16.0)

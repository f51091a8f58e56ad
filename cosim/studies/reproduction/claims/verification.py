"""C1 to C4: the scheme's stiffness matrices, and the verification runs, slip alone."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from stickslip import simulate
from stickslip.reference.linearised import GRAVITY
from stickslip.reference.scheme_errors import MENDED, PRINTED
from stickslip.reference.spring_angles import ATTACHMENT_RADIUS, fixed_angles, stiffness_matrix

from ..cases import DATASET_1, PRETENSION, Case, exact_parameters, scheme
from ..claim import STUDY, Claim, judges
from ..motion import rate, upward_crossings

Run = tuple[np.ndarray, np.ndarray]  # time s, x m

AXES = "xyφ"
HALF_A_DIGIT = 0.5e-5
#: Attachment radii above the study's that are tried, m.
RADII = ATTACHMENT_RADIUS + 1e-5 * np.arange(1, 1000)
DURATION, STIFF_DURATION = 20.0, 10.0
STIFF, WEAK_SPRING = 9999.0, 1.0  # N/m
OFFSET, LARGE_OFFSET = 0.02, 0.05  # m
HARDENING = 40.0  # 1/m2; §6.2 of the study: linear for the first couple of centimetres only


@judges("C1")
def judge_matrices(claim: Claim) -> dict[str, float]:
    """Every printed entry against K = k sum g gT; entries that are not listed are printed 0."""
    for treatment in ("zero", "constant", "opposed"):
        angles = fixed_angles(treatment)
        ours, printed = stiffness_matrix(angles), np.zeros((3, 3))
        for name in filter(lambda name: name.startswith(treatment), STUDY):
            i, j = map(AXES.index, name[-2:])
            printed[i, j] = printed[j, i] = STUDY[name].value
            entry, kind = [ours[i, j]] * 2, f"entry_{(i == 2) + (j == 2)}"
            claim.row(kind, entry, study=name, axes=name[-2:], treatment=treatment)
        apart = np.abs(ours - printed).max()
        claim.check("entries", [apart, apart], treatment=treatment)
        # the least radius with which a printed digit changes
        for radius in RADII:
            matrix = stiffness_matrix(angles, radius)
            off = np.abs(matrix - printed).max()
            if off >= HALF_A_DIGIT:
                break
        claim.turn("radius", off, radius=1e3 * radius, entry=matrix[2, 2])
    return {}


def _exact(case: Case, duration: float, vx: float = 0.0, **model: Any) -> Run:
    """The exact model from rest against the frame, or riding on the surface."""
    run = simulate(exact_parameters(case, **{"initial": {"vx": vx}} | model), duration, 1e-3)
    return run.time, run["x"]


def _runs(
    case: Case, duration: float, x0: float = 0.0, scatter: float = 0.0, **model: Any
) -> list[Run]:
    """Slip alone, as printed and mended, and the exact model."""
    schemes = [scheme(case, faults, scatter=scatter) for faults in (PRINTED, MENDED)]
    slides = [one.slide(duration, x0=x0) for one in schemes]
    return [*((run.time, run.q[:, 0]) for run in slides), _exact(case, duration, **model)]


def _growth(run: Run) -> float:
    """Travel of a run by that of its first half."""
    half, whole = np.interp((DURATION / 2, DURATION), *run)
    return float(whole / half)


@judges("C2")
def judge_no_stiffness(claim: Claim) -> dict[str, float]:
    """k = 0 under constant friction; x = mu_k g t2 / 2 in slip, the belt's speed the limit."""
    case = DATASET_1.changed(stiffness=0.0)
    runs = _runs(case, DURATION)
    ends = [float(np.interp(DURATION, *run)) for run in runs]
    claim.row("travel", ends, derived=0.5 * case.mu_k * GRAVITY * DURATION**2)
    claim.check("drifts", [_growth(run) for run in runs])
    claim.turn("sprung", _growth(_exact(case.changed(stiffness=WEAK_SPRING), DURATION)))
    meets = case.speed / (case.mu_k * GRAVITY)
    return {"meets": meets, "speed": case.speed, "ridden": ends[-1]}


@judges("C3")
def judge_stiff(claim: Claim) -> dict[str, float]:
    """k = 9999 N/m; the displacement is below what the camera sees."""
    case = DATASET_1.changed(stiffness=STIFF)
    runs = [*_runs(case, STIFF_DURATION, scatter=0.02), _exact(case, STIFF_DURATION, case.speed)]
    *largest, riding = (np.abs(x).max() for _, x in runs)
    claim.row("largest", largest)
    claim.check("pixel", [1e3 * one for one in largest])
    claim.turn("riding", 1e3 * riding)
    return {}


@judges("C4")
def judge_no_friction(claim: Claim) -> dict[str, float]:
    """No friction; free vibration at sqrt(4k/m)."""
    case, at_rest = DATASET_1.changed(mu_s=0.0, mu_k=0.0), {"vx": 0.0, "phi": 0.0}
    expected = math.sqrt(4.0 * case.stiffness / case.mass) / (2.0 * math.pi)
    wide = {"x": LARGE_OFFSET} | at_rest
    cubic = {"cubic": HARDENING * case.stiffness, "neutral_extension": PRETENSION}
    runs = _runs(case, DURATION, OFFSET, initial={"x": OFFSET} | at_rest)
    hardened = _exact(case, DURATION, initial=wide, spring_hardening=cubic)
    rates = [rate(upward_crossings(*run)) for run in (*runs, hardened)]
    off = [abs(one / expected - 1.0) for one in rates]
    last = [x[time > DURATION - 1.0].max() for time, x in runs]
    claim.row("frequency", rates[:3], derived=expected)
    claim.row("amplitude", last, derived=OFFSET)
    claim.check("frequency", off[:3])
    claim.turn("hardened", off[3], part=HARDENING * LARGE_OFFSET**2)
    claim.check("undamped", [abs(value / OFFSET - 1.0) for value in last])
    loose = simulate(exact_parameters(case, pretension=0.0, initial=wide), 3 * DURATION, 1e-2)
    return {"rotation": np.degrees(np.abs(loose["phi"]).max())}

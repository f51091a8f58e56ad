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
from ..motion import oscillation_rate

Run = tuple[np.ndarray, np.ndarray]  # time s, x m

AXES = "xyφ"
HALF_A_DIGIT = 0.5e-5
DURATION, STIFF_DURATION = 20.0, 10.0
STIFF, WEAK_SPRING = 9999.0, 1.0  # N/m
OFFSET, LARGE_OFFSET = 0.02, 0.05  # m
HARDENING = 40.0  # 1/m2; §6.2 of the study: linear for the first couple of centimetres only


@judges("C1")
def judge_matrices(claim: Claim) -> dict[str, float]:
    """Every printed entry against K = k sum g gT; entries that are not listed are printed 0."""
    for treatment in ("zero", "constant", "opposed"):
        ours = stiffness_matrix(fixed_angles(treatment))
        printed = np.zeros((3, 3))
        for name, study in STUDY.items():
            if name.startswith(treatment):
                i, j = (AXES.index(axis) for axis in name[-2:])
                printed[i, j] = printed[j, i] = study.number
                kind = f"entry_{(i == 2) + (j == 2)}"
                entry = [ours[i, j]] * 2
                claim.row(kind, entry, study=name, axes=name[-2:], treatment=treatment)
        apart = np.abs(ours - printed).max()
        claim.check("entries", [apart, apart], treatment=treatment)
        radius, matrix = _changed_digit(treatment, printed)
        claim.turn(
            "radius", np.abs(matrix - printed).max(), radius=1e3 * radius, entry=matrix[2, 2]
        )
    return {}


def _changed_digit(treatment: str, printed: np.ndarray) -> tuple[float, np.ndarray]:
    """The least attachment radius above the study's with which a printed digit changes, m; K/k."""
    for step in range(1, 1000):
        radius = ATTACHMENT_RADIUS + 1e-5 * step
        matrix = stiffness_matrix(fixed_angles(treatment), radius)
        if np.abs(matrix - printed).max() >= HALF_A_DIGIT:
            break
    return radius, matrix


@judges("C2")
def judge_no_stiffness(claim: Claim) -> dict[str, float]:
    """k = 0 under constant friction; x = mu_k g t2 / 2 in slip, the belt's speed the limit."""
    case = DATASET_1.changed(stiffness=0.0)
    runs = [*_slides(case), _exact(case, DURATION)]
    ends = [_travel(run, DURATION) for run in runs]
    claim.row("travel", ends, derived=0.5 * case.mu_k * GRAVITY * DURATION**2)
    claim.check("drifts", [_growth(run) for run in runs])
    sprung = _exact(case.changed(stiffness=WEAK_SPRING), DURATION)
    claim.turn("sprung", _growth(sprung))
    meets = case.speed / (case.mu_k * GRAVITY)
    return {"meets": meets, "speed": case.speed, "ridden": ends[-1]}


def _travel(run: Run, time: float) -> float:
    return float(np.interp(time, *run))


def _growth(run: Run) -> float:
    """Travel of a run by that of its first half."""
    return _travel(run, DURATION) / _travel(run, DURATION / 2)


def _slides(
    case: Case, x0: float = 0.0, scatter: float = 0.0, duration: float = DURATION
) -> list[Run]:
    """Slip alone, as printed and mended."""
    runs = [
        scheme(case, faults, scatter=scatter).slide(duration, x0=x0) for faults in (PRINTED, MENDED)
    ]
    return [(run.time, run.q[:, 0]) for run in runs]


def _exact(case: Case, duration: float, vx: float = 0.0, **model: Any) -> Run:
    """The exact model from rest against the frame, or riding on the surface."""
    run = simulate(exact_parameters(case, **{"initial": {"vx": vx}} | model), duration, 1e-3)
    return run.time, run["x"]


@judges("C3")
def judge_stiff(claim: Claim) -> dict[str, float]:
    """k = 9999 N/m; the displacement is below what the camera sees."""
    case = DATASET_1.changed(stiffness=STIFF)
    slides = _slides(case, scatter=0.02, duration=STIFF_DURATION)
    runs = [*slides, _exact(case, STIFF_DURATION)]
    largest = [np.abs(x).max() for _, x in runs]
    claim.row("largest", largest)
    claim.check("pixel", [1e3 * one for one in largest])
    claim.turn("riding", 1e3 * np.abs(_exact(case, STIFF_DURATION, vx=case.speed)[1]).max())
    return {}


@judges("C4")
def judge_no_friction(claim: Claim) -> dict[str, float]:
    """No friction; free vibration at sqrt(4k/m)."""
    case = DATASET_1.changed(mu_s=0.0, mu_k=0.0)
    expected = math.sqrt(4.0 * case.stiffness / case.mass) / (2.0 * math.pi)
    at_rest = {"vx": 0.0, "phi": 0.0}
    exact = _exact(case, DURATION, initial={"x": OFFSET} | at_rest)
    runs = [*_slides(case, OFFSET), exact]
    rates = [oscillation_rate(*run) for run in runs]
    last = [x[time > DURATION - 1.0].max() for time, x in runs]
    claim.row("frequency", rates, derived=expected)
    claim.row("amplitude", last, derived=OFFSET)
    claim.check("frequency", [abs(rate / expected - 1.0) for rate in rates])
    wide = {"x": LARGE_OFFSET} | at_rest
    cubic = {"cubic": HARDENING * case.stiffness, "neutral_extension": PRETENSION}
    hardened = oscillation_rate(*_exact(case, DURATION, initial=wide, spring_hardening=cubic))
    claim.turn("hardened", abs(hardened / expected - 1.0), part=HARDENING * LARGE_OFFSET**2)
    claim.check("undamped", [abs(value / OFFSET - 1.0) for value in last])
    loose = simulate(exact_parameters(case, pretension=0.0, initial=wide), 3 * DURATION, 1e-2)
    return {"rotation": np.degrees(np.abs(loose["phi"]).max())}

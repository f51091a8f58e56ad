"""C1 to C4: the scheme's stiffness matrices, and the verification runs, slip alone."""

from __future__ import annotations

import math

import numpy as np
from stickslip import simulate
from stickslip.reference.linearised import GRAVITY, SchemeRun
from stickslip.reference.scheme_errors import MENDED, PRINTED, Faults
from stickslip.reference.spring_angles import (
    ATTACHMENT_RADIUS,
    fixed_angles,
    stiffness_matrix,
)

from cosim.studies.reproduction.cases import MATRICES, STUDY

from ..cases import DATASET_1, PRETENSION, Case, exact_parameters, scheme
from ..claim import Check, Claim, Margin, Row, Turn
from ..motion import oscillation_rate

DIGITS = 5
NAMES = "xyφ"
UNITS = {0: "1", 1: "m", 2: "m²"}


def judge_matrices() -> Claim:
    """Every printed entry against K = k sum g gT."""
    rows, checks = [], []
    for treatment, entries in MATRICES.items():
        ours = stiffness_matrix(fixed_angles(treatment))
        expected = np.zeros((3, 3))
        for (i, j), value in entries.items():
            expected[i, j] = expected[j, i] = value.number
            rows.append(
                Row(
                    f"K_{NAMES[i]}{NAMES[j]}/k, {treatment}",
                    UNITS[(i == 2) + (j == 2)],
                    value,
                    float(ours[i, j]),
                    float(ours[i, j]),
                    digits=6,
                )
            )
        same = bool(np.array_equal(np.round(ours, DIGITS), expected))
        says = f"{treatment}: all nine entries to {DIGITS} decimals"
        apart = float(np.abs(ours - expected).max())
        checks.append(
            Check(
                says,
                same,
                same,
                None,
                margin=Margin(f"{treatment}: largest difference", apart, 0.5 * 10.0**-DIGITS),
                turns=(_other_radius(treatment, expected),),
            )
        )
    return Claim(
        "C1",
        "the stiffness matrices of the spring-angle treatments",
        tuple(rows),
        tuple(checks),
        remarks=(
            "The fourth treatment starts from the matrix of the first. The exact model needs no "
            "stiffness matrix; its small vibrations are checked in C4.",
        ),
        place="§4.2.2, eq. 4.16 to 4.18",
        rests="the printed r, β and α alone",
    )


def _other_radius(treatment: str, expected: np.ndarray) -> Turn:
    """The least attachment radius above the study's with which a printed digit changes."""
    radius = ATTACHMENT_RADIUS
    while True:
        radius += 1e-5
        matrix = stiffness_matrix(fixed_angles(treatment), radius)
        if not np.array_equal(np.round(matrix, DIGITS), expected):
            break
    return Turn(
        f"{treatment}: r of {1e3 * radius:.2f} instead of {1e3 * ATTACHMENT_RADIUS:.0f} mm",
        f"K_φφ/k {matrix[2, 2]:.6f} m²",
        False,
    )


DURATION, STIFF_DURATION = 20.0, 10.0
STIFF = 9999.0
OFFSET, LARGE_OFFSET = 0.02, 0.05
# a pixel of the study's camera, 1024 across 0.2 m: less than this is no displacement
PIXEL = 0.2 / 1024
CLOSE = 1e-3  # crossings are read off samples 1 ms apart
# §6.2 of the study: springs are linear for the first couple of centimetres only
FAR_OFFSET, HARDENING = 0.05, 40.0  # m, 1/m2
TWICE = 1.9  # a travel in proportion to time is twice as long in twice the time
WEAK_SPRING = 1.0  # N/m


def _slide(
    case: Case, faults: Faults, x0: float = 0.0, scatter: float = 0.0, duration: float = DURATION
) -> SchemeRun:
    return scheme(case, faults, scatter=scatter).slide(duration, x0=x0)


def judge_no_stiffness() -> Claim:
    """k = 0 under constant friction: x = mu_k g t2 / 2 in slip; the belt's speed is the limit."""
    case = DATASET_1.changed(stiffness=0.0)
    runs = {faults: _slide(case, faults) for faults in (PRINTED, MENDED)}
    printed, mended = runs[PRINTED], runs[MENDED]
    travels = {
        "printed": _travels(printed.time, printed.q[:, 0]),
        "mended": _travels(mended.time, mended.q[:, 0]),
        "exact": _exact_travels(case),
    }
    sprung = _exact_travels(case.changed(stiffness=WEAK_SPRING))
    meets = DATASET_1.speed / (case.mu_k * GRAVITY)
    return Claim(
        "C2",
        "without springs the block drifts without bound",
        (
            Row(
                "x after 20 s",
                "m",
                None,
                *(travel[1] for travel in travels.values()),
                derived=0.5 * case.mu_k * GRAVITY * DURATION**2,
                how="½ µ_k g t²",
            ),
        ),
        (
            Check(
                "x grows without bound, in proportion to time or faster",
                *(_drifts(travel) for travel in travels.values()),
                margin=Margin("x(20 s)/x(10 s)", travels["exact"][1] / travels["exact"][0], TWICE),
                turns=(
                    Turn(
                        f"springs of {WEAK_SPRING:g} N/m instead of none",
                        f"x(20 s)/x(10 s) {sprung[1] / sprung[0]:.2f}",
                        _drifts(sprung),
                    ),
                ),
            ),
        ),
        first=(
            f"Both drifts are without bound, but not the same drift. A verification run of the "
            "study is slip alone: friction pushes the block for ever, past the speed of the "
            f"surface, so that x is ½ µ_k g t². A block on a surface at {DATASET_1.speed:g} m/s "
            f"has its speed after {meets:.2f} s, sticks, and rides along: "
            f"{travels['exact'][1]:.1f} m in {DURATION:.0f} s."
        ),
        place="§4.5, fig. 4.13",
        rests="the equation of motion alone",
    )


def _travels(time: np.ndarray, x: np.ndarray) -> tuple[float, float]:
    """x at half the run and at its end, m."""
    return float(np.interp(DURATION / 2, time, x)), float(np.interp(DURATION, time, x))


def _exact_travels(case: Case) -> tuple[float, float]:
    run = simulate(exact_parameters(case, initial={"vx": 0.0}), DURATION)
    return _travels(run.time, run["x"])


def _drifts(travel: tuple[float, float]) -> bool:
    return travel[1] > TWICE * travel[0] > 0.0


def judge_stiff() -> Claim:
    """k = 9999 N/m: the displacement is below what the camera sees."""
    case = DATASET_1.changed(stiffness=STIFF)
    largest = [
        float(np.abs(_slide(case, faults, scatter=0.02, duration=STIFF_DURATION).q[:, 0]).max())
        for faults in (PRINTED, MENDED)
    ]
    released = simulate(exact_parameters(case, initial={"vx": 0.0}), STIFF_DURATION, 1e-3)
    riding = simulate(exact_parameters(case), STIFF_DURATION, 1e-3)
    largest.append(float(np.abs(released["x"]).max()))
    ridden = float(np.abs(riding["x"]).max())
    return Claim(
        "C3",
        "stiff springs hold the block in place",
        (Row("largest |x|", "m", STUDY["stiff_displacement"], *largest),),
        (
            Check(
                f"|x| stays below a camera pixel, {1e3 * PIXEL:.2f} mm",
                *(value < PIXEL for value in largest),
                margin=Margin("largest |x|", 1e3 * largest[-1], 1e3 * PIXEL, "mm"),
                turns=(
                    Turn(
                        "a start riding on the surface instead of at rest",
                        f"largest |x| {1e3 * ridden:.2f} mm",
                        ridden < PIXEL,
                    ),
                ),
            ),
        ),
        remarks=(
            "Slip from rest, as in the study. A block that starts riding on the surface "
            "swings by v √(m/4k).",
        ),
        place="§4.5, fig. 4.14",
        rests="what counts as no displacement: a pixel of the camera",
    )


def judge_no_friction() -> Claim:
    """No friction: free vibration at sqrt(4k/m)."""
    case = DATASET_1.changed(mu_s=0.0, mu_k=0.0)
    expected = math.sqrt(4.0 * case.stiffness / case.mass) / (2.0 * math.pi)
    runs = [_slide(case, faults, OFFSET) for faults in (PRINTED, MENDED)]
    motions = [(run.time, run.q[:, 0]) for run in runs]
    at_rest = {"vx": 0.0, "phi": 0.0}
    exact = simulate(exact_parameters(case, initial={"x": OFFSET} | at_rest), DURATION, 1e-3)
    large = simulate(
        exact_parameters(case, pretension=0.0, initial={"x": LARGE_OFFSET} | at_rest),
        3 * DURATION,
        1e-2,
    )
    motions.append((exact.time, exact["x"]))
    rates = [oscillation_rate(time, x) for time, x in motions]
    last = [float(x[time > DURATION - 1.0].max()) for time, x in motions]
    near = [abs(rate / expected - 1.0) < CLOSE for rate in rates]
    kept = [abs(value / OFFSET - 1.0) < CLOSE for value in last]
    return Claim(
        "C4",
        "without friction it vibrates freely at √(4k/m)",
        (
            Row("frequency", "Hz", None, *rates, derived=expected, how="√(4k/m)/2π"),
            Row(
                "amplitude in the last second",
                "m",
                None,
                *last,
                derived=OFFSET,
                how="the offset, kept",
            ),
        ),
        (
            Check(
                "the frequency is √(4k/m)/2π",
                *near,
                margin=Margin("frequency off by", abs(rates[-1] / expected - 1.0), CLOSE),
                turns=(_hardened(case, expected),),
            ),
            Check(
                "the vibration goes on undamped",
                *kept,
                margin=Margin("amplitude off by", abs(last[-1] / OFFSET - 1.0), CLOSE),
            ),
        ),
        remarks=(
            f"Exact geometry, no pretension, offset {100 * LARGE_OFFSET:.0f} cm: the largest "
            f"rotation within {3 * DURATION:.0f} s, started straight, is "
            f"{np.degrees(np.abs(large['phi']).max()):.2g}°.",
        ),
        assumed=(f"the initial offset: {100 * OFFSET:.0f} cm (not printed)",),
        place="§4.5, fig. 4.15",
        rests="the springs' linearity over the offset",
    )


def _hardened(case: Case, expected: float) -> Turn:
    """A wider vibration, on springs whose force is k e (1 + h e²)."""
    start = {"x": FAR_OFFSET, "vx": 0.0, "phi": 0.0}
    hardened = {
        "cubic": HARDENING * case.stiffness,
        "neutral_extension": PRETENSION,
    }
    run = simulate(exact_parameters(case, initial=start, spring_hardening=hardened), DURATION, 1e-3)
    rate = oscillation_rate(run.time, run["x"])
    return Turn(
        f"an offset of {100 * FAR_OFFSET:.0f} cm on springs that harden by "
        f"{HARDENING * FAR_OFFSET**2:.0%} there",
        f"frequency off by {rate / expected - 1.0:.1%}",
        abs(rate / expected - 1.0) < CLOSE,
    )

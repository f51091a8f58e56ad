"""C2, C3, C4: the study's verification runs, slip alone: no springs, stiff springs, no friction."""

from __future__ import annotations

import math

import numpy as np
from stickslip import simulate
from stickslip.reference.faults import MENDED, PRINTED, Faults
from stickslip.reference.linearised import GRAVITY, SchemeRun

from ..cases import DATASET_1, Case, exact_parameters, scheme
from ..claim import Check, Claim, Row
from ..motion import oscillation_rate

DURATION, STIFF_DURATION = 20.0, 10.0
STIFF = 9999.0
OFFSET, LARGE_OFFSET = 0.02, 0.05
# a pixel of the study's camera, 1024 across 0.2 m: less than this is no displacement
PIXEL = 0.2 / 1024


def _slide(
    case: Case, faults: Faults, x0: float = 0.0, scatter: float = 0.0, duration: float = DURATION
) -> SchemeRun:
    return scheme(case, faults, scatter=scatter).slide(duration, x0=x0)


def _at(run: SchemeRun, time: float) -> float:
    return float(np.interp(time, run.time, run.q[:, 0]))


def judge_no_stiffness() -> Claim:
    """k = 0 under constant friction: x = mu_k g t2 / 2 in slip; the belt's speed is the limit."""
    case = DATASET_1.changed(stiffness=0.0)
    runs = {faults: _slide(case, faults) for faults in (PRINTED, MENDED)}
    printed, mended = runs[PRINTED], runs[MENDED]
    exact = simulate(exact_parameters(case, initial={"vx": 0.0}), DURATION)
    half = exact.time.searchsorted(DURATION / 2)

    def drifts(at_half: float, at_end: float) -> bool:
        return at_end > 1.9 * at_half > 0.0  # in proportion to time, or faster

    return Claim(
        "C2", "without springs the block drifts without bound",
        (
            Row("x after 20 s", "m", 0.5 * case.mu_k * GRAVITY * DURATION**2,
                _at(printed, DURATION), _at(mended, DURATION), float(exact["x"][-1])),
        ),
        (
            Check(
                "x grows without bound",
                drifts(_at(printed, DURATION / 2), _at(printed, DURATION)),
                drifts(_at(mended, DURATION / 2), _at(mended, DURATION)),
                drifts(float(exact["x"][half]), float(exact["x"][-1])),
            ),
        ),
        remarks=(
            "The study's column is ½ µ_k g t². The scheme's slip goes on past the speed of the "
            "surface; the exact block sticks there and rides along at 0.15 m/s.",
        ),
    )


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
    return Claim(
        "C3", "stiff springs hold the block in place",
        (Row("largest |x|", "m", 0.0, *largest),),
        (
            Check(f"|x| stays below a camera pixel, {1e3 * PIXEL:.2f} mm",
                  *(value < PIXEL for value in largest)),
        ),
        remarks=(
            "Slip from rest, as in the study. A block that starts riding on the surface swings by "
            f"v √(m/4k): the exact model gives {1e3 * np.abs(riding['x']).max():.2f} mm.",
        ),
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
        3 * DURATION, 1e-2,
    )
    motions.append((exact.time, exact["x"]))
    rates = [oscillation_rate(time, x) for time, x in motions]
    last = [float(x[time > DURATION - 1.0].max()) for time, x in motions]
    # crossings are read off samples 1 ms apart
    near = [abs(rate / expected - 1.0) < 1e-3 for rate in rates]
    kept = [abs(value / OFFSET - 1.0) < 1e-3 for value in last]
    return Claim(
        "C4", "without friction it vibrates freely at √(4k/m)",
        (
            Row("frequency", "Hz", expected, *rates),
            Row("amplitude in the last second", "m", OFFSET, *last),
        ),
        (
            Check("the frequency is √(4k/m)/2π", *near),
            Check("the vibration goes on undamped", *kept),
        ),
        remarks=(
            f"Exact geometry, no pretension, offset {100 * LARGE_OFFSET:.0f} cm: the largest "
            f"rotation within {3 * DURATION:.0f} s, started straight, is "
            f"{np.degrees(np.abs(large['phi']).max()):.2g}°.",
        ),
        assumed=(f"the initial offset: {100 * OFFSET:.0f} cm (not printed)",),
    )

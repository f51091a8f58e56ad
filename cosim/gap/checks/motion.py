"""Whether the block moves as its surface, springs and mass are stated.

Whether these are in SI units at all is seen before anything is smoothed; times and places that
cannot be are refused when they are read (`data.units`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy import stats
from scipy.signal import savgol_filter

from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.data.units import cycle_of, friction_of, swing, velocity_of
from cosim.gap.result import Doubt
from cosim.gap.weak_form.constants import CUBIC_REACH
from cosim.gap.weak_form.rows import Response, rows_of
from cosim.gap.windows.sticks import smoothed, sticks_of

from .level import LEVEL, far

# Units.
#: Sticks only make cycles longer than free vibrations, hardening springs shorter by a factor of
#: two: cycles that are shorter than this part of one are of another mass, or of other springs.
SHORT_CYCLE = 1.0 / 3.0
#: A surface that is so many times faster than x ever moves, while the springs' force swings by this
#: part of the weight: x would have to move at 0.005 g / omega, a few mm/s, at least.
UNIT_SPEED, SWINGS = 300.0, 0.01

# Speed in stick.
#: Part of the speed by which a contact that is sheared has the block swing past the surface.
SHEARED = 0.02
#: Part of the speed by which a loaded contact creeps: bristles of 100 um in a stroke of 1 mm.
CREEPS = 0.1
#: Beyond this part a set-point is another one: what runs at it says nothing of the one stated.
WRONG_SPEED = 0.15
#: Sticks of one run that differ by more than this part tell of a surface that is not steady.
UNEVEN = 2.0 * WRONG_SPEED
#: Sticks at so many times the speed stated, or less, are of another unit: no crest of a drive is.
OTHER_UNIT = 3.0
#: Velocities are counted in so many bins; the median within this part about the fullest is what x
#: has most often: noise of a velocity is as wide on slow surfaces.
BINS, PEAK = 40, 0.3
#: Fewest sticks whose scatter tells the error of their mean slope.
FEWEST_STICKS = 3
#: Least travel in a stick, as part of the range of x, and fewest sticks, as part of all cycles: the
#: end of a vibration that dies out is straight, too.
TRAVEL, THROUGHOUT = 0.2, 0.5
#: Third derivative of x in sticks, as part of that in the crests of a vibration: 0, or 1; on
#: springs that are half as stiff half of it.
CREST = 0.5

# Springs.
#: Standard deviation of what friction that goes with the place, or with what was slid, makes of the
#: stiffness: friction a F (1 + sin q x) is a spring of a F q, a few percent of those of the rig.
FRICTION = 0.02
#: Fewest rows of the weak form, ten of a slip, and fewest velocities, that tell anything.
FEWEST_ROWS = 30
#: Nothing that is known makes springs softer than this part of themselves: a second mass on the
#: block, or a belt that gives, takes a fifth.
SOFTEST = 0.7
#: Standard deviation of what springs that are not linear, or not along x, make of a measured force.
SHAPE = 0.02


def doubts_of_units(runs: Sequence[MeasuredRun]) -> list[Doubt]:
    """One for each run whose mass and springs, or surface speed, cannot be in SI units."""
    found = [(run.name, _wrong(run)) for run in runs]
    return [Doubt("units", f"{name}: {text}", (name,), True) for name, text in found if text]


def _wrong(run: MeasuredRun) -> str:
    """What is in another unit, and in which; "" for nothing."""
    period, cycle = 2.0 * math.pi / run.natural_frequency, cycle_of(run)
    if cycle < SHORT_CYCLE * period:
        free = f"the free block of {run.mass:g} kg on springs of {run.stiffness:g} N/m swings in"
        return f"x swings in {cycle:.3g} s, but {free} {period:.3g} s: mass in g, springs in N/mm?"
    fastest = float(np.nanquantile(np.abs(velocity_of(run)[0]), 0.99))
    if friction_of(run) > SWINGS and abs(run.surface_speed) > UNIT_SPEED * fastest:
        return f"surface_speed = {run.surface_speed:g} m/s, but x moves at {fastest:.2g} m/s: mm/s?"
    return ""


def doubts_of_direction(campaign: Campaign, runs: Sequence[MeasuredRun]) -> list[Doubt]:
    """One for each run in which friction would push against the surface.

    The springs hold the mean of friction, K mean(x) = mean friction, but for the momentum at the
    record's ends; and friction carries the block along.
    """
    doubts = []
    for run in runs:
        momentum = swing(run.motion.x) / (run.natural_frequency * run.motion.duration)
        least = far(len(runs)) * campaign.zero_sd(run) + momentum
        mean = float(np.nanmean(run.motion.x))
        if math.copysign(mean, mean * run.surface_speed) < -least:
            text = (
                f"{run.name}: x is {1e3 * mean:.3g} mm in the mean, against the surface "
                f"({run.surface_speed:g} m/s), which carries the block along: sign of x, or of "
                "surface_speed?"
            )
            doubts.append(Doubt("direction", text, (run.name,), True))
    return doubts


def doubts_of_speed(campaign: Campaign, runs: Sequence[MeasuredRun]) -> list[Doubt]:
    """One for each run that sticks at another speed than its set-point, or one for all of them.

    A contact creeps: a block may be somewhat slower than its surface, but not faster.
    """
    found = [(run, *told) for run in runs if (told := stick_speed(run)) is not None]
    known, limit = math.hypot(campaign.errors.surface_speed, SHEARED), far(len(found) + 1)
    logs = np.array([math.log(abs(speed / run.surface_speed)) for run, speed, _ in found])
    common = float(np.median(logs)) if len(found) > 2 else 0.0
    if not _is_off(common, limit * known / math.sqrt(max(len(found), 1))):
        common = 0.0
    doubts = []
    for (run, speed, error), log in zip(found, logs, strict=True):
        if _is_off(log - common, limit * math.hypot(known, error / speed)):
            text = (
                f"{run.name}: surface_speed = {run.surface_speed:g} m/s, but x moves at "
                f"{speed:.3g} m/s in sticks: wrong set-point?"
            )
            is_unit = abs(log) > math.log(OTHER_UNIT)
            text = f"{text[:-1]}, or another unit?" if is_unit else text
            far_off = abs(speed / abs(run.surface_speed) - 1.0) > WRONG_SPEED
            is_severe = is_unit or (far_off and not _is_uneven(run))
            doubts.append(Doubt(_check_of(is_unit), text, (run.name,), is_severe))
    if common:
        names, times = tuple(run.name for run, *_ in found), f"{math.exp(common):.3g} times"
        is_unit = abs(common) > math.log(OTHER_UNIT)
        hint = "another unit?" if is_unit else "the camera's scale, its clock, or the drive?"
        text = f"all runs: in sticks x moves at {times} the surface_speed stated: {hint}"
        doubts.append(Doubt(_check_of(is_unit), text, names, abs(common) > WRONG_SPEED))
    return doubts


def _check_of(is_unit: bool) -> str:
    """No finding answers another unit (`checks.ANSWERABLE`)."""
    return "units" if is_unit else "speed"


def _is_uneven(run: MeasuredRun) -> bool:
    """Whether sticks are slower and faster than stated: what varies in a run is no set-point.

    A block whose sticks keep step with a ripple of the drive is carried at its crests, or troughs.
    """
    slopes, _ = _sticks_at(run, abs(run.surface_speed))
    spread = UNEVEN * abs(run.surface_speed)
    return bool(slopes.size and np.ptp(slopes) > spread
                and slopes.min() < abs(run.surface_speed) < slopes.max())  # fmt: skip


def _is_off(log: float, limit: float) -> bool:
    return not math.log1p(-CREEPS) - limit < log < limit


def stick_speed(run: MeasuredRun) -> tuple[float, float] | None:
    """Along the surface and its standard error, m/s; None where too little sticks.

    Whatever speed is stated: sticks are looked for at it, and at the one that x has most often.
    """
    tried = [abs(run.surface_speed), _most_often(run)]
    found = [_sticks_at(run, speed) for speed in tried if speed > 0.0]
    slopes, durations = max(found, key=lambda one: float(np.sum(one[1])))
    if slopes.size < max(FEWEST_STICKS, THROUGHOUT * run.motion.duration / cycle_of(run)):
        return None
    middle = float(np.median(slopes))
    error = 1.2533 * float(np.std(slopes)) / math.sqrt(slopes.size)
    return (middle, error) if middle > 0.0 else None


def _sticks_at(run: MeasuredRun, speed: float) -> tuple[np.ndarray, np.ndarray]:
    """Slope (m/s, along the surface) and duration (s) of every stick, were this the speed.

    None where they are the crests of a vibration, with a third derivative of -omega^2 x speed.
    """
    along = math.copysign(1.0, run.surface_speed)
    slopes, durations, third, square = [], [], 0.0, 1e-300
    for stick in sticks_of(replace(run, surface_speed=along * speed)):
        rows = np.arange(stick.first, stick.last + 1)
        rows = rows[np.isfinite(run.motion.x[rows])]
        if rows.size < 5 or speed * stick.duration < TRAVEL * swing(run.motion.x):
            continue
        time, x = run.motion.time[rows] - run.motion.time[rows].mean(), along * run.motion.x[rows]
        slopes.append(np.polyfit(time, x, 1)[0])
        durations.append(stick.duration)
        cubic = time**3 / 6.0 - np.polyval(np.polyfit(time, time**3 / 6.0, 2), time)
        third, square = third + float(cubic @ x), square + float(cubic @ cubic)
    crest = -(run.natural_frequency**2) * speed
    error = stats.norm.isf(LEVEL) * run.noise["x"] / math.sqrt(square)
    if third / square / crest + abs(error / crest) > CREST:
        return np.zeros(0), np.zeros(0)
    return np.array(slopes), np.array(durations)


def _most_often(run: MeasuredRun) -> float:
    """The speed along the surface that x has most often, m/s; 0.0 where it never moves along."""
    track = smoothed(run)
    reach = max(2, round(CUBIC_REACH / run.natural_frequency / track.interval))
    size = min(2 * reach + 1, (track.x.size - 1) // 2 * 2 + 1)
    velocity = savgol_filter(track.x, size, 3, 1, track.interval)
    velocity = velocity[track.seen] * math.copysign(1.0, run.surface_speed)
    top = float(np.quantile(velocity, 0.99))
    velocity = velocity[velocity > 0.2 * top]
    if top <= 0.0 or velocity.size < FEWEST_ROWS:
        return 0.0
    counts, edges = np.histogram(velocity, BINS)
    peak = float(edges[np.argmax(counts)])
    for _ in range(BINS):
        peak = float(np.median(velocity[np.abs(velocity - peak) < PEAK * peak]))
    return peak


def doubts_of_springs(campaign: Campaign, runs: Sequence[MeasuredRun]) -> list[Doubt]:
    """One for each set-up (mass and springs) whose slips swing otherwise than stated."""
    told = [(run, *one) for run in runs if (one := stiffness_ratio(campaign, run)) is not None]
    setups = sorted({(run.mass, run.stiffness) for run, *_ in told})
    known, doubts = math.hypot(campaign.errors.stiffness, FRICTION), []
    for mass, stiffness in setups:
        mine = [one for one in told if (one[0].mass, one[0].stiffness) == (mass, stiffness)]
        run, ratio, error = min(mine, key=lambda one: one[2])
        if abs(math.log(ratio)) < far(len(setups)) * math.hypot(known, error / ratio):
            continue
        hertz = run.natural_frequency / (2.0 * math.pi)
        names = tuple(one[0].name for one in mine)
        text = (
            f"{', '.join(names)}: slips swing at {hertz * math.sqrt(ratio):.3g} Hz, expected is "
            f"{hertz:.3g} Hz, that of {mass:g} kg on four springs of {stiffness:g} N/m: "
            f"{ratio * stiffness:.3g} N/m, or {mass / ratio:.3g} kg?"
        )
        doubts.append(Doubt("springs", text, names, ratio < SOFTEST))
    return doubts


def stiffness_ratio(campaign: Campaign, run: MeasuredRun) -> tuple[float, float] | None:
    """Springs as slips have them in parts of what is stated, and its standard error; None: few.

    From the weak form's rows, beside damping and a friction that changes slowly with time.
    """
    track = smoothed(run)
    rows = rows_of(track, campaign.rig)
    slips = rows.kinds == 0
    if slips.sum() < FEWEST_ROWS:
        return None
    friction = rows.weight * track.direction * np.vander(track.time / track.time[-1], 3).T
    force = np.stack([-rows.restoring, track.velocity, *friction], axis=1)
    columns, values = rows.respond(Response(force=force), 5)[slips], rows.values[slips]
    numbers = np.linalg.lstsq(columns, values, rcond=None)[0]
    left = float(np.mean((values - columns @ numbers) ** 2))
    error = math.sqrt(np.linalg.pinv(columns.T @ columns)[0, 0] * max(left, 1.0))
    ratio = 1.0 + float(numbers[0])
    return (ratio, error) if ratio > 0.0 else None


def doubts_of_force(campaign: Campaign, runs: Sequence[MeasuredRun]) -> list[Doubt]:
    """One for each run whose measured force grows otherwise with x than its springs say.

    force is what all springs together pull the block back with, positive where x is: K = 4 k.
    """
    measured = [run for run in runs if "force" in run.motion.channels]
    known, doubts = math.hypot(campaign.errors.stiffness, SHAPE), []
    for run in measured:
        wanted, (slope, error) = run.total_stiffness, _force_slope(run)
        if abs(slope - wanted) > far(len(measured)) * math.hypot(error, known * wanted):
            hint = "its sign?" if slope < 0.0 else "stiffness, scale of x or unit of force?"
            text = (
                f"{run.name}: force grows by {slope:.3g} N/m, expected is {wanted:.3g} N/m, that "
                f"of four springs of {run.stiffness:g} N/m: {hint}"
            )
            doubts.append(Doubt("force", text, (run.name,)))
    return doubts


def _force_slope(run: MeasuredRun) -> tuple[float, float]:
    """Force for each metre of x, N/m, and its standard error, infinite where x hardly moves."""
    seen = np.isfinite(run.motion["force"]) & np.isfinite(run.motion.x)
    force, x = run.motion["force"][seen], run.motion.x[seen]
    noise = x.size * run.noise["x"] ** 2
    if x.size < 3 or (spread := float(np.sum((x - x.mean()) ** 2)) - noise) <= noise:
        return 0.0, math.inf  # noise of x, which flattens the slope, is taken out
    slope = float((x - x.mean()) @ force) / spread
    left = force - force.mean() - slope * (x - x.mean())
    return slope, math.sqrt(float(left @ left) / (x.size - 2) / spread)

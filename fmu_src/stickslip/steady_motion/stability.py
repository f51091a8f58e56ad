"""Do small lateral and rotational disturbances of a motion grow or die out?

A stick-slip motion along x repeats itself from stick to stick, and so does, to first order, what
is beside it: a disturbance d = (y, phi, vy, omega) in the middle of one stick is A d in the middle
of the next. The eigenvalues of A are the Floquet multipliers of the cycle; the motion is stable
where all of them lie inside the unit circle (Leine & Nijmeijer, Dynamics and Bifurcations of
Non-Smooth Mechanical Systems, 2004, chapter 7). A is taken column by column from runs of the model
that are disturbed either way, stick and slip included, so that no law needs a derivative.

A motion that does not stick is looked at once in each of its swings, one that slides evenly once
in a natural period.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ..parameters import Parameters
from ..simulation import simulate
from ..trajectory import Trajectory
from .live import DRY, Interface, LiveRun, RunEnded
from .work import Work

STABLE, NEUTRAL, UNSTABLE, GUIDED = "stable", "neutral", "unstable", "guided"
#: Multipliers this close to 1 are told as 1: what grows by e in a thousand cycles is in no run.
CLOSE_TO_ONE = 1e-3
#: Disturbance, m: the model's own error, some 1e-11, is a hundred-thousandth of it, and so are the
#: terms of third order.
DISTURBANCE = 1e-6
#: Of the start, m: far above rounding, and free to grow by a factor of millions.
START = 1e-9
#: Cycles are the same where they last equally long to this part; then one is enough. Where they are
#: not, as many are multiplied as there are, up to so many.
SAME, CYCLES = 1e-3, 32
#: Of the state x, y, phi, vx, vy, omega: what is beside the line.
BESIDE = {"y": (1, 4), "phi": (2, 5)}


@dataclass(frozen=True)
class Stability:
    """How small disturbances beside a motion fare.

    Attributes
    ----------
    multipliers : (n,) moduli of the multipliers of one cycle, the largest first; n = 2 for each of
        y and phi that is free, none where the rig guides the block
    period : of a cycle, s
    amplification : what a disturbance of the start grows by at most in the whole run, its speed
        ramp included; NaN where the run's own motion was looked at
    straight : whether the motion along the x axis was looked at, as of a rig without imperfections
        that starts on its line; else the run's own motion, of a rig that has no such line
    """

    multipliers: np.ndarray
    period: float
    amplification: float
    straight: bool

    @property
    def growth(self) -> float:
        """Largest multiplier: what a disturbance is multiplied by in a cycle; 0 where guided."""
        return float(self.multipliers[0]) if self.multipliers.size else 0.0

    @property
    def verdict(self) -> str:
        """stable, neutral (neither grows nor dies out), unstable, or guided."""
        if not self.multipliers.size:
            return GUIDED
        if abs(self.growth - 1.0) < CLOSE_TO_ONE:
            return NEUTRAL
        return UNSTABLE if self.growth > 1.0 else STABLE

    @property
    def time_to_grow(self) -> float | None:
        """Time in which a disturbance grows tenfold, s; None where none does."""
        if self.verdict != UNSTABLE:
            return None
        return self.period * float(np.log(10.0) / np.log(self.growth))


def stability(
    parameters: Parameters,
    duration: float = 30.0,
    interface: Interface = DRY,
    work: Work | None = None,
) -> Stability:
    """Multipliers of the last cycles of a run of ``duration`` (s), and what grows on the way there.

    interface: its temperature and the water in it. work: steps that are left. Raises
    `live.RunEnded` where the motion cannot be followed that far.
    """
    moduli, period, time = _multipliers(parameters, duration, interface, work)
    straight = _has_line(parameters)
    if not moduli.size:
        amplified = 0.0
    elif straight:
        amplified = _amplification(_as_drawn(parameters), time, interface, work)
    else:
        amplified = np.nan
    return Stability(moduli, period, amplified, straight)


def growth_in_a_cycle(
    parameters: Parameters,
    duration: float = 30.0,
    interface: Interface = DRY,
    work: Work | None = None,
) -> float:
    """`Stability.growth` alone, in half the time: for searches and maps."""
    moduli, _, _ = _multipliers(parameters, duration, interface, work)
    return float(moduli[0]) if moduli.size else 0.0


def guided(parameters: Parameters) -> Parameters:
    """The same rig, its block held to the x axis: rounding would carry it off an unstable one."""
    rig = parameters.rig.model_copy(update={"degrees_of_freedom": ("x",)})
    return parameters.model_copy(update={"rig": rig})


def _multipliers(
    parameters: Parameters, duration: float, interface: Interface, work: Work | None
) -> tuple[np.ndarray, float, np.ndarray]:
    """Moduli of a cycle's multipliers, the largest first, its period (s), and the run's times."""
    on_line = parameters
    if _has_line(parameters):
        parameters = _as_drawn(parameters)
        on_line = guided(parameters)
    beside = [
        i
        for name in ("y", "phi")
        if name in parameters.rig.degrees_of_freedom
        for i in BESIDE[name]
    ]
    run = simulate(
        on_line,
        duration,
        _sampling(parameters),
        **interface.inputs,
        progress=(work or Work()).over(),
    )
    if not run.complete:
        raise RunEnded(run.reason)
    moments, sticking = _sections(run)
    lengths = np.diff(moments)
    period = float(np.mean(lengths))
    if np.ptp(lengths) < SAME * period:
        moments = moments[-2:]
    if not beside:
        return np.empty(0), period, run.time
    scale = _scale(parameters)[beside]
    product, cycles = np.eye(len(beside)), len(moments) - 1
    live = LiveRun(on_line, interface)
    for begin, end in pairwise(moments):
        (work or Work()).spend(2.0 * len(beside) * (end - begin))
        free = live.advance(begin).of(parameters)
        product = _transfer(free, end, beside, scale, sticking) @ product
    moduli = np.abs(np.linalg.eigvals(product)) ** (1.0 / cycles)
    return np.sort(moduli)[::-1], period, run.time


def _has_line(parameters: Parameters) -> bool:
    """Is the rig its own mirror image, imperfections and the start aside?"""
    off_axis = parameters.spring_misalignment
    angles = np.radians(parameters.rig.attachment_angles_deg)
    places = {(round(float(np.cos(a)), 9), round(float(np.sin(a)), 9) + 0.0) for a in angles}
    return (
        parameters.rig.surface == "belt"
        and parameters.turning_surface.curvature == 0.0
        and off_axis.angle_deg == 0.0
        and off_axis.lateral_offset == 0.0
        and places == {(c, 0.0 - s) for c, s in places}
    )


def _as_drawn(parameters: Parameters) -> Parameters:
    """The same rig without imperfections, started on the x axis."""
    start = {"y": 0.0, "phi": 0.0, "vy": 0.0, "omega": 0.0}
    return parameters.model_copy(
        update={
            "initial": parameters.initial.model_copy(update=start),
            "imperfections": type(parameters.imperfections)(),
        }
    )


def _sampling(parameters: Parameters) -> float:
    """A fortieth of the natural period, s: fine enough to find the swings."""
    frequency = parameters.natural_frequency
    return 1.0 / (40.0 * frequency) if frequency > 0.0 else 0.01


def _scale(parameters: Parameters) -> np.ndarray:
    """What one metre at the contact's rim is in x, y, phi, vx, vy, omega."""
    rate = max(2.0 * np.pi * parameters.natural_frequency, 1.0)
    arm = 1.0 / parameters.rig.contact_radius
    return np.array([1.0, 1.0, arm, rate, rate, rate * arm])


def _sections(run: Trajectory) -> tuple[np.ndarray, bool]:
    """Moments, s, that are a cycle apart, in the run's last part; whether the block sticks there.

    The middles of the last sticks where there are two, else where x swings through its least, else
    natural periods.
    """
    begin = run.parameters.surface.run_up_time
    slips = run.slip_starts
    restarts = run.events[run.events[:, 1] == 0.0, 0]
    after = np.searchsorted(slips, restarts, side="right")
    ended = after < slips.size
    middles = 0.5 * (restarts[ended] + slips[after[ended]])
    late = middles[middles > begin][-CYCLES - 1 :]
    natural = 1.0 / max(run.parameters.natural_frequency, 0.1)
    if late.size > 1 and run.time[-1] - late[-1] < 0.5 * (run.time[-1] - begin):
        return late, True
    swings = _lowest(run, begin)[-CYCLES - 1 :]
    if swings.size > 1:
        return swings, False
    count = int(np.clip((run.time[-1] - begin) / natural, 1, CYCLES))
    return run.time[-1] - natural * np.arange(count, -1, -1), False


def _lowest(run: Trajectory, begin: float) -> np.ndarray:
    """Times after ``begin`` at which x turns upward, s; none where it hardly moves."""
    late = run.time >= begin
    time, vx = run.time[late], run["vx"][late]
    if time.size < 2 or np.ptp(run["x"][late]) < 1e3 * DISTURBANCE:
        return np.empty(0)
    up = np.flatnonzero((vx[:-1] < 0.0) & (vx[1:] >= 0.0))
    return time[up] - vx[up] * (time[up + 1] - time[up]) / (vx[up + 1] - vx[up])


def _transfer(
    live: LiveRun, end: float, beside: list[int], scale: np.ndarray, sticking: bool
) -> np.ndarray:
    """Disturbances at ``end`` for those now, (n, n), in metres at the rim."""
    columns = []
    course = _course(live, end) if sticking else np.zeros(6)
    for i, size in zip(beside, scale, strict=True):
        change = np.zeros(6)
        change[i] = DISTURBANCE * size
        ahead = live.copy().displace(change).advance(end)
        behind = live.copy().displace(-change).advance(end)
        moved = ahead.state - behind.state
        moved -= moved[0] * course  # compared where the surface has carried both equally far
        columns.append(moved[beside] / (2.0 * DISTURBANCE * scale))
    return np.column_stack(columns)


def _amplification(
    parameters: Parameters, time: np.ndarray, interface: Interface, work: Work | None
) -> float:
    """Largest distance from the line over that at the start, of a block displaced, and turned."""
    arm, largest = parameters.rig.contact_radius, 0.0
    for name in ("y", "phi"):
        if name not in parameters.rig.degrees_of_freedom:
            continue
        start: dict[str, float] = {name: START / (arm if name == "phi" else 1.0)}
        moved = parameters.model_copy(
            update={"initial": parameters.initial.model_copy(update=start)}
        )
        run = simulate(
            moved, time[-1], time[1], **interface.inputs, progress=(work or Work()).over()
        )
        far = np.hypot(run["y"], arm * run["phi"])
        largest = max(largest, float(far.max()) / START)
    return largest


def _course(live: LiveRun, moment: float) -> np.ndarray:
    """Change of the state (6,) per travel along x of a block that sticks at ``moment`` (s)."""
    span = 1e-3 * (moment - live.time)
    there = live.copy().advance(moment)
    change = there.copy().advance(moment + span).state - there.state
    return change / change[0]

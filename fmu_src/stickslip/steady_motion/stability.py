"""Do small lateral and rotational disturbances of a motion grow or die out?

A stick-slip motion along x repeats itself from stick to stick, and so does, to first order, what
is beside it: a disturbance d = (y, phi, vy, omega) in the middle of one stick is A d in the middle
of the next. The eigenvalues of A are the Floquet multipliers of the cycle; the motion is stable
where all of them lie inside the unit circle (Leine & Nijmeijer, Dynamics and Bifurcations of
Non-Smooth Mechanical Systems, 2004, chapter 7). A is taken column by column from runs of the model
that are disturbed, stick and slip included, so that no law needs a derivative.

Where friction falls steeply a motion can graze: a small disturbance meets other events than a
smaller one, or than its mirror image, and there is no A. So it is taken for disturbances of two
sizes and, where the rig is not its own mirror image, of both signs; where these do not agree on
whether a disturbance grows, nothing is said.

A cycle is as many sticks as it takes until their lengths repeat, and is looked at in a run that is
made longer until they do. A motion that does not stick is looked at once in each of its swings,
one that slides evenly once in a natural period.
"""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ..arrays import RunArrays
from ..parameters import Parameters
from ..trajectory import Trajectory
from .live import DRY, Interface, live_run, simulated

STABLE, NEUTRAL, UNSTABLE, GUIDED = "stable", "neutral", "unstable", "guided"
GRAZING = "grazing"
#: Multipliers this close to 1 are told as 1: what grows by e in a thousand cycles is in no run.
CLOSE_TO_ONE = 1e-3
#: Disturbances, m: the multipliers are those of the first; the model's own error, some 1e-11, is a
#: ten-thousandth of the second.
DISTURBANCES = 1e-5, 1e-7
#: Of the start, m: far above rounding, and free to grow by a factor of millions.
START = 1e-9
#: Cycles repeat where their lengths do to this part, as groups of up to so many sticks; a run in
#: which they do not yet is made twice as long, so many times. Where they never do, as many are
#: multiplied as there are, up to so many.
SAME, LONGEST_CYCLE, DOUBLINGS, CYCLES = 1e-6, 8, 2, 32
#: Of the state x, y, phi, vx, vy, omega: what is beside the line.
BESIDE = {"y": (1, 4), "phi": (2, 5)}


@dataclass(frozen=True)
class Stability:
    """How small disturbances beside a motion fare.

    Attributes
    ----------
    multipliers : (n,) moduli of the multipliers of one stick to the next, the largest first; n = 2
        for each of y and phi that is free, none where the rig guides the block
    period : of a cycle, s
    amplification : what a disturbance of the start grows by at most in the whole run, its speed
        ramp included; NaN where the run's own motion was looked at
    straight : whether the motion along the x axis was looked at, as of a rig without imperfections
        that starts on its line; else the run's own motion, of a rig that has no such line
    others : largest multiplier by disturbances of the other size and sign
    """

    multipliers: np.ndarray
    period: float
    amplification: float
    straight: bool
    others: tuple[float, ...] = ()

    @property
    def growth(self) -> float:
        """Largest multiplier: what a disturbance is multiplied by in a cycle; 0 where guided."""
        return float(self.multipliers[0]) if self.multipliers.size else 0.0

    @property
    def verdict(self) -> str:
        """stable, neutral (neither grows nor dies out), unstable, guided, or grazing.

        Grazing: disturbances of other sizes and signs fare differently.
        """
        if not self.multipliers.size:
            return GUIDED
        verdicts = {_verdict(growth) for growth in (self.growth, *self.others)}
        if len(verdicts) > 1 and np.ptp([self.growth, *self.others]) > CLOSE_TO_ONE:
            return GRAZING
        return _verdict(self.growth)

    @property
    def time_to_grow(self) -> float | None:
        """Time in which a disturbance grows tenfold, s; None where none does."""
        if self.verdict != UNSTABLE:
            return None
        return self.period * float(np.log(10.0) / np.log(self.growth))


def _verdict(growth: float) -> str:
    if abs(growth - 1.0) < CLOSE_TO_ONE:
        return NEUTRAL
    return UNSTABLE if growth > 1.0 else STABLE


def stability(
    parameters: Parameters, duration: float = 30.0, interface: Interface = DRY
) -> Stability:
    """Multipliers of the cycle that a run of ``duration`` (s) comes to, and what grows on the way.

    interface: its temperature and the water in it. Raises `live.RunEnded` where the motion cannot
    be followed that far.
    """
    found = cycle_stability(parameters, duration, interface)
    if not found.multipliers.size:
        amplified = 0.0
    elif found.straight:
        amplified = _amplification(_as_drawn(parameters), duration, interface)
    else:
        amplified = np.nan
    return replace(found, amplification=amplified)


def cycle_stability(
    parameters: Parameters, duration: float = 30.0, interface: Interface = DRY
) -> Stability:
    """`stability` without the amplification, in half the time: for searches and maps."""
    straight = _has_line(parameters)
    on_line = parameters
    if straight:
        parameters = _as_drawn(parameters)
        on_line = guided(parameters)
    free = parameters.rig.degrees_of_freedom
    beside = [i for name in ("y", "phi") if name in free for i in BESIDE[name]]
    moments, sticking = _converged(on_line, parameters, duration, interface)
    period = float(np.mean(np.diff(moments)))
    if not beside:
        return Stability(np.empty(0), period, np.nan, straight)
    live = live_run(on_line, interface)
    # of its own mirror image both signs fare alike
    kinds = [
        (size, sign) for size in DISTURBANCES for sign in ((1.0,) if straight else (1.0, -1.0))
    ]
    products = {kind: np.eye(len(beside)) for kind in kinds}
    scale = _scale(parameters)
    for begin, end in pairwise(moments):
        interface.work.spend((1.0 + len(kinds) * len(beside)) * (end - begin))
        disturbed = live.advance(begin).of(parameters)
        undisturbed = disturbed.copy().advance(end).state
        course = _course(disturbed, end) if sticking else np.zeros(6)
        for size, sign in kinds:
            changes = sign * size * scale
            transfer = _transfer(disturbed, end, beside, changes, undisturbed, course)
            products[size, sign] = transfer @ products[size, sign]
    cycles = len(moments) - 1
    moduli = [
        np.sort(np.abs(np.linalg.eigvals(product)) ** (1.0 / cycles))[::-1]
        for product in products.values()
    ]
    others = tuple(float(each[0]) for each in moduli[1:])
    return Stability(moduli[0], period, np.nan, straight, others)


def guided(parameters: Parameters) -> Parameters:
    """The same rig, its block held to the x axis: rounding would carry it off an unstable one."""
    return parameters.with_values("rig", degrees_of_freedom=("x",))


def _converged(
    on_line: Parameters, parameters: Parameters, duration: float, interface: Interface
) -> tuple[np.ndarray, bool]:
    """Moments, s, of one cycle, or of as many as there are; whether the block sticks there."""
    ramp = parameters.surface.run_up_time
    for doubling in range(DOUBLINGS + 1):
        length = ramp + (duration - ramp) * 2.0**doubling
        run = simulated(on_line, length, _sampling(parameters), interface)
        moments, sticking = _sections(run)
        count = _sticks_in_a_cycle(np.diff(moments))
        if count:
            return moments[-count - 1 :], sticking
    return moments, sticking


def _sticks_in_a_cycle(lengths: np.ndarray) -> int:
    """After how many their lengths (n,) repeat, twice at least; 0: they do not."""
    for count in range(1, min(LONGEST_CYCLE, lengths.size // 3) + 1):
        late = lengths[-3 * count :].reshape(3, count)
        if np.ptp(late, axis=0).max() < SAME * lengths.mean():
            return count
    return 0


def _has_line(parameters: Parameters) -> bool:
    """Is the rig its own mirror image, imperfections and the start aside?"""
    off_axis = parameters.spring_misalignment
    angles = np.radians(parameters.rig.attachment_angles_deg)
    places = {(round(float(np.cos(a)), 9), round(float(np.sin(a)), 9) + 0.0) for a in angles}
    return (
        parameters.rig.surface == "belt"
        and parameters.turning_surface.curvature == 0.0
        and off_axis.angle_deg == 0.0
        and off_axis.frame_angle_deg == 0.0
        and off_axis.lateral_offset == 0.0
        and off_axis.diagonal_offset == 0.0
        and places == {(c, 0.0 - s) for c, s in places}
    )


def _as_drawn(parameters: Parameters) -> Parameters:
    """The same rig without imperfections, started on the x axis."""
    started = parameters.with_values("initial", y=0.0, phi=0.0, vy=0.0, omega=0.0)
    return started.model_copy(update={"imperfections": type(parameters.imperfections)()})


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
    if time.size < 2 or np.ptp(run["x"][late]) < 1e3 * DISTURBANCES[1]:
        return np.empty(0)
    up = np.flatnonzero((vx[:-1] < 0.0) & (vx[1:] >= 0.0))
    found: np.ndarray = time[up] - vx[up] * (time[up + 1] - time[up]) / (vx[up + 1] - vx[up])
    return found


def _transfer(
    live: RunArrays,
    end: float,
    beside: list[int],
    changes: np.ndarray,
    undisturbed: np.ndarray,
    course: np.ndarray,
) -> np.ndarray:
    """Disturbances at ``end`` for those now, (n, n), in units of the ``changes`` (6,).

    undisturbed: the state then (6,). course: of it, per travel along x.
    """
    columns = []
    for i in beside:
        change = np.zeros(6)
        change[i] = changes[i]
        moved = live.copy().displace(change).advance(end).state - undisturbed
        moved -= moved[0] * course  # compared where the surface has carried both equally far
        columns.append(moved[beside] / changes[beside])
    return np.column_stack(columns)


def _amplification(parameters: Parameters, duration: float, interface: Interface) -> float:
    """Largest distance from the line over that at the start, of a block displaced, and turned."""
    arm, largest = parameters.rig.contact_radius, 0.0
    for name in ("y", "phi"):
        if name not in parameters.rig.degrees_of_freedom:
            continue
        start = {name: START / (arm if name == "phi" else 1.0)}
        moved = parameters.with_values("initial", **start)
        run = simulated(moved, duration, _sampling(parameters), interface, whole=False)
        far = np.hypot(run["y"], arm * run["phi"])
        largest = max(largest, float(far.max()) / START)
    return largest


def _course(live: RunArrays, moment: float) -> np.ndarray:
    """Change of the state (6,) per travel along x of a block that sticks at ``moment`` (s)."""
    span = 1e-3 * (moment - live.time)
    there = live.copy().advance(moment)
    change = there.copy().advance(moment + span).state - there.state
    found: np.ndarray = change / change[0]
    return found

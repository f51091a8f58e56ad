"""Over the length of the belt: the shortest on which the drift stays below a limit, and a map.

The shortest of a rig as it is, and in doubt: between the lengths for which the doubt is known.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from cosim.processes import processes
from thermal.arrays import Array

from .case import Case, StudyError
from .drift import endless_belt, interface_drift, least_below, run_drift, steady_drift
from .uncertainty import INTERVAL, Uncertainty

#: Longest belt that is tried, m.
LONGEST = 50.0
#: How well the length is found, relative; the drift is known to less.
_TOLERANCE = 5e-3
#: Shortest belts by rise, "run" or "interface", and level.
Levels = dict[str, dict[str, "Length"]]


@dataclass(frozen=True)
class Length:
    """Shortest belt, m; None with the reason. says: for tables, such as 1.7, <1 or >4."""

    length: float | None
    says: str
    reason: str = ""

    @property
    def in_words(self) -> str:
        """The same with its unit, for sentences; "" where nothing is told."""
        words = self.says.replace("<", "less than ").replace(">", "more than ")
        return words and f"{words} m"


def rounded_up(length: float) -> tuple[str, str]:
    """Two digits of a length (m), upwards, so that the belt is long enough; and their step, m.

    >>> rounded_up(10.24)
    ('11', '1')
    """
    step = 10.0 ** (math.floor(math.log10(length)) - 1)
    # what is two digits but for the binary rounding stays so
    return f"{step * math.ceil(length / step - 1e-9):.3g}", f"{step:g}"


def length_text(length: float | None) -> str:
    """A shortest belt for a table; none where no belt does."""
    return "none" if length is None else rounded_up(length)[0]


def metres(length: float) -> str:
    """A shortest belt for a sentence."""
    up, step = rounded_up(length)
    return f"{up} m (rounded up to the next {step} m)"


def shortest_belt(
    case: Case,
    limit: float,
    drift: Callable[[Case], float] = run_drift,
    longest: float = LONGEST,
) -> float | None:
    """The shortest belt of a drive on which a rise stays below a limit, m.

    Parameters
    ----------
    case : everything but the length, which is tried
    limit : K, > 0
    drift : rise of a case, K, which falls with the length: `run_drift` (belt at entry, after the
        runs), `steady_drift` (the same for ever) or `interface_drift`
    longest : m, the longest that is tried

    Returns a belt that is long enough, by at most 1 % too long: the shortest that has room where
    that does already, None where `longest` does not.
    Raises ParameterError, in one line, for a case that cannot be; NoSteadyState with
    `steady_drift` where nothing takes the heat.

    >>> from cosim.studies.belt_length import Case, shortest_belt
    >>> shortest_belt(Case(length=1.0, speed=0.15), limit=0.07)
    1.66...
    """
    if not limit > 0.0:
        raise StudyError(f"limit = {limit:g} K: must be above 0")

    return least_below(
        lambda length: drift(case.with_length(length)),
        limit,
        (case.shortest, max(longest, case.shortest)),
        _TOLERANCE,
        surely=True,
    )


@lru_cache(maxsize=64)
def shortest_belts(case: Case, limit: float) -> tuple[float | None, float | None, float | None]:
    """For runs, for ever, for the interface, m; of cases that differ in length alone ask with one.

    limit in K. Beyond a belt that never comes round the interface is the same.
    """
    return (
        shortest_belt(case, limit, run_drift),
        shortest_belt(case, limit, steady_drift),
        shortest_belt(case, limit, interface_drift, min(LONGEST, endless_belt(case).length)),
    )


def shortest_in_doubt(doubts: Mapping[float, Uncertainty | None], limit: float) -> Levels:
    """Shortest belts by rise and level, median and high; limit in K.

    doubts: on belts of some lengths, m. Nothing is told beyond them.
    """
    lengths = sorted(doubts)
    known = [one for length in lengths if (one := doubts[length]) is not None]
    if len(known) < len(lengths):
        none = Length(None, "", "no doubt was computed: --samples 0, or the ice melts")
        return {rise: {"median": none, "high": none} for rise in ("run", "interface")}
    levels = {"median": "median", "high": f"{INTERVAL[1]:.0%} level"}
    return {
        rise: {
            level: between(lengths, [getattr(one, prefix + level) for one in known], limit, called)
            for level, called in levels.items()
        }
        for rise, prefix in (("run", ""), ("interface", "interface_"))
    }


def between(lengths: Sequence[float], rises: Sequence[float], limit: float, level: str) -> Length:
    """Shortest belt, m, for rises (K) on some lengths (m, increasing); limit in K.

    Beyond the last belt that is above the limit; straight in the logarithms of both. Nothing is
    told beyond the lengths. level: what the rises are called in the reason.
    """
    last = max((i for i, rise in enumerate(rises) if rise > limit), default=None)
    if last is None:
        short = rounded_up(lengths[0])[0]
        return Length(lengths[0], f"<{short}", "the shortest of the belts looked at")
    if last == len(lengths) - 1:
        longest = f"{lengths[-1]:.3g}"
        where = f"on {longest} m, the longest belt looked at"
        return Length(None, f">{longest}", f"{where}, the {level} is {rises[-1]:.2g} K")
    # a rise that falls to nothing within a step would draw the place to the shorter belt
    below = max(rises[last + 1], 0.1 * limit)
    part = math.log(rises[last] / limit) / math.log(rises[last] / below)
    length = lengths[last] * (lengths[last + 1] / lengths[last]) ** part
    return Length(length, rounded_up(length)[0])


#: Corners of the map: m and m/s.
LENGTHS, SPEEDS = (0.3, 10.0), (0.05, 1.5)


@dataclass(frozen=True)
class DriftMap:
    """drift (lengths, speeds), K; NaN where a map was stopped before it came there."""

    lengths: Array
    speeds: Array
    drift: Array


def empty_map(points: int, case: Case | None = None) -> DriftMap:
    """points x points places, evenly in the logarithm, with nothing known.

    case: whose speed and shortest belt are to lie on it.
    """
    lengths, speeds = LENGTHS, SPEEDS
    if case is not None:
        lengths = (max(LENGTHS[0], case.shortest), max(LENGTHS[1], 5.0 * case.shortest))
        speeds = (min(SPEEDS[0], 0.3 * case.speed), max(SPEEDS[1], 3.0 * case.speed))
    return DriftMap(
        np.geomspace(*lengths, points),
        np.geomspace(*speeds, points),
        np.full((points, points), np.nan),
    )


def fill_map(
    grid: DriftMap, case: Case, jobs: int, progress: Callable[[int], object] = lambda done: None
) -> None:
    """Drifts of a case on other belts, in `jobs` processes; what interrupts it leaves the rest."""
    belts = [(case.with_length(float(length)), grid.speeds) for length in grid.lengths]
    with processes(jobs) as mapped:
        for i, column in enumerate(mapped(_column, belts)):
            grid.drift[i] = column
            progress(grid.speeds.size)


def _column(case: Case, speeds: Array) -> list[float]:
    return [run_drift(replace(case, speed=float(speed))) for speed in speeds]

"""Cutting a track into sticks and slips: the partition with the least penalised misfit.

A stick is a line with the slope of the surface speed (known within a few per cent), a slip a free
vibration x = c + a cos(omega t) + b sin(omega t). Misfits are in units of the noise squared; every
piece costs what it must explain to be more than chance (Schwarz: log n for each number it brings).
Dynamic programming finds the best of all partitions (Jackson et al., IEEE Signal Process. Lett. 12,
2005; starts that cannot win are dropped: Killick et al., J. Am. Stat. Assoc. 107, 2012), here
with two kinds of pieces, of which two sticks never meet.
"""

from __future__ import annotations

import math

import numba
import numpy as np

STICK, SLIP = 0, 1
#: What a set-point says of the speed of a surface: relative standard deviation.
SPEED_ERROR = 0.03
#: Numbers a piece brings: where it ends, and level (stick) or level, amplitude and phase (slip).
STICK_NUMBERS, SLIP_NUMBERS = 2, 4
STICK_SAMPLES, SLIP_SAMPLES = 3, 4
#: Parts of a natural period: a slip lasts half a one to a whole one, and hardly less whatever is
#: missing in the model; what is longer is put together from several pieces.
SHORTEST_SLIP, LONGEST_SLIP = 0.4, 1.5


def partition(
    time: np.ndarray, x: np.ndarray, speed: float, omega: float, noise: float
) -> list[tuple[int, int, int]]:
    """Pieces (kind, first, last + 1) that cover a track without holes.

    Parameters
    ----------
    time, x : (n,) arrays, s and m, no sample missing
    speed : of the surface, m/s
    omega : natural frequency, rad/s
    noise : standard deviation of a sample, m
    """
    return partition_cost(time, x, speed, omega, noise)[0]


def partition_cost(
    time: np.ndarray, x: np.ndarray, speed: float, omega: float, noise: float
) -> tuple[list[tuple[int, int, int]], float]:
    """The partition and its penalised misfit, in units of the noise squared."""
    penalty = math.log(max(len(time), 3))
    period = 2.0 * math.pi / omega
    spans = (SHORTEST_SLIP * period, LONGEST_SLIP * period)
    before_stick, before_slip, kinds, cost = _least_cost(
        time, x / noise, speed / noise, omega, penalty, spans
    )
    pieces: list[tuple[int, int, int]] = []
    end, kind = len(time), int(kinds[len(time)])
    while end > 0:
        start = int((before_stick if kind == STICK else before_slip)[end])
        pieces.append((kind, start, end))
        kind = SLIP if kind == STICK else int(kinds[start])
        end = start
    return _joined(pieces[::-1]), float(cost)


def _joined(pieces: list[tuple[int, int, int]]) -> list[tuple[int, int, int]]:
    """Neighbouring slips as one."""
    joined: list[tuple[int, int, int]] = []
    for kind, start, end in pieces:
        if joined and joined[-1][0] == kind:
            joined[-1] = (kind, joined[-1][1], end)
        else:
            joined.append((kind, start, end))
    return joined


@numba.njit(cache=True)
def _least_cost(time, x, speed, omega, penalty, spans):
    """Start of the last piece, if a stick or a slip ends before each sample, and the better one.

    And the least cost of all samples.
    """
    n = len(time)
    stick_cost, slip_cost = np.full(n + 1, np.inf), np.full(n + 1, np.inf)
    stick_start, slip_start = np.zeros(n + 1, np.int64), np.zeros(n + 1, np.int64)
    kinds = np.full(n + 1, SLIP)
    slip_cost[0] = 0.0
    starts, sums = np.zeros(n, np.int64), np.zeros((n, 6))
    count = 0
    for end in range(1, n + 1):
        starts[count], sums[count] = end - 1, 0.0
        count += 1
        _best_stick(
            time, x, speed, penalty, end, starts, sums, count, slip_cost, stick_cost, stick_start
        )
        _best_slip(time, x, omega, penalty, spans, end, stick_cost, slip_cost, slip_start)
        count = _promising(starts, sums, count, slip_cost, slip_cost[end])
        if stick_cost[end] < slip_cost[end]:
            kinds[end] = STICK
    return stick_start, slip_start, kinds, min(stick_cost[n], slip_cost[n])


@numba.njit(cache=True)
def _best_stick(
    time, x, speed, penalty, end, starts, sums, count, slip_cost, stick_cost, stick_start
):
    """Cost of the best partition that ends with a stick before sample ``end``.

    Each of the ``count`` possible starts has its sums over time and distance from the line, and
    its misfit so far.
    """
    prior = 1.0 / (SPEED_ERROR * speed) ** 2
    for row in range(count):
        start = starts[row]
        number = float(end - start)
        t = time[end - 1] - time[start]
        r = x[end - 1] - x[start] - speed * t
        own = sums[row]
        own[0] += t
        own[1] += t * t
        own[2] += r
        own[3] += r * r
        own[4] += t * r
        cross = own[4] - own[0] * own[2] / number
        spread = own[1] - own[0] * own[0] / number + prior
        own[5] = own[3] - own[2] * own[2] / number - cross * cross / spread
        cost = slip_cost[start] + own[5] + STICK_NUMBERS * penalty
        if number >= STICK_SAMPLES and cost < stick_cost[end]:
            stick_cost[end] = cost
            stick_start[end] = start


@numba.njit(cache=True)
def _promising(starts, sums, count, slip_cost, rival):
    """Drop starts that a stick that begins here will beat whatever comes (Killick's pruning)."""
    kept = 0
    for row in range(count):
        if slip_cost[starts[row]] + sums[row, 5] < rival:
            starts[kept] = starts[row]
            sums[kept] = sums[row]
            kept += 1
    return kept


@numba.njit(cache=True)
def _best_slip(time, x, omega, penalty, spans, end, stick_cost, slip_cost, slip_start):
    """Cost of the best partition that ends with a slip before sample ``end``."""
    origin = time[end - 1]
    level = x[end - 1]
    sums = np.zeros(9)  # 1, s, c, ss, sc, cc, r, rs, rc with s = sin, c = 1 - cos
    s_rr = 0.0
    for start in range(end - 1, -1, -1):
        angle = omega * (time[start] - origin)
        if -angle > omega * spans[1]:
            break
        s = math.sin(angle)
        c = 2.0 * math.sin(0.5 * angle) ** 2
        r = x[start] - level
        sums[0] += 1.0
        sums[1] += s
        sums[2] += c
        sums[3] += s * s
        sums[4] += s * c
        sums[5] += c * c
        sums[6] += r
        sums[7] += r * s
        sums[8] += r * c
        s_rr += r * r
        inside = start > 0 and end < len(time)
        if sums[0] < SLIP_SAMPLES or (inside and -angle < omega * spans[0]):
            continue
        misfit = s_rr - _explained(sums)
        cost = min(stick_cost[start], slip_cost[start]) + misfit + SLIP_NUMBERS * penalty
        if cost < slip_cost[end]:
            slip_cost[end] = cost
            slip_start[end] = start


@numba.njit(cache=True)
def _explained(sums):
    """Sum of squares that 1, sin and 1 - cos explain, by elimination in this order."""
    n, s, c, ss, sc, cc, r, rs, rc = sums
    found = r * r / n
    ss, sc, rs = ss - s * s / n, sc - s * c / n, rs - s * r / n
    cc, rc = cc - c * c / n, rc - c * r / n
    if ss > 0.0:
        found += rs * rs / ss
        left, rc = cc - sc * sc / ss, rc - sc * rs / ss
        if left > 1e-10 * cc:
            found += rc * rc / left
    return found

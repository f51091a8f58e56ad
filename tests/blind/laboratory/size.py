"""How large a hidden thing is, in units of the tracker's noise.

Definition. From the true motion, segments of SEGMENT swings are taken, up to PIECES of them evenly
over each run, fitted and held-out runs alike. Each is simulated once more from the same state
(bristles and memories included) with the thing taken out and everything else the same. The
difference of the two, in x and, where it is recorded, y, over the noise, is what the thing does.
What a plain model could make good by itself is then taken off by least squares, to first order:
mu_s and mu_k of the whole campaign, the zero of each run, and place and speed at the start of each
segment, in the plane x and y of them. The size is the root mean square of what is left over all
samples. `raw` is the same without taking anything off. A fault of the camera is measured in the
same way: what it does to each segment's path, with its clock set at the segment's beginning.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .apparatus import GRAVITY, Record
from .recording import Fault
from .simulation import SAMPLE, simulate

SEGMENT = 3.0  # swings: free swing and stick
PIECES = 3  # segments of a run
STRIDE = 5  # rows of a segment from one that counts to the next


@dataclass(frozen=True)
class Size:
    """Root mean squares in noise units, and how many samples they are over."""

    size: float
    raw: float
    samples: int


def swing(p: Record) -> float:
    """Time of one swing with its stick, s."""
    omega = np.sqrt(4 * p["stiffness"] / p["mass"])
    stretch = 2 * (p["mu_s"] - p["mu_k"]) * p["mass"] * GRAVITY / (4 * p["stiffness"])
    return float(2 * np.pi / omega + stretch / p["belt_speed"])


def segment_starts(p: Record, rows: int) -> tuple[list[int], int]:
    """First rows of the segments of a run and their length in rows."""
    length = min(round(SEGMENT * swing(p) / SAMPLE), (rows - 1) // PIECES)
    first = np.linspace(0, rows - 1 - length, PIECES).astype(int)
    return list(first), length


def fault_difference(what: Fault, amount: float, path: NDArray, begin: float, duration: float):
    """What a fault of the camera does to a segment's path, m, clock set at its first row."""
    t = begin + np.arange(len(path)) * SAMPLE
    written, shown = what(t, path, amount, duration)
    written = written - written[0] + begin
    return np.column_stack([np.interp(t, written, axis) for axis in shown.T]) - path


def perturbed(p: Record, name: str) -> Record:
    other = p.copy()
    other[name] *= 1.005
    return other


def run_pieces(
    plain: Record,
    rows: NDArray,
    noise: float,
    axes: int,
    step: float,
    fault: tuple[Fault, float] | None,
) -> list[tuple[NDArray, NDArray, NDArray]]:
    """Of each segment: difference (n,), what starts can do (n, 2 axes), what mu can do (n, 2)."""
    starts, length = segment_starts(plain, len(rows))
    found = []
    for first in starts:
        start, begin = rows[first], first * SAMPLE
        path = rows[first : first + length + 1, :2]

        def go(p: Record, row: NDArray, begin: float = begin) -> NDArray:
            return simulate(p, row, length * SAMPLE, begin=begin, step=step)[:, :2]

        base = go(plain, start)
        if fault:
            change = fault_difference(*fault, path, begin, len(rows) * SAMPLE)
        else:
            change = path - base
        moved = []
        for j in [0, 3, 1, 4][: 2 * axes]:
            other = start.copy()
            other[j] += 1e-4 if j < 3 else 1e-3
            moved.append(go(plain, other) - base)
        free = [go(perturbed(plain, name), start) - base for name in ("mu_s", "mu_k")]

        def flat(a: NDArray) -> NDArray:
            return (a[::STRIDE, :axes] / noise).ravel()

        shape = (flat(base).size, 0)
        nuisance = np.column_stack([flat(a) for a in moved]) if moved else np.empty(shape)
        found.append((flat(change), nuisance, np.column_stack([flat(a) for a in free])))
    return found


def clear(of: NDArray, what: NDArray) -> NDArray:
    """`what` (n, k) without its part in the span of the columns of `of`."""
    lengths = np.linalg.norm(of, axis=0)
    u, s, _ = np.linalg.svd(of[:, lengths > 0] / lengths[lengths > 0], full_matrices=False)
    u = u[:, s > 1e-6 * s.max(initial=0.0)]
    return what - u @ (u.T @ what)


def measure(
    plains: Sequence[Record],
    motions: Sequence[NDArray],
    noise: float,
    axes: int,
    step: float,
    fault: tuple[Fault, float] | None = None,
) -> Size:
    """Size of what is in the motions and not in the records `plains`.

    motions : rows of each run, every SAMPLE; axes : 1 x alone, 2 with y
    """
    parts, changes = [], []
    for plain, rows in zip(plains, motions, strict=True):
        pieces = run_pieces(plain, rows, noise, axes, step, fault)
        cleared = []
        for change, start, mu in pieces:
            zero = np.tile(np.eye(axes), (change.size // axes, 1))
            changes.append(change)
            cleared.append(clear(start, np.column_stack([change, mu, zero])))
        stacked = np.vstack(cleared)
        parts.append(clear(stacked[:, 3:], stacked[:, :3]))
    raw = np.concatenate(changes)
    total = np.vstack(parts)
    left = clear(total[:, 1:], total[:, :1])
    return Size(float(np.sqrt(np.mean(left**2))), float(np.sqrt(np.mean(raw**2))), len(left))

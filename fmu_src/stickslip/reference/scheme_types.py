"""What the compiled loop of the study's scheme reads and writes, and the study's constants."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

INTERVAL = 0.01  # s, the pieces of time that the study steps through
STEPS = 99  # a block is sampled at 100 instants
STEP = INTERVAL / STEPS
STICK_STEP = 20.0 / 1999.0  # s: 2000 samples over 20 s, the study's
ROW_STEPS = 11  # a row every ninth part of a block, 1.1 ms
LONGEST_SLIP_BLOCKS = 100  # fault F14

STICK, SLIP = 0, 1
# how a phase ended
BROKE_AWAY, STUCK_AGAIN, CUT, OUT_OF_TIME = 0, 1, 2, 3

ROW = 10  # t, x, y, phi, x', y', phi', force, moment, mode
PHASE = 5  # begin, end, mode, how it ended, jump of x' at the end


class SchemeRig(NamedTuple):
    """Rig and friction; SI units. Scatters are standard deviations."""

    mass: float
    inertia: float
    stiffness: float
    normal_force: float
    speed: float
    curvature: float
    mu_s: float
    mu_k: float
    mu_slope: float
    mu_k_speed: float
    static_scatter: float
    force_scatter: float
    moment_scatter: float
    correlation_length: float
    covered: float  # share of the disc's area that the strips have together
    reach: float
    spring_length: float
    updated: bool
    strip_wise: bool
    seed: int


class SchemeFaults(NamedTuple):
    """The faults as the loop reads them."""

    one_spring: bool
    white: bool
    on_grid: bool
    stale: bool
    mirrored: bool
    cut: bool
    lagging: bool


class Memory(NamedTuple):
    """What a run carries along, written in place, and the geometry's arrays."""

    q: np.ndarray  # x, y, phi
    v: np.ndarray
    before: np.ndarray  # velocities before the last block
    alpha: np.ndarray
    load: np.ndarray  # force, moment, lateral force
    mean: np.ndarray  # of the load, without scatter, on a block slower than the surface
    side: np.ndarray  # one number: 1 where the surface is faster than the block, else -1
    past: np.ndarray  # recent heat J, distance slid m, friction along x N
    attachment: np.ndarray
    beta: np.ndarray
    shares: np.ndarray
    middles: np.ndarray
    rows: np.ndarray
    phases: np.ndarray
    counts: np.ndarray  # rows and phases written

"""The compiled loop of the study's scheme: stick and slip in turn, slip in blocks of 10 ms."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from .linear_step import propagator, step
from .scheme_types import (
    BLOCK,
    BROKE_AWAY,
    CUT,
    LONGEST_SLIP_BLOCKS,
    OUT_OF_TIME,
    ROW_STEPS,
    SLIP,
    STEP,
    STEPS,
    STICK,
    STICK_STEP,
    STUCK_AGAIN,
)
from .spring_angles import stiffness_over_k, updated_angles
from .strip_friction import even_load, field_scatter, mean_load

BISECTIONS = 50  # halves 0.1 ms to below the resolution of a double


@njit(cache=True, nogil=True)
def run(rig, faults, memory, cycles, duration):
    """Stick and slip ``cycles`` times or until ``duration`` (s); rows and phases in ``memory``."""
    np.random.seed(rig.seed)
    t = 0.0
    memory.before[0] = rig.speed
    for _ in range(cycles):
        t = _stick(rig, faults, memory, t, duration)
        if t < duration:
            t = _slip(rig, faults, memory, t, duration)
        full = memory.counts[1] + 2 > memory.phases.shape[0]
        if t >= duration or full:
            break
    return t


@njit(cache=True, nogil=True)
def slide(rig, faults, memory, duration):
    """Slip alone for ``duration`` (s), never stopped by the surface's speed."""
    np.random.seed(rig.seed)
    t = 0.0
    _record(memory, t, SLIP)
    while t < duration:
        if rig.updated:
            _turn_springs(rig, faults, memory)
        t, _ = _block(rig, faults, memory, t, duration, True)
    _close(memory, 0.0, t, SLIP, OUT_OF_TIME, 0.0)
    return t


@njit(cache=True)
def _record(memory, t, mode):
    n = memory.counts[0]
    if n >= memory.rows.shape[0]:
        return
    row = memory.rows[n]
    row[0] = t
    row[1:4] = memory.q
    row[4:7] = memory.v
    row[7:9] = memory.load
    row[9] = mode
    memory.counts[0] = n + 1


@njit(cache=True)
def _close(memory, begin, end, mode, how, jump):
    phase = memory.phases[memory.counts[1]]
    phase[0] = begin
    phase[1] = end
    phase[2] = mode
    phase[3] = how
    phase[4] = jump
    memory.counts[1] += 1


@njit(cache=True)
def _stick(rig, faults, memory, t, until):
    """Carry the block with the surface until the springs break it away; returns the time."""
    springs = rig.stiffness if faults.one_spring else 4.0 * rig.stiffness
    mu = rig.mu_s
    if rig.static_scatter > 0.0:
        mu += rig.static_scatter * np.random.standard_normal()
    begin = t
    x0 = memory.q[0]
    threshold = mu * rig.normal_force / springs if springs > 0.0 else math.inf
    stay = max((threshold - x0) / rig.speed, 0.0)
    if faults.on_grid and stay < math.inf:  # the last sample before the springs reach the limit
        stay = max(math.ceil(stay / STICK_STEP) - 1, 0) * STICK_STEP
    end = min(begin + stay, until)
    memory.v[:] = 0.0
    memory.v[0] = rig.speed
    memory.load[1] = 0.0
    samples = int((end - begin) / STICK_STEP)
    for i in range(samples + 2):
        t = min(begin + i * STICK_STEP, end)
        memory.q[0] = x0 + rig.speed * (t - begin)
        memory.load[0] = springs * memory.q[0]
        _record(memory, t, STICK)
    _close(memory, begin, end, STICK, BROKE_AWAY if end < until else OUT_OF_TIME, 0.0)
    if faults.stale:
        memory.v[:] = memory.before
    return end


@njit(cache=True)
def _slip(rig, faults, memory, t, until):
    """Slide in blocks until the surface's speed is reached; returns the time."""
    begin = t
    how = CUT
    blocks = 0
    memory.before[:] = memory.v
    memory.side[0] = 1.0
    while True:
        if rig.updated and not faults.stale:
            _turn_springs(rig, faults, memory)
        t, reached = _block(rig, faults, memory, t, until, faults.on_grid)
        if faults.on_grid:
            reached = memory.v[0] >= rig.speed
        elif reached and 4.0 * rig.stiffness * abs(memory.q[0]) > rig.mu_s * rig.normal_force:
            reached = False  # friction cannot hold it: the block slides through
            memory.side[0] = -memory.side[0]
        if reached:
            how = STUCK_AGAIN
            break
        if rig.updated and faults.stale:
            _turn_springs(rig, faults, memory)
        blocks += 1
        # not reached by the block that ends a slip: its own beginning is what stays
        memory.before[:] = memory.v
        if faults.cut and blocks == LONGEST_SLIP_BLOCKS:
            break
        if t >= until:
            how = OUT_OF_TIME
            break
    _close(memory, begin, t, SLIP, how, rig.speed - memory.v[0])
    return t


@njit(cache=True)
def _turn_springs(rig, faults, memory):
    updated_angles(
        memory.q[2],
        memory.attachment,
        memory.beta,
        rig.reach,
        rig.spring_length,
        faults.mirrored,
        memory.alpha,
    )


@njit(cache=True)
def _block(rig, faults, memory, t, until, to_the_end):
    """One block of slip under constant spring angles; returns time and whether it re-stuck.

    Unless it goes ``to_the_end``, the block stops where the surface's speed is reached.
    """
    w = np.empty((3, 3))
    stiffness_over_k(memory.alpha, memory.attachment, w)
    w *= rig.stiffness / rig.mass
    w[2] *= rig.mass / rig.inertia
    prop = np.empty((5, 3, 3))
    propagator(w, STEP, prop)
    q1, v1 = np.empty(3), np.empty(3)
    load1 = np.empty(2)
    a0, a1 = np.zeros(3), np.zeros(3)
    begin = t
    if rig.strip_wise:
        mean_load(rig, memory.v, memory.shares, memory.middles, memory.mean)
    _scattered(rig, faults, memory, rig.speed * t - memory.q[0], memory.load)
    for i in range(STEPS):
        a0[0], a0[2] = memory.load[0] / rig.mass, memory.load[1] / rig.inertia
        step(prop, STEP, memory.q, memory.v, a0, a0, q1, v1)  # foresees where the load is taken
        if rig.strip_wise and not faults.lagging:
            even_load(rig, v1, memory.shares, memory.middles, memory.mean)
        _scattered(rig, faults, memory, rig.speed * (t + STEP) - q1[0], load1)
        a1[0], a1[2] = load1[0] / rig.mass, load1[1] / rig.inertia
        step(prop, STEP, memory.q, memory.v, a0, a1, q1, v1)
        if not to_the_end and memory.side[0] * (v1[0] - rig.speed) >= 0.0:
            share = _reach(rig, memory, w, a0, a1)
            memory.load[:] = memory.load + share * (load1 - memory.load)
            t += share * STEP
            _record(memory, t, SLIP)
            return t, True
        memory.q[:] = q1
        memory.v[:] = v1
        memory.load[:] = load1
        t = begin + (i + 1) * STEP
        if (i + 1) % ROW_STEPS == 0:
            _record(memory, t, SLIP)
        if t >= until:
            return t, False
    return begin + BLOCK, False


@njit(cache=True)
def _scattered(rig, faults, memory, place, load):
    """Write mean load and scatter at ``place`` (m) on the surface into ``load``."""
    load[:] = memory.side[0] * memory.mean
    if rig.force_scatter == 0.0:
        return
    normals = np.empty(2)
    if faults.white:
        normals[0] = np.random.standard_normal()
        normals[1] = np.random.standard_normal()
    else:
        field_scatter(rig.seed, place, rig.correlation_length, normals)
    load[0] += rig.force_scatter * normals[0]
    load[1] += rig.moment_scatter * normals[1]


@njit(cache=True)
def _reach(rig, memory, w, a0, a1):
    """Advance ``memory`` to where x' meets the surface's speed within a step: share of it."""
    side = memory.side[0]
    if side * (memory.v[0] - rig.speed) >= 0.0:
        # friction would drag the block past the surface's speed: it stays with it
        memory.q[0] += rig.speed * STEP
        memory.v[:] = 0.0
        memory.v[0] = rig.speed
        return 1.0
    early, late = 0.0, 1.0
    prop = np.empty((5, 3, 3))
    q1, v1, a = np.empty(3), np.empty(3), np.empty(3)
    for _ in range(BISECTIONS):
        middle = 0.5 * (early + late)
        propagator(w, middle * STEP, prop)
        a[:] = a0 + middle * (a1 - a0)
        step(prop, middle * STEP, memory.q, memory.v, a0, a, q1, v1)
        if side * (v1[0] - rig.speed) >= 0.0:
            late = middle
        else:
            early = middle
    memory.q[:] = q1
    memory.v[:] = v1
    return late

"""The compiled loop of the study's scheme: stick and slip in turn, slip in blocks of 10 ms."""

from __future__ import annotations

import numpy as np
from numba import njit

from .linear_step import propagator, step
from .linearised_stick import BISECTIONS, close, record, stick
from .scheme_effects import (
    add_spring_and_damping_load,
    friction_load,
    held_in_stick,
    load_in_stick,
    remember,
    surface_speed,
    turn_springs,
)
from .scheme_types import (
    CUT,
    INTERVAL,
    LONGEST_SLIP_BLOCKS,
    OUT_OF_TIME,
    ROW_STEPS,
    SLIP,
    STEP,
    STEPS,
    STUCK_AGAIN,
)
from .spring_angles import stiffness_over_k, updated_angles
from .strip_friction import even_load, field_scatter, mean_load


@njit(cache=True, nogil=True)
def run(rig, faults, effects, memory, cycles, duration):
    """Stick and slip ``cycles`` times or until ``duration`` (s); rows and phases in ``memory``."""
    np.random.seed(rig.seed)
    t = 0.0
    memory.before[0] = rig.speed
    for _ in range(cycles):
        t = stick(rig, faults, effects, memory, t, duration)
        if t < duration:
            t = _slip(rig, faults, effects, memory, t, duration)
        full = memory.counts[1] + 2 > memory.phases.shape[0]
        if t >= duration or full:
            break
    return t


@njit(cache=True, nogil=True)
def slide(rig, faults, effects, memory, duration):
    """Slip alone for ``duration`` (s), never stopped by the surface's speed."""
    np.random.seed(rig.seed)
    t = 0.0
    record(memory, t, SLIP)
    while t < duration:
        if rig.updated:
            _turn_springs(rig, faults, effects, memory)
        t, _ = _block(rig, faults, effects, memory, t, duration, True)
    close(memory, 0.0, t, SLIP, OUT_OF_TIME, 0.0)
    return t


@njit(cache=True)
def _slip(rig, faults, effects, memory, t, until):
    """Slide in blocks until the surface's speed is reached; returns the time."""
    begin = t
    how = CUT
    blocks = 0
    memory.before[:] = memory.v
    memory.side[0] = 1.0
    while True:
        if rig.updated and not faults.stale:
            _turn_springs(rig, faults, effects, memory)
        t, reached = _block(rig, faults, effects, memory, t, until, faults.on_grid)
        if faults.on_grid:
            reached = memory.v[0] >= surface_speed(rig, effects, t)
        elif reached and not _holds(rig, effects, memory, t):
            reached = False  # the block slides through
            memory.side[0] = -memory.side[0]
        if reached:
            how = STUCK_AGAIN
            break
        if rig.updated and faults.stale:
            _turn_springs(rig, faults, effects, memory)
        blocks += 1
        # not reached by the block that ends a slip: its own beginning is what stays
        memory.before[:] = memory.v
        if faults.cut and blocks == LONGEST_SLIP_BLOCKS:
            break
        if t >= until:
            how = OUT_OF_TIME
            break
    close(memory, begin, t, SLIP, how, surface_speed(rig, effects, t) - memory.v[0])
    return t


@njit(cache=True)
def _holds(rig, effects, memory, t):
    """Can friction keep the block on the surface, along x?"""
    load = load_in_stick(rig, effects, t, memory.q[0])
    return abs(load) <= held_in_stick(rig, effects, t, 0.0, memory.q[0])


@njit(cache=True)
def _turn_springs(rig, faults, effects, memory):
    updated_angles(
        memory.q[2],
        memory.attachment,
        memory.beta,
        rig.reach,
        rig.spring_length,
        faults.mirrored,
        memory.alpha,
    )
    if effects.on:
        turn_springs(effects, memory.attachment, rig.spring_length, memory.alpha)


@njit(cache=True)
def _block(rig, faults, effects, memory, t, until, to_the_end):
    """One block of slip under constant spring angles; returns time and whether it re-stuck.

    Unless it goes ``to_the_end``, the block stops where the surface's speed is reached.
    """
    w, prop = np.empty((3, 3)), np.empty((5, 3, 3))
    _propagate(rig, memory, w, prop)
    q1, v1, load1 = np.empty(3), np.empty(3), np.empty(3)
    a0, a1 = np.empty(3), np.empty(3)
    begin = t
    past, side, mean = memory.past, memory.side, memory.mean
    shares, middles = memory.shares, memory.middles
    alpha, attachment = memory.alpha, memory.attachment
    if rig.strip_wise:
        mean_load(rig, memory.v, memory.shares, memory.middles, memory.mean)
    # only a load that depends on the state needs a look ahead to where it is taken
    ahead = effects.on or not faults.white or (rig.strip_wise and not faults.lagging)
    if effects.on:
        friction_load(
            rig, effects, past, side, mean, shares, middles, t, memory.q, memory.v, memory.load
        )
        add_spring_and_damping_load(effects, alpha, attachment, memory.q, memory.v, memory.load)
    else:
        _plain_load(memory, memory.load)
    if rig.force_scatter > 0.0:
        _add_scatter(rig, faults, rig.speed * t - memory.q[0], memory.load)
    for i in range(STEPS):
        _accelerate(rig, memory.load, a0)
        if ahead:
            step(prop, STEP, memory.q, memory.v, a0, a0, q1, v1)
        if rig.strip_wise and not faults.lagging:
            even_load(rig, v1, memory.shares, memory.middles, memory.mean)
        if effects.on:
            friction_load(rig, effects, past, side, mean, shares, middles, t + STEP, q1, v1, load1)
            add_spring_and_damping_load(effects, alpha, attachment, q1, v1, load1)
        else:
            _plain_load(memory, load1)
        if rig.force_scatter > 0.0:
            _add_scatter(rig, faults, rig.speed * (t + STEP) - q1[0], load1)
        _accelerate(rig, load1, a1)
        step(prop, STEP, memory.q, memory.v, a0, a1, q1, v1)
        speed = rig.speed
        if effects.on:
            speed = surface_speed(rig, effects, t + STEP)
        if not to_the_end and memory.side[0] * (v1[0] - speed) >= 0.0:
            share = _reach(rig, effects, memory, t, w, a0, a1)
            memory.load[:] = memory.load + share * (load1 - memory.load)
            t += share * STEP
            record(memory, t, SLIP)
            return t, True
        memory.q[:], memory.v[:], memory.load[:] = q1, v1, load1
        t = begin + (i + 1) * STEP
        if effects.on:
            remember(rig, effects, past, t, v1, STEP)
        if (i + 1) % ROW_STEPS == 0:
            record(memory, t, SLIP)
        if t >= until:
            return t, False
    return begin + INTERVAL, False


@njit(cache=True)
def _propagate(rig, memory, w, prop):
    """Write W = M^-1 K under the present spring angles, and the step's matrices."""
    stiffness_over_k(memory.alpha, memory.attachment, w)
    w *= rig.stiffness / rig.mass
    w[2] *= rig.mass / rig.inertia
    propagator(w, STEP, prop)


@njit(cache=True)
def _accelerate(rig, load, a):
    a[0] = load[0] / rig.mass
    a[1] = load[2] / rig.mass
    a[2] = load[1] / rig.inertia


@njit(cache=True)
def _plain_load(memory, load):
    load[0] = memory.side[0] * memory.mean[0]
    load[1] = memory.side[0] * memory.mean[1]
    load[2] = 0.0


@njit(cache=True)
def _add_scatter(rig, faults, place, load):
    """Add the scatter of friction at ``place`` (m) on the surface to ``load``."""
    normals = np.empty(2)
    if faults.white:
        normals[0] = np.random.standard_normal()
        normals[1] = np.random.standard_normal()
    else:
        field_scatter(rig.seed, place, rig.correlation_length, normals)
    load[0] += rig.force_scatter * normals[0]
    load[1] += rig.moment_scatter * normals[1]


@njit(cache=True)
def _reach(rig, effects, memory, t, w, a0, a1):
    """Advance ``memory`` to where x' meets the surface's speed within a step: share of it."""
    side = memory.side[0]
    speed = surface_speed(rig, effects, t)
    if side * (memory.v[0] - speed) >= 0.0:
        # friction would drag the block past the surface's speed: it stays with it
        memory.q[0] += speed * STEP
        memory.v[:] = 0.0
        memory.v[0] = speed
        return 1.0
    early, late = 0.0, 1.0
    prop = np.empty((5, 3, 3))
    q1, v1, a = np.empty(3), np.empty(3), np.empty(3)
    for _ in range(BISECTIONS):
        middle = 0.5 * (early + late)
        propagator(w, middle * STEP, prop)
        a[:] = a0 + middle * (a1 - a0)
        step(prop, middle * STEP, memory.q, memory.v, a0, a, q1, v1)
        if side * (v1[0] - surface_speed(rig, effects, t + middle * STEP)) >= 0.0:
            late = middle
        else:
            early = middle
    memory.q[:] = q1
    memory.v[:] = v1
    return late

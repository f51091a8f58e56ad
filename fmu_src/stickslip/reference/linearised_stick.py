"""Stick in the study's scheme, and the rows and phases that its compiled loop writes."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from .scheme_effects import RECENT_HEAT, held_in_stick, load_in_stick, surface_speed, surface_travel
from .scheme_types import BROKE_AWAY, OUT_OF_TIME, STICK, STICK_STEP

BISECTIONS = 50  # halves 10 ms or 0.1 ms to below the resolution of a double


@njit(cache=True)
def record(memory, t, mode):
    """Write a row: time, q, velocity, load, mode."""
    n = memory.counts[0]
    if n >= memory.rows.shape[0]:
        return
    row = memory.rows[n]
    row[0] = t
    row[1:4] = memory.q
    row[4:7] = memory.v
    row[7:9] = memory.load[:2]
    row[9] = mode
    memory.counts[0] = n + 1


@njit(cache=True)
def close(memory, begin, end, mode, how, jump):
    """Write a phase that has ended."""
    phase = memory.phases[memory.counts[1]]
    phase[0] = begin
    phase[1] = end
    phase[2] = mode
    phase[3] = how
    phase[4] = jump
    memory.counts[1] += 1


@njit(cache=True)
def stick(rig, faults, effects, memory, t, until):
    """Carry the block with the surface until the springs break it away; returns the time."""
    share = 0.25 if faults.one_spring else 1.0
    if effects.stick_springs > 0.0:
        share = 0.25 * effects.stick_springs
    springs = 4.0 * share * rig.stiffness
    extra = 0.0
    if rig.static_scatter > 0.0:
        extra = rig.static_scatter * np.random.standard_normal()
    begin = t
    x0 = memory.q[0]
    if effects.on:
        end = _break_away(rig, faults, effects, share, extra * rig.normal_force, x0, t, until)
        memory.past[RECENT_HEAT] *= math.exp((begin - end) / effects.relaxation)
    else:
        limit = (rig.mu_s + extra) * rig.normal_force
        threshold = limit / springs if springs > 0.0 else math.inf
        stay = max((threshold - x0) / rig.speed, 0.0)
        if faults.on_grid and stay < math.inf:  # the last sample before the limit is reached
            stay = max(math.ceil(stay / STICK_STEP) - 1, 0) * STICK_STEP
        end = min(begin + stay, until)
    memory.v[:] = 0.0
    memory.load[1] = 0.0
    samples = int((end - begin) / STICK_STEP)
    for i in range(samples + 2):
        t = min(begin + i * STICK_STEP, end)
        memory.q[0] = _carried(rig, effects, x0, begin, t)
        memory.v[0] = surface_speed(rig, effects, t)
        memory.load[0] = springs * memory.q[0]
        record(memory, t, STICK)
    close(memory, begin, end, STICK, BROKE_AWAY if end < until else OUT_OF_TIME, 0.0)
    if faults.stale:
        memory.v[:] = memory.before
    return end


@njit(cache=True)
def _carried(rig, effects, x0, begin, t):
    """Place of a block that the surface has carried since ``begin``, m."""
    if effects.ripple == 0.0:
        return x0 + rig.speed * (t - begin)
    return x0 + surface_travel(rig, effects, t) - surface_travel(rig, effects, begin)


@njit(cache=True)
def _lets_go(rig, effects, share, extra, t, hold, x):
    held = held_in_stick(rig, effects, t, hold, x) + extra
    return share * load_in_stick(rig, effects, t, x) >= held


@njit(cache=True)
def _break_away(rig, faults, effects, share, extra, x0, begin, until):
    """When the load in stick reaches what the contact holds (``extra`` N more than its mean)."""
    before = begin
    i = 0
    while True:
        t = begin + i * STICK_STEP
        x = _carried(rig, effects, x0, begin, t)
        if _lets_go(rig, effects, share, extra, t, t - begin, x):
            break
        if t >= until:
            return until
        before = t
        i += 1
    if faults.on_grid or i == 0:
        return before
    late = t
    for _ in range(BISECTIONS):
        middle = 0.5 * (before + late)
        x = _carried(rig, effects, x0, begin, middle)
        if _lets_go(rig, effects, share, extra, middle, middle - begin, x):
            late = middle
        else:
            before = middle
    return late

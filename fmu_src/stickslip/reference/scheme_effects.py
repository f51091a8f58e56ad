"""Effects of the catalogue in the study's scheme: added to its loads, all off by default.

What each effect is stands in `stickslip.effects`; here it takes the form that the scheme's own
elements allow: springs linear in x, y and phi, a disc of strips along y, stick judged along x.
With all faults mended and the block guided along x it is the kernel's (the tests hold it to that).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from numba import njit


class SchemeEffects(NamedTuple):
    """Numbers of the effects; SI units, rad. `on` says whether there are any.

    stick_springs: springs counted in stick, 0 for what fault F1 says.
    """

    on: bool = False
    stick_springs: float = 0.0
    lateral: float = 0.0
    strengthening: float = 0.0
    hold_time: float = 0.01
    film: float = 0.0
    weakening_per_joule: float = 0.0
    relaxation: float = 5.0
    run_in: float = 0.0
    run_in_distance: float = 1.0
    cubic: float = 0.0
    damping: float = 0.0
    damping_rotation: float = 0.0
    ripple: float = 0.0
    ripple_rate: float = 1.0
    ripple_phase: float = 0.0
    pattern: float = 0.0
    pattern_wavenumber: float = 1.0
    pattern_phase: float = 0.0
    spring_angle: float = 0.0
    anchor_offset: float = 0.0


NO_EFFECTS = SchemeEffects()

RECENT_HEAT, DISTANCE, FRICTION = 0, 1, 2  # places in the memory of what has been
SMALLEST_SLIDING = 1e-9  # m/s, below which a strip's sliding has no direction
# neighbouring strips that share a direction: twenty directions leave 1e-3 of the spin moment open
TOGETHER = 5


@njit(cache=True)
def surface_speed(rig, effects, t):
    """Speed of the surface, m/s (speed_ripple)."""
    if effects.ripple == 0.0:
        return rig.speed
    angle = effects.ripple_rate * t + effects.ripple_phase
    return rig.speed * (1.0 + effects.ripple * math.sin(angle))


@njit(cache=True)
def surface_travel(rig, effects, t):
    """Travel of the surface since the start, m."""
    travel = rig.speed * t
    if effects.ripple != 0.0:
        start, now = effects.ripple_phase, effects.ripple_rate * t + effects.ripple_phase
        travel += (
            rig.speed * effects.ripple / effects.ripple_rate * (math.cos(start) - math.cos(now))
        )
    return travel


@njit(cache=True)
def place_factor(effects, place):
    """Friction of a place on the surface over its mean (surface_pattern)."""
    if effects.pattern == 0.0:
        return 1.0
    angle = effects.pattern_wavenumber * place + effects.pattern_phase
    return max(0.0, 1.0 + effects.pattern * math.cos(angle))


@njit(cache=True)
def kinetic_factor(effects, past, place):
    """mu_k over its value at the start: place, recent heat and distance slid."""
    factor = place_factor(effects, place)
    factor *= max(0.0, 1.0 - effects.weakening_per_joule * past[RECENT_HEAT])
    if effects.run_in != 0.0:
        drift = 1.0 - math.exp(-past[DISTANCE] / effects.run_in_distance)
        factor *= max(0.0, 1.0 + effects.run_in * drift)
    return factor


@njit(cache=True)
def load_in_stick(rig, effects, t, x):
    """Load on the contact along -x, N: springs, damping and the block's own inertia."""
    angle = effects.ripple_rate * t + effects.ripple_phase
    acceleration = rig.speed * effects.ripple * effects.ripple_rate * math.cos(angle)
    load = 4.0 * (rig.stiffness * x + effects.cubic * x**3)
    return load + effects.damping * surface_speed(rig, effects, t) + rig.mass * acceleration


@njit(cache=True)
def held_in_stick(rig, effects, t, hold, x):
    """What the contact holds after ``hold`` (s) of stick, N."""
    mu = rig.mu_s * place_factor(effects, x - surface_travel(rig, effects, t))
    if effects.strengthening != 0.0:
        mu += effects.strengthening * math.log10(1.0 + hold / effects.hold_time)
    return mu * rig.normal_force


@njit(cache=True)
def friction_load(rig, effects, past, side, mean, shares, middles, t, q, v, load):
    """Write friction (force, moment, lateral force) under the effects into ``load`` (3,).

    side, mean, shares, middles, past: those of the scheme's memory, one by one, because handing
    over the whole of it at every step costs more than the physics.
    """
    factor = kinetic_factor(effects, past, q[0] - surface_travel(rig, effects, t))
    if effects.lateral > 0.0:
        _planar_load(rig, effects, shares, middles, factor, t, q, v, load)
    else:
        load[0] = side[0] * factor * mean[0]
        load[1] = side[0] * factor * mean[1]
        load[2] = 0.0
    load[0] += effects.film * (surface_speed(rig, effects, t) - v[0])
    past[FRICTION] = load[0]


@njit(cache=True)
def _planar_load(rig, effects, shares, middles, factor, t, q, v, load):
    """Friction of every strip against its own sliding velocity (lateral_friction).

    The strips lie along y, so a lateral force has no arm. The surface under a strip moves with
    v (1 - Y/R, x/R): with a curvature it carries the block sideways.
    """
    kappa = effects.lateral
    speed = surface_speed(rig, effects, t)
    across = kappa * (speed * rig.curvature * q[0] - v[1])
    centre = speed * (1.0 - rig.curvature * q[1]) - v[0]
    spin = kappa * (v[2] - speed * rig.curvature)
    load[:] = 0.0
    for j in range(TOGETHER // 2, shares.size, TOGETHER):
        share = 0.0
        for i in range(j - TOGETHER // 2, j + TOGETHER // 2 + 1):
            share += shares[i]
        y = middles[j]
        along = centre + spin * y
        sliding = max(math.sqrt(along * along + across * across), SMALLEST_SLIDING)
        mu = max(rig.mu_k - rig.mu_slope * (sliding - rig.mu_k_speed), 0.0)
        force = factor * mu * share * rig.normal_force / sliding
        load[0] += force * along
        load[1] -= kappa * force * along * y
        load[2] += kappa * force * across


@njit(cache=True)
def add_spring_and_damping_load(effects, alpha, attachment, q, v, load):
    """Add what the cubic term of the springs and the damping put on the block to ``load`` (3,)."""
    load[0] -= effects.damping * v[0]
    load[2] -= effects.damping * v[1]
    load[1] -= effects.damping_rotation * v[2]
    if effects.cubic == 0.0:
        return
    for i in range(4):
        c, d = math.cos(alpha[i]), math.sin(alpha[i])
        arm = d * attachment[i, 0] - c * attachment[i, 1]
        extension = c * q[0] + d * q[1] + arm * q[2]
        pull = effects.cubic * extension**3
        load[0] -= pull * c
        load[1] -= pull * arm
        load[2] -= pull * d


@njit(cache=True)
def turn_springs(effects, attachment, length, alpha):
    """Add the misalignment to the spring angles (4,); springs of either side lean opposite ways
    where the anchors are shifted."""
    for i in range(4):
        lean = math.atan2(effects.anchor_offset, length)
        alpha[i] += effects.spring_angle + (lean if attachment[i, 0] > 0.0 else -lean)


@njit(cache=True)
def remember(rig, effects, past, t, v, h):
    """Carry the lumped thermal state and the distance over a step ``h`` (s) of slip or stick."""
    sliding = abs(surface_speed(rig, effects, t) - v[0])
    heat = abs(past[FRICTION]) * sliding
    past[RECENT_HEAT] += h * (heat - past[RECENT_HEAT] / effects.relaxation)
    past[DISTANCE] += h * sliding

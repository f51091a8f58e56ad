"""Bristles between block and surface: the law of LuGre, for a disc in the plane.

A contact is sheared before it slides. Bristles of the stiffness sigma_0 = mu_s N / z_0 are bent by
z and give way at the friction N g(u) of a slip (Canudas de Wit, Olsson, Astrom & Lischinsky, IEEE
Trans. Automat. Contr. 40, 1995),

    F = -(sigma_0 z + sigma_1 z'),    z' = u - sigma_0 |u| z / (N g(u)),

with the coefficient g that falls from mu_s to mu_k over v_s, see `friction.coefficient`; sigma_1 is
a part of the critical damping 2 sqrt(sigma_0 m).

In the plane z has parts (z_x, z_y) of the slide and z_r of the spin, in the scaled velocities
(U_x, kappa U_y, kappa a Omega). Shear is uniform over the contact as long as nothing gives way, so
that the stiffness against a turn is a^2 sigma_0 / 2. With force f and moment m of the sliding disc,
per N and N a and with g in them,

    z_s' = s_s - (sigma_0 |s_s| / (N f)) z_s,    z_r' = s_r - (sigma_0 |s_r| / (2 N m)) z_r:

steady sliding has the disc's friction, and along x alone this is the law above. What lies between
is lumped: each point of the disc would have bristles of its own.

In a slip much faster than v_s the bristles only follow: they are left out there (BRISTLES is 0), z
stays as it was, and friction is that of a slip, see `friction.force`.
"""

from math import sqrt

from ..contact import (
    holding_ratio,
    scale_sliding,
    scaled_sliding_speed,
    set_contact,
    set_holding_load,
)
from ..friction.force import add_contact_drag, set_sliding_coefficients
from ..layout import *
from ..steady_sliding import LOOK_AHEAD

# Of its friction that a contact keeps where a law leaves it none: without a limit bristles would
# give way faster than any step could follow.
LEAST_FRICTION = 1e-3
# Slide over spin, or spin over slide, below which one is as good as none: rounding of the
# quadrature over the contact would be all that is left of its friction.
NEXT_TO_NONE = 1e-12


def has_bristles(p: Floats) -> bool:
    """Is the contact sheared before it slides?"""
    return p[P_BRISTLE_STIFFNESS] > 0.0


def least_friction(p: Floats) -> float:
    """Friction that a contact with bristles always has, N."""
    return LEAST_FRICTION * max(p[P_MU_S], p[P_MU_K]) * p[P_NORMAL_FORCE]


def yield_rate(p: Floats, own: float, other: float, limit: float, whole: float) -> float:
    """Rate at which bristles give way, 1/s: sigma_0 own / limit.

    own, other: speeds of the slide and the spin or the other way round, m/s; limit: friction
    against the first, N, and ``whole`` what stands for it where the first is next to none.
    """
    if own > NEXT_TO_NONE * other:
        return p[P_BRISTLE_STIFFNESS] * own / max(limit, own / (own + other) * least_friction(p))
    return p[P_BRISTLE_STIFFNESS] * other / max(whole, least_friction(p))


def set_bristle_friction(p: Floats, u: Floats, w: Floats) -> None:
    """Friction of the sheared contact in ``w``, its rates of shear and mean sliding speed.

    Into ``w[W_FRICTION:]`` (N, N, N m), ``w[W_SHEARING:]`` and ``w[W_MEAN_SPEED]`` (m/s).
    """
    kappa = p[P_LATERAL]
    arm = kappa * p[P_RADIUS]
    stiffness = p[P_BRISTLE_STIFFNESS]
    damping = p[P_BRISTLE_DAMPING]
    sx = w[W_SCALED]
    sy = w[W_SCALED + 1]
    sr = w[W_SCALED + 2]
    set_sliding_coefficients(p, u, w, sx, sy, sr)
    force = p[P_NORMAL_FORCE] * w[W_PAIR]
    moment = p[P_NORMAL_FORCE] * w[W_PAIR + 1]
    sliding = sqrt(sx * sx + sy * sy)
    spinning = abs(sr)
    # f = mu U/s at next to no slide, m = mu s/(4 U) at next to no spin; all spin has m = 2 mu / 3
    slide = yield_rate(p, sliding, spinning, force, 1.5 * moment)
    spin = yield_rate(p, spinning, sliding, 2.0 * moment, 0.5 * force)
    w[W_YIELD_RATE] = max(slide, spin)
    w[W_SHEARING] = sx - slide * w[W_STATE + SHEAR_X]
    w[W_SHEARING + 1] = sy - slide * w[W_STATE + SHEAR_X + 1]
    w[W_SHEARING + 2] = sr - spin * w[W_STATE + SHEAR_X + 2]
    w[W_FRICTION] = -(stiffness * w[W_STATE + SHEAR_X] + damping * w[W_SHEARING])
    across = stiffness * w[W_STATE + SHEAR_X + 1] + damping * w[W_SHEARING + 1]
    turning = stiffness * w[W_STATE + SHEAR_X + 2] + damping * w[W_SHEARING + 2]
    w[W_FRICTION + 1] = -kappa * across
    w[W_FRICTION + 2] = -0.5 * arm * turning
    add_contact_drag(p, w, sx, sy, sr)


def storing_power(p: Floats, w: Floats) -> float:
    """Rate of the bristles' energy, W, from their rates of shear in ``w``."""
    power = w[W_STATE + SHEAR_X] * w[W_SHEARING] + w[W_STATE + SHEAR_X + 1] * w[W_SHEARING + 1]
    power += 0.5 * w[W_STATE + SHEAR_X + 2] * w[W_SHEARING + 2]
    return p[P_BRISTLE_STIFFNESS] * power


def bristle_energy(p: Floats, z: Floats, instant: int) -> float:
    """Energy of the bristles at an instant in ``z``, J."""
    zx = z[instant + SHEAR_X]
    zy = z[instant + SHEAR_X + 1]
    zr = z[instant + SHEAR_X + 2]
    return 0.5 * p[P_BRISTLE_STIFFNESS] * (zx * zx + zy * zy + 0.5 * zr * zr)


def set_sliding_shear(p: Floats, u: Floats, z: Floats, w: Floats, instant: int) -> None:
    """Shear of a contact that slides steadily as in ``w``, not at rest, into ``z``."""
    sx = w[W_SCALED]
    sy = w[W_SCALED + 1]
    sr = w[W_SCALED + 2]
    set_sliding_coefficients(p, u, w, sx, sy, sr)
    sliding = sqrt(sx * sx + sy * sy)
    most = p[P_NORMAL_FORCE] / p[P_BRISTLE_STIFFNESS]
    for i in range(3):
        z[instant + SHEAR_X + i] = 0.0
    if sliding > 0.0:
        z[instant + SHEAR_X] = most * w[W_PAIR] * sx / sliding
        z[instant + SHEAR_X + 1] = most * w[W_PAIR] * sy / sliding
    if sr != 0.0:
        z[instant + SHEAR_X + 2] = 2.0 * most * w[W_PAIR + 1] * sr / abs(sr)


def set_holding_shear(p: Floats, u: Floats, z: Floats, w: Floats, instant: int) -> None:
    """Shear of a contact at rest that holds the loads in ``w``, or all it can, into ``z``."""
    kappa = p[P_LATERAL]
    set_holding_load(p, w)
    share = 1.0 / (p[P_BRISTLE_STIFFNESS] * max(1.0, holding_ratio(p, u, w)))
    z[instant + SHEAR_X] = -share * w[W_FRICTION]
    z[instant + SHEAR_X + 1] = 0.0
    z[instant + SHEAR_X + 2] = 0.0
    if kappa > 0.0:
        z[instant + SHEAR_X + 1] = -share * w[W_FRICTION + 1] / kappa
        z[instant + SHEAR_X + 2] = -2.0 * share * w[W_FRICTION + 2] / (kappa * p[P_RADIUS])


def set_presliding_shear(p: Floats, u: Floats, z: Floats, w: Floats, instant: int) -> None:
    """Shear and velocity of a contact whose load grows as the surface carries the block along.

    z' is the rate of the load over sigma_0, and F the load; the sliding velocity s that has this
    solves s = z' + r(s) z, with the rate of yielding r, by iteration. Inertia is left out.
    """
    ahead = LOOK_AHEAD / p[P_RATE]
    for i in range(3):
        w[W_STEADY + i] = z[instant + SHEAR_X + i]  # under the load now
    for i in range(3):
        w[W_STATE + X + i] += ahead * w[W_STATE + VX + i]
    w[W_STATE + TIME] += ahead
    set_contact(p, u, w, W_STATE)
    set_holding_shear(p, u, z, w, instant)
    for i in range(3):
        w[W_STATE + X + i] -= ahead * w[W_STATE + VX + i]
        w[W_DIRECTION + i] = (z[instant + SHEAR_X + i] - w[W_STEADY + i]) / ahead
        delay = p[P_BRISTLE_DAMPING] / p[P_BRISTLE_STIFFNESS]
        z[instant + SHEAR_X + i] = w[W_STEADY + i] - delay * w[W_DIRECTION + i]
        w[W_STATE + SHEAR_X + i] = z[instant + SHEAR_X + i]
        w[W_SLIDING + i] = 0.0
        w[W_SCALED + i] = 0.0
    w[W_STATE + TIME] -= ahead
    most = p[P_TRANSITION_SPEED]
    change = most
    sweep = 0
    while change > 1e-9 * most and sweep < 100:
        set_bristle_friction(p, u, w)
        square = 0.0
        for i in range(3):
            off = w[W_DIRECTION + i] - w[W_SHEARING + i]
            square += off * off
            if p[P_SCALES + i] > 0.0:
                w[W_SLIDING + i] += off / p[P_SCALES + i]
        change = sqrt(square)
        scale_sliding(p, w)
        if scaled_sliding_speed(w) > most:  # no load that grows is held any more
            sweep = 100
        sweep += 1
    if sweep < 100:
        for i in range(3):
            z[instant + VX + i] += p[P_FREE + i] * w[W_SLIDING + i]


def yielding_share(p: Floats, w: Floats) -> float:
    """Part of the sliding that the bristles do not follow, from `set_bristle_friction`.

    0 for bristles without load, 1 in steady sliding; below 0 where they spring back.
    """
    sx = w[W_SCALED]
    sy = w[W_SCALED + 1]
    sr = w[W_SCALED + 2]
    size = sx * sx + sy * sy + 0.5 * sr * sr
    if size == 0.0:
        return 0.0
    follow = sx * w[W_SHEARING] + sy * w[W_SHEARING + 1] + 0.5 * sr * w[W_SHEARING + 2]
    return 1.0 - follow / size

"""Friction coefficients, and the friction on a contact that slides.

One formula serves friction along x and friction along the local velocity. With the ratio kappa
(`P_LATERAL`) the contact feels the scaled sliding velocity (U_x, kappa U_y, kappa Omega) and
answers with (F_x, kappa F_y, kappa M): at kappa = 1 the isotropic disc, at kappa = 0 a force
along x alone. The scaling is that of an elliptic dissipation potential, so friction opposes the
motion for every kappa.
"""

from math import sqrt

from .disc import disc_friction
from .layout import (
    P_LATERAL,
    P_MU_K,
    P_MU_S,
    P_NORMAL_FORCE,
    P_RADIUS,
    P_REFERENCE,
    P_SENSITIVITY,
    U_TEMPERATURE,
    W_FRICTION,
    W_MEAN_SPEED,
    W_PAIR,
)


def kinetic_coefficient(p: "float[:]", u: "float[:]") -> float:
    """mu_k at the interface temperature: linear, constant above the melting point (0 degC)."""
    temperature = min(u[U_TEMPERATURE], 0.0)
    return max(0.0, p[P_MU_K] * (1.0 - p[P_SENSITIVITY] * (temperature - p[P_REFERENCE])))


def holding_coefficient(p: "float[:]", u: "float[:]") -> float:
    """Coefficient that a contact at rest can hold: mu_s, or mu_k where that is larger.

    With mu_k > mu_s a block that breaks away at mu_s is stopped at once; at rest it therefore
    holds up to mu_k.
    """
    return max(p[P_MU_S], kinetic_coefficient(p, u))


def friction_along(p: "float[:]", u: "float[:]", w: "float[:]", sx: float, sy: float, sr: float):
    """Friction against the scaled sliding velocity (sx, sy, sr), not zero; sr is a rim speed.

    Writes force and moment on the block to ``w[W_FRICTION:]`` (N, N, N m) and the mean local
    sliding speed to ``w[W_MEAN_SPEED]`` (m/s).
    """
    limit = kinetic_coefficient(p, u) * p[P_NORMAL_FORCE]
    kappa = p[P_LATERAL]
    sliding = sqrt(sx * sx + sy * sy)
    disc_friction(sliding, abs(sr), w)
    force = w[W_PAIR]
    moment = w[W_PAIR + 1]
    w[W_MEAN_SPEED] = force * sliding + moment * abs(sr)
    w[W_FRICTION] = 0.0
    w[W_FRICTION + 1] = 0.0
    w[W_FRICTION + 2] = 0.0
    if sliding > 0.0:
        w[W_FRICTION] = -limit * force * sx / sliding
        w[W_FRICTION + 1] = -limit * kappa * force * sy / sliding
    if sr > 0.0:
        w[W_FRICTION + 2] = -limit * kappa * p[P_RADIUS] * moment
    elif sr < 0.0:
        w[W_FRICTION + 2] = limit * kappa * p[P_RADIUS] * moment

"""Motion of a contact that sticks: with the surface, or presliding against it under its load.

A contact is sheared before it slides. With a presliding speed v_c the surface leaves the block
behind as if the contact were a film (regularised Coulomb friction) of the viscosity
eta = mu_s N / v_c:

    F_x = -eta U_x,   F_y = -kappa^2 eta U_y,   M = -kappa^2 eta (a^2 / 2) Omega.

(U_x, U_y, Omega) is the sliding velocity and (F_x, F_y, M) the friction that holds the block: mass
times the surface's acceleration, less springs, damping and external loads. So v_c is the speed
under the load mu_s N along x; on one linear spring x' = V - v_c K x / (mu_s N). A contact that has
grown stronger by its age preslides no slower, and breaks away at what it then holds. Where mu_k is
larger than mu_s, it takes the place of mu_s.

Presliding has no inertia, so that the velocity of a stick follows from its place: with inertia it
would lag behind this by v_c / (mu_s g), and be stiff. What the block's momentum changes by is the
surface's work, see `held_energy`. (Quasi-steady sliding, see `steady_sliding`, is a slip.)
"""

from math import sqrt

from .contact import set_contact, set_holding_load, set_sliding_velocity
from .friction.coefficient import holding_coefficient
from .friction.disc import disc_friction
from .layout import *
from .rig.drive import surface_motion
from .rig.springs import damping_per_speed

# Each multiplies what the presliding velocity is off by by the presliding speed per load times the
# damping per speed: hundredths where a contact sticks.
QUADRATIC_SWEEPS = 8


def ride_surface(p: Floats, w: Floats) -> None:
    """Give ``w[W_STATE:]`` the surface's velocity where friction acts, and guides let it."""
    for i in range(3):
        if p[P_SCALES + i] > 0.0:
            w[W_STATE + VX + i] = p[P_FREE + i] * w[W_SURFACE + i]


def set_stick_velocity(p: Floats, u: Floats, w: Floats, presliding: float) -> None:
    """Velocity of a block that sticks at the place in ``w[W_STATE:]``, where it is free.

    ``presliding`` is the sliding speed per load, m/(s N): P_PRESLIDING, or 0 for the surface's own
    velocity. Leaves the surface's motion there and the sliding velocity in ``w``: the presliding,
    and what guides keep from following.
    """
    surface_motion(p, u, w, W_STATE)
    ride_surface(p, w)
    if presliding != 0.0:
        add_presliding(p, u, w, presliding)
    else:
        set_sliding_velocity(p, w, W_STATE)


def add_presliding(p: Floats, u: Floats, w: Floats, c: float) -> None:
    """Add presliding to the surface's velocity in ``w[W_STATE:]``, c per load, m/(s N).

    Leaves the contact in ``w``, friction as of `set_holding_load`.
    The friction that it answers to has a part of its own: damping, and on a turning surface the
    acceleration of what slides on it.
    """
    set_contact(p, u, w, W_STATE)
    set_holding_load(p, w)
    vx = w[W_STATE + VX]
    vy = w[W_STATE + VY]
    there = damping_per_speed(p, vx, vy)
    d = there
    ux = 0.0
    uy = 0.0
    ur = 0.0
    kappa = p[P_LATERAL]
    sweeps = 1
    if p[P_DAMPING_QUADRATIC] != 0.0 or p[P_DAMPING_DRY] != 0.0:
        sweeps = QUADRATIC_SWEEPS
    for _ in range(sweeps):
        # damping per speed is another at the velocity that comes of it
        fx = w[W_FRICTION] + (d - there) * vx
        ux = -c * fx / (1.0 + c * d)
        if kappa > 0.0:
            cy = p[P_FREE_Y] * c / (kappa * kappa)
            cr = 2.0 * p[P_FREE_PHI] * c / (kappa * kappa * p[P_RADIUS] * p[P_RADIUS])
            turning = p[P_MASS] * w[W_SURFACE + 2]
            ex = -c * fx
            ey = -cy * (w[W_FRICTION + 1] + (d - there) * vy)
            size = (1.0 + c * d) * (1.0 + cy * d) + c * cy * turning * turning
            ux = ((1.0 + cy * d) * ex + c * turning * ey) / size
            uy = ((1.0 + c * d) * ey - cy * turning * ex) / size
            ur = -cr * w[W_FRICTION + 2] / (1.0 + cr * p[P_DAMPING_ROTATION])
        d = damping_per_speed(p, vx + ux, vy + uy)
    w[W_STATE + VX] += ux
    w[W_STATE + VY] += uy
    w[W_STATE + OMEGA] += ur
    w[W_LOAD] -= d * ux + (d - there) * vx
    w[W_LOAD + 1] -= d * uy + (d - there) * vy
    w[W_LOAD + 2] -= p[P_DAMPING_ROTATION] * ur
    if p[P_CURVATURE] != 0.0:
        surface_motion(p, u, w, W_STATE)
    set_sliding_velocity(p, w, W_STATE)
    set_holding_load(p, w)


def set_presliding(p: Floats, u: Floats, w: Floats) -> float:
    """Velocity, contact, friction and mean sliding speed of a stick with presliding, into ``w``.

    Returns what the surface's power differs by from friction times its velocity, W, beside the
    change of `held_energy`: that of the surface's own acceleration is in both.
    """
    set_stick_velocity(p, u, w, p[P_PRESLIDING])
    ux = w[W_SLIDING]
    w[W_MEAN_SPEED] = abs(ux)
    power = -p[P_MASS] * w[W_SURFACE + 3] * w[W_STATE + VX]
    kappa = p[P_LATERAL]
    if kappa > 0.0:
        uy = w[W_SCALED + 1]
        spinning = abs(w[W_SCALED + 2])
        sliding = sqrt(ux * ux + uy * uy)
        disc_friction(sliding, spinning, w)
        w[W_MEAN_SPEED] = w[W_PAIR] * sliding + w[W_PAIR + 1] * spinning
        power -= p[P_MASS] * w[W_SURFACE + 4] * w[W_STATE + VY]
        power -= p[P_INERTIA] * w[W_SURFACE + 5] * w[W_STATE + OMEGA]
    return power


def held_energy(p: Floats, z: Floats, instant: int) -> float:
    """Kinetic energy of the motions that the contact holds at an instant in ``z``, J.

    With presliding, velocities follow from places without a force: what this changes by is
    the surface's work.
    """
    vx = z[instant + VX]
    energy = 0.5 * p[P_MASS] * vx * vx
    if p[P_LATERAL] > 0.0:
        vy = z[instant + VY]
        omega = z[instant + OMEGA]
        energy += 0.5 * p[P_MASS] * vy * vy + 0.5 * p[P_INERTIA] * omega * omega
    return energy


def fastest_presliding(p: Floats, u: Floats, w: Floats) -> float:
    """Scaled sliding speed that no stick at the instant in ``w[W_STATE:]`` exceeds, m/s.

    That of a load at the limit, and 4/3 of it where the load is all moment.
    """
    if p[P_PRESLIDING] == 0.0:
        return 0.0
    limit = holding_coefficient(p, u, w) * p[P_NORMAL_FORCE] / p[P_STICK_RATIO]
    return 1.5 * p[P_PRESLIDING] * limit

"""Does the contact hold? The limit surface in stick, and the way a slip begins."""

from math import sqrt

from .friction.coefficient import holding_coefficient, onset_coefficient
from .friction.disc import disc_friction
from .layout import *
from .rig.drive import input_at, surface_motion
from .rig.springs import add_damping, add_spring_forces


def set_sliding_velocity(p: Floats, w: Floats, state: int) -> None:
    """Velocity of the block relative to the surface under its centre, into ``w[W_SLIDING:]``.

    And as the contact feels it, into ``w[W_SCALED:]``.
    """
    for i in range(3):
        w[W_SLIDING + i] = w[state + VX + i] - w[W_SURFACE + i]
    scale_sliding(p, w)


def scale_sliding(p: Floats, w: Floats) -> None:
    """The scaled sliding velocity (U_x, kappa U_y, kappa a Omega), into ``w[W_SCALED:]``."""
    for i in range(3):
        w[W_SCALED + i] = p[P_SCALES + i] * w[W_SLIDING + i]


def scaled_sliding_speed(w: Floats) -> float:
    """Length of the scaled sliding velocity, m/s."""
    sx = w[W_SCALED]
    sy = w[W_SCALED + 1]
    sr = w[W_SCALED + 2]
    return sqrt(sx * sx + sy * sy + sr * sr)


def guided_sliding_speed(p: Floats, w: Floats) -> float:
    """Scaled sliding speed that guides keep up: no friction can bring it to rest, m/s."""
    sy = (1.0 - p[P_FREE_Y]) * p[P_LATERAL] * w[W_SLIDING + 1]
    sr = (1.0 - p[P_FREE_PHI]) * p[P_LATERAL] * p[P_RADIUS] * w[W_SLIDING + 2]
    return sqrt(sy * sy + sr * sr)


def set_holding_load(p: Floats, w: Floats) -> None:
    """Friction that would keep the block on the surface, into ``w[W_FRICTION:]``.

    M a_surface - loads, for the directions in which friction acts and the block is free;
    guides carry the rest.
    """
    for i in range(3):
        w[W_FRICTION + i] = 0.0
        if p[P_SCALES + i] > 0.0:
            load = p[P_MASS + i] * w[W_SURFACE + 3 + i] - w[W_LOAD + i]
            w[W_FRICTION + i] = p[P_FREE + i] * load


def spin_under_load(force: float, moment: float, w: Floats) -> float:
    """Part of spin, 0 ... 1, in the motion to which a load at the limit gives way.

    ``force`` is per mu N, ``moment`` per mu N a, both >= 0, not both zero. Slide and spin in the
    proportion 1 - t : t are answered by friction parallel to the load; that motion is normal to the
    limit surface where the load meets it. Leaves force and moment of friction in ``w[W_PAIR:]``.
    """
    if moment == 0.0:
        disc_friction(1.0, 0.0, w)
        return 0.0
    if force == 0.0:
        disc_friction(0.0, 1.0, w)
        return 1.0
    low = 0.0
    high = 1.0
    cross_low = -moment  # cross product of load and friction; pure sliding is (1, 0)
    cross_high = force * 2.0 / 3.0  # pure spinning is (0, 2/3)
    t = 0.5
    before = 2.0
    side = 0
    sweep = 0
    while abs(t - before) > 1e-12 and sweep < 100:
        before = t
        t = high - cross_high * (high - low) / (cross_high - cross_low)
        disc_friction(1.0 - t, t, w)
        cross = force * w[W_PAIR + 1] - moment * w[W_PAIR]
        if cross < 0.0:
            low = t
            cross_low = cross
            if side == -1:
                cross_high = 0.5 * cross_high  # Illinois: keeps both ends moving
            side = -1
        else:
            high = t
            cross_high = cross
            if side == 1:
                cross_low = 0.5 * cross_low
            side = 1
        sweep += 1
    return t


def limit_surface_ratio(force: float, moment: float, w: Floats) -> float:
    """How far a load reaches towards the limit surface: 1 on it, below 1 inside.

    The gauge of the convex set that `disc_friction` bounds: the largest load.n / support(n) over
    all motions n, taken at the motion of `spin_under_load`, so that an error there enters squared.
    """
    if force == 0.0 and moment == 0.0:
        return 0.0
    t = spin_under_load(force, moment, w)
    support = (1.0 - t) * w[W_PAIR] + t * w[W_PAIR + 1]
    return ((1.0 - t) * force + t * moment) / support


def holding_ratio(p: Floats, u: Floats, w: Floats) -> float:
    """Load over what the contact can hold; the block breaks away where it reaches 1.

    Takes the load from `set_holding_load`. A contact without friction holds nothing: 2. Nor does
    one that guides keep from following a turning surface: it slides, and has no friction to spare.
    """
    limit = holding_coefficient(p, u, w) * p[P_NORMAL_FORCE]
    if limit == 0.0 or guided_sliding_speed(p, w) > rest_speed(p, u):
        return 2.0
    kappa = p[P_LATERAL]
    fx = w[W_FRICTION] / limit
    if kappa == 0.0:
        return abs(fx)
    fy = w[W_FRICTION + 1] / (limit * kappa)
    m = w[W_FRICTION + 2] / (limit * kappa * p[P_RADIUS])
    return limit_surface_ratio(sqrt(fx * fx + fy * fy), abs(m), w)


def set_onset_direction(p: Floats, u: Floats, w: Floats) -> None:
    """Direction in which a block at rest on the surface begins to slide, into ``w[W_DIRECTION:]``.

    The scaled relative acceleration s satisfies m s = T - mu_k N grad P(s), where -T is the
    holding load of `set_holding_load` and P the mean local sliding speed: the minimum of a
    strictly convex function. Its direction is found by lagged weights, grad P(s) = weight * s in
    the sliding and in the spinning part with the weights of the last iterate, its size follows
    from the direction. The start is the motion to which a load on the limit surface gives way: the
    nearer the load is to that, the better. Where the centre of rotation nears the rim, the weights
    change so fast that an iterate overshoots; then shorter changes are made.
    """
    limit = onset_coefficient(p, u, w) * p[P_NORMAL_FORCE]
    kappa = p[P_LATERAL]
    arm = kappa * p[P_RADIUS]
    tx = -w[W_FRICTION]
    ty = -kappa * w[W_FRICTION + 1]
    tr = -arm * w[W_FRICTION + 2]
    speed = set_yielding_motion(p, limit, w)
    change = 1.0
    part = 1.0
    sweep = 0
    while speed > 0.0 and change > 1e-13 and sweep < 500:
        dx = w[W_DIRECTION]
        dy = w[W_DIRECTION + 1]
        dr = w[W_DIRECTION + 2]
        sliding = sqrt(dx * dx + dy * dy)
        spinning = abs(dr)
        disc_friction(sliding, spinning, w)
        slide = 0.0
        spin = 0.0
        if sliding > 0.0:
            slide = limit * w[W_PAIR] / sliding
        if spinning > 0.0:
            spin = limit * w[W_PAIR + 1] / spinning
        drive = tx * dx - slide * dx * dx
        mass = p[P_MASS] * dx * dx
        if kappa > 0.0:
            drive += ty * dy / (kappa * kappa) - slide * dy * dy
            drive += tr * dr / (arm * arm) - spin * dr * dr
            mass += p[P_MASS] * dy * dy / (kappa * kappa) + p[P_INERTIA] * dr * dr / (arm * arm)
        speed = drive / mass
        sx = tx / (speed * p[P_MASS] + slide)
        sy = ty / (speed * p[P_MASS] + kappa * kappa * slide)
        sr = tr / (speed * p[P_INERTIA] + arm * arm * spin)
        size = sqrt(sx * sx + sy * sy + sr * sr)
        if speed > 0.0 and size > 0.0:
            before = change
            change = abs(sx / size - dx) + abs(sy / size - dy) + abs(sr / size - dr)
            if change > 0.9 * before and sweep > 0:
                part = max(0.25, 0.5 * part)
            dx += part * (sx / size - dx)
            dy += part * (sy / size - dy)
            dr += part * (sr / size - dr)
            size = sqrt(dx * dx + dy * dy + dr * dr)
            w[W_DIRECTION] = dx / size
            w[W_DIRECTION + 1] = dy / size
            w[W_DIRECTION + 2] = dr / size
        sweep += 1


def set_yielding_motion(p: Floats, limit: float, w: Floats) -> float:
    """Motion normal to the limit surface at the holding load, into ``w[W_DIRECTION:]``.

    Returns the scaled relative acceleration along it, m/s^2: what the load leaves over friction; 0
    or less where it leaves nothing.
    """
    kappa = p[P_LATERAL]
    tx = -w[W_FRICTION]
    ty = 0.0
    tr = 0.0
    if kappa > 0.0:
        ty = -w[W_FRICTION + 1] / kappa
        tr = -w[W_FRICTION + 2] / (kappa * p[P_RADIUS])
    force = sqrt(tx * tx + ty * ty)
    w[W_DIRECTION] = 1.0
    w[W_DIRECTION + 1] = 0.0
    w[W_DIRECTION + 2] = 0.0
    if force == 0.0 and tr == 0.0:
        return 0.0
    t = spin_under_load(force, abs(tr), w)
    size = sqrt((1.0 - t) * (1.0 - t) + t * t)
    nx = 0.0
    ny = 0.0
    nr = 0.0
    if force > 0.0:
        nx = (1.0 - t) / size * tx / force
        ny = (1.0 - t) / size * ty / force
    if tr != 0.0:
        nr = t / size * tr / abs(tr)
    w[W_DIRECTION] = nx
    w[W_DIRECTION + 1] = ny
    w[W_DIRECTION + 2] = nr
    drive = nx * tx + ny * ty + nr * tr
    drive -= limit * ((1.0 - t) * w[W_PAIR] + t * w[W_PAIR + 1]) / size
    mass = p[P_MASS] * nx * nx
    if kappa > 0.0:
        arm = kappa * p[P_RADIUS]
        mass += p[P_MASS] * ny * ny / (kappa * kappa) + p[P_INERTIA] * nr * nr / (arm * arm)
    return drive / mass


def speed_scale(p: Floats, u: Floats) -> float:
    """A speed typical of this motion, m/s: what is small is small against it."""
    return max(abs(u[U_SPEED]), p[P_SPEED_SCALE])


def rest_speed(p: Floats, u: Floats) -> float:
    """Scaled sliding speed below which a decelerating contact is taken to come to rest, m/s.

    Below it the direction of friction is frozen, and one smooth step lands the block on the
    surface: what the freezing costs is of the order of rest_speed^2 / (mu g), some 1e-14 m, or
    1e-12 m where the integrator's tolerance is coarse.
    It also settles what the law leaves open: with mu_s > mu_k a contact that slides in the plane
    and passes rest at a distance never reaches it exactly, however small the distance.
    """
    return min(max(1e-6, 0.1 * sqrt(p[P_TOLERANCE])), 1e-5) * speed_scale(p, u)


def set_loads(p: Floats, u: Floats, w: Floats, state: int) -> None:
    """Springs, damping and external loads on the block into ``w[W_LOAD:]`` (N, N, N m)."""
    for i in range(3):
        w[W_LOAD + i] = input_at(u, U_FORCE_X + i, w[state + TIME])
    add_spring_forces(p, w, state)
    add_damping(p, w, state)


def set_contact(p: Floats, u: Floats, w: Floats, state: int) -> None:
    """Loads, surface and sliding velocity at a moment: what every law of the contact needs."""
    set_loads(p, u, w, state)
    surface_motion(p, u, w, state)
    set_sliding_velocity(p, w, state)

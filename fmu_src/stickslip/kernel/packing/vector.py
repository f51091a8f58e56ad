"""The vector ``p`` from the parameters' values and random draws.

First curves through given points, and slopes that keep them monotone: Fritsch & Butland, SIAM J.
Sci. Stat. Comput. 5 (1984). In ``v`` a curve is two rows of CURVE_LIMIT places, abscissae and
ordinates. In ``p`` it is points of a width: abscissa, ordinate, slope there. Then what a rig
departs by from its drawing, friction, springs, and the scales that the integrator needs.
"""

from math import cos, log, radians, sin, sqrt

from ..cubic import end_slope, joined_slope
from ..layout import *
from ..terms import *


def count_points(v: Floats, first: int) -> int:
    """Points of the curve whose abscissae begin at ``v[first]``, see `count_grown`."""
    return count_grown(v, first, CURVE_LIMIT)


def count_grown(v: Floats, first: int, limit: int) -> int:
    """Numbers of a row of ``limit`` places from ``v[first]`` on: it ends where they stop growing.

    The places that it leaves unused do not count, and one number is no row: then 0.
    """
    count = 1
    while count < limit and v[first + count] > v[first + count - 1]:
        count += 1
    if count == 1:
        return 0
    return count


def copy_points(v: Floats, x: int, y: int, count: int, p: Floats, at: int, width: int) -> None:
    """Put abscissae ``v[x:]`` and ordinates ``v[y:]`` into the points ``p[at:]``."""
    for i in range(count):
        p[at + width * i] = v[x + i]
        p[at + width * i + 1] = v[y + i]


def secant(p: Floats, at: int, width: int) -> float:
    """Slope from the point ``p[at:]`` to the next."""
    return (p[at + width + 1] - p[at + 1]) / (p[at + width] - p[at])


def inner_slope(p: Floats, at: int, width: int) -> float:
    """Slope at a point between two: weighted harmonic mean of the secants; 0 at an extremum."""
    span_before = p[at] - p[at - width]
    span_after = p[at + width] - p[at]
    return joined_slope(span_before, secant(p, at - width, width), span_after, secant(p, at, width))


def set_curve_slopes(p: Floats, first: int, count: int, width: int) -> None:
    """Slopes at so many points ``p[first:]``; at the ends those of the first and the last piece."""
    last = first + width * (count - 1)
    p[first + 2] = secant(p, first, width)
    p[last + 2] = secant(p, last - width, width)
    for i in range(1, count - 1):
        p[first + width * i + 2] = inner_slope(p, first + width * i, width)


def departure(d: Floats, i: int, deviation: float) -> float:
    """Draw i, normally distributed with a standard deviation and cut at three of them."""
    return deviation * max(-3.0, min(3.0, d[i]))


def set_start(v: Floats, d: Floats, p: Floats) -> None:
    """Where the block stands at the start and how it moves: x, y, phi, vx, vy, omega."""
    for i in range(6):
        p[P_INITIAL + i] = v[V_INITIAL_X + i]
    for i in range(2):
        p[P_INITIAL + i] += departure(d, D_START_POSITION + i, v[V_IMPERFECTIONS_START_POSITION])
    turn = radians(v[V_IMPERFECTIONS_START_ANGLE_DEG])
    p[P_INITIAL + 2] += departure(d, D_START_ANGLE, turn)


# (speed / v_s)^p from which nothing is left of the excess: exp(-44) of it is below a thousandth of
# the rounding of the coefficient that it falls from.
NOTHING_LEFT = 44.0
# Of its excess, what friction may err by where bristles are left out: worth some 1e-7 m of the way.
LAG = 1e-4


def set_friction_law(v: Floats, p: Floats) -> None:
    """Everything of friction but the effects' own numbers; mass and normal force are there."""
    p[P_TRANSITION_SPEED] = v[V_FRICTION_TRANSITION_SPEED]
    p[P_TRANSITION_EXPONENT] = v[V_FRICTION_TRANSITION_EXPONENT]
    p[P_TRANSITION_END] = p[P_TRANSITION_SPEED] * NOTHING_LEFT ** (1.0 / p[P_TRANSITION_EXPONENT])
    p[P_MU_S] = with_coefficient_factor(p, v, v[V_FRICTION_MU_S])
    p[P_MU_K] = with_coefficient_factor(p, v, v[V_FRICTION_MU_K])
    p[P_MU_SCALE] = p[P_MU_K]
    set_table(v, p)
    limit = max(p[P_MU_S], p[P_MU_K]) * p[P_NORMAL_FORCE]
    if limit > 0.0:
        p[P_PRESLIDING] = v[V_FRICTION_STICK_CREEP] / limit
        set_bristles(v, p, limit)


def set_table(v: Floats, p: Floats) -> None:
    """Points of the table of mu_k over the sliding speed, and rows of them over the temperature.

    The table takes the place of mu_k, which is then the table's value at rest, the largest of its
    rows'. What depends on the load alone multiplies it as it does mu_k.
    """
    count = count_points(v, V_FRICTION_TABLE_SPEED)
    if count == 0:
        return
    rows = max(1, count_grown(v, V_FRICTION_TABLE_TEMPERATURE_DEGC, TEMPERATURE_LIMIT))
    p[P_TABLE_POINTS] = float(count)
    p[P_TABLE_ROWS] = float(rows)
    at_rest = 0.0
    for i in range(rows):
        row = P_TABLE + TABLE_ROW * i
        p[P_TABLE_TEMPERATURE + i] = v[V_FRICTION_TABLE_TEMPERATURE_DEGC + i]
        mu = V_FRICTION_TABLE_MU + count * i
        copy_points(v, V_FRICTION_TABLE_SPEED, mu, count, p, row, TABLE_WIDTH)
        set_row_slopes(p, row, count)
        at_rest = max(at_rest, p[row + 1])
    p[P_MU_SCALE] = with_coefficient_factor(p, v, 1.0)
    p[P_MU_K] = p[P_MU_SCALE] * at_rest


def set_row_slopes(p: Floats, row: int, count: int) -> None:
    """PCHIP's slopes of so many points ``p[row:]``."""
    set_curve_slopes(p, row, count, TABLE_WIDTH)
    if count == 2:  # a straight line
        return
    second = row + TABLE_WIDTH
    next_span = p[second + TABLE_WIDTH] - p[second]
    next_rise = secant(p, second, TABLE_WIDTH)
    p[row + 2] = end_slope(p[second] - p[row], p[row + 2], next_span, next_rise)
    last = row + TABLE_WIDTH * (count - 1)
    before = last - TABLE_WIDTH
    next_span = p[before] - p[before - TABLE_WIDTH]
    next_rise = secant(p, before - TABLE_WIDTH, TABLE_WIDTH)
    p[last + 2] = end_slope(p[last] - p[before], p[last + 2], next_span, next_rise)


def set_bristles(v: Floats, p: Floats, limit: float) -> None:
    """Stiffness and damping of a contact that is sheared by so much under the load ``limit``, N.

    From the sliding speed P_FAST_SLIP on the bristles trail behind those of steady sliding by no
    more than the part LAG of the excess of friction: in a slip that gains a = mu_s g, z_0 a / v_s^2
    times exp(-(u / v_s)^p).
    """
    distance = v[V_FRICTION_PRESLIDING_DISTANCE]
    speed = p[P_TRANSITION_SPEED]
    if distance <= 0.0 or speed <= 0.0:
        return
    p[P_BRISTLE_STIFFNESS] = limit / distance
    critical = 2.0 * sqrt(p[P_BRISTLE_STIFFNESS] * p[P_MASS])
    p[P_BRISTLE_DAMPING] = v[V_FRICTION_BRISTLE_DAMPING] * critical
    lag = distance * limit / p[P_MASS] / (speed * speed)
    fast = max(3.0, log(lag / LAG))
    p[P_FAST_SLIP] = speed * fast ** (1.0 / p[P_TRANSITION_EXPONENT])


def set_kind_of_law(p: Floats) -> None:
    """Whether mu_k varies over the contact, and on what of the past the motion depends.

    The numbers of the effects are there.
    """
    falls = p[P_TRANSITION_SPEED] > 0.0
    if p[P_TABLE_POINTS] > 0.0 or has_local_law(p):
        p[P_LOCAL_LAW] = 1.0
    p[P_FEEDING] = float(MOVING)
    if p[P_BRISTLE_STIFFNESS] > 0.0:
        p[P_FEEDING] = float(SHEARED)
    if has_memory(p) or (falls and has_ageing(p)):
        p[P_FEEDING] = float(REMEMBERED)


def place_springs(v: Floats, d: Floats, p: Floats) -> None:
    """Attachments on the block, and anchors one spring length away from them.

    The springs lie along x, but for the turn and the shift that an effect gives them. A spring
    shorter than a twentieth of its installed length has collapsed: the block has been carried into
    the anchor, where the direction of the spring force has no meaning any more.
    """
    length = v[V_RIG_SPRING_LENGTH]
    if p[P_STIFFNESS] > 0.0:
        p[P_SHORTEST] = 0.05 * length
    turn = with_spring_turn(p, v, 0.0)
    frame = with_frame_turn(p, v, 0.0)
    shift = with_anchor_shift(p, v, 0.0)
    diagonal = with_diagonal_shift(p, v, 0.0)
    for i in range(4):
        angle = radians(v[V_RIG_ATTACHMENT_ANGLES_DEG + i])
        bx = v[V_RIG_ATTACHMENT_RADIUS] * cos(angle)
        by = v[V_RIG_ATTACHMENT_RADIUS] * sin(angle)
        outward = length
        if bx < 0.0:
            outward = -length
        p[P_ATTACH + 2 * i] = bx
        p[P_ATTACH + 2 * i + 1] = by
        ax = bx + outward * cos(turn)
        ay = by + outward * sin(turn)
        aside = shift - diagonal
        if i == 0 or i == 3:
            aside = shift + diagonal
        p[P_ANCHOR + 2 * i] = cos(frame) * ax - sin(frame) * ay
        p[P_ANCHOR + 2 * i + 1] = sin(frame) * ax + cos(frame) * ay + aside
    for i in range(4):
        more = departure(d, D_SPRING_STIFFNESS + i, v[V_IMPERFECTIONS_SPRING_STIFFNESS])
        p[P_RELATIVE_STIFFNESS + i] = 1.0 + more
    for i in range(8):
        p[P_ANCHOR + i] += departure(d, D_ANCHOR_POSITION + i, v[V_IMPERFECTIONS_ANCHOR_POSITION])


def set_force_curve(v: Floats, p: Floats) -> None:
    """Points of the force-length curve with monotone slopes, and the energies under it, J.

    Beyond its ends it goes on as straight as its first and its last piece on the whole.
    """
    extension = V_SPRINGS_FORCE_CURVE_EXTENSION
    count = count_points(v, extension)
    if count == 0:
        return
    p[P_CURVE_POINTS] = float(count)
    copy_points(v, extension, V_SPRINGS_FORCE_CURVE_FORCE, count, p, P_CURVE, CURVE_WIDTH)
    set_curve_slopes(p, P_CURVE, count, CURVE_WIDTH)
    energy = 0.0
    for i in range(1, count):
        at = P_CURVE + CURVE_WIDTH * i
        before = at - CURVE_WIDTH
        h = p[at] - p[before]
        mean = h * (p[before + 1] + p[at + 1]) / 2.0
        energy += mean + h * h * (p[before + 2] - p[at + 2]) / 12.0
        p[at + 3] = energy


def set_scales(v: Floats, p: Floats) -> None:
    """Rate and speed that belong to this rig, and the longest step.

    Rate and speed scale the integrator's error test only: where nothing sets a rate (no springs) it
    is 1 rad/s, where nothing sets a speed 1e-6 m/s. No step is longer than a twelfth of a period.
    """
    rate = max(sqrt(4.0 * p[P_STIFFNESS] / p[P_MASS]), 1.0)
    p[P_RATE] = rate
    given = max(rate * size_of(p, P_INITIAL), size_of(p, P_INITIAL + 3))
    p[P_SPEED_SCALE] = max(max(p[P_MU_S] * GRAVITY / rate, given), 1e-6)
    p[P_LONGEST_STEP] = 0.5 / rate
    fastest = with_fastest_rate(p, v, 0.0)
    if fastest > 0.0:
        p[P_LONGEST_STEP] = min(p[P_LONGEST_STEP], 0.5 / fastest)
    p[P_LONGEST_STICK] = p[P_LONGEST_STEP]


def size_of(p: Floats, at: int) -> float:
    """Length of a displacement (m) or velocity (m/s) ``p[at:]``, turns as far as the rim goes."""
    rim = p[P_RADIUS] * p[at + 2]
    return sqrt(p[at] * p[at] + p[at + 1] * p[at + 1] + rim * rim)


# Rim speed over sliding speed up to which a few points of the disc tell how a smooth law averages
# over it, to some 1e-9 of what it varies by; the error of the force grows with the eighth power.
FEW_POINTS = 0.07


def pack(v: Floats, d: Floats, p: Floats) -> None:
    """Make ``p`` of the parameters' values and the standard random numbers that go with them.

    The values are taken as checked; what ``p`` held before does not matter.
    """
    for i in range(P_SIZE):
        p[i] = 0.0
    set_rig(v, d, p)
    set_friction_law(v, p)
    set_effect_numbers(v, d, p)
    set_directions(p)
    set_kind_of_law(p)
    set_start(v, d, p)
    place_springs(v, d, p)
    set_force_curve(v, p)
    set_scales(v, p)


def set_directions(p: Floats) -> None:
    """Numbers of x, y and phi in a row, from those of the rig and the effects."""
    p[P_MASS + 1] = p[P_MASS]
    p[P_FREE] = 1.0
    p[P_SCALES] = 1.0
    p[P_SCALES + 1] = p[P_LATERAL]
    p[P_SCALES + 2] = p[P_LATERAL] * p[P_RADIUS]


def set_rig(v: Floats, d: Floats, p: Floats) -> None:
    """The block, how it is guided and driven; an inertia of 0 is a disc of the contact radius."""
    p[P_MASS] = v[V_RIG_MASS] * (1.0 + departure(d, D_MASS, v[V_IMPERFECTIONS_MASS]))
    p[P_RADIUS] = v[V_RIG_CONTACT_RADIUS]
    p[P_INERTIA] = v[V_RIG_INERTIA]
    if p[P_INERTIA] == 0.0:
        p[P_INERTIA] = 0.5 * p[P_MASS] * (p[P_RADIUS] * p[P_RADIUS])
    p[P_NORMAL_FORCE] = p[P_MASS] * GRAVITY
    p[P_FREE_Y] = v[V_RIG_FREE_Y]
    p[P_FREE_PHI] = v[V_RIG_FREE_PHI]
    p[P_NATURAL_LENGTH] = v[V_RIG_SPRING_NATURAL_LENGTH]
    p[P_STIFFNESS] = v[V_SPRINGS_STIFFNESS]
    p[P_RUN_UP] = v[V_SURFACE_RUN_UP_TIME]
    p[P_TOLERANCE] = v[V_SOLVER_TOLERANCE]
    p[P_FEW_POINTS] = FEW_POINTS

"""Parameters that cannot stand side by side, by their values ``v``.

What is said of each is in `stickslip.contradictions`.
"""

from ..layout import *
from ..terms import has_dry_law
from .vector import count_grown, count_points

# what `contradiction` returns
NO_CONTRADICTION = 0
CREEP_BESIDE_STATE_LAW = 1
TRANSITION_BESIDE_STATE_LAW = 2
BRISTLES_WITHOUT_TRANSITION = 3
BRISTLES_BESIDE_CREEP = 4
BRISTLES_BESIDE_STICK_STIFFNESS = 5
SPRINGS_COIL_ON_COIL = 6
FORCE_CURVE_OF_ONE_POINT = 7
FORCE_CURVE_GOES_BACK = 8
FORCE_CURVE_FALLS = 9
TABLE_OF_ONE_POINT = 10
TABLE_GOES_BACK = 11
TABLE_AT_NEGATIVE_SPEED = 12
TABLE_OF_NEGATIVE_FRICTION = 13
TABLE_BESIDE_DRY_LAW = 14
SURFACE_TURNS_UNDER_BLOCK = 15
FULL_RIPPLE_TOO_FAST = 16
GUIDED_Y_MOVES = 17
GUIDED_PHI_TURNS = 18
TABLE_TEMPERATURES_GO_BACK = 19
TABLE_ROW_WITHOUT_FRICTION = 20

FASTEST_FULL_RIPPLE = 100.0  # Hz

# Beyond these, numbers that the model makes of a parameter (squares, quotients) can be infinite.
SMALLEST = 1e-100
LARGEST = 1e100


def beyond_numbers(v: Floats) -> int:
    """Place of the first value that is too small or too large to compute with, -1 for none."""
    for i in range(V_SIZE):
        size = abs(v[i])
        if size > LARGEST or (is_divisor(i) and 0.0 < size < SMALLEST):
            return i
    return -1


def is_divisor(place: int) -> bool:
    """Whether the model divides by the value there; elsewhere next to nothing is nothing."""
    is_rigs = place == V_RIG_MASS or place == V_RIG_INERTIA or place == V_RIG_CONTACT_RADIUS
    is_length = place == V_SURFACE_PATTERN_WAVELENGTH
    return is_rigs or is_length or place == V_SURFACE_SCATTER_CORRELATION_LENGTH


def contradiction(v: Floats) -> int:
    """The first contradiction between any of the parameters, NO_CONTRADICTION where there is none.

    Each value by itself is taken as checked against its bounds.
    """
    found = contradiction_of_contact(v)
    if found == NO_CONTRADICTION:
        found = contradiction_of_springs(v)
    if found == NO_CONTRADICTION:
        found = contradiction_of_table(v)
    if found == NO_CONTRADICTION:
        found = contradiction_of_motion(v)
    return found


def contradiction_of_contact(v: Floats) -> int:
    """Laws of how a contact is sheared before it slides: there can be one."""
    if v[V_RATE_AND_STATE_DIRECT] != 0.0 or v[V_RATE_AND_STATE_EVOLUTION] != 0.0:
        if v[V_FRICTION_STICK_CREEP] != 0.0:
            return CREEP_BESIDE_STATE_LAW
        if v[V_FRICTION_TRANSITION_SPEED] != 0.0:
            return TRANSITION_BESIDE_STATE_LAW
    if v[V_FRICTION_PRESLIDING_DISTANCE] == 0.0:
        return NO_CONTRADICTION
    if v[V_FRICTION_TRANSITION_SPEED] == 0.0:
        return BRISTLES_WITHOUT_TRANSITION
    if v[V_FRICTION_STICK_CREEP] != 0.0:
        return BRISTLES_BESIDE_CREEP
    if v[V_STICK_STIFFNESS_RATIO] != 1.0:
        return BRISTLES_BESIDE_STICK_STIFFNESS
    return NO_CONTRADICTION


def contradiction_of_springs(v: Floats) -> int:
    """Lengths of the springs, and their force-length curve."""
    extension = V_SPRINGS_FORCE_CURVE_EXTENSION
    force = V_SPRINGS_FORCE_CURVE_FORCE
    if v[V_RIG_SPRING_NATURAL_LENGTH] > 2.0 * v[V_RIG_SPRING_LENGTH]:
        return SPRINGS_COIL_ON_COIL
    count = count_points(v, extension)
    given = is_given(v, extension, CURVE_LIMIT) or is_given(v, force, CURVE_LIMIT)
    if count == 0 and given:
        return FORCE_CURVE_OF_ONE_POINT
    ended = is_ended(v, extension, count, CURVE_LIMIT)
    if not (ended and is_ended(v, force, count, CURVE_LIMIT)):
        return FORCE_CURVE_GOES_BACK
    for i in range(1, count):
        if v[force + i] < v[force + i - 1]:
            return FORCE_CURVE_FALLS
    return NO_CONTRADICTION


def contradiction_of_table(v: Floats) -> int:
    """The table of mu_k over sliding speed and temperature, and other laws of that speed."""
    speed = V_FRICTION_TABLE_SPEED
    mu = V_FRICTION_TABLE_MU
    temperature = V_FRICTION_TABLE_TEMPERATURE_DEGC
    count = count_points(v, speed)
    rows = count_grown(v, temperature, TEMPERATURE_LIMIT)
    size = count * max(1, rows)
    if count == 0 and (is_given(v, speed, CURVE_LIMIT) or is_given(v, mu, TABLE_LIMIT)):
        return TABLE_OF_ONE_POINT
    if not (is_ended(v, speed, count, CURVE_LIMIT) and is_table_ended(v, count, rows)):
        return TABLE_GOES_BACK
    if rows == 0 and is_given(v, temperature, TEMPERATURE_LIMIT):
        return TABLE_TEMPERATURES_GO_BACK
    if rows > 0 and not is_repeated(v, temperature, rows, TEMPERATURE_LIMIT):
        return TABLE_TEMPERATURES_GO_BACK
    if v[speed] < 0.0:
        return TABLE_AT_NEGATIVE_SPEED
    for i in range(size):
        if v[mu + i] < 0.0:
            return TABLE_OF_NEGATIVE_FRICTION
    for i in range(rows):
        if count > 0 and not is_given(v, mu + count * i, count):
            return TABLE_ROW_WITHOUT_FRICTION
    if count > 0 and has_dry_law(v):
        return TABLE_BESIDE_DRY_LAW
    return NO_CONTRADICTION


def is_table_ended(v: Floats, count: int, rows: int) -> bool:
    """Whether the places beyond the coefficients repeat the last, or are all 0.

    Without temperatures, those of the first of them will do.
    """
    mu = V_FRICTION_TABLE_MU
    if rows == 0 and not is_given(v, mu + CURVE_LIMIT, TABLE_LIMIT - CURVE_LIMIT):
        return is_ended(v, mu, count, CURVE_LIMIT)
    return is_ended(v, mu, count * max(1, rows), TABLE_LIMIT)


def contradiction_of_motion(v: Floats) -> int:
    """Drive of the surface, and the start."""
    if abs(v[V_TURNING_SURFACE_CURVATURE]) * v[V_RIG_CONTACT_RADIUS] >= 1.0:
        return SURFACE_TURNS_UNDER_BLOCK
    full = v[V_SPEED_RIPPLE_AMPLITUDE] == 1.0
    if full and v[V_SPEED_RIPPLE_FREQUENCY] > FASTEST_FULL_RIPPLE:
        return FULL_RIPPLE_TOO_FAST
    if v[V_RIG_FREE_Y] == 0.0 and v[V_INITIAL_VY] != 0.0:
        return GUIDED_Y_MOVES
    if v[V_RIG_FREE_PHI] == 0.0 and v[V_INITIAL_OMEGA] != 0.0:
        return GUIDED_PHI_TURNS
    return NO_CONTRADICTION


def is_given(v: Floats, first: int, limit: int) -> bool:
    """Does any of so many places hold a number?"""
    for i in range(limit):
        if v[first + i] != 0.0:
            return True
    return False


def is_repeated(v: Floats, first: int, count: int, limit: int) -> bool:
    """Do the places beyond so many numbers repeat the last of them?"""
    for i in range(count, limit):
        if v[first + i] != v[first + max(count - 1, 0)]:
            return False
    return True


def is_ended(v: Floats, first: int, count: int, limit: int) -> bool:
    """Do the places beyond so many numbers repeat the last of them, or are all of them 0?"""
    return is_repeated(v, first, count, limit) or not is_given(v, first + count, limit - count)

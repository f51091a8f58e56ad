"""Named parameters to the kernel's vector ``p``. Pure Python: it travels inside the FMU."""

from __future__ import annotations

from collections.abc import Mapping
from math import cos, hypot, log, pi, radians, sin, sqrt
from random import Random
from typing import NamedTuple

from .derived import (
    set_effect_numbers,
    with_anchor_shift,
    with_coefficient_factor,
    with_fastest_rate,
    with_spring_turn,
)
from .kernel.layout import (
    CURVE_LIMIT,
    CURVE_WIDTH,
    MOVING,
    P_ANCHOR,
    P_ATTACH,
    P_BRISTLE_DAMPING,
    P_BRISTLE_STIFFNESS,
    P_CURVE,
    P_CURVE_POINTS,
    P_FAST_SLIP,
    P_FEEDING,
    P_FEW_POINTS,
    P_FREE_PHI,
    P_FREE_Y,
    P_INERTIA,
    P_INITIAL,
    P_LOCAL_LAW,
    P_LONGEST_STEP,
    P_LONGEST_STICK,
    P_MASS,
    P_MU_K,
    P_MU_S,
    P_MU_SCALE,
    P_NATURAL_LENGTH,
    P_NORMAL_FORCE,
    P_PRESLIDING,
    P_QUADRATURE,
    P_RADIUS,
    P_RATE,
    P_RELATIVE_STIFFNESS,
    P_RUN_UP,
    P_SHORTEST,
    P_SIZE,
    P_SPEED_SCALE,
    P_STIFFNESS,
    P_TABLE,
    P_TABLE_POINTS,
    P_TABLEAU,
    P_TOLERANCE,
    P_TRANSITION_EXPONENT,
    P_TRANSITION_SPEED,
    RAYS,
    REMEMBERED,
    SHEARED,
    TABLE_WIDTH,
)
from .kernel.terms import has_ageing, has_local_law, has_memory
from .tableau import flat_tableau

GRAVITY = 9.81  # m/s^2
# Of its excess, what friction may err by where bristles are left out: worth some 1e-7 m of the way.
LAG = 1e-4

# Rim speed over sliding speed up to which a few points of the disc tell how a law averages over it,
# to 1e-9 of what it varies by; the error grows with the eighth power.
FEW_POINTS = 0.07

# where each parameter of the core stands, for those that enter the kernel as they are
SLOTS = {
    "rig.mass": P_MASS,
    "rig.contact_radius": P_RADIUS,
    "rig.free_y": P_FREE_Y,
    "rig.free_phi": P_FREE_PHI,
    "rig.spring_natural_length": P_NATURAL_LENGTH,
    "springs.stiffness": P_STIFFNESS,
    "friction.mu_s": P_MU_S,
    "friction.mu_k": P_MU_K,
    "friction.transition_speed": P_TRANSITION_SPEED,
    "friction.transition_exponent": P_TRANSITION_EXPONENT,
    "surface.run_up_time": P_RUN_UP,
    "solver.tolerance": P_TOLERANCE,
}


def pack(values: Mapping[str, float]) -> list[float]:
    """Kernel vector ``p`` from a mapping ``table.parameter`` -> value in SI units.

    The names are those of `Parameters.flat`, which are the FMU's; ``rig.inertia`` = 0 stands for a
    disc of the contact radius. The values are taken as checked.
    """
    p = [0.0] * P_SIZE
    for name, slot in SLOTS.items():
        p[slot] = float(values[name])
    departures = _imperfections(values)
    p[P_MASS] *= 1.0 + departures.mass
    p[P_INERTIA] = values["rig.inertia"] or 0.5 * p[P_MASS] * p[P_RADIUS] ** 2
    p[P_NORMAL_FORCE] = p[P_MASS] * GRAVITY
    p[P_MU_S] = with_coefficient_factor(p, values, p[P_MU_S])
    p[P_MU_K] = with_coefficient_factor(p, values, p[P_MU_K])
    p[P_MU_SCALE] = p[P_MU_K]
    _set_table(p, values)
    limit = max(p[P_MU_S], p[P_MU_K]) * p[P_NORMAL_FORCE]
    p[P_PRESLIDING] = values["friction.stick_creep"] / limit if limit > 0.0 else 0.0
    _set_bristles(p, values, limit)
    set_effect_numbers(p, values)
    falls = p[P_TRANSITION_SPEED] > 0.0
    p[P_LOCAL_LAW] = float(falls or p[P_TABLE_POINTS] > 0.0 or has_local_law(p))
    p[P_FEEDING] = float(SHEARED if p[P_BRISTLE_STIFFNESS] > 0.0 else MOVING)
    if has_memory(p) or (falls and has_ageing(p)):
        p[P_FEEDING] = float(REMEMBERED)
    for i, name in enumerate(("x", "y", "phi", "vx", "vy", "omega")):
        p[P_INITIAL + i] = values[f"initial.{name}"]
    for i, departure in enumerate(departures.start):
        p[P_INITIAL + i] += departure
    _place_springs(p, values)
    for i in range(4):
        p[P_RELATIVE_STIFFNESS + i] = 1.0 + departures.stiffness[i]
    for i in range(8):
        p[P_ANCHOR + i] += departures.anchors[i]
    _set_curve(p, values)
    _set_scales(p, values)
    p[P_FEW_POINTS] = FEW_POINTS
    p[P_QUADRATURE:P_TABLEAU] = quadrature_tables()
    tableau = flat_tableau()
    p[P_TABLEAU : P_TABLEAU + len(tableau)] = tableau
    return p


def _set_bristles(p: list[float], values: Mapping[str, float], limit: float) -> None:
    """Stiffness and damping of a contact that is sheared by so much under the load ``limit``, N.

    From the sliding speed P_FAST_SLIP on the bristles trail behind those of steady sliding by no
    more than the part LAG of the excess of friction: in a slip that gains a = mu_s g, z_0 a / v_s^2
    times exp(-(u / v_s)^p).
    """
    distance = values["friction.presliding_distance"]
    if distance > 0.0 and p[P_TRANSITION_SPEED] > 0.0:
        p[P_BRISTLE_STIFFNESS] = limit / distance
        critical = 2.0 * sqrt(p[P_BRISTLE_STIFFNESS] * p[P_MASS])
        p[P_BRISTLE_DAMPING] = values["friction.bristle_damping"] * critical
        speed = p[P_TRANSITION_SPEED]
        lag = distance * limit / p[P_MASS] / speed**2
        fast = max(3.0, log(lag / LAG))
        p[P_FAST_SLIP] = speed * fast ** (1.0 / p[P_TRANSITION_EXPONENT])


class Departures(NamedTuple):
    """What a rig departs by from the drawing: mass and stiffness relative, anchors m, start m, m,
    rad."""

    mass: float
    stiffness: list[float]
    anchors: list[float]
    start: list[float]


def _imperfections(values: Mapping[str, float]) -> Departures:
    """What this rig departs by from the drawing.

    Normally distributed, cut at three standard deviations. The draws are the same whichever of
    them is switched on.
    """
    draw = Random(int(values["imperfections.seed"]))

    def departures(deviation: float, count: int) -> list[float]:
        return [deviation * max(-3.0, min(3.0, draw.gauss(0.0, 1.0))) for _ in range(count)]

    place = values["imperfections.start_position"]
    turn = radians(values["imperfections.start_angle_deg"])
    return Departures(
        mass=departures(values["imperfections.mass"], 1)[0],
        stiffness=departures(values["imperfections.spring_stiffness"], 4),
        anchors=departures(values["imperfections.anchor_position"], 8),
        start=departures(place, 2) + departures(turn, 1),
    )


def _place_springs(p: list[float], values: Mapping[str, float]) -> None:
    """Attachments on the block, and anchors one spring length away from them.

    The springs lie along x, but for the turn and the shift that an effect gives them. A spring
    shorter than a twentieth of its installed length has collapsed: the block has been carried into
    the anchor, where the direction of the spring force has no meaning any more.
    """
    length = values["rig.spring_length"]
    if p[P_STIFFNESS] > 0.0:
        p[P_SHORTEST] = 0.05 * length
    radius = values["rig.attachment_radius"]
    turn = with_spring_turn(p, values, 0.0)
    shift = with_anchor_shift(p, values, 0.0)
    for i in range(4):
        angle = radians(values[f"rig.attachment_angles_deg[{i + 1}]"])
        bx, by = radius * cos(angle), radius * sin(angle)
        outward = length if bx >= 0.0 else -length
        p[P_ATTACH + 2 * i : P_ATTACH + 2 * i + 2] = bx, by
        p[P_ANCHOR + 2 * i] = bx + outward * cos(turn)
        p[P_ANCHOR + 2 * i + 1] = by + outward * sin(turn) + shift


def _set_curve(p: list[float], values: Mapping[str, float]) -> None:
    """Points of the force-length curve with monotone slopes (Fritsch & Butland) and energies."""
    x, f = _points(values, "springs.force_curve_extension", "springs.force_curve_force")
    if not x:
        return
    count = len(x)
    p[P_CURVE_POINTS] = float(count)
    span = [x[i + 1] - x[i] for i in range(count - 1)]
    rise = [(f[i + 1] - f[i]) / span[i] for i in range(count - 1)]
    slope = [rise[0], *_inner_slopes(span, rise), rise[-1]]
    energy = 0.0
    for i in range(count):
        if i > 0:
            h = span[i - 1]
            energy += h * (f[i - 1] + f[i]) / 2.0 + h * h * (slope[i - 1] - slope[i]) / 12.0
        at = P_CURVE + CURVE_WIDTH * i
        p[at : at + 4] = x[i], f[i], slope[i], energy


def _set_table(p: list[float], values: Mapping[str, float]) -> None:
    """Points of the table of mu_k over the sliding speed, with PCHIP's slopes.

    The table takes the place of mu_k, which is then the table's value at rest. What depends on the
    load alone multiplies it as it does mu_k.
    """
    v, mu = _points(values, "friction.table_speed", "friction.table_mu")
    if not v:
        return
    count = len(v)
    p[P_TABLE_POINTS] = float(count)
    span = [v[i + 1] - v[i] for i in range(count - 1)]
    rise = [(mu[i + 1] - mu[i]) / span[i] for i in range(count - 1)]
    slope = [
        _end_slope(span, rise),
        *_inner_slopes(span, rise),
        _end_slope(span[::-1], rise[::-1]),
    ]
    for i in range(count):
        at = P_TABLE + TABLE_WIDTH * i
        p[at : at + TABLE_WIDTH] = v[i], mu[i], slope[i]
    p[P_MU_SCALE] = with_coefficient_factor(p, values, 1.0)
    p[P_MU_K] = p[P_MU_SCALE] * mu[0]


def _points(values: Mapping[str, float], first: str, second: str) -> tuple[list[float], ...]:
    """The points of two parameters that make a curve; none where they are fewer than two.

    The curve ends where the first stops growing: the places that it leaves unused do not count.
    """
    x = [values[f"{first}[{i + 1}]"] for i in range(CURVE_LIMIT)]
    y = [values[f"{second}[{i + 1}]"] for i in range(CURVE_LIMIT)]
    count = 1
    while count < CURVE_LIMIT and x[count] > x[count - 1]:
        count += 1
    return ([], []) if count == 1 else (x[:count], y[:count])


def _inner_slopes(span: list[float], rise: list[float]) -> list[float]:
    """Slopes at the inner points: the weighted harmonic mean of the secants; 0 at an extremum."""
    slopes = []
    for i in range(1, len(span)):
        slope = 0.0
        if rise[i - 1] * rise[i] > 0.0:
            before, after = 2.0 * span[i] + span[i - 1], span[i] + 2.0 * span[i - 1]
            slope = (before + after) / (before / rise[i - 1] + after / rise[i])
        slopes.append(slope)
    return slopes


def _end_slope(span: list[float], rise: list[float]) -> float:
    """PCHIP's slope at the first point: of the parabola through three, kept monotone."""
    if len(span) == 1:
        return rise[0]
    slope = ((2.0 * span[0] + span[1]) * rise[0] - span[0] * rise[1]) / (span[0] + span[1])
    if slope * rise[0] <= 0.0:
        return 0.0
    if rise[0] * rise[1] <= 0.0 and abs(slope) > 3.0 * abs(rise[0]):
        return 3.0 * rise[0]
    return slope


def _set_scales(p: list[float], values: Mapping[str, float]) -> None:
    """Rate and speed that belong to this rig, and the longest step.

    Rate and speed scale the integrator's error test only: where nothing sets a rate (no springs) it
    is 1 rad/s, where nothing sets a speed 1e-6 m/s. No step is longer than a twelfth of a period.
    """
    rate = max(sqrt(4.0 * p[P_STIFFNESS] / p[P_MASS]), 1.0)
    x, y, phi, vx, vy, omega = p[P_INITIAL : P_INITIAL + 6]
    arm = p[P_RADIUS]
    p[P_RATE] = rate
    p[P_SPEED_SCALE] = max(
        p[P_MU_S] * GRAVITY / rate,
        rate * hypot(x, y, arm * phi),
        hypot(vx, vy, arm * omega),
        1e-6,
    )
    p[P_LONGEST_STEP] = 0.5 / rate
    fastest = with_fastest_rate(p, values, 0.0)
    if fastest > 0.0:
        p[P_LONGEST_STEP] = min(p[P_LONGEST_STEP], 0.5 / fastest)
    p[P_LONGEST_STICK] = p[P_LONGEST_STEP]


def quadrature_tables() -> list[float]:
    """Angles of strips and rays (midpoint rule) and Gauss-Legendre nodes, for `disc`."""
    rays = RAYS
    strips = [(j + 0.5) * pi / (2 * rays) for j in range(rays)]
    about = [(j + 0.5) * pi / rays for j in range(rays)]
    nodes = []
    for inner in (-1.0, 1.0):
        root = sqrt(3.0 / 7.0 + inner * 2.0 / 7.0 * sqrt(6.0 / 5.0))
        weight = (18.0 - inner * sqrt(30.0)) / 36.0
        nodes += [(-root, weight), (root, weight)]
    tables = [cos(a) for a in strips] + [sin(a) ** 2 for a in strips]
    tables += [cos(a) for a in about] + [sin(a) ** 2 for a in about]
    return tables + [node for node, _ in nodes] + [weight for _, weight in nodes]

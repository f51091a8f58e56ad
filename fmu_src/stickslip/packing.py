"""Named parameters to the kernel's vector ``p``. Pure Python: it travels inside the FMU."""

from math import cos, hypot, pi, radians, sin, sqrt
from random import Random

from .kernel import layout
from .kernel.layout import (
    P_ANCHOR,
    P_ASPERITY,
    P_ATTACH,
    P_COUETTE,
    P_CURVE,
    P_CURVE_POINTS,
    P_FEEDING,
    P_INERTIA,
    P_INITIAL,
    P_LOCAL_LAW,
    P_LONGEST_STEP,
    P_MASS,
    P_MELT_FILM,
    P_MU_K,
    P_MU_S,
    P_NORMAL_FORCE,
    P_QUADRATURE,
    P_RADIUS,
    P_RATE,
    P_RELATIVE_STIFFNESS,
    P_RIPPLE,
    P_RIPPLE_PHASE,
    P_RIPPLE_RATE,
    P_SCATTER_WAVES,
    P_SHORTEST,
    P_SIZE,
    P_SPEED_SCALE,
    P_STICK_CREEP,
    P_STIFFNESS,
    P_TABLEAU,
)
from .kernel.tableau import flat_tableau

GRAVITY = 9.81  # m/s^2
CURVE_LIMIT = 16  # points of a force-length curve that ``p`` has room for

# where each parameter stands, for those that enter the kernel as they are
SLOTS = {
    "rig.mass": "P_MASS",
    "rig.contact_radius": "P_RADIUS",
    "rig.free_y": "P_FREE_Y",
    "rig.free_phi": "P_FREE_PHI",
    "rig.spring_natural_length": "P_NATURAL_LENGTH",
    "springs.stiffness": "P_STIFFNESS",
    "friction.mu_s": "P_MU_S",
    "friction.mu_k": "P_MU_K",
    "lateral_friction.ratio": "P_LATERAL",
    "turning_surface.curvature": "P_CURVATURE",
    "static_strengthening.rate": "P_STRENGTHENING",
    "static_strengthening.hold_time": "P_HOLD_TIME",
    "static_strengthening.saturating": "P_SATURATING",
    "static_strengthening.saturation_time": "P_SATURATION_TIME",
    "velocity_weakening.linear": "P_LINEAR",
    "velocity_weakening.hyperbolic": "P_HYPERBOLIC",
    "velocity_weakening.inverse_root": "P_INVERSE_ROOT",
    "velocity_weakening.stribeck": "P_STRIBECK",
    "velocity_weakening.stribeck_speed": "P_STRIBECK_SPEED",
    "film_drag.coefficient": "P_FILM",
    "film_drag.root_coefficient": "P_FILM_ROOT",
    "thermal_weakening.per_joule": "P_WEAKENING",
    "thermal_weakening.relaxation_time": "P_RELAXATION",
    "thermal_weakening.curvature": "P_WEAKENING_CURVATURE",
    "run_in.change": "P_RUN_IN",
    "run_in.distance": "P_RUN_IN_DISTANCE",
    "spring_hardening.cubic": "P_CUBIC",
    "spring_hardening.neutral_extension": "P_NEUTRAL",
    "structural_damping.coefficient": "P_DAMPING",
    "structural_damping.rotational": "P_DAMPING_ROTATION",
    "speed_ripple.amplitude": "P_RIPPLE",
    "speed_ripple.second_amplitude": "P_RIPPLE_SECOND",
    "surface_pattern.amplitude": "P_PATTERN",
    "surface_pattern.second_amplitude": "P_PATTERN_SECOND",
    "surface_scatter.deviation": "P_SCATTER",
    "stick_stiffness.ratio": "P_STICK_RATIO",
    "rate_and_state.direct": "P_DIRECT",
    "rate_and_state.evolution": "P_EVOLUTION",
    "rate_and_state.distance": "P_STATE_DISTANCE",
    "rate_and_state.reference_speed": "P_STATE_SPEED",
    "rate_and_state.initial_age": "P_INITIAL_AGE",
    "temperature_dependence.sensitivity": "P_SENSITIVITY",
    "temperature_dependence.static_sensitivity": "P_STATIC_SENSITIVITY",
    "temperature_dependence.reference_degC": "P_REFERENCE",
    "mixed_lubrication.share": "P_FLOODED",
    "mixed_lubrication.roughness": "P_ROUGHNESS",
    "surface.run_up_time": "P_RUN_UP",
    "solver.tolerance": "P_TOLERANCE",
}
ASPERITY = ("length", "hardness", "effusivity", "constant")
FILM = ("wetted_share", "length", "viscosity", "latent_heat")
LOCAL_LAWS = (
    "velocity_weakening.linear",
    "velocity_weakening.hyperbolic",
    "velocity_weakening.inverse_root",
    "velocity_weakening.stribeck",
    "film_drag.root_coefficient",
    "asperity_melting.length",
    "melt_film.wetted_share",
    "mixed_lubrication.share",
)
# by these, friction depends on the way of the surface, the distance slid, the heat or the age
MEMORIES = (
    "surface_pattern.amplitude",
    "surface_scatter.deviation",
    "run_in.change",
    "thermal_weakening.per_joule",
    "rate_and_state.direct",
    "rate_and_state.evolution",
)


def pack(values: dict[str, float]) -> list[float]:
    """Kernel vector ``p`` from a mapping ``block.parameter`` -> value in SI units.

    The names are those of `Parameters.flat`, which are the FMU's; ``rig.inertia`` = 0 stands for a
    disc of the contact radius. The values are taken as checked.
    """
    p = [0.0] * P_SIZE
    for name, slot in SLOTS.items():
        p[getattr(layout, slot)] = float(values[name])
    departures = _imperfections(values)
    p[P_MASS] *= 1.0 + departures["mass"]
    p[P_INERTIA] = values["rig.inertia"] or 0.5 * p[P_MASS] * p[P_RADIUS] ** 2
    p[P_NORMAL_FORCE] = p[P_MASS] * GRAVITY
    load = p[P_NORMAL_FORCE] / values["load_dependence.reference_force"]
    p[P_MU_S] *= load ** -values["load_dependence.exponent"]
    p[P_MU_K] *= load ** -values["load_dependence.exponent"]
    limit = max(p[P_MU_S], p[P_MU_K]) * p[P_NORMAL_FORCE]
    p[P_STICK_CREEP] = values["friction.stick_creep"] / limit if limit > 0.0 else 0.0
    _set_melting(p, values)
    p[P_LOCAL_LAW] = float(any(values[name] != 0.0 for name in LOCAL_LAWS))
    if p[layout.P_DIRECT] != 0.0 or p[layout.P_EVOLUTION] != 0.0:
        p[layout.P_CREEP_SPEED] = values["rate_and_state.creep_speed"]
    remembers = any(values[name] != 0.0 for name in MEMORIES)
    p[P_FEEDING] = float(layout.REMEMBERED if remembers else layout.MOVING)
    for i, name in enumerate(("x", "y", "phi", "vx", "vy", "omega")):
        p[P_INITIAL + i] = values[f"initial.{name}"]
    for i, departure in enumerate(departures["start"]):
        p[P_INITIAL + i] += departure
    _place_springs(p, values)
    for i in range(4):
        p[P_RELATIVE_STIFFNESS + i] = 1.0 + departures["stiffness"][i]
    for i in range(8):
        p[P_ANCHOR + i] += departures["anchors"][i]
    _set_curve(p, values)
    _set_surface(p, values)
    _set_scales(p)
    p[P_QUADRATURE:P_TABLEAU] = quadrature_tables()
    tableau = flat_tableau()
    p[P_TABLEAU : P_TABLEAU + len(tableau)] = tableau
    return p


def _imperfections(values: dict[str, float]) -> dict[str, float | list[float]]:
    """What this rig departs by from the drawing: relative, relative, m, (m, m, rad).

    Normally distributed, cut at three standard deviations. The draws are the same whichever of
    them is switched on.
    """
    draw = Random(int(values["imperfections.seed"]))

    def departures(deviation: float, count: int) -> list[float]:
        return [deviation * max(-3.0, min(3.0, draw.gauss(0.0, 1.0))) for _ in range(count)]

    place = values["imperfections.start_position"]
    turn = radians(values["imperfections.start_angle_deg"])
    return {
        "mass": departures(values["imperfections.mass"], 1)[0],
        "stiffness": departures(values["imperfections.spring_stiffness"], 4),
        "anchors": departures(values["imperfections.anchor_position"], 8),
        "start": departures(place, 2) + departures(turn, 1),
    }


def _set_melting(p: list[float], values: dict[str, float]) -> None:
    """The laws as the kernel wants them: l (H / (C e))^2, (mu_f)^2 / v, and eta / p.

    p is the load on what a film covers; water of the melting face (mixed_lubrication) is spread
    over the whole contact.
    """
    asperity = {name: values[f"asperity_melting.{name}"] for name in ASPERITY}
    warming = asperity["constant"] * asperity["effusivity"]
    p[P_ASPERITY] = asperity["length"] * (asperity["hardness"] / warming) ** 2
    film = {name: values[f"melt_film.{name}"] for name in FILM}
    area = film["wetted_share"] * pi * p[P_RADIUS] ** 2
    shear = 2.0 * film["viscosity"] * film["latent_heat"] / film["length"]  # (Pa)^2 s/m
    p[P_MELT_FILM] = shear * (area / p[P_NORMAL_FORCE]) ** 2
    whole = pi * p[P_RADIUS] ** 2
    p[P_COUETTE] = values["mixed_lubrication.viscosity"] * whole / p[P_NORMAL_FORCE]


def _place_springs(p: list[float], values: dict[str, float]) -> None:
    """Attachments on the block, and anchors one spring length away from them.

    The springs lie along x, but for the turn and the shift of spring_misalignment. A spring
    shorter than a twentieth of its installed length has collapsed: the block has been carried into
    the anchor, where the direction of the spring force has no meaning any more.
    """
    length = values["rig.spring_length"]
    if p[P_STIFFNESS] > 0.0:
        p[P_SHORTEST] = 0.05 * length
    radius = values["rig.attachment_radius"]
    turn = radians(values["spring_misalignment.angle_deg"])
    for i in range(4):
        angle = radians(values[f"rig.attachment_angles_deg[{i + 1}]"])
        bx, by = radius * cos(angle), radius * sin(angle)
        outward = length if bx >= 0.0 else -length
        p[P_ATTACH + 2 * i : P_ATTACH + 2 * i + 2] = bx, by
        p[P_ANCHOR + 2 * i] = bx + outward * cos(turn)
        p[P_ANCHOR + 2 * i + 1] = (
            by + outward * sin(turn) + values["spring_misalignment.lateral_offset"]
        )


def _set_curve(p: list[float], values: dict[str, float]) -> None:
    """Points of the force-length curve with monotone slopes (Fritsch & Butland) and energies.

    The curve ends where the extensions stop growing; two points at least make a curve.
    """
    x = [values[f"springs.force_curve_extension[{i + 1}]"] for i in range(CURVE_LIMIT)]
    f = [values[f"springs.force_curve_force[{i + 1}]"] for i in range(CURVE_LIMIT)]
    count = 1
    while count < CURVE_LIMIT and x[count] > x[count - 1]:
        count += 1
    if count == 1:
        return
    p[P_CURVE_POINTS] = float(count)
    span = [x[i + 1] - x[i] for i in range(count - 1)]
    rise = [(f[i + 1] - f[i]) / span[i] for i in range(count - 1)]
    slope = [rise[0]] * count
    slope[-1] = rise[-1]
    for i in range(1, count - 1):
        slope[i] = 0.0
        if rise[i - 1] * rise[i] > 0.0:
            before, after = 2.0 * span[i] + span[i - 1], span[i] + 2.0 * span[i - 1]
            slope[i] = (before + after) / (before / rise[i - 1] + after / rise[i])
    energy = 0.0
    for i in range(count):
        if i > 0:
            h = span[i - 1]
            energy += h * (f[i - 1] + f[i]) / 2.0 + h * h * (slope[i - 1] - slope[i]) / 12.0
        at = P_CURVE + layout.CURVE_WIDTH * i
        p[at : at + 4] = x[i], f[i], slope[i], energy


def _set_surface(p: list[float], values: dict[str, float]) -> None:
    """Ripple of the speed, pattern and random field of the friction."""
    p[P_RIPPLE_RATE] = 2.0 * pi * values["speed_ripple.frequency"]
    p[P_RIPPLE_PHASE] = radians(values["speed_ripple.phase_deg"])
    p[layout.P_RIPPLE_SECOND_PHASE] = radians(values["speed_ripple.second_phase_deg"])
    p[layout.P_PATTERN_WAVENUMBER] = 2.0 * pi / values["surface_pattern.wavelength"]
    p[layout.P_PATTERN_PHASE] = radians(values["surface_pattern.phase_deg"])
    p[layout.P_PATTERN_SECOND_PHASE] = radians(values["surface_pattern.second_phase_deg"])
    # a Gaussian correlation of length L has normally distributed wavenumbers, deviation 1/L
    draw = Random(int(values["surface_scatter.seed"]))
    for i in range(layout.WAVES):
        wavenumber = draw.gauss(0.0, 1.0) / values["surface_scatter.correlation_length"]
        p[P_SCATTER_WAVES + 2 * i] = wavenumber
        p[P_SCATTER_WAVES + 2 * i + 1] = draw.uniform(0.0, 2.0 * pi)


def _set_scales(p: list[float]) -> None:
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
    if p[P_RIPPLE] != 0.0:
        fastest = p[P_RIPPLE_RATE] * (2.0 if p[layout.P_RIPPLE_SECOND] != 0.0 else 1.0)
        p[P_LONGEST_STEP] = min(p[P_LONGEST_STEP], 0.5 / fastest)


def quadrature_tables() -> list[float]:
    """Angles of strips and rays (midpoint rule) and Gauss-Legendre nodes, for `disc`."""
    rays = layout.RAYS
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

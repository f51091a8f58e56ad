"""Every effect that acts along x, in cycles of stick and slip against an independent model.

The other side (`one_mass_model`) has its own equations, scipy's integrator and scipy's events; each
law is written here once more, from the catalogue's sentence.
"""

import numpy as np
import pytest
from one_mass_model import DISTANCE, GRAVITY, RECENT_HEAT, TRAVEL, OneMass, X
from stickslip import Parameters, Rig, Solver, Springs, simulate

MASS, STIFFNESS, MU_S, MU_K, SPEED = 0.67, 80.68, 0.2815, 0.2086, 0.15
NORMAL = MASS * GRAVITY
RIG = Rig(mass=MASS, degrees_of_freedom=("x",), spring_length=1.0, spring_natural_length=1.0)
TIMES = np.linspace(0.0, 3.0, 301)


def model(**changes) -> OneMass:
    """The plain oscillator of the source study's first case, with some laws exchanged."""
    plain = {
        "mass": MASS,
        "pull": lambda x: -STIFFNESS * x,
        "kinetic": lambda sliding, s: MU_K * NORMAL,
        "static": lambda held, s: MU_S * NORMAL,
        "speed": lambda t: SPEED,
    }
    return OneMass(**(plain | changes))


def kinetic(law):
    """Friction force from a factor on mu_k that depends on sliding speed and state."""
    return lambda sliding, s: MU_K * NORMAL * law(sliding, s)


def ripple(t):
    return SPEED * (1.0 + 0.2 * np.sin(2.0 * np.pi * 1.3 * t + np.radians(40.0)))


def ripple_rate(t):
    return SPEED * 0.2 * 2.0 * np.pi * 1.3 * np.cos(2.0 * np.pi * 1.3 * t + np.radians(40.0))


def pattern(s):
    return 1.0 + 0.2 * np.cos(2.0 * np.pi * (s[X] - s[TRAVEL]) / 0.07 + np.radians(30.0))


#: Harmonics beside the first: part of it, and degrees by which they are on.
HARMONICS = {2: (0.4, 70.0), 3: (0.3, -50.0), 4: (0.15, 110.0)}


def with_harmonics(wave, angle):
    """A wave and its harmonics."""
    more = (part * wave(n * angle + np.radians(on)) for n, (part, on) in HARMONICS.items())
    return wave(angle) + sum(more)


def harmonic_ripple(t):
    return SPEED * (1.0 + 0.2 * with_harmonics(np.sin, 2.0 * np.pi * 1.3 * t + np.radians(40.0)))


def harmonic_ripple_rate(t):
    before, after = harmonic_ripple(t - 1e-5), harmonic_ripple(t + 1e-5)
    return (after - before) / 2e-5


def harmonic_pattern(s):
    angle = 2.0 * np.pi * (s[X] - s[TRAVEL]) / 0.07 + np.radians(30.0)
    return 1.0 + 0.2 * with_harmonics(np.cos, angle)


HIGHER = {
    f"{which}_{what}": value
    for which, (part, on) in zip(("second", "third", "fourth"), HARMONICS.values(), strict=True)
    for what, value in (("amplitude", part), ("phase_deg", on))
}


def warm(s):
    return 1.0 - 0.8 * s[RECENT_HEAT]


def worn(s):
    return 1.0 - 0.4 * (1.0 - np.exp(-((s[DISTANCE] / 0.15) ** 0.8)))


LIGHT, A_DECADE = (NORMAL / 10.0) ** -0.4, 1.0 - 0.4 * np.log10(NORMAL / 8.0)
ADHERING = (NORMAL + 3.0) / NORMAL * 8.0 / (8.0 + 3.0)

# effect -> (block and its parameters, the laws that the independent model gets)
CASES = {
    "plain": ({}, {}),
    "static_strengthening": (
        {"static_strengthening": {"rate": 0.05, "hold_time": 0.004}},
        {"static": lambda held, s: NORMAL * (MU_S + 0.05 * np.log10(1.0 + max(held, 0) / 0.004))},
    ),
    "static_strengthening, saturating": (
        {"static_strengthening": {"saturating": 0.08, "saturation_time": 0.05}},
        {"static": lambda held, s: NORMAL * (MU_S + 0.08 * (1 - np.exp(-max(held, 0) / 0.05)))},
    ),
    "static_strengthening, power": (
        {"static_strengthening": {"power": 0.08, "exponent": 0.4}},
        {"static": lambda held, s: NORMAL * (MU_S + 0.08 * max(held, 0) ** 0.4)},
    ),
    "velocity_weakening, power": (
        {"velocity_weakening": {"power": 0.2, "exponent": 1.6, "power_speed": 0.1}},
        {"kinetic": kinetic(lambda u, s: 1.0 / (1.0 + 0.2 * (u / 0.1) ** 1.6))},
    ),
    "velocity_weakening, logarithmic": (
        {"velocity_weakening": {"logarithmic": 0.15, "logarithm_speed": 0.02}},
        {"kinetic": kinetic(lambda u, s: 1.0 - 0.15 * np.log10(1.0 + u / 0.02))},
    ),
    "velocity_weakening, linear": (
        {"velocity_weakening": {"linear": 0.8}},
        {"kinetic": kinetic(lambda u, s: max(0.0, 1.0 - 0.8 * u))},
    ),
    "velocity_weakening, hyperbolic": (
        {"velocity_weakening": {"hyperbolic": 2.0}},
        {"kinetic": kinetic(lambda u, s: 1.0 / (1.0 + 2.0 * u))},
    ),
    "velocity_weakening, inverse root": (
        {"velocity_weakening": {"inverse_root": 20.0}},
        {"kinetic": kinetic(lambda u, s: (1.0 + 20.0 * u) ** -0.5)},
    ),
    "velocity_weakening, Stribeck": (
        {"velocity_weakening": {"stribeck": 0.3, "stribeck_speed": 0.06}},
        {"kinetic": kinetic(lambda u, s: 1.0 + 0.3 * np.exp(-u / 0.06))},
    ),
    "film_drag, linear": (
        {"film_drag": {"coefficient": 0.08}},
        {"kinetic": lambda u, s: MU_K * NORMAL + 0.08 * u},
    ),
    "film_drag, root": (
        {"film_drag": {"root_coefficient": 0.1}},
        {"kinetic": lambda u, s: MU_K * NORMAL + 0.1 * np.sqrt(u)},
    ),
    "film_drag, power": (
        {"film_drag": {"power": 0.015, "exponent": 1.7, "power_speed": 0.2}},
        {"kinetic": lambda u, s: MU_K * NORMAL + 0.015 * (u / 0.2) ** 1.7},
    ),
    "film_drag, saturating": (
        {"film_drag": {"saturating": 0.03, "saturation_speed": 0.1}},
        {"kinetic": lambda u, s: MU_K * NORMAL + 0.03 * u / (u + 0.1)},
    ),
    "thermal_weakening, mu_s in proportion": (
        {"thermal_weakening": {"per_joule": 0.8, "relaxation_time": 0.6, "static_relative": 1.0}},
        {
            "kinetic": kinetic(lambda u, s: warm(s)),
            "static": lambda held, s: MU_S * NORMAL * warm(s),
            "relaxation": 0.6,
        },
    ),
    "thermal_weakening, mu_s by as much": (
        {"thermal_weakening": {"per_joule": 0.8, "relaxation_time": 0.6, "static_absolute": 1.0}},
        {
            "kinetic": kinetic(lambda u, s: warm(s)),
            "static": lambda held, s: NORMAL * (MU_S - MU_K * (1.0 - warm(s))),
            "relaxation": 0.6,
        },
    ),
    "run_in, stretched, mu_s in proportion": (
        {"run_in": {"change": -0.4, "distance": 0.15, "stretching": 0.8, "static_relative": 1.0}},
        {
            "kinetic": kinetic(lambda u, s: worn(s)),
            "static": lambda held, s: MU_S * NORMAL * worn(s),
        },
    ),
    "run_in, stretched, mu_s by as much": (
        {"run_in": {"change": -0.4, "distance": 0.15, "stretching": 0.8, "static_absolute": 1.0}},
        {
            "kinetic": kinetic(lambda u, s: worn(s)),
            "static": lambda held, s: NORMAL * (MU_S - MU_K * (1.0 - worn(s))),
        },
    ),
    "thermal_weakening": (
        {"thermal_weakening": {"per_joule": 0.8, "relaxation_time": 0.6}},
        {"kinetic": kinetic(lambda u, s: max(0.0, 1.0 - 0.8 * s[RECENT_HEAT])), "relaxation": 0.6},
    ),
    "thermal_weakening, exponential": (
        {"thermal_weakening": {"per_joule": 0.8, "relaxation_time": 0.6, "curvature": 0.0}},
        {"kinetic": kinetic(lambda u, s: np.exp(-0.8 * s[RECENT_HEAT])), "relaxation": 0.6},
    ),
    "thermal_weakening, hyperbolic": (
        {"thermal_weakening": {"per_joule": 0.8, "relaxation_time": 0.6, "curvature": 1.0}},
        {"kinetic": kinetic(lambda u, s: 1.0 / (1.0 + 0.8 * s[RECENT_HEAT])), "relaxation": 0.6},
    ),
    "run_in": (
        {"run_in": {"change": -0.4, "distance": 0.15}},
        {"kinetic": kinetic(lambda u, s: 1.0 - 0.4 * (1.0 - np.exp(-s[DISTANCE] / 0.15)))},
    ),
    "spring_hardening": (
        {"spring_hardening": {"cubic": 2e4}},
        {"pull": lambda x: -STIFFNESS * x - 8e4 * x**3},
    ),
    "spring_hardening, about another extension": (
        {"spring_hardening": {"cubic": 2e4, "neutral_extension": 0.01}},
        {"pull": lambda x: -STIFFNESS * x - 4e4 * ((x + 0.01) ** 3 + (x - 0.01) ** 3)},
    ),
    "spring_hardening, quintic": (
        {"spring_hardening": {"quintic": 2e7}},
        {"pull": lambda x: -STIFFNESS * x - 8e7 * x**5},
    ),
    "structural_damping": ({"structural_damping": {"coefficient": 0.08}}, {"damping": 0.08}),
    "speed_ripple": (
        {"speed_ripple": {"amplitude": 0.2, "frequency": 1.3, "phase_deg": 40.0}},
        {"speed": ripple, "acceleration": ripple_rate},
    ),
    "surface_pattern": (
        {"surface_pattern": {"amplitude": 0.2, "wavelength": 0.07, "phase_deg": 30.0}},
        {
            "kinetic": kinetic(lambda u, s: pattern(s)),
            "static": lambda held, s: MU_S * NORMAL * pattern(s),
        },
    ),
    "speed_ripple, four harmonics": (
        {"speed_ripple": {"amplitude": 0.2, "frequency": 1.3, "phase_deg": 40.0} | HIGHER},
        {"speed": harmonic_ripple, "acceleration": harmonic_ripple_rate},
    ),
    "surface_pattern, four harmonics": (
        {"surface_pattern": {"amplitude": 0.2, "wavelength": 0.07, "phase_deg": 30.0} | HIGHER},
        {
            "kinetic": kinetic(lambda u, s: harmonic_pattern(s)),
            "static": lambda held, s: MU_S * NORMAL * harmonic_pattern(s),
        },
    ),
    "load_dependence": (
        {"load_dependence": {"exponent": 0.4, "reference_force": 10.0}},
        {
            "kinetic": kinetic(lambda u, s: LIGHT),
            "static": lambda held, s: MU_S * NORMAL * LIGHT,
        },
    ),
    "load_dependence, adhesion": (
        {"load_dependence": {"adhesion": 3.0, "reference_force": 8.0}},
        {
            "kinetic": kinetic(lambda u, s: ADHERING),
            "static": lambda held, s: MU_S * NORMAL * ADHERING,
        },
    ),
    "load_dependence, so much a decade": (
        {"load_dependence": {"logarithmic": 0.4, "reference_force": 8.0}},
        {
            "kinetic": kinetic(lambda u, s: A_DECADE),
            "static": lambda held, s: MU_S * NORMAL * A_DECADE,
        },
    ),
    "stick_stiffness": ({"stick_stiffness": {"ratio": 0.4}}, {"judged": 0.4}),
}


@pytest.mark.parametrize("case", CASES)
def test_cycles(case):
    blocks, laws = CASES[case]
    parameters = Parameters(
        rig=RIG,
        springs=Springs(stiffness=STIFFNESS / 4.0),
        solver=Solver(tolerance=1e-13),
        initial={"vx": float(laws["speed"](0.0)) if "speed" in laws else SPEED},
        **blocks,
    )
    run = simulate(parameters, TIMES[-1], TIMES[1])
    samples, events = model(**laws).run(TIMES)
    assert len(events) >= 3  # break-away, re-stick, break-away again
    # speed times the rounding of an event's time is far below; what is left is both integrators'
    np.testing.assert_allclose(run.events, events, rtol=0, atol=1e-9)
    np.testing.assert_allclose(run["x"], samples[X], rtol=0, atol=1e-9)
    np.testing.assert_allclose(run["heat"], samples[2], rtol=0, atol=1e-9)
    np.testing.assert_allclose(run["sliding_distance"], samples[DISTANCE], rtol=0, atol=1e-9)

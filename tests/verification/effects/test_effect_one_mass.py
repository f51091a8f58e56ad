"""Every effect that acts along x, in cycles of stick and slip against an independent model.

The other side (`one_mass_model`) has its own equations, scipy's integrator and scipy's events; each
law is written here once more, from the catalogue's sentence.
"""

import numpy as np
import pytest
from one_mass_model import DISTANCE, GRAVITY, RECENT_HEAT, TRAVEL, OneMass, X
from stickslip import Parameters, simulate

MASS, STIFFNESS, MU_S, MU_K, SPEED = 0.67, 80.68, 0.2815, 0.2086, 0.15
NORMAL = MASS * GRAVITY

RIG = dict(mass=MASS, degrees_of_freedom=("x",), spring_length=1.0, spring_natural_length=1.0)
TIMES = np.linspace(0.0, 3.0, 301)


def kinetic(law):
    """mu_k times what depends on sliding speed and state."""
    return {"kinetic": lambda sliding, s: MU_K * NORMAL * law(sliding, s)}


def drag(force):
    """A force of the sliding speed beside mu_k, N."""
    return {"kinetic": lambda sliding, s: MU_K * NORMAL + force(sliding)}


def held(more):
    """What mu_s has gained after so long at rest."""
    return {"static": lambda time, s: NORMAL * (MU_S + more(max(time, 0.0)))}


def both(law):
    """A factor of the state on mu_k and mu_s."""
    return kinetic(lambda u, s: law(s)) | {"static": lambda time, s: MU_S * NORMAL * law(s)}


def by_as_much(law):
    """A factor of the state on mu_k; mu_s changes by as much."""
    static = {"static": lambda time, s: NORMAL * (MU_S - MU_K * (1.0 - law(s)))}
    return kinetic(lambda u, s: law(s)) | static


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
HEATED, FADES = {"per_joule": 0.8, "relaxation_time": 0.6}, {"relaxation": 0.6}
WORN = {"change": -0.4, "distance": 0.15, "stretching": 0.8}
RIPPLED = {"amplitude": 0.2, "frequency": 1.3, "phase_deg": 40.0}
PATTERNED = {"amplitude": 0.2, "wavelength": 0.07, "phase_deg": 30.0}

# effect, which of its laws -> its parameters, the laws that the independent model gets
CASES = {
    "plain": ({}, {}),
    "static_strengthening": (
        {"rate": 0.05, "hold_time": 0.004}, held(lambda t: 0.05 * np.log10(1.0 + t / 0.004))),
    "static_strengthening, saturating": (
        {"saturating": 0.08, "saturation_time": 0.05}, held(lambda t: 0.08 * -np.expm1(-t / 0.05))),
    "static_strengthening, power": (
        {"power": 0.08, "exponent": 0.4}, held(lambda t: 0.08 * t**0.4)),
    "velocity_weakening, power": (
        {"power": 0.2, "exponent": 1.6, "power_speed": 0.1},
        kinetic(lambda u, s: 1.0 / (1.0 + 0.2 * (u / 0.1) ** 1.6))),
    "velocity_weakening, logarithmic": (
        {"logarithmic": 0.15, "logarithm_speed": 0.02},
        kinetic(lambda u, s: 1.0 - 0.15 * np.log10(1.0 + u / 0.02))),
    "velocity_weakening, linear": ({"linear": 0.8}, kinetic(lambda u, s: max(0.0, 1.0 - 0.8 * u))),
    "velocity_weakening, hyperbolic": (
        {"hyperbolic": 2.0}, kinetic(lambda u, s: 1.0 / (1.0 + 2.0 * u))),
    "velocity_weakening, inverse root": (
        {"inverse_root": 20.0}, kinetic(lambda u, s: (1.0 + 20.0 * u) ** -0.5)),
    "velocity_weakening, Stribeck": (
        {"stribeck": 0.3, "stribeck_speed": 0.06},
        kinetic(lambda u, s: 1 + 0.3 * np.exp(-u / 0.06))),
    "film_drag, linear": ({"coefficient": 0.08}, drag(lambda u: 0.08 * u)),
    "film_drag, root": ({"root_coefficient": 0.1}, drag(lambda u: 0.1 * np.sqrt(u))),
    "film_drag, power": (
        {"power": 0.015, "exponent": 1.7, "power_speed": 0.2},
        drag(lambda u: 0.015 * (u / 0.2) ** 1.7)),
    "film_drag, saturating": (
        {"saturating": 0.03, "saturation_speed": 0.1}, drag(lambda u: 0.03 * u / (u + 0.1))),
    "thermal_weakening, mu_s in proportion": (
        HEATED | {"static_relative": 1.0}, both(warm) | FADES),
    "thermal_weakening, mu_s by as much": (
        HEATED | {"static_absolute": 1.0}, by_as_much(warm) | FADES),
    "thermal_weakening": (HEATED, kinetic(lambda u, s: max(0.0, warm(s))) | FADES),
    "thermal_weakening, exponential": (
        HEATED | {"curvature": 0.0}, kinetic(lambda u, s: np.exp(-0.8 * s[RECENT_HEAT])) | FADES),
    "thermal_weakening, hyperbolic": (
        HEATED | {"curvature": 1.0},
        kinetic(lambda u, s: 1.0 / (1.0 + 0.8 * s[RECENT_HEAT])) | FADES),
    "run_in, stretched, mu_s in proportion": (WORN | {"static_relative": 1.0}, both(worn)),
    "run_in, stretched, mu_s by as much": (WORN | {"static_absolute": 1.0}, by_as_much(worn)),
    "run_in": (
        {"change": -0.4, "distance": 0.15},
        kinetic(lambda u, s: 1.0 - 0.4 * (1.0 - np.exp(-s[DISTANCE] / 0.15)))),
    "spring_hardening": ({"cubic": 2e4}, {"pull": lambda x: -STIFFNESS * x - 8e4 * x**3}),
    "spring_hardening, about another extension": (
        {"cubic": 2e4, "neutral_extension": 0.01},
        {"pull": lambda x: -STIFFNESS * x - 4e4 * ((x + 0.01) ** 3 + (x - 0.01) ** 3)}),
    "spring_hardening, quintic": (
        {"quintic": 2e7}, {"pull": lambda x: -STIFFNESS * x - 8e7 * x**5}),
    "structural_damping": ({"coefficient": 0.08}, {"damping": lambda v: 0.08 * v}),
    "structural_damping, quadratic": ({"quadratic": 0.5}, {"damping": lambda v: 0.5 * abs(v) * v}),
    "structural_damping, dry": (
        {"dry_force": 0.02, "dry_speed": 0.05},
        {"damping": lambda v: 0.02 * v / np.hypot(v, 0.05)}),
    "speed_ripple": (RIPPLED, {"speed": ripple, "acceleration": ripple_rate}),
    "surface_pattern": (PATTERNED, both(pattern)),
    "speed_ripple, four harmonics": (
        RIPPLED | HIGHER, {"speed": harmonic_ripple, "acceleration": harmonic_ripple_rate}),
    "surface_pattern, four harmonics": (PATTERNED | HIGHER, both(harmonic_pattern)),
    "load_dependence": ({"exponent": 0.4, "reference_force": 10.0}, both(lambda s: LIGHT)),
    "load_dependence, adhesion": (
        {"adhesion": 3.0, "reference_force": 8.0}, both(lambda s: ADHERING)),
    "load_dependence, so much a decade": (
        {"logarithmic": 0.4, "reference_force": 8.0}, both(lambda s: A_DECADE)),
    "stick_stiffness": ({"ratio": 0.4}, {"judged": 0.4}),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_cycles(case):
    effect, laws = CASES[case]
    parameters = Parameters(
        rig=RIG,
        springs=dict(stiffness=STIFFNESS / 4.0),
        solver=dict(tolerance=1e-13),
        initial={"vx": float(laws["speed"](0.0)) if "speed" in laws else SPEED},
        **({case.partition(",")[0]: effect} if effect else {}),
    )
    run = simulate(parameters, TIMES[-1], TIMES[1])
    samples, events = OneMass(**laws).run(TIMES)
    assert len(events) >= 3  # break-away, re-stick, break-away again
    # speed times the rounding of an event's time is far below; what is left is both integrators'
    np.testing.assert_allclose(run.events, events, rtol=0, atol=1e-9)
    np.testing.assert_allclose(run["x"], samples[X], rtol=0, atol=1e-9)
    np.testing.assert_allclose(run["heat"], samples[2], rtol=0, atol=1e-9)
    np.testing.assert_allclose(run["sliding_distance"], samples[DISTANCE], rtol=0, atol=1e-9)

"""The curve that a law is, against its formula as its file states it."""

import numpy as np
import pytest
from stickslip import EFFECTS, Parameters
from stickslip.friction.law_curves import axis_of, law_curve

MU_S, MU_K = 0.2815, 0.2086
#: Effect -> its table, and the formula over the axis.
FORMULAS = {
    "static_strengthening": ({"rate": 0.05}, lambda t: MU_S + 0.05 * np.log10(1.0 + t / 0.01)),
    "velocity_weakening": ({"hyperbolic": 2.0}, lambda v: MU_K / (1.0 + 2.0 * v)),
    "thermal_weakening": ({"per_joule": 0.4}, lambda q: MU_K * (1.0 - 0.4 * q)),
    "run_in": ({"change": -0.5}, lambda s: MU_K * (1.0 - 0.5 * (1.0 - np.exp(-s)))),
    "spring_hardening": ({"cubic": 3e4}, lambda e: 20.17 * e + 3e4 * e**3),
    "structural_damping": ({"coefficient": 0.5}, lambda v: -0.5 * v),
    "surface_pattern": ({"amplitude": 0.15, "wavelength": 0.3},
        lambda s: MU_K * (1.0 + 0.15 * np.cos(2.0 * np.pi * s / 0.3))),
    "load_dependence": ({"exponent": 0.3, "reference_force": 8.0},
        lambda n: MU_K * (n / 8.0) ** -0.3),
    "speed_ripple": ({"amplitude": 0.3, "frequency": 0.7},
        lambda t: 0.15 * (1.0 + 0.3 * np.sin(2.0 * np.pi * 0.7 * t))),
    # in steady sliding theta = D / v; creep at 1e-6 m/s is nothing here
    "rate_and_state": ({"direct": 0.01, "evolution": 0.03},
        lambda v: MU_K + (0.01 - 0.03) * np.log(v / 1e-4)),
}  # fmt: skip


def entry(name):
    return next(effect for effect in EFFECTS if effect.id == name)


@pytest.mark.parametrize("name", FORMULAS)
def test_the_curve_is_the_formula(name):
    table, formula = FORMULAS[name]
    reach = {"rate_and_state": 0.003, "thermal_weakening": 1.0}.get(name, 0.0)
    curve = law_curve(entry(name), Parameters(**{name: table}), reach=reach)
    # the creep speed under the root is (1e-6 / v)^2 / 2 of ln v, at v of 1e-5 m/s and more
    tolerance = 1e-4 if name == "rate_and_state" else 1e-12
    np.testing.assert_allclose(curve.y, formula(curve.x), rtol=0, atol=tolerance)
    assert np.ptp(curve.y) > 0.0


def test_what_is_no_curve_has_none():
    without = {effect.id for effect in EFFECTS if not axis_of(effect)}
    assert without == {
        "lateral_friction", "turning_surface", "spring_misalignment", "stick_stiffness",
    }  # fmt: skip
    assert all(law_curve(entry(name), Parameters()) is None for name in without)

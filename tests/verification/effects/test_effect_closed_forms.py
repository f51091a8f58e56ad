"""Effects where a closed form or a published figure says the answer.

What acts along x is compared with an independent model, law by law, in `test_effect_one_mass`.
"""

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline
from stickslip import Parameters, simulate

GRAVITY = 9.81
# along x alone, springs so long that none is ever carried into its anchor
UNIT = {
    "rig": {
        "mass": 1.0,
        "spring_length": 10.0,
        "spring_natural_length": 10.0,
        "degrees_of_freedom": ("x",),
    },
    "springs": {"stiffness": 0.25},
    "friction": {"mu_s": 1.0 / GRAVITY, "mu_k": 1.0 / GRAVITY},
    "surface": {"speed": 0.2},
    "initial": {"vx": 0.2},
    "solver": {"tolerance": 1e-13},
}
FREE = {"friction": {"mu_s": 0.0, "mu_k": 0.0}}


def unit(**blocks) -> Parameters:
    """m = K = 1, F_s = F_k = 1 N, v = 0.2 m/s, from rest on the belt."""
    return Parameters(**(UNIT | blocks))


# Leine et al. (1998), |F| = F_s / (1 + 3 |v_rel|): computed independently to 1e-13
LEINE = {"period": 12.0010312948, "slip": 4.2959995255, "from": 1.0, "to": -0.5410063539}
# known to eight decimals
LEINE_EXTREMES = {"x_max": 1.13394468, "x_min": -0.55543269, "v_min": -0.83990205}


@pytest.fixture(scope="module")
def leine():
    return simulate(unit(velocity_weakening={"hyperbolic": 3.0}), 40.0, 1e-3)


def test_leine_cycle(leine):
    begins = leine.events[leine.events[:, 1] == 1]
    ends = leine.events[leine.events[:, 1] == 0]
    assert len(begins) == 3 and len(ends) == 3
    np.testing.assert_allclose(np.diff(begins[:, 0]), LEINE["period"], rtol=0, atol=1e-9)
    np.testing.assert_allclose(ends[:, 0] - begins[:, 0], LEINE["slip"], rtol=0, atol=1e-9)
    stick = begins[1:, 0] - ends[:-1, 0]
    np.testing.assert_allclose(stick, LEINE["period"] - LEINE["slip"], rtol=0, atol=1e-9)
    np.testing.assert_allclose(begins[:, 2], LEINE["from"], rtol=0, atol=1e-9)
    np.testing.assert_allclose(ends[:, 2], LEINE["to"], rtol=0, atol=1e-9)


def turning_points(time, x, v, a):
    """Places at which the velocity is 0, by cubics through value and slope between samples."""
    return CubicHermiteSpline(time, x, v)(CubicHermiteSpline(time, v, a).roots(extrapolate=False))


def test_leine_extremes(leine):
    """What the cubics err at 1 ms is below 1e-13."""
    inside = (leine.time > leine.events[0, 0] + 1e-3) & (leine.time < leine.events[1, 0] - 1e-3)
    t, x, v = leine.time[inside], leine["x"][inside], leine["vx"][inside]
    force = leine["friction_force_x"][inside] - x
    way, speed = CubicHermiteSpline(t, x, v), CubicHermiteSpline(t, v, force)
    turns, slowest = (each(each.derivative().roots(extrapolate=False)) for each in (way, speed))
    found = {"x_max": turns.max(), "x_min": turns.min(), "v_min": slowest.min()}
    assert found == pytest.approx(LEINE_EXTREMES, abs=5.1e-9)  # half the last digit known


def test_quadratic_damping_takes_its_part_of_every_swing():
    """m x'' + q |x'| x' + K x = 0, m = 1: (1 + 2 q a) exp(-2 q a) = (1 - 2 q b) exp(2 q b).

    a and b: distances from the middle at which a swing begins and ends; the first integral of the
    motion is linear in x'^2 over x.
    """
    q, start = 0.2, 1.0
    run = simulate(
        unit(structural_damping={"quadratic": q}, initial={"x": start}, **FREE), 30.0, 0.01
    )
    x, v = run["x"], run["vx"]
    turns = np.abs(turning_points(run.time, x, v, -x - q * np.abs(v) * v))
    turns = np.append(start, turns[turns < start - 1e-6])
    assert len(turns) > 8
    begin, end = turns[:-1], turns[1:]
    left, right = (1 + 2 * q * begin) * np.exp(-2 * q * begin), np.exp(2 * q * end)
    np.testing.assert_allclose((1 - 2 * q * end) * right, left, rtol=0, atol=1e-9)
    stored = 0.5 * (x**2 + v**2)
    np.testing.assert_allclose(run["damping_heat"], 0.5 * start**2 - stored, rtol=0, atol=1e-11)


@pytest.mark.parametrize("within", [1e-2, 1e-3])
def test_dry_guides_take_the_same_from_every_swing(within):
    """m x'' + F sign(x') + K x = 0, m = K = 1: each half swing ends 2 F nearer to the middle.

    Where the force turns round within v_0 it lacks v_0^2 / (2 v^2) of itself at the velocity v.
    """
    force, start = 0.02, 1.0
    dry = {"dry_force": force, "dry_speed": within}
    run = simulate(unit(structural_damping=dry, initial={"x": start}, **FREE), 30.0, 0.01)
    x, v = run["x"], run["vx"]
    turns = turning_points(run.time, x, v, -x - force * v / np.hypot(v, within))
    turns = np.abs(turns[np.abs(turns) < start - force])
    assert len(turns) > 8
    lost = 2.0 * force * np.arange(1, len(turns) + 1)
    assert np.max(np.abs(start - lost - turns)) < 10.0 * lost[-1] * within**2 * np.log(1.0 / within)
    stored = 0.5 * (x**2 + v**2)
    np.testing.assert_allclose(run["damping_heat"], 0.5 * start**2 - stored, rtol=0, atol=1e-11)

"""A contact with bristles along a line: against the equations of LuGre, and their limits.

sigma_0 = mu_s N / z_0, sigma_1 = 2 zeta sqrt(sigma_0 m), u the sliding velocity,

    m x'' = -K x - sigma_0 z - sigma_1 z',    z' = u - sigma_0 |u| z / (N g(u)),
    g(u) = mu_k + (mu_s - mu_k) exp(-(|u| / v_s)^p).
"""

import numpy as np
import pytest
from line_rig import GRAVITY, MU_K, MU_S, ONE_LINE
from scipy.integrate import solve_ivp
from stickslip import Parameters, simulate

RIG = {
    "mass": 0.67, "stiffness": 80.0, "speed": 0.05, "start": 0.05,
    "transition_speed": 3e-3, "transition_exponent": 1.0,
    "presliding_distance": 5e-5, "bristle_damping": 0.4,
}  # fmt: skip
#: The table of a scenario that each of them is in, where it is not `friction`.
ELSEWHERE = {
    "mass": ("rig", "mass"), "stiffness": ("springs", "stiffness"),
    "speed": ("surface", "speed"), "start": ("initial", "vx"),
}  # fmt: skip


def parameters(**changes) -> Parameters:
    tables = {"rig": {"degrees_of_freedom": ("x",), "attachment_angles_deg": ONE_LINE}}
    tables["friction"] = {"mu_s": MU_S, "mu_k": MU_K}
    for name, value in (RIG | {k: v for k, v in changes.items() if k in RIG}).items():
        table, key = ELSEWHERE.get(name, ("friction", name))
        tables.setdefault(table, {})[key] = value / 4.0 if name == "stiffness" else value
    return Parameters(**tables, **{k: v for k, v in changes.items() if k not in RIG})


def by_scipy(times, **changes):
    """x at ``times`` by LSODA; in slip the bristles begin with the shear of steady sliding."""
    rig = RIG | changes
    m, normal, speed = rig["mass"], rig["mass"] * GRAVITY, rig["speed"]
    stiff = MU_S * normal / rig["presliding_distance"]
    damper = 2.0 * rig["bristle_damping"] * np.sqrt(stiff * m)

    def limit(u):
        fall = (abs(u) / rig["transition_speed"]) ** rig["transition_exponent"]
        return normal * (MU_K + (MU_S - MU_K) * np.exp(-fall)) / stiff

    def slopes(t, y):
        u = y[1] - speed
        rate = u - abs(u) * y[2] / limit(u)
        force = -rig["stiffness"] * y[0] - stiff * y[2] - damper * rate
        return [y[1], force / m, rate]

    u = rig["start"] - speed
    start = [0.0, rig["start"], np.sign(u) * limit(u)]
    run = solve_ivp(slopes, (0.0, times[-1]), start, "LSODA", t_eval=times, rtol=1e-10, atol=1e-13)
    return run.y[0]


@pytest.mark.parametrize(("changes", "duration"), [
    ({}, 4.0),
    ({"speed": 0.15, "start": 0.0, "mass": 2.0}, 4.0),
    ({"speed": 0.02, "stiffness": 160.0, "transition_speed": 1e-3}, 4.0),
    ({"presliding_distance": 2e-5, "transition_speed": 8e-3, "mass": 1.5}, 5.0),
    ({"presliding_distance": 1e-4, "transition_exponent": 2.0, "speed": 0.1}, 5.0),
    ({"bristle_damping": 0.1, "transition_exponent": 0.7}, 3.0),
])  # fmt: skip
def test_the_motion_is_that_of_lugre(changes, duration):
    run = simulate(parameters(**changes), duration, 0.01)
    x = by_scipy(run.time, **changes)
    assert run["slip_count"][-1] >= 4
    assert np.abs(run["x"] - x).max() < 3e-7
    assert np.abs(run["energy_residual"]).max() < 1e-10 * run["heat"][-1]
    assert np.all(np.diff(run["heat"]) > 0.0)


def test_a_rigid_contact_is_the_limit():
    """Of order 2/3 in z_0, as the delay of a load that passes a fold slowly.

    (Haberman, SIAM J. Appl. Math. 37, 1979: here the turning point of the next test.)
    """
    distances = np.array([4e-6, 2e-6, 1e-6])
    rigid = simulate(parameters(presliding_distance=0.0), 1.3, 0.01)
    apart = []
    for distance in distances:
        run = simulate(parameters(presliding_distance=distance), 1.3, 0.01)
        apart.append(np.abs(run["x"] - rigid["x"]).max())
    order = np.log2(np.array(apart[:-1]) / apart[1:])
    np.testing.assert_allclose(order, 2.0 / 3.0, atol=0.05)


@pytest.mark.parametrize("damping", [0.05, 0.4])
def test_the_ringing_of_bristles_is_no_slip(damping):
    """One slip for each rise and fall of the springs' load, however the block rings afterwards."""
    run = simulate(parameters(presliding_distance=1e-4, bristle_damping=damping), 4.0, 1e-3)
    x = run["x"]
    falls = np.flatnonzero((x[1:-1] > x[:-2]) & (x[1:-1] >= x[2:]) & (x[1:-1] > 0.02))
    cycles = 1 + np.count_nonzero(np.diff(run.time[falls]) > 0.2)
    assert run["slip_count"][-1] == len(run.slip_starts) == cycles >= 5
    rings = (run["vx"] > RIG["speed"]) & (run["mode"] == 0.0)
    assert np.count_nonzero(rings) > 10


def test_a_contact_that_ages_holds_more():
    """Slowly loaded it breaks away at what mu_s has grown to, less what its loading takes."""
    slow, growth = {"speed": 1e-3, "start": 1e-3, "transition_speed": 8e-3, "mass": 0.3}, 0.06
    held = []
    for saturating in (0.0, growth):
        ageing = {"saturating": saturating, "saturation_time": 0.05}
        run = simulate(parameters(**slow, static_strengthening=ageing), 25.0, 0.01)
        held.append(RIG["stiffness"] * run["x"].max() / (slow["mass"] * GRAVITY))
    assert held[1] - held[0] == pytest.approx(growth, rel=0.1)

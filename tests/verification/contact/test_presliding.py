"""A contact that creeps in stick: closed forms, the regularised law, loads that change.

On one linear spring the block moves as x = x_e (1 - exp(-V t / x_e)), x_e = mu_s N V / (v_c K): it
breaks away where K x = mu_s N, unless the surface is slower than the creep at that load.
"""

import numpy as np
import pytest
from line_rig import GRAVITY, MASS, MU_K, MU_S, STIFFNESS, line
from scipy.integrate import solve_ivp
from stickslip import Parameters, simulate
from stickslip.catalogue import CATALOGUE
from stickslip.kernel import layout

SPEED, CREEP = 0.02, 2e-3
HOLD = MU_S * MASS * GRAVITY
RATE = CREEP * STIFFNESS / HOLD  # of the exponential, 1/s


def on_a_line(duration=3.0, interval=0.01, **tables):
    return simulate(line(SPEED, {"stick_creep": CREEP}, **tables), duration, interval)


def way(time, rate=RATE):
    return SPEED / rate * -np.expm1(-rate * time)


def test_the_way_and_the_break_away_of_a_linear_spring():
    run = on_a_line()
    away = run.slip_starts[0]
    assert away == pytest.approx(-np.log1p(-RATE * HOLD / STIFFNESS / SPEED) / RATE, rel=1e-13)
    stick = run.time < away
    np.testing.assert_allclose(run["x"][stick], way(run.time[stick]), rtol=1e-12, atol=0)
    lag = CREEP * run["friction_force_x"][stick] / HOLD
    np.testing.assert_allclose(SPEED - run["vx"][stick], lag, rtol=0, atol=1e-15)


def test_what_a_stick_that_creeps_shows():
    """Sliding speed, distance slid and heat are those of the creep; the mode is that of a stick."""
    run = on_a_line(interval=1e-3)
    stick = run.time < run.slip_starts[0]
    time, x = run.time[stick], run["x"][stick]
    slid = SPEED * time - x
    lag = RATE * x
    power = STIFFNESS * x * lag
    heat = time + 2.0 * np.expm1(-RATE * time) / RATE - np.expm1(-2.0 * RATE * time) / (2.0 * RATE)
    heat *= STIFFNESS * RATE * (SPEED / RATE) ** 2
    assert not run["mode"][stick].any() and not run["slip_time"][stick].any()
    np.testing.assert_allclose(run["sliding_speed"][stick], lag, rtol=1e-10, atol=0)
    np.testing.assert_allclose(run["sliding_distance"][stick], slid, rtol=0, atol=1e-13)
    np.testing.assert_allclose(run["heat"][stick], heat, rtol=0, atol=1e-13)
    # the heat of a step of a millisecond over it: the power in its middle
    middle = 0.5 * (power[1:] + power[:-1])
    np.testing.assert_allclose(run["heat_flow"][stick][1:], middle, rtol=0, atol=1e-7)
    work = SPEED * STIFFNESS * (SPEED * time - x) / RATE  # of friction, K x V
    work += 0.5 * MASS * (run["vx"][stick] ** 2 - SPEED**2)  # and the momentum that creep takes
    np.testing.assert_allclose(run["surface_work"][stick], work, rtol=0, atol=1e-12)


def test_a_surface_slower_than_the_creep_never_loses_the_block():
    """As the FMU can be told at any time; a scenario is refused."""
    slow = 0.5 * CREEP
    quick = line(2.0 * CREEP, {"stick_creep": CREEP}, initial={"vx": slow})
    surface = quick.surface.model_copy(update={"speed": slow})
    run = simulate(quick.model_copy(update={"surface": surface}), 40.0, 0.1)
    assert len(run.events) == 0
    load = 0.5 * HOLD * -np.expm1(-RATE * run.time)
    np.testing.assert_allclose(STIFFNESS * run["x"], load, rtol=1e-11, atol=0)


def test_a_contact_that_ages_breaks_away_at_what_it_holds_then():
    growth, hold_time = 0.05, 0.1
    ageing = {"rate": growth, "hold_time": hold_time}
    away = on_a_line(5.0, static_strengthening=ageing).slip_starts[0]
    holds = (MU_S + growth * np.log10(1.0 + away / hold_time)) * MASS * GRAVITY
    assert STIFFNESS * way(away) == pytest.approx(holds, rel=1e-12)


def test_the_heat_of_a_creep_weakens_the_slip_after_it():
    law = {"per_joule": 20.0, "relaxation_time": 1e9}
    run = on_a_line(3.0, 1e-4, thermal_weakening=law)
    first = int(np.flatnonzero(run["mode"] == 1)[0])
    heat = run["heat"][first]
    assert heat > 1e-4
    friction = run["friction_force_x"][first] / (MU_K * MASS * GRAVITY)
    assert 1.0 - friction == pytest.approx(20.0 * heat, rel=1e-6)


# The law with inertia, by scipy's stiff solver: m x'' = -K x + eta (V - x').


PLANES = {
    "belt": {},
    "isotropic": {"lateral_friction": {"ratio": 1.0}},
    "slab": {"rig": {"surface": "slab", "slab_radius": 0.4},
             "initial": {"vx": 0.02 * (1.0 - 0.007 / 0.4), "vy": 0.02 * -0.008 / 0.4,
                         "omega": 0.02 / 0.4}},
    "damped": {"structural_damping": {"coefficient": 3.0, "rotational": 0.01}},
    "guided": {"rig": {"degrees_of_freedom": ("x", "y")}},
}  # fmt: skip


def in_the_plane(case: str, creep: float) -> Parameters:
    blocks = {
        "rig": {"spring_natural_length": 0.17}, "springs": {"stiffness": 40.0},
        "friction": {"mu_s": 0.5, "stick_creep": creep}, "lateral_friction": {"ratio": 0.6},
        "surface": {"speed": 0.02}, "initial": {"x": -0.008, "y": 0.007, "phi": 0.1, "vx": 0.02},
    }  # fmt: skip
    for name, table in PLANES[case].items():
        blocks[name] = blocks.get(name, {}) | table
    return Parameters(**blocks)


def with_inertia(parameters: Parameters, end: float) -> np.ndarray:
    """Place at ``end`` by the stiff equations, from the velocity that a creep begins with."""
    kernel = CATALOGUE.compiled
    p, u, w = np.array(parameters.pack()), np.zeros(layout.U_SIZE), np.zeros(layout.W_SIZE)
    u[layout.U_SPEED] = parameters.surface.speed
    kappa = p[layout.P_LATERAL]
    eta = (
        np.array([1.0, kappa**2, 0.5 * (kappa * p[layout.P_RADIUS]) ** 2]) / p[layout.P_PRESLIDING]
    )
    inertia = np.array([p[layout.P_MASS], p[layout.P_MASS], p[layout.P_INERTIA]])
    free = np.array([1.0, p[layout.P_FREE_Y], p[layout.P_FREE_PHI]])

    def slopes(t, y):
        w[layout.W_STATE + 1 : layout.W_STATE + 7] = y
        kernel.set_contact(p, u, w, layout.W_STATE)
        force = (
            w[layout.W_LOAD : layout.W_LOAD + 3] - eta * w[layout.W_SLIDING : layout.W_SLIDING + 3]
        )
        return [*y[3:], *(free * force / inertia)]

    first = simulate(parameters, 1e-6, 1e-6)
    names = ("x", "y", "phi", "vx", "vy", "omega")
    start = [first[name][0] for name in names]
    run = solve_ivp(slopes, (0.0, end), start, method="Radau", rtol=1e-10, atol=1e-13)
    return run.y[:3, -1]


@pytest.mark.parametrize("case", PLANES)
def test_the_plane_s_creep_is_the_regularised_law_s_limit(case):
    """What inertia adds to the way falls with the square of the creep, the way with itself."""
    apart, crept = [], []
    for creep in (5e-4, 2.5e-4):
        parameters = in_the_plane(case, creep)
        run = simulate(parameters, 0.3)
        rigid = simulate(in_the_plane(case, 0.0), 0.3)
        assert not run["mode"].any() and not rigid["mode"].any()
        scale = np.array([1.0, 1.0, parameters.rig.contact_radius])
        place, held = (scale * [r[name][-1] for name in ("x", "y", "phi")] for r in (run, rigid))
        apart.append(np.abs(place - scale * with_inertia(parameters, run.time[-1])).max())
        crept.append(np.abs(place - held).max())
    assert crept[0] > 3e-5 and crept[0] / crept[1] == pytest.approx(2.0, rel=0.05)
    assert apart[0] < 1e-3 * crept[0]
    assert apart[0] / apart[1] == pytest.approx(4.0, rel=0.25)


def test_loads_that_change_at_every_step_do_not_tear_the_stick():
    """A force that grows to 0.15 of the limit in a second, in steps of the communication.

    From c = v_c / (mu_s N): x' = V - c (K x + q t), of second order in the step if the force is
    that of the middle.
    """
    kernel = CATALOGUE.compiled
    p, u = np.array(line(SPEED, {"stick_creep": CREEP}).pack()), np.zeros(layout.U_SIZE)
    u[layout.U_SPEED], growth = SPEED, 0.15 * HOLD
    ends = []
    for count in (100, 200):
        z, w = np.zeros(layout.Z_SIZE), np.zeros(layout.W_SIZE)
        e, o = np.zeros(layout.E_FIRST), np.zeros(layout.O_SIZE)
        kernel.initialise(p, z, 0.0)
        for step in range(count):
            u[layout.U_FORCE_X] = -growth * (step + 0.5) / count
            assert kernel.advance(p, u, z, w, e, (step + 1) / count) == layout.DONE
        kernel.show(p, u, z, w, o, 0)
        assert o[layout.O_MODE] == 0.0 and o[layout.O_SLIPS] == 0.0
        assert abs(o[layout.O_ENERGY_RESIDUAL]) < 1e-12
        ends.append((o[layout.O_X], o[layout.O_HEAT]))
    c = CREEP / HOLD

    def slopes(t, y):
        load = STIFFNESS * y[0] + growth * t
        return [SPEED - c * load, c * load**2]

    exact = solve_ivp(slopes, (0.0, 1.0), [0.0, 0.0], method="DOP853", rtol=1e-13, atol=1e-16)
    errors = np.abs(np.array(ends) - exact.y[:, -1])
    assert np.all(errors[1] < 1e-6)
    assert errors[0, 0] / errors[1, 0] == pytest.approx(4.0, rel=0.05)

"""What a contact remembers: heat as a half-space does, and its age over a distance of sliding."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from stickslip import Parameters, simulate

MASS, MU_K, SPEED = 0.67, 0.2, 0.15
NORMAL = MASS * 9.81
ALONG_X = {"degrees_of_freedom": ("x",), "spring_length": 1.0, "spring_natural_length": 1.0}


def test_a_constant_power_warms_a_half_space_with_the_root_of_the_time():
    """Carslaw & Jaeger: the loss is proportional to sqrt(t), from tau/20 to 20 tau, to 3 %.

    A block that rests where its springs balance friction makes heat at a constant power, but for a
    loss so small that it moves nothing; the friction force tells it.
    """
    time, small, stiffness = 0.5, 1e-6, 20.17
    power = MU_K * NORMAL * SPEED
    run = simulate(
        Parameters(
            rig={**ALONG_X, "mass": MASS},
            springs={"stiffness": stiffness},
            friction={"mu_s": MU_K, "mu_k": MU_K},
            surface={"speed": SPEED},
            initial={"x": MU_K * NORMAL / (4.0 * stiffness)},
            thermal_weakening={
                "per_joule": small / power,
                "relaxation_time": time,
                "diffusion": 1.0,
            },
        ),
        20.0 * time,
        time / 20.0,
    )
    assert np.all(run["mode"][1:] == 1)
    loss = 1.0 - np.abs(run["friction_force_x"][1:]) / (MU_K * NORMAL)
    warmth = loss / small / np.sqrt(run.time[1:])
    assert np.ptp(warmth) < 2.0 * 0.03 * np.mean([warmth.max(), warmth.min()])


def first_slip(**ageing):
    """Times, sliding speed and friction over normal force of the first slip, and its hold."""
    run = simulate(
        Parameters(
            rig={**ALONG_X, "mass": MASS},
            friction={"mu_s": 0.3, "mu_k": MU_K},
            initial={"vx": SPEED},
            static_strengthening=ageing,
        ),
        1.0,
        1e-4,
    )
    begin, end = run.events[0, 0], run.events[1, 0]
    inside = (run.time > begin) & (run.time < end)
    force = np.abs(run["friction_force_x"][inside]) / NORMAL
    return begin, run.time[inside], run["sliding_speed"][inside], force


@pytest.mark.parametrize(
    ("ageing", "worth"),
    [
        ({"rate": 0.05, "hold_time": 0.02}, lambda age: 0.05 * np.log10(1.0 + age / 0.02)),
        ({"power": 0.08, "exponent": 0.4}, lambda age: 0.08 * age**0.4),
        (
            {"saturating": 0.06, "saturation_time": 0.1},
            lambda age: 0.06 * (1.0 - np.exp(-age / 0.1)),
        ),
    ],
)
def test_sliding_renews_an_aged_contact_over_a_distance(ageing, worth):
    """theta' = 1 - v theta / D by scipy along the measured speed, from the hold at break-away."""
    distance = 3e-3
    hold, time, speed, mu = first_slip(**ageing, memory_distance=distance)
    assert hold == pytest.approx(time[0], abs=2e-4)
    along = CubicSpline(np.append(hold, time), np.append(0.0, speed))
    aged = solve_ivp(
        lambda t, age: 1.0 - along(t) * age / distance,
        (hold, time[-1]),
        [hold],
        t_eval=time,
        rtol=1e-10,
        atol=1e-12,
    )
    np.testing.assert_allclose(mu, MU_K + worth(aged.y[0]), rtol=0, atol=1e-6)
    assert mu[0] > MU_K + 0.9 * worth(hold) and mu.min() < MU_K + 0.5 * worth(hold)


def test_without_a_distance_sliding_forgets_at_once():
    _, _, _, mu = first_slip(rate=0.05)
    np.testing.assert_allclose(mu, MU_K, rtol=1e-12)


def test_what_sliding_has_left_counts_in_the_next_hold():
    """A renewal over more than a slip's way: break-aways come at higher loads than by the hold."""
    rig = {
        "rig": {**ALONG_X, "mass": MASS},
        "friction": {"mu_s": 0.3, "mu_k": MU_K},
        "initial": {"vx": SPEED},
    }
    begins = {}
    for distance in (0.0, 0.05):
        ageing = {"rate": 0.05, "hold_time": 0.02, "memory_distance": distance}
        run = simulate(Parameters(**rig, static_strengthening=ageing), 2.0)
        assert run.complete and np.max(np.abs(run["energy_residual"])) < 1e-9 * run["heat"][-1]
        begins[distance] = run.events[run.events[:, 1] == 1][:, 2]
    assert begins[0.05][0] == pytest.approx(begins[0.0][0], rel=1e-9)
    assert begins[0.05][1] > begins[0.0][1] + 1e-4

"""Heat that the contact remembers as a half-space does, against the closed form."""

import numpy as np
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
        Parameters(rig={**ALONG_X, "mass": MASS}, springs={"stiffness": stiffness},
                   friction={"mu_s": MU_K, "mu_k": MU_K}, surface={"speed": SPEED},
                   initial={"x": MU_K * NORMAL / (4.0 * stiffness)},
                   thermal_weakening={"per_joule": small / power, "relaxation_time": time,
                       "diffusion": 1.0}),
        20.0 * time, time / 20.0,
    )  # fmt: skip
    assert np.all(run["mode"][1:] == 1)
    loss = 1.0 - np.abs(run["friction_force_x"][1:]) / (MU_K * NORMAL)
    warmth = loss / small / np.sqrt(run.time[1:])
    assert np.ptp(warmth) < 2.0 * 0.03 * np.mean([warmth.max(), warmth.min()])

"""Kinetic friction by a table over the sliding speed, against scipy and laws as formulas."""

import random
import warnings

import numpy as np
import pytest
from kernel_steps import largest_step_difference, memory_of
from scipy.interpolate import PchipInterpolator
from stickslip import Parameters, simulate
from stickslip.catalogue import CATALOGUE
from stickslip.kernel.layout import P_MU_K

NORMAL = 0.67 * 9.81
#: Falls, is flat, has a peak, and falls to nothing.
SPEED = (0.0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.6)
MU = (0.25, 0.2, 0.2, 0.16, 0.22, 0.12, 0.0)
PLANAR = {
    "lateral_friction": {"ratio": 1.0},
    "rig": {"spring_natural_length": 0.17},
    "initial": {"x": 0.01, "y": 0.005, "phi": 0.2, "vx": 0.05},
}


def table(speed=SPEED, mu=MU, **more) -> dict:
    return {"friction": {"table_speed": tuple(speed), "table_mu": tuple(mu), "mu_s": 0.5, **more}}


def test_at_rest_the_contact_holds_the_larger_of_mu_s_and_the_first_point():
    for mu_s, held in ((0.4, 0.4), (0.1, 0.25)):
        with warnings.catch_warnings(action="ignore"):  # of a mu_s below that
            parameters = Parameters(
                rig={"degrees_of_freedom": ("x",), "spring_length": 1.0,
                     "spring_natural_length": 1.0},
                initial={"vx": 0.15}, **table(mu_s=mu_s),
            )  # fmt: skip
        assert parameters.pack()[P_MU_K] == MU[0]
        run = simulate(parameters, 3.0)
        assert 4.0 * 20.17 * run.events[0, 2] == pytest.approx(held * NORMAL, rel=1e-9)


def test_what_else_acts_on_mu_k_multiplies_it():
    """Load, place, distance slid: the force of a slip is all of them times the table's value."""
    run = simulate(
        Parameters(rig={"degrees_of_freedom": ("x",), "spring_natural_length": 0.17},
                   load_dependence={"exponent": 0.3, "reference_force": 8.0},
                   surface_pattern={"amplitude": 0.1, "wavelength": 0.2},
                   run_in={"change": -0.3, "distance": 0.5}, **table()),
        4.0, 1e-2,
    )  # fmt: skip
    slip = (run["mode"] == 1) & (run["sliding_speed"] > 1e-3)
    assert slip.sum() > 50
    place = (run["x"] - run["surface_travel"])[slip]
    factor = (NORMAL / 8.0) ** -0.3 * (1.0 + 0.1 * np.cos(2.0 * np.pi * place / 0.2))
    factor *= 1.0 - 0.3 * (1.0 - np.exp(-run["sliding_distance"][slip] / 0.5))
    mu = PchipInterpolator(SPEED, MU)(np.minimum(run["sliding_speed"][slip], SPEED[-1]))
    force = np.abs(run["friction_force_x"][slip])
    np.testing.assert_allclose(force, NORMAL * factor * mu, rtol=0, atol=1e-11)


def test_interpreted_and_compiled_take_the_same_step():
    draw = random.Random("table")
    for _ in range(5):
        mu = [draw.uniform(0.05, 0.3) for _ in SPEED]
        memory = memory_of(Parameters(**table(SPEED, mu), **PLANAR), -8.0, 0.0)
        assert largest_step_difference(CATALOGUE.compiled, memory, 60) == 0.0

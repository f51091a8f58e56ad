"""A coefficient that depends on the local speed, over the disc: quadrature against adaptive.

The kernel integrates over 8 x 4 points what the law's variation over the contact changes, over
twelve where the contact hardly spins, over four where next to nothing of it does. The error is
relative to mu_k, the largest over motions from pure sliding to pure spinning; a bound is about
twice what was found. Steep laws cost accuracy where the centre of rotation nears the rim.
"""

import numpy as np
import pytest
from disc_integral import law_over_disc
from scipy.interpolate import PchipInterpolator
from stickslip import Parameters
from stickslip.kernel import layout
from stickslip.kernel.friction.force import friction_in_slip
from stickslip.kernel.packing.vector import FEW_POINTS

MU, RADIUS, NORMAL = 0.2, 0.04, 0.67 * 9.81
FAST = 0.3  # m/s
# sliding and spinning (rim) speed, m/s
MOTIONS = ((0.3, 0.0), (0.3, 0.1), (0.3, 0.25), (0.3, 0.3), (0.25, 0.3), (0.1, 0.3), (0.0, 0.3))
#: Falls, is flat, has a peak, and falls to nothing.
TABLE = (0.0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.6), (0.25, 0.2, 0.2, 0.16, 0.22, 0.12, 0.0)
CURVE = PchipInterpolator(*TABLE)
# law -> (parameters, the law, bound on the error relative to mu_k)
LAWS = {
    "linear": ({"velocity_weakening.linear": 1.2}, lambda u: MU * (1.0 - 1.2 * u), 1.2e-5),
    "linear, used up": (
        {"velocity_weakening.linear": 4.0}, lambda u: MU * max(0.0, 1.0 - 4.0 * u), 1.5e-2,
    ),
    "hyperbolic": ({"velocity_weakening.hyperbolic": 3.0}, lambda u: MU / (1.0 + 3.0 * u), 5e-5),
    "inverse root": (
        {"velocity_weakening.inverse_root": 50.0}, lambda u: MU / np.sqrt(1.0 + 50.0 * u), 7e-4,
    ),
    "Stribeck": (
        {"velocity_weakening.stribeck": 0.5, "velocity_weakening.stribeck_speed": 0.05},
        lambda u: MU * (1.0 + 0.5 * np.exp(-u / 0.05)), 8e-4,
    ),
    "root of the speed": (
        {"film_drag.root_coefficient": 0.5}, lambda u: MU + 0.5 / NORMAL * np.sqrt(u), 6e-5,
    ),
    "bell": (
        {"viscoelastic_peak.height": 0.8, "viscoelastic_peak.peak_speed": 0.1,
         "viscoelastic_peak.narrowness": 0.7},
        lambda u: MU * (1.0 + 0.8 * np.exp(-((0.7 * np.log10(max(u, 1e-300) / 0.1)) ** 2))), 2e-3,
    ),
    "from mu_s to mu_k": (
        {"friction.mu_s": 0.3, "friction.transition_speed": 0.1},
        lambda u: MU + 0.1 * np.exp(-u / 0.1), 1e-4,
    ),
    # the quadrature pays for a law that goes up and down
    "table": (
        {"friction.mu_s": 0.5, "friction.table_speed": TABLE[0], "friction.table_mu": TABLE[1]},
        lambda u: float(CURVE(u)), 2e-2,
    ),
}  # fmt: skip


def kernel_law(parameters: dict[str, float], sliding: float, spinning: float) -> tuple:
    """Force and moment of the kernel per normal force (and radius)."""
    tables = {"friction": {"mu_k": MU}, "lateral_friction": {"ratio": 1.0}}
    for name, value in parameters.items():
        table, _, key = name.partition(".")
        tables.setdefault(table, {})[key] = value
    p = Parameters(**tables).pack()
    u, w = [0.0] * layout.U_SIZE, [0.0] * layout.W_SIZE
    u[layout.U_TEMPERATURE] = -8.0
    friction_in_slip(p, u, w, sliding, 0.0, spinning)
    return -w[layout.W_FRICTION] / NORMAL, -w[layout.W_FRICTION + 2] / (NORMAL * RADIUS)


@pytest.mark.parametrize("name", LAWS)
def test_quadrature_over_the_disc(name):
    parameters, law, bound = LAWS[name]
    errors = [
        np.subtract(kernel_law(parameters, *motion), law_over_disc(law, *motion, 0.01 * bound * MU))
        for motion in MOTIONS
    ]
    assert np.max(np.abs(errors)) / MU < bound


@pytest.mark.parametrize("spinning", [0.999 * FEW_POINTS**2, 0.1, 0.5, 0.999])
@pytest.mark.parametrize("name", ["linear", "hyperbolic", "inverse root", "Stribeck"])
def test_a_contact_that_hardly_spins_needs_few_points(name, spinning):
    """Twelve points, of the seventh degree, are as good as the adaptive quadrature.

    A rule of a lower degree would err by 1e-7 of what the law varies by; four do below the square.
    """
    parameters, law, _ = LAWS[name]
    motion = (FAST, spinning * FEW_POINTS * FAST)
    exact = law_over_disc(law, *motion, 1e-11)
    np.testing.assert_allclose(kernel_law(parameters, *motion), exact, rtol=0, atol=1e-9 * MU)


@pytest.mark.parametrize("name", LAWS)
def test_pure_sliding_is_the_law_itself(name):
    parameters, law, _ = LAWS[name]
    for speed in (0.001, 0.1, FAST):
        force, moment = kernel_law(parameters, speed, 0.0)
        assert force == pytest.approx(law(speed), rel=1e-13)
        assert moment == 0.0

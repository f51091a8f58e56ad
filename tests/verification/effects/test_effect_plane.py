"""Effects of a block that slides and turns in the plane, against an independent model.

The other side (`planar_model`) sums friction over points of the contact and takes the springs from
their energy. In all cases the centre of rotation stays off the contact, where its sum is exact.
"""

import numpy as np
import pytest
from planar_model import CORNERS, OUTWARD, STATE, Slider
from stickslip import Parameters, simulate

START = (0.02, 0.005, 0.05, -0.1, 0.01, -0.3)
MU_K, NORMAL = 0.2086, 0.67 * 9.81


def turned_anchors(angle_deg: float, offset: float, diagonal: float = 0.0) -> np.ndarray:
    turn = np.radians(angle_deg)
    return (
        CORNERS
        + 0.2 * OUTWARD * [[np.cos(turn)], [np.sin(turn)]]
        + [[0.0] * 4, offset + diagonal * np.array([1.0, -1.0, -1.0, 1.0])]
    )


# effect, which of its laws -> its parameters, the other model's laws
CASES = {
    "plain": ({}, {}),
    "lateral_friction, along x alone": ({"ratio": 0.0}, {"ratio": 0.0}),
    "lateral_friction": ({"ratio": 0.4}, {"ratio": 0.4}),
    "turning_surface": ({"curvature": -2.5}, {"curvature": -2.5}),
    "film_drag": ({"coefficient": 1.5}, {"film": 1.5}),
    "structural_damping": (
        {"coefficient": 1.5, "rotational": 2e-3}, {"damping": 1.5, "damping_rotation": 2e-3}),
    "spring_hardening": (
        {"cubic": 8e3}, {"spring_energy": lambda e: 0.5 * 20.17 * e**2 + 2e3 * e**4}),
    "spring_hardening, about another extension": (
        {"cubic": 8e3, "neutral_extension": 0.015},
        {"spring_energy": lambda e: 0.5 * 20.17 * e**2 + 2e3 * (e - 0.015) ** 4}),
    "spring_misalignment": (
        {"angle_deg": 8.0, "lateral_offset": 0.02, "diagonal_offset": 0.01},
        {"anchors": turned_anchors(8.0, 0.02, 0.01)}),
    # laws of the local speed go through the kernel's quadrature, 8 x 4 points over the contact,
    # which is that exact where the speed varies little over it (see test_effect_local_law)
    "velocity_weakening, Stribeck": (
        {"stribeck": 0.5, "stribeck_speed": 0.1},
        {"law": lambda u: MU_K * (1.0 + 0.5 * np.exp(-u / 0.1))}),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_slip_in_the_plane(case):
    effect, laws = CASES[case]
    blocks = {case.partition(",")[0]: effect} if effect else {}
    run = simulate(
        Parameters(rig={"spring_natural_length": 0.17},
                   initial=dict(zip(STATE[:6], START, strict=True)), solver=dict(tolerance=1e-13),
                   **({"lateral_friction": {"ratio": 1.0}} | blocks)),
        0.2, 0.2,
    )  # fmt: skip
    assert not len(run.events) or run.events[-1, 0] == 0.0  # it slides all the time
    expected = Slider(**laws).run(START, 0.2)
    np.testing.assert_allclose([run[name][-1] for name in STATE], expected, rtol=0, atol=1e-9)


def test_a_block_at_rest_on_a_slab_goes_round_with_it():
    """Stick on a turning surface: phi = v t/R, x = R sin phi, y = R (1 - cos phi)."""
    radius, speed = 0.5, 0.15
    run = simulate(
        Parameters(rig={"spring_length": 2.0, "spring_natural_length": 2.0},
                   springs={"stiffness": 1.0}, friction={"mu_s": 0.9, "mu_k": 0.5},
                   lateral_friction={"ratio": 1.0}, turning_surface={"curvature": 1.0 / radius},
                   initial={"vx": speed, "omega": speed / radius}),
        2.0,
    )  # fmt: skip
    assert not len(run.events)  # never left the surface
    phi = speed * run.time / radius
    np.testing.assert_allclose(run["phi"], phi, rtol=0, atol=1e-12)
    np.testing.assert_allclose(run["x"], radius * np.sin(phi), rtol=0, atol=1e-12)
    np.testing.assert_allclose(run["y"], radius * (1.0 - np.cos(phi)), rtol=0, atol=1e-12)

"""One slip with exact spring geometry against an independent model and integrator.

The independent side takes forces from the gradient of the elastic energy, friction from a sum over
the contact in polar coordinates, and scipy's DOP853 with its event location; it shares no code with
the kernel.
"""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from stickslip import Friction, Initial, LateralFriction, Parameters, Rig, Surface, simulate

GRAVITY = 9.81
MASS, RADIUS, MU_K, STIFFNESS = 0.67, 0.04, 0.2086, 20.17
INERTIA = 0.5 * MASS * RADIUS**2
STATE = ("x", "y", "phi", "vx", "vy", "omega")
LENGTH, NATURAL, ATTACHMENT = 0.20, 0.17, 0.05
ANGLES = np.radians([160.0, 20.0, 200.0, 340.0])
CORNERS = ATTACHMENT * np.array([np.cos(ANGLES), np.sin(ANGLES)])
ANCHORS = CORNERS + LENGTH * np.array([[-1.0, 1.0, -1.0, 1.0], [0.0] * 4])


def spring_loads(q):
    """-dV/dq of V = sum k/2 (l_i - l_0)^2, with complex-step derivatives."""

    def energy(q):
        x, y, phi = q
        rotated = np.array(
            [
                np.cos(phi) * CORNERS[0] - np.sin(phi) * CORNERS[1],
                np.sin(phi) * CORNERS[0] + np.cos(phi) * CORNERS[1],
            ]
        )
        gap = ANCHORS - rotated - np.array([[x], [y]])
        length = np.sqrt(gap[0] ** 2 + gap[1] ** 2)
        return 0.5 * STIFFNESS * np.sum((length - NATURAL) ** 2)

    step = 1e-30
    return np.array([-energy(q + 1j * step * row).imag / step for row in np.eye(3)])


def contact_points(radial=40, angular=80):
    """Points and weights of a product rule on the disc: Gauss in r^2, trapezoid in the angle."""
    nodes, weights = np.polynomial.legendre.leggauss(radial)
    r = RADIUS * np.sqrt(0.5 * (nodes + 1.0))
    theta = 2.0 * np.pi * np.arange(angular) / angular
    r, theta = np.meshgrid(r, theta, indexing="ij")
    w = np.repeat(0.5 * weights / angular, angular)
    return (r * np.cos(theta)).ravel(), (r * np.sin(theta)).ravel(), w


def planar_friction(velocity, points):
    px, py, w = points
    ux = velocity[0] - velocity[2] * py
    uy = velocity[1] + velocity[2] * px
    scale = -MU_K * MASS * GRAVITY * w / np.hypot(ux, uy)
    return np.array([scale @ ux, scale @ uy, scale @ (px * uy - py * ux)])


def friction_along_x(velocity, points):
    return np.array([-MU_K * MASS * GRAVITY * np.sign(velocity[0]), 0.0, 0.0])


def surface_velocity(q, speed, curvature):
    return np.array([speed * (1.0 - curvature * q[1]), speed * curvature * q[0], speed * curvature])


CASES = {
    "along x, belt": (friction_along_x, 0.0, 0.0, (0.06, 0.01, 0.3, 0.0, 0.02, -0.5)),
    # little spin: where the centre of rotation stays off the disc, the quadrature is exact
    "planar, belt": (planar_friction, 1.0, 0.0, (0.02, 0.005, 0.05, -0.1, 0.01, -0.3)),
    "planar, slab": (planar_friction, 1.0, 2.0, (0.02, 0.005, 0.05, -0.1, 0.01, -0.3)),
}


@pytest.mark.parametrize("case", CASES)
def test_slip_against_an_independent_solver(case):
    friction, ratio, curvature, start = CASES[case]
    speed, points = 0.15, contact_points()

    def slopes(t, state):
        q, velocity = state[:3], state[3:6]
        sliding = velocity - surface_velocity(q, speed, curvature)
        force = friction(sliding, points)
        accelerations = (spring_loads(q) + force) / np.array([MASS, MASS, INERTIA])
        return np.concatenate([velocity, accelerations, [-force @ sliding]])

    def sliding_stops(t, state):
        return state[3] - speed * (1.0 - curvature * state[1])

    sliding_stops.terminal = True
    sliding_stops.direction = 1.0
    reference = solve_ivp(
        slopes,
        (0.0, 0.2 if ratio else 1.0),
        [*start, 0.0],
        method="DOP853",
        rtol=1e-12,
        atol=1e-13,
        events=sliding_stops if ratio == 0.0 else None,
    )
    end = reference.t[-1]
    if ratio == 0.0:
        assert end < 0.9  # the slip has ended, and so has the comparison
    run = simulate(
        Parameters(
            rig=Rig(
                spring_natural_length=NATURAL,
                surface="slab" if curvature else "belt",
                slab_radius=0.5,
            ),
            friction=Friction(mu_s=0.2815, mu_k=MU_K),
            lateral_friction=LateralFriction(ratio=ratio),
            surface=Surface(speed=speed),
            initial=Initial(**dict(zip(STATE, start, strict=True))),
        ),
        end,
        end,
    )
    got = [run[name][-1] for name in (*STATE, "heat")]
    np.testing.assert_allclose(got, reference.y[:, -1], rtol=0, atol=1e-9)

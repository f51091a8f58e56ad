"""Bristles of a disc in the plane: steady sliding, shear, and a stiff solver of scipy."""

import numpy as np
import pytest
from effect_cases import with_friction
from scipy.integrate import solve_ivp
from stickslip import Parameters
from stickslip.arrays import RunArrays
from stickslip.catalogue import CATALOGUE
from stickslip.kernel import layout
from stickslip.kernel.bristles import law as bristles
from stickslip.kernel.contact import scale_sliding
from stickslip.kernel.friction.force import friction_in_slip

GRAVITY = 9.81
#: Of scratch space: (x, y, turning) of the shear, of friction, of sliding, and of the shear's rate.
SHEAR = slice(layout.W_STATE + layout.SHEAR_X, layout.W_STATE + layout.SHEAR_X + 3)
FRICTION, SLIDING, SHEARING = (
    slice(at, at + 3) for at in (layout.W_FRICTION, layout.W_SLIDING, layout.W_SHEARING)
)
BRISTLES = {"transition_speed": 3e-3, "presliding_distance": 5e-5}


def rig(kappa=1.0, **friction):
    law = {"mu_s": 0.3, "mu_k": 0.2} | BRISTLES
    return Parameters(friction=law | friction, lateral_friction={"ratio": kappa})


def sliding(p, motion):
    """Scratch space of a contact that slides with (U_x, U_y, Omega)."""
    w = [0.0] * layout.W_SIZE
    w[SLIDING] = motion
    scale_sliding(p, w)
    w[layout.W_STATE + layout.MODE] = layout.SLIP
    return w


@pytest.mark.parametrize("kappa", [0.0, 0.6, 1.0])
@pytest.mark.parametrize(
    "motion",
    [
        (0.002, 0.0, 0.0), (-0.3, 0.2, 0.0), (0.0, 0.0, -0.1), (0.004, -0.003, 0.05),
        (0.001, 0.0, 2.0), (1e-3, 0.0, 1e-13), (1e-18, 0.0, 0.2),
    ],
)  # fmt: skip
def test_in_steady_sliding_friction_is_the_disc_s(kappa, motion):
    if kappa == 0.0 and motion[0] == 0.0:
        return  # nothing slides
    p, u = rig(kappa).pack(), [0.0] * layout.U_SIZE
    u[layout.U_TEMPERATURE] = -8.0
    w, z = sliding(p, motion), [0.0] * layout.INSTANT
    bristles.set_sliding_shear(p, u, z, w, 0)
    w[SHEAR] = z[layout.SHEAR_X : layout.SHEAR_X + 3]
    bristles.set_bristle_friction(p, u, w)
    found = w[FRICTION]
    speed = max(abs(motion[0]), abs(motion[1]), 0.04 * abs(motion[2]))
    assert np.abs(w[SHEARING]).max() < 1e-11 * speed
    scaled = motion[0], kappa * motion[1], kappa * p[layout.P_RADIUS] * motion[2]
    friction_in_slip(p, u, w, *scaled)
    np.testing.assert_allclose(found, w[FRICTION], rtol=1e-9, atol=1e-11)


def test_a_small_shear_is_that_of_a_uniform_layer():
    """sigma_0 along x, kappa^2 sigma_0 across, and kappa^2 sigma_0 a^2 / 2 against a turn."""
    kappa, shear = 0.6, np.array([2e-7, -1e-7, 3e-6])  # m, m, rad
    p, u = rig(kappa, bristle_damping=0.0).pack(), [0.0] * layout.U_SIZE
    a, stiffness = p[layout.P_RADIUS], p[layout.P_BRISTLE_STIFFNESS]
    w = sliding(p, (0.0, 0.0, 0.0))
    scale = np.array([1.0, kappa, kappa * a])
    w[SHEAR] = scale * shear
    bristles.set_bristle_friction(p, u, w)
    expected = -stiffness * shear * np.array([1.0, kappa**2, 0.5 * (kappa * a) ** 2])
    np.testing.assert_allclose(w[FRICTION], expected, rtol=1e-12)
    z = w[layout.W_STATE :]
    energy = -0.5 * np.dot(expected, shear)
    assert bristles.bristle_energy(p, z, 0) == pytest.approx(energy, rel=1e-12)
    w[SHEARING] = scale * np.array([1e-3, 2e-3, 0.05])
    power = -np.dot(expected, [1e-3, 2e-3, 0.05])
    assert bristles.storing_power(p, w) == pytest.approx(power, rel=1e-12)


def test_it_takes_up_more_than_it_gives_back():
    """Friction is dissipative for bristles of any shear inside their limit, sliding anyhow."""
    p, u, draw = rig(0.7).pack(), [0.0] * layout.U_SIZE, np.random.default_rng(3)
    least = 0.2 * 0.67 * GRAVITY / p[layout.P_BRISTLE_STIFFNESS]
    for _ in range(300):
        w = sliding(p, 10.0 ** draw.uniform(-5, -1) * draw.normal(size=3) * [1.0, 1.0, 25.0])
        shear = draw.normal(size=3)
        shear *= least * draw.uniform(0.0, 0.6) / np.linalg.norm(shear)
        w[SHEAR] = shear
        bristles.set_bristle_friction(p, u, w)
        power = np.dot(w[FRICTION], w[SLIDING])
        assert -power - bristles.storing_power(p, w) > 0.0


def without_elimination(p):
    """The same contact, its bristles followed however fast it slides."""
    p = np.array(p)
    p[layout.P_FAST_SLIP] = 1e3
    return p


def places(p, u, times):
    """(n, 3) x, y, phi and the shear that the run begins with."""
    run = RunArrays.begin(p, u)
    run.advance(0.0)
    start = run.z[layout.SHOWN + 1 : layout.SHOWN + 1 + layout.SHEARED].copy()
    shown = []
    for time in times:
        assert run.advance(time)
        shown.append(run.z[layout.SHOWN + 1 : layout.SHOWN + 4].copy())
    return np.array(shown), start


def test_the_plane_s_motion_is_that_of_a_stiff_solver():
    """Slopes of the kernel by LSODA; and what it costs to leave the bristles out of fast slips."""
    tables = {
        "rig": {"spring_natural_length": 0.17}, "springs": {"stiffness": 40.0},
        "lateral_friction": {"ratio": 0.8}, "surface": {"speed": 0.05},
        "initial": {"x": 0.004, "y": 0.003, "phi": 0.1, "vx": 0.05},
    }  # fmt: skip
    p, u = with_friction(Parameters(**tables), **BRISTLES).pack(), np.zeros(layout.U_SIZE)
    u[layout.U_SPEED], u[layout.U_TEMPERATURE] = 0.05, -8.0
    kernel, w = CATALOGUE.compiled, np.zeros(layout.W_SIZE)
    w[layout.W_STATE + layout.BRISTLES] = 1.0

    def slopes(t, y):
        w[layout.W_STATE + 1 : layout.W_STATE + 1 + layout.SHEARED] = y
        kernel.set_slopes(stiff, u, w, float(layout.SLIP), layout.W_SLOPES)
        return w[layout.W_SLOPES : layout.W_SLOPES + layout.SHEARED].copy()

    times, scale = np.arange(0.0, 0.4, 0.01), np.array([1.0, 1.0, 0.04])
    stiff = without_elimination(p)
    exact, start = places(stiff, u, times)
    reference = solve_ivp(
        slopes, (0.0, times[-1]), start, "LSODA", t_eval=times, rtol=1e-9, atol=1e-12
    )
    assert np.abs(scale * (exact - reference.y[:3].T)).max() < 1e-9
    found, _ = places(np.array(p), u, times)
    turned = np.abs(scale * (found - exact)).max()
    assert 1e-9 < turned < 2e-6  # it did leave them out

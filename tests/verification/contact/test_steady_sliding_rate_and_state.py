"""Rate-and-state friction in the plane: what the load makes of a slip slower than the creep speed.

Against scipy's Radau on the equations of motion themselves, which finds the direction of sliding
from its stiffness, from 1e-9 m/s in the direction in which the slip begins.
"""

import numpy as np
import pytest
from kernel_steps import memory_of
from scipy.integrate import solve_ivp
from stickslip import Parameters
from stickslip.compiled import compiled_kernel
from stickslip.kernel.layout import (
    DIRECTION,
    DISTANCE,
    DONE,
    E_FIRST,
    HERE,
    INSTANT,
    MODE,
    NEXT,
    P_FREE_PHI,
    P_INERTIA,
    P_LATERAL,
    P_MASS,
    P_RADIUS,
    P_RATE_AND_STATE_DISTANCE,
    QUASI_STEADY,
    RATE_AND_STATE_AGE,
    SLIP,
    TIME,
    VX,
    W_FRICTION,
    W_LOAD,
    W_MEAN_SPEED,
    W_SIZE,
    W_SLIDING,
    W_STATE,
    X,
)


def rig(ratio: float) -> Parameters:
    return Parameters(
        rig={"spring_natural_length": 0.17},
        springs={"stiffness": 97.0},
        surface={"speed": 0.011},
        lateral_friction={"ratio": ratio},
        initial={"y": 0.005, "phi": 0.1},
        rate_and_state={
            "direct": 0.0074,
            "evolution": 0.016,
            "distance": 1e-5,
            "reference_speed": 3e-4,
            "creep_speed": 1e-6,
        },
    )


def creep_from(memory, duration: float):
    """Blocks at the first break-away and ``duration`` (s) later, and how many steps crept."""
    kernel = compiled_kernel()
    p, u, z = (np.array(part) for part in (memory.p, memory.u, memory.z))
    w, e = np.zeros(W_SIZE), np.zeros(E_FIRST)
    begin, crept = None, 0
    while begin is None or z[HERE + TIME] < begin[TIME] + duration:
        before = z[HERE + MODE]
        assert kernel.internal_step(p, u, z, w, e, 0.0) == DONE
        kernel.copy_instant(z, NEXT, HERE)
        if begin is None and before != SLIP and z[HERE + MODE] == SLIP:
            begin = z[HERE : HERE + INSTANT].copy()
        crept += begin is not None and z[HERE + QUASI_STEADY] == 1.0
    return begin, z[HERE : HERE + INSTANT], crept


def radau(memory, begin, end: float) -> np.ndarray:
    """x, y, phi, their rates, age and sliding distance at ``end``, by the stiff equations."""
    kernel = compiled_kernel()
    p, u, w = np.array(memory.p), np.array(memory.u), np.zeros(W_SIZE)
    scale = np.array([1.0, p[P_LATERAL], p[P_LATERAL] * p[P_RADIUS]])
    inertia = np.array([p[P_MASS], p[P_MASS], p[P_INERTIA]])
    distance = p[P_RATE_AND_STATE_DISTANCE]

    def rates(t, y):
        w[W_STATE : W_STATE + INSTANT] = begin
        w[W_STATE + TIME] = t
        w[W_STATE + X : W_STATE + X + 6] = y[:6]
        w[W_STATE + RATE_AND_STATE_AGE] = y[6]
        kernel.set_contact(p, u, w, W_STATE)
        kernel.friction_in_slip(p, u, w, *(scale * w[W_SLIDING : W_SLIDING + 3]))
        force = w[W_LOAD : W_LOAD + 3] + w[W_FRICTION : W_FRICTION + 3]
        mean = w[W_MEAN_SPEED]
        return [
            *y[3:6],
            *(force / inertia),
            kernel.rate_and_state_age_rate(mean, y[6], distance),
            mean,
        ]

    start = np.array([*begin[X : X + 6], begin[RATE_AND_STATE_AGE], 0.0])
    start[VX - X : 6] += 1e-9 * begin[DIRECTION : DIRECTION + 3] / scale
    atol = [1e-13] * 3 + [1e-12] * 3 + [1e-8, 1e-13]
    run = solve_ivp(rates, (begin[TIME], end), start, method="Radau", rtol=1e-8, atol=atol)
    return run.y[:, -1]


@pytest.mark.parametrize("ratio", [0.5, 1.0])
def test_creep_is_the_stiff_motion_itself(ratio):
    """Over 5 ms; how its start is taken costs some 1e-4 of the creep."""
    memory = memory_of(rig(ratio))
    assert memory.p[P_FREE_PHI] == 1.0
    begin, end, crept = creep_from(memory, 0.005)
    exact = radau(memory, begin, end[TIME])
    assert crept > 0
    distance = end[DISTANCE] - begin[DISTANCE]
    assert distance == pytest.approx(exact[7], rel=5e-4)
    away = (end[X : X + 3] - exact[:3]) * [1.0, 1.0, memory.p[P_RADIUS]]
    assert np.max(np.abs(away)) < 5e-4 * distance

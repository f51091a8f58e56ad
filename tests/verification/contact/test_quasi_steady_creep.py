"""Slips in the plane that are too slow for inertia: the load makes them, by the law of friction.

Friction that loses nothing on breaking away, and rate-and-state friction below its creep speed.

Against scipy's Radau on the equations of motion themselves, which finds the direction of sliding
from its stiffness, from 1e-9 m/s in the direction in which the slip begins.
"""

import numpy as np
import pytest
from kernel_steps import memory_of
from scipy.integrate import solve_ivp
from stickslip import Parameters
from stickslip.catalogue import CATALOGUE
from stickslip.kernel import layout


def turning() -> Parameters:
    """mu_k = mu_s, wound up by its start so that it gives way turning as well as sliding."""
    return Parameters(
        rig={"spring_natural_length": 0.17}, springs={"stiffness": 60.0},
        friction={"mu_s": 0.3, "mu_k": 0.3}, lateral_friction={"ratio": 1.0},
        surface={"speed": 0.02}, initial={"y": 0.004, "phi": 0.1, "vx": 0.02},
    )  # fmt: skip


def ageing(ratio: float) -> Parameters:
    return Parameters(
        rig={"spring_natural_length": 0.17}, springs={"stiffness": 97.0}, surface={"speed": 0.011},
        lateral_friction={"ratio": ratio}, initial={"y": 0.005, "phi": 0.1},
        rate_and_state={"direct": 0.0074, "evolution": 0.016, "distance": 1e-5,
            "reference_speed": 3e-4, "creep_speed": 1e-6},
    )  # fmt: skip


def creep_from(memory, duration: float):
    """Blocks at the first break-away and ``duration`` (s) later, and how many steps crept."""
    kernel = CATALOGUE.compiled
    p, u, z = (np.array(part) for part in (memory.p, memory.u, memory.z))
    w, e = np.zeros(layout.W_SIZE), np.zeros(layout.E_FIRST)
    begin, crept = None, 0
    while begin is None or z[layout.HERE + layout.TIME] < begin[layout.TIME] + duration:
        before = z[layout.HERE + layout.MODE]
        assert kernel.internal_step(p, u, z, w, e, 0.0) == layout.DONE
        kernel.copy_instant(z, layout.NEXT, layout.HERE)
        if begin is None and before != layout.SLIP and z[layout.HERE + layout.MODE] == layout.SLIP:
            begin = z[layout.HERE : layout.HERE + layout.INSTANT].copy()
        crept += begin is not None and z[layout.HERE + layout.QUASI_STEADY] == 1.0
    return begin, z[layout.HERE : layout.HERE + layout.INSTANT], crept


def radau(memory, begin, end: float) -> np.ndarray:
    """x, y, phi, their rates, age and sliding distance at ``end``, by the stiff equations."""
    kernel = CATALOGUE.compiled
    p, u, w = np.array(memory.p), np.array(memory.u), np.zeros(layout.W_SIZE)
    scale = np.array([1.0, p[layout.P_LATERAL], p[layout.P_LATERAL] * p[layout.P_RADIUS]])
    inertia = np.array([p[layout.P_MASS], p[layout.P_MASS], p[layout.P_INERTIA]])
    distance = p[layout.P_RATE_AND_STATE_DISTANCE]

    def rates(t, y):
        w[layout.W_STATE : layout.W_STATE + layout.INSTANT] = begin
        w[layout.W_STATE + layout.TIME] = t
        w[layout.W_STATE + layout.X : layout.W_STATE + layout.X + 6] = y[:6]
        w[layout.W_STATE + layout.RATE_AND_STATE_AGE] = y[6]
        kernel.set_contact(p, u, w, layout.W_STATE)
        kernel.friction_in_slip(p, u, w, *(scale * w[layout.W_SLIDING : layout.W_SLIDING + 3]))
        force = w[layout.W_LOAD : layout.W_LOAD + 3] + w[layout.W_FRICTION : layout.W_FRICTION + 3]
        mean = w[layout.W_MEAN_SPEED]
        return [
            *y[3:6], *(force / inertia), kernel.rate_and_state_age_rate(mean, y[6], distance), mean,
        ]  # fmt: skip

    start = np.array([*begin[layout.X : layout.X + 6], begin[layout.RATE_AND_STATE_AGE], 0.0])
    start[layout.VX - layout.X : 6] += 1e-9 * begin[layout.DIRECTION : layout.DIRECTION + 3] / scale
    atol = [1e-13] * 3 + [1e-12] * 3 + [1e-8, 1e-13]
    run = solve_ivp(rates, (begin[layout.TIME], end), start, method="Radau", rtol=1e-8, atol=atol)
    return run.y[:, -1]


@pytest.mark.parametrize(
    ("rig", "duration", "allowed"),
    [(turning(), 0.1, 1e-9), (ageing(0.5), 0.005, None), (ageing(1.0), 0.005, None)],
    ids=["turning", "ageing, half across", "ageing"],
)
def test_creep_is_the_stiff_motion_itself(rig, duration, allowed):
    """How its start is taken costs 1e-9 m, or with an age some 1e-4 of the creep."""
    memory = memory_of(rig)
    assert memory.p[layout.P_FREE_PHI] == 1.0
    begin, end, crept = creep_from(memory, duration)
    exact = radau(memory, begin, end[layout.TIME])
    assert crept > 0
    distance = end[layout.DISTANCE] - begin[layout.DISTANCE]
    assert distance == pytest.approx(exact[7], rel=5e-4)
    away = (end[layout.X : layout.X + 3] - exact[:3]) * [1.0, 1.0, memory.p[layout.P_RADIUS]]
    assert np.max(np.abs(away)) < (allowed or 5e-4 * distance)

"""The kernel against scipy's `solve_ivp` with events, on the same right-hand side.

    python tests/benchmarks/against_solve_ivp.py

Both run 20 s of planar stick-slip on a belt. scipy calls the kernel's own right-hand side, once as
Python and once compiled, so that the second ratio is scipy's stepping alone. Its DOP853 is given
the tolerance at which its last break-away is as exact as ours (against a run of ours at the
tightest tolerance), stick and slip alternate by its event location, and it is spared what the
kernel does besides: outputs at 100 Hz come from its own dense output.
"""

import time

import numpy as np
from mechanics import median_seconds
from scipy.integrate import solve_ivp
from stickslip import Initial, LateralFriction, Parameters, Rig, Solver, simulate
from stickslip.compiled import compiled_kernel
from stickslip.kernel import motion
from stickslip.kernel.layout import (
    P_MU_S,
    P_NORMAL_FORCE,
    SLIP,
    STATES,
    STICK,
    U_SIZE,
    U_SPEED,
    VX,
    W_FRICTION,
    W_SIZE,
    W_SLOPES,
    W_STATE,
    X,
)

SPEED, DURATION = 0.15, 20.0


def belt(tolerance: float = 1e-11) -> Parameters:
    return Parameters(
        rig=Rig(spring_natural_length=0.17),
        lateral_friction=LateralFriction(ratio=1.0),
        initial=Initial(vx=SPEED),
        solver=Solver(tolerance=tolerance),
    )


def scipy_run(tolerance: float, set_slopes, array) -> list[float]:
    """Times of break-away, s."""
    p, u, w = array(belt().pack()), array(np.zeros(U_SIZE)), array(np.zeros(W_SIZE))
    u[U_SPEED] = SPEED
    mode = STICK

    def slopes(t, y):
        w[W_STATE] = t
        w[W_STATE + 1 : W_STATE + 1 + STATES] = y
        if mode == SLIP:  # friction keeps its direction beyond the end of the slip
            w[W_STATE + VX] = min(y[VX - 1], SPEED - 1e-6)
        set_slopes(p, u, w, float(mode), W_SLOPES)
        rates = np.array(w[W_SLOPES : W_SLOPES + STATES])
        rates[X - 1] = y[VX - 1]
        return rates

    def gives_way(t, y):
        slopes(t, y)
        return abs(w[W_FRICTION]) - p[P_MU_S] * p[P_NORMAL_FORCE]

    def comes_to_rest(t, y):
        return y[VX - 1] - SPEED if t > began + 1e-3 else -1.0

    gives_way.terminal = comes_to_rest.terminal = True
    gives_way.direction = comes_to_rest.direction = 1.0
    y, t, starts = np.zeros(STATES), 0.0, []
    y[VX - 1] = SPEED
    samples = np.arange(0.0, DURATION + 0.005, 0.01)
    while t < DURATION:
        began = t
        run = solve_ivp(
            slopes,
            (t, DURATION),
            y,
            method="DOP853",
            t_eval=samples[samples >= t],
            events=gives_way if mode == STICK else comes_to_rest,
            rtol=tolerance,
            atol=1e-3 * tolerance,
        )
        if run.status == 0:
            break
        t, y = run.t_events[0][0], run.y_events[0][0].copy()
        y[VX - 1] = SPEED
        if mode == STICK:
            starts.append(t)
        mode = SLIP if mode == STICK else STICK
    return starts


def same_accuracy(exact: float, ours: float, set_slopes, array) -> tuple[float, float]:
    """Seconds and error of the loosest scipy run that is as exact as ours."""
    for tolerance in (1e-8, 1e-9, 1e-10, 1e-11, 1e-12):
        start = time.perf_counter()
        error = abs(scipy_run(tolerance, set_slopes, array)[-1] - exact)
        seconds = time.perf_counter() - start
        if error <= max(abs(ours - exact), 1e-10):
            break
    return seconds, error


def main() -> None:
    exact = simulate(belt(1e-13), DURATION).slip_starts[-1]
    ours = simulate(belt(), DURATION).slip_starts[-1]
    seconds = median_seconds(lambda: simulate(belt(), DURATION), 9)
    print("                                   ms   last break-away off by, s   ratio")
    print(f"kernel                    {1e3 * seconds:9.2f}   {abs(ours - exact):20.1e}")
    for name, set_slopes, array in (
        ("solve_ivp, Python", motion.set_slopes, list),
        ("solve_ivp, compiled", compiled_kernel().set_slopes, np.array),
    ):
        peer, error = same_accuracy(exact, ours, set_slopes, array)
        print(f"{name:25s} {1e3 * peer:9.2f}   {error:20.1e}   {peer / seconds:13.0f}")


if __name__ == "__main__":
    main()

"""Halving the macro step: how the coupled answer changes, and with which order.

The joules of a macro step cross exactly, spread evenly over it on the thermal side. The surface of
a body that conducts answers a redistribution of its heat over a step H with H^(3/2), so that is the
order of the interface temperature. The temperature that friction feels is one step old: the motion
has the order of Gauss-Seidel, 1, once the step resolves the stick-slip cycle.

    python tests/verification/coupled/test_macro_step.py    prints a table of the docs
"""

from functools import cache

import numpy as np
import pytest

from cosim import read_scenario, run_scenario

DURATION, COMMON = 2.56, 0.16
STEPS = (0.08, 0.04, 0.02, 0.01, 0.005, 0.0025)


@cache
def coupled_run(step: float, sensitivity: float) -> tuple[np.ndarray, np.ndarray]:
    """Interface temperature (degC) and x (m) at the multiples of 0.16 s."""
    times = {"duration": DURATION, "output_interval": COMMON, "snapshot_interval": COMMON}
    scenario = read_scenario("warm_friction").changed(
        {f"run.{name}": value for name, value in times.items()}
        | {"surface.run_up_time": 0.0, "initial.vx": 0.15, "coupling.macro_step": step}
        | {"temperature_dependence.sensitivity": sensitivity}
    )
    result = run_scenario(scenario).result
    assert result.status == "complete"
    return result["thermal.interface_temperature"], result["mechanics.x"]


def changes(sensitivity: float, steps=STEPS) -> list[tuple[float, float, float]]:
    """For each halving: the step halved, the largest change of temperature (K) and of x (m)."""
    runs = [coupled_run(step, sensitivity) for step in steps]
    return [
        (step, *(float(np.max(np.abs(a - b))) for a, b in zip(coarse, fine, strict=True)))
        for step, coarse, fine in zip(steps, runs, runs[1:], strict=False)
    ]


def orders(values: list[float]) -> np.ndarray:
    return np.log2(np.array(values[:-1]) / np.array(values[1:]))


@pytest.mark.parametrize("sensitivity", [0.0, 0.125])
def test_interface_temperature_converges(sensitivity):
    table = changes(sensitivity, STEPS[1:])
    assert orders([change for _, change, _ in table]) == pytest.approx(1.5, abs=0.2)
    assert table[-1][1] < 2e-5  # K, from 5 ms to 2.5 ms


def test_closed_loop_motion_converges_with_order_one():
    # two kelvins of rise would stop the friction: a loop many times stronger than ice's
    table = changes(2.0, STEPS[2:])
    assert orders([change for _, _, change in table]) == pytest.approx(1.0, abs=0.15)


def test_open_chain_leaves_the_motion_alone():
    """Friction that does not feel the temperature: x is the same for every step, bit for bit."""
    assert all(change == 0.0 for _, _, change in changes(0.0, (0.04, 0.01)))


if __name__ == "__main__":
    print("| macro step halved from | interface temperature changes by | order | x changes by |")
    print("|---|---|---|---|")
    table = changes(0.125)
    measured = ["", *(f"{order:.2f}" for order in orders([change for _, change, _ in table]))]
    for (step, kelvin, metre), order in zip(table, measured, strict=True):
        print(f"| {1e3 * step:g} ms | {1e3 * kelvin:.3g} mK | {order} | {1e6 * metre:.2g} µm |")

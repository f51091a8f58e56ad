"""Effects that belong to the surface: ripple of its speed, pattern and scatter of its friction."""

import numpy as np
import pytest
from stickslip import Parameters, simulate
from stickslip.kernel.friction.coefficient import surface_factor
from stickslip.kernel.layout import U_SIZE, W_SIZE, W_STATE, X

X_ONLY = {"rig": {"degrees_of_freedom": ("x",)}}
MU_K, NORMAL = 0.2086, 0.67 * 9.81


def field(parameters: Parameters, places: np.ndarray) -> np.ndarray:
    """Friction relative to its mean at places on the surface (m)."""
    p, w = parameters.pack(), [0.0] * W_SIZE
    found = []
    for place in places:
        w[W_STATE + X] = place
        found.append(surface_factor(p, [0.0] * U_SIZE, w))
    return np.array(found)


def scattered(seed: int = 1, **more) -> Parameters:
    size = {"deviation": 0.1, "correlation_length": 0.02, "seed": seed}
    return Parameters(surface_scatter=size, **X_ONLY, **more)


@pytest.mark.parametrize("ramp", [0.0, 1.5])
def test_ripple_of_the_speed(ramp):
    """v_s = v (1 + A sin(2 pi f t + phase)), times t/T in a ramp; its integral is the travel."""
    v, a, f, phase = 0.15, 0.2, 1.7, np.radians(50.0)
    run = simulate(
        Parameters(speed_ripple={"amplitude": a, "frequency": f, "phase_deg": 50.0},
                   surface={"speed": v, "run_up_time": ramp}, **X_ONLY),
        4.0,
    )  # fmt: skip
    t, rate = run.time, 2.0 * np.pi * f
    ramp_factor = np.minimum(1.0, t / ramp) if ramp else np.ones_like(t)
    speed = v * ramp_factor * (1.0 + a * np.sin(rate * t + phase))
    np.testing.assert_allclose(run["surface_speed_actual"], speed, rtol=0, atol=1e-15)

    def travel(t):
        return t + a / rate * (np.cos(phase) - np.cos(rate * t + phase))

    def travel_in_ramp(t):
        swing = np.sin(rate * t + phase) - np.sin(phase) - rate * t * np.cos(rate * t + phase)
        return (0.5 * t**2 + a / rate**2 * swing) / ramp

    exact = v * travel(t)
    if ramp:
        after = travel_in_ramp(ramp) + travel(t) - travel(ramp)
        exact = v * np.where(t < ramp, travel_in_ramp(np.minimum(t, ramp)), after)
    np.testing.assert_allclose(run["surface_travel"], exact, rtol=0, atol=1e-12)
    stick = run["mode"] == 0
    np.testing.assert_array_equal(run["vx"][stick], run["surface_speed_actual"][stick])


def test_scatter_belongs_to_the_place_on_the_surface():
    parameters = scattered()
    run = simulate(parameters, 4.0)
    slip = run["mode"] == 1
    expected = MU_K * NORMAL * field(parameters, (run["x"] - run["surface_travel"])[slip])
    np.testing.assert_allclose(np.abs(run["friction_force_x"][slip]), expected, rtol=1e-12)


def test_scatter_has_its_mean_deviation_and_correlation():
    """Over 4000 seeds; what is left is the sampling error, asked to stay below four deviations."""
    deviation, length, seeds = 0.1, 0.02, 4000
    places = 0.3 + length * np.array([0.0, 0.5, 1.0, 2.0, 4.0])
    fields = np.array([field(scattered(seed=seed), places) for seed in range(seeds)]) - 1.0
    noise = 1.0 / np.sqrt(seeds)
    assert np.max(np.abs(fields.mean(axis=0))) < 4.0 * noise * deviation
    # the variance of a square is below 2 for a sum of waves, as for the normal distribution
    np.testing.assert_allclose(fields.std(axis=0) / deviation, 1.0, atol=4.0 * noise)
    correlation = np.mean(fields[:, :1] * fields, axis=0) / deviation**2
    gap = (places - places[0]) / length
    np.testing.assert_allclose(correlation, np.exp(-0.5 * gap**2), atol=4.0 * np.sqrt(2.0) * noise)


def test_scatter_does_not_depend_on_the_step():
    """Cycles are those of a hundred times the tolerance: it is a field, not a throw per step."""
    runs = [simulate(scattered(solver={"tolerance": each}), 6.0) for each in (1e-11, 1e-13)]
    assert len(runs[0].events) > 10
    np.testing.assert_allclose(runs[0].events, runs[1].events, rtol=0, atol=1e-9)

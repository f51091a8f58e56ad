"""BeltIceThermal, whole and reduced: heat as a running total, and where it went."""

import numpy as np
import pytest
from heat_instance import OUTPUTS, H, constant

RECEIVED, STORED, TO_AIR = (OUTPUTS.index(f"heat_{of}") for of in ("received", "stored", "to_air"))


def total(heat, totals, sizes, speed=0.15, **others):
    """Outputs after each step, with `heat` set before it."""
    rows, time = [], 0.0
    for joules, size in zip(totals, sizes, strict=True):
        heat.put(heat=joules, surface_speed=speed, **others)
        heat.slave.doStep(time, size)
        time += size
        rows.append(heat.outputs())
    return np.array(rows)


def test_every_joule_of_the_total_is_taken_in_whatever_the_steps(heat):
    sizes = np.tile([0.01, 0.05, 0.2, 0.5], 5)
    totals = 3.7 + np.cumsum(np.random.default_rng(1).uniform(0.0, 0.2, sizes.size))
    rows = total(heat.start(heat=3.7), totals, sizes)
    np.testing.assert_allclose(rows[:, RECEIVED], totals - 3.7, rtol=0, atol=1e-12 * totals[-1])


def test_power_and_total_do_the_same(heat):
    given = constant(50)
    by_power = heat.start().run(*given)[1:]
    heat.slave.reset()
    by_total = total(heat.start(), np.arange(1, 51) * 0.3 * H, np.full(50, H))
    np.testing.assert_allclose(by_total, by_power, rtol=0, atol=1e-12)


def test_the_total_wins_from_its_first_change_on(heat):
    totals = np.array([0.0, 0.0, 0.01, 0.01, 0.03])
    rows = total(heat.start(), totals, np.full(5, H), heat_flow=0.5)
    expected = np.array([0.005, 0.01, 0.02, 0.02, 0.04])
    np.testing.assert_allclose(rows[:, RECEIVED], expected, rtol=0, atol=1e-15)


def test_a_state_knows_which_of_the_two_counts(heat):
    rows = total(heat.start(), [0.01, 0.02], [H, H])
    state = heat.slave.getFMUState()
    saved = heat.slave.serializeFMUState(state)
    heat.put(heat=0.05, heat_flow=2.0)
    heat.slave.doStep(2 * H, H)
    after = heat.outputs()
    heat.slave.setFMUState(heat.slave.deserializeFMUState(saved))
    assert np.array_equal(heat.outputs(), rows[-1])
    heat.put(heat=0.05, heat_flow=2.0)
    heat.slave.doStep(2 * H, H)
    assert np.array_equal(heat.outputs(), after) and after[RECEIVED] == pytest.approx(
        0.05, rel=1e-14
    )


@pytest.mark.parametrize("values", [
    {"ambient__temperature_degC": -0.3, "contact__wiper": 0.3},
    {"belt__air_heat_transfer": 1e3, "ice__air_heat_transfer": 1e3},
], ids=["melting", "windy"])  # fmt: skip
def test_what_was_received_is_stored_or_with_the_air(heat, values):
    """The belt stops, runs back, and carries water that freezes; the heat ends."""
    n = np.arange(300)
    flow = np.where(n < 200, 8.0 + 2.0 * np.sin(n / 20), 0.0)
    speed = np.where(n < 100, 0.3, np.where(n < 250, -0.2, 0.0))
    rows = heat.start(**values).run(flow, speed, 0.0 * n, np.arange(301) * H)
    assert rows[-1, RECEIVED] > 10.0 and rows[-1, TO_AIR] > 1e-3 * rows[-1, RECEIVED]
    assert (rows[-1, OUTPUTS.index("melted_mass")] > 1e-6) == ("contact__wiper" in values)
    balance = rows[:, RECEIVED] - rows[:, STORED] - rows[:, TO_AIR]
    assert np.abs(balance).max() <= 1e-12 * rows[-1, RECEIVED]

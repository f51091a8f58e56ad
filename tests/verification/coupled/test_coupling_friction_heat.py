"""Friction warms a body, and the warmer body brakes less: a closed loop with a known answer.

    C theta' = mu0 (1 - beta theta) N v - G theta

theta is the body's temperature over that of the air. One participant turns the temperature into
friction heat (J since the start), the other takes the joules of each step, spread evenly over it.
The exact answer is theta = theta_inf (1 - exp(-r t)), r = (G + mu0 beta N v) / C,
theta_inf = mu0 N v / (G + mu0 beta N v) = 42.857 K.
"""

from math import exp, expm1

import numpy as np
import pytest
from ledgers import exchanged, largest_residual

from cosim.coupling import Connection, CoupledSystem, GaussSeidel, inputs, outputs, port_table, run

CAPACITY, LOSS = 50.0, 2.0  # J/K, W/K
MU, BETA, LOAD, SPEED = 0.4, 0.02, 500.0, 3.0  # 1, 1/K, N, m/s
POWER = MU * LOAD * SPEED
RATE = (LOSS + BETA * POWER) / CAPACITY
STEADY = POWER / (LOSS + BETA * POWER)


class Friction:
    name = "friction"
    ports = port_table(inputs(temperature="K") + outputs(heat="J"))

    def enter_initialisation(self, start, stop):
        self.heat = self.temperature = 0.0

    def exit_initialisation(self):
        pass

    def write(self, values):
        self.temperature = values["temperature"]

    def read(self):
        return {"heat": self.heat}

    def step(self, time, size):
        self.heat += POWER * (1.0 - BETA * self.temperature) * size

    def close(self):
        pass


class Body:
    name = "body"
    ports = port_table(inputs(heat="J") + outputs(temperature="K", received="J", residual="J"))

    def enter_initialisation(self, start, stop):
        self.temperature = self.received = self.lost = self.heat = 0.0

    def exit_initialisation(self):
        pass

    def write(self, values):
        self.heat = values["heat"]

    def read(self):
        stored = CAPACITY * self.temperature
        return {
            "temperature": self.temperature,
            "received": self.received,
            "residual": self.received - stored - self.lost,
        }

    def step(self, time, size):
        joules, self.received = self.heat - self.received, self.heat
        rate = LOSS / CAPACITY
        reached = self.temperature + expm1(-rate * size) * (self.temperature - joules / size / LOSS)
        self.lost += joules - CAPACITY * (reached - self.temperature)
        self.temperature = reached

    def close(self):
        pass


def warm(macro_step, stop=100.0):
    system = CoupledSystem(
        [Friction(), Body()],
        [
            Connection("friction.heat", "body.heat", taken="received"),
            Connection("body.temperature", "friction.temperature"),
        ],
        residuals=["body.residual"],
    )
    return run(system, GaussSeidel(("friction", "body")), stop=stop, macro_step=macro_step)


def largest_error(result):
    exact = STEADY * -np.expm1(-RATE * result.time)
    return np.max(np.abs(result["body.temperature"] - exact))


def test_the_answer_is_the_known_one():
    assert pytest.approx(42.857, abs=5e-4) == STEADY
    assert warm(0.5)["body.temperature"][-1] == pytest.approx(STEADY, rel=1e-9)


def test_halving_the_macro_step_halves_the_error():
    steps = np.array([0.4, 0.2, 0.1, 0.05])
    errors = [largest_error(warm(h, stop=20.0)) for h in steps]
    assert np.polyfit(np.log(steps), np.log(errors), 1)[0] == pytest.approx(1.0, abs=0.03)


def test_beyond_the_stable_step_the_loop_blows_up_and_below_it_does_not():
    """One step maps theta to theta e - (P beta theta - P)(1 - e)/G, e = exp(-G H / C)."""
    limit = 8.4118
    growth = [
        exp(-LOSS * h / CAPACITY) + BETA * POWER / LOSS * expm1(-LOSS * h / CAPACITY)
        for h in (0.999 * limit, 1.001 * limit)
    ]
    assert growth[0] > -1.0 > growth[1]
    assert largest_error(warm(0.95 * limit, stop=2000.0)) < 2 * STEADY
    assert largest_error(warm(1.05 * limit, stop=2000.0)) > 100 * STEADY


def test_every_joule_is_accounted_for():
    result = warm(0.37)
    assert exchanged(result.ledger) == pytest.approx(result["friction.heat"][-1], rel=1e-15)
    assert largest_residual(result.ledger) < 1e-12 * exchanged(result.ledger)

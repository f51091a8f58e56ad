"""Whether a participant comes back exactly is tried, whatever it is made of."""

import math
import pickle

import pytest
from part import Part

from cosim import coupling
from cosim.coupling import restores_exactly, run


class Counter(Part):
    """Its output is the number of steps, plus what it has kept for itself."""

    name, ports = "counter", coupling.port_table(coupling.outputs(x="1"))

    def __init__(self, forgets=0, fails=None, off=0.0):
        self.kept = {"steps": 0.0}
        self.hidden, self.forgets, self.fails, self.off = 0, forgets, fails, off
        self.states = 0

    def enter_initialisation(self, start, stop):
        self.kept = {"steps": self.off}

    def _may_fail(self, call):
        if self.fails == call:
            raise RuntimeError(f"cannot {call}")

    def read(self):
        return {"x": self.kept["steps"] + self.forgets * self.hidden}

    def step(self, time, size):
        self._may_fail("step")
        self.kept["steps"] += 1.0
        self.hidden += 1

    def get_state(self):
        self._may_fail("get_state")
        self.states += 1
        return pickle.dumps(self.kept)

    def set_state(self, state):
        self._may_fail("set_state")
        self.kept = pickle.loads(state)

    def free_state(self, state):
        self.states -= 1
        self._may_fail("free_state")


@pytest.mark.parametrize("off", [0.0, math.nan])
def test_one_that_comes_back_is_left_where_it_was(off):
    counter = Counter(off=off)
    counter.enter_initialisation(0.0, 1.0)
    assert restores_exactly(counter, 0.0, 0.1)
    assert counter.read() == pytest.approx({"x": off}, nan_ok=True) and counter.states == 0


@pytest.mark.parametrize("counter", [
    Counter(forgets=1), Counter(fails="get_state"), Counter(fails="set_state"),
    Counter(fails="free_state"), object(),
])  # fmt: skip
def test_one_that_does_not_is_found(counter):
    assert not restores_exactly(counter, 0.0, 0.1)
    assert getattr(counter, "states", 0) == 0


def test_a_step_that_fails_is_that_and_nothing_else():
    counter = Counter(fails="step")
    with pytest.raises(RuntimeError, match="^cannot step$"):
        restores_exactly(counter, 0.0, 0.1)
    assert counter.states == 0
    with pytest.raises(coupling.ParticipantError, match="^counter: failed during .*: cannot step$"):
        run(
            coupling.CoupledSystem([counter], []), coupling.Iterated(("counter",)), stop=1.0,
            control=coupling.FixedStep(0.1),
        )  # fmt: skip

"""A coupled run on small participants: exchange, grid, recording, ledger, what is kept."""

import math

import numpy as np
import pytest
from ledgers import exchanged, largest_residual
from part import Part

from cosim import coupling
from cosim.coupling import Connection, CoupledSystem, CouplingError, GaussSeidel, outputs, run


class Model(Part):
    """The least a participant can be: holds what it is given and remembers its steps."""

    def __init__(self, name, ports):
        self.name = name
        self.ports = coupling.port_table(ports)
        self.given = {}
        self.steps = []

    def enter_initialisation(self, start, stop):
        self.time = start

    def write(self, values):
        self.given.update(values)

    def step(self, time, size):
        self.steps.append((time, size))
        self.time = time + size


class Clock(Model):
    """Gives out the time it has reached."""

    def __init__(self, name="clock"):
        super().__init__(name, outputs(now="s"))

    def read(self):
        return {"now": self.time}


class Follower(Model):
    """Passes on what it is given, plus a constant, without delay."""

    def __init__(self, name, start=0.0, add=0.0, factor=1.0):
        super().__init__(name, coupling.inputs(seen="s") + outputs(shown="s"))
        self.given = {"seen": start}
        self.add, self.factor = add, factor

    def read(self):
        return {"shown": self.factor * self.given["seen"] + self.add}


class Brake(Model):
    """Makes 3 W of heat from the start."""

    def __init__(self, leak):
        super().__init__("brake", outputs(heat="J", residual="J"))
        self.leak = leak

    def read(self):
        return {"heat": 3.0 * self.time, "residual": self.leak}


class Disc(Model):
    """Takes up the part `keeps` of the heat."""

    def __init__(self, keeps):
        super().__init__("disc", coupling.inputs(heat="J") + outputs(heat_received="J"))
        self.received, self.keeps = 0.0, keeps

    def read(self):
        return {"heat_received": self.received}

    def step(self, time, size):
        super().step(time, size)
        self.received = self.keeps * self.given["heat"]


def clock_and_follower():
    return CoupledSystem([Clock(), Follower("mirror")], [Connection("clock.now", "mirror.seen")])


def mirrored(order=("clock", "mirror"), **how):
    return run(clock_and_follower(), GaussSeidel(order), **{"stop": 1.0, "macro_step": 0.25} | how)


@pytest.mark.parametrize("order, late", [(("clock", "mirror"), 0), (("mirror", "clock"), 1)])
def test_later_participants_see_the_new_values_and_earlier_ones_those_before(order, late):
    result = mirrored(order)
    assert (result.status, result.reason, result.steps) == ("complete", "", 4)
    np.testing.assert_array_equal(result["mirror.shown"][late:], result["clock.now"][: 5 - late])


def test_initial_exchange_reaches_the_end_of_a_chain_against_the_order():
    names = ["d", "c", "b", "a"]
    chain = [Follower(name, add=1.0) for name in names] + [Clock()]
    links = {"clock.now": "a", "a.shown": "b", "b.shown": "c", "c.shown": "d"}
    system = CoupledSystem(chain, [Connection(s, f"{t}.seen") for s, t in links.items()])
    result = run(system, GaussSeidel((*names, "clock")), start=5.0, stop=6.0, macro_step=1.0)
    assert [result[f"{name}.shown"][0] for name in "abcd"] == [6.0, 7.0, 8.0, 9.0]
    assert result.sweeps == 4


def loop(factor):
    return CoupledSystem(
        [Follower("a", add=1.0, factor=factor), Follower("b", add=1.0, factor=factor)],
        [Connection("a.shown", "b.seen"), Connection("b.shown", "a.seen")],
    )


@pytest.mark.parametrize("factor, solution", [(0.5, 2.0), (1.5, -2.0)])
def test_initial_exchange_solves_a_loop_with_feedthrough(factor, solution):
    """x = factor (1 + x); where it amplifies, plain sweeps run away from the solution."""
    result = run(loop(factor), GaussSeidel(("a", "b")), stop=1.0, macro_step=1.0)
    assert result["a.shown"][0] == pytest.approx(solution, rel=1e-11)


def test_a_loop_without_a_solution_is_reported_with_what_changes_and_the_remedy():
    with pytest.raises(CouplingError, match=r"not settled after \d+ sweeps: [ab]\.shown.*break it"):
        run(loop(1.0), GaussSeidel(("a", "b")), stop=1.0, macro_step=1.0)


@pytest.mark.parametrize("stop, macro_step", [(30.0, 0.01), (1.0, 0.3), (0.7, 0.1), (1e3, 1 / 3)])
def test_grid_hits_the_end_exactly_and_does_not_drift(stop, macro_step):
    times = mirrored(stop=stop, macro_step=macro_step).time.tolist()
    assert times[-1] == stop
    assert times[:-1] == [n * macro_step for n in range(len(times) - 1)]
    assert len(times) - 1 == math.ceil(round(stop / macro_step, 6))
    assert 0 < times[-1] - times[-2] <= macro_step * (1 + 1e-9)


@pytest.mark.parametrize("change, message", [
    ({"macro_step": 0.0}, "macro_step = 0 s: must be greater than 0"),
    ({"macro_step": math.nan}, "macro_step = nan: must be a finite"),
    ({"stop": -1.0}, "stop = -1 s: must be later than start = 0 s"),
    ({"start": 1e16, "stop": 1e16 + 64, "macro_step": 0.1}, "too small to advance"),
    ({"record_every": 0}, "record_every = 0: must be at least 1"),
])  # fmt: skip
def test_a_run_that_makes_no_sense_is_refused(change, message):
    with pytest.raises(CouplingError, match=message):
        mirrored(**change)


def test_every_nth_point_is_recorded_and_the_last():
    result = mirrored(macro_step=0.1, record_every=4)
    np.testing.assert_allclose(result.time, [0.0, 0.4, 0.8, 1.0], rtol=1e-15)
    assert result.units == {"clock.now": "s", "mirror.shown": "s", "mirror.seen": "s"}
    np.testing.assert_array_equal(result["mirror.seen"], result["mirror.shown"])
    with pytest.raises(KeyError, match="nearest: 'clock.now'"):
        result["clock.nom"]


def braked(order, keeps=1.0, factor=1.0, leak=0.0):
    """Ledger of 2 s in which a brake makes 6 J; a factor leaves a part of them."""
    link = Connection(
        "brake.heat", "disc.heat", taken="heat_received", transformation=coupling.Affine(factor)
    )
    system = CoupledSystem([Brake(leak), Disc(keeps)], [link], residuals=["brake.residual"])
    return run(system, GaussSeidel(order), stop=2.0, macro_step=0.1).ledger


@pytest.mark.parametrize(
    "given, handed, missing",
    [({}, 6.0, 0.0), ({"factor": 1 / 3}, 2.0, 0.0), ({"keeps": 0.9, "leak": 0.25}, 6.0, 0.85)],
)
def test_the_ledger_has_what_is_handed_over_and_what_is_missing(given, handed, missing):
    """What a sink loses, and what a participant is off by."""
    ledger = braked(("brake", "disc"), **given)
    assert exchanged(ledger) == pytest.approx(handed, rel=1e-12)
    assert ledger.residual[-1] == pytest.approx(missing, rel=1e-12, abs=1e-12)
    assert largest_residual(ledger) == pytest.approx(missing, rel=1e-12, abs=1e-12)


def test_the_ledger_shows_the_joules_in_transit_when_the_sink_steps_first():
    in_transit = braked(("disc", "brake")).flows[0].in_transit
    np.testing.assert_allclose(in_transit[1:], 0.3, rtol=1e-12)


class Failing(Clock):
    """Fails in the step that starts at or after `at`."""

    def __init__(self, at, error):
        super().__init__("failing")
        self.at, self.error = at, error

    def step(self, time, size):
        super().step(time, size)
        if time >= self.at:
            raise self.error


def failing(error):
    system = CoupledSystem([Failing(0.5, error)], [])
    return run(system, GaussSeidel(("failing",)), stop=1.0, macro_step=0.125, record_every=3)


@pytest.mark.parametrize("error, status, reason", [
    (RuntimeError("spring\nbroke"), "failed",
     "failing: failed in the step from t = 0.5 s: spring broke"),
    (KeyboardInterrupt(), "interrupted", "interrupted at t = 0.5 s"),
])  # fmt: skip
def test_what_ends_a_step_ends_the_run_and_nothing_is_lost(error, status, reason):
    result = failing(error)
    assert (result.status, result.reason, result.steps) == (status, reason, 4)
    assert result.time[-1] == 0.5 and result["failing.now"][-1] == 0.5
    if status == "failed":
        assert isinstance(result.error, coupling.ParticipantError)
        assert result.error.__cause__ is error


def test_an_output_that_is_no_number_is_a_failure():
    system = CoupledSystem([Follower("mirror"), Clock()], [Connection("clock.now", "mirror.seen")])
    system.participants["clock"].read = lambda: {"now": math.nan}
    said = "clock: .*initialisation: output now is nan"
    with pytest.raises(coupling.ParticipantError, match=said):
        run(system, GaussSeidel(("clock", "mirror")), stop=1.0, macro_step=0.5)


@pytest.mark.parametrize("event", [0.6, 0.3, math.nextafter(0.2, 1.0), 0.25])
def test_an_event_that_is_a_communication_point_but_for_rounding_makes_no_sliver(event):
    """6 steps of 0.1 s end at 0.6000000000000001 s; a step of 1e-16 s would be no step."""
    system = clock_and_follower()
    result = run(system, GaussSeidel(("clock", "mirror")), stop=1.0, macro_step=0.1, events=[event])
    sizes = [size for _, size in system.participants["clock"].steps]
    assert min(sizes) > 0.04 and len(sizes) == (11 if event == 0.25 else 10)
    # between two points of the grid it makes no row
    assert (event in result.time) == (event != 0.25) and result.time[-1] == 1.0

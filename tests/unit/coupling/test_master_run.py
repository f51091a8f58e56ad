"""A coupled run on small participants: exchange, grid, recording, ledger, what is kept."""

import math
import os
import signal

import numpy as np
import pytest
from ledgers import exchanged, largest_residual
from part import Part

from cosim.coupling import (
    Affine,
    Connection,
    CoupledSystem,
    CouplingError,
    GaussSeidel,
    ParticipantError,
    inputs,
    outputs,
    port_table,
    run,
)
from cosim.coupling.step_control.control import Grid


class Model(Part):
    """The least a participant can be: holds what it is given and remembers its steps."""

    def __init__(self, name, ports):
        self.name = name
        self.ports = port_table(ports)
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
        super().__init__(name, inputs(seen="s") + outputs(shown="s"))
        self.given = {"seen": start}
        self.add, self.factor = add, factor

    def read(self):
        return {"shown": self.factor * self.given["seen"] + self.add}


class Brake(Model):
    """Makes 3 W of heat from the start."""

    def __init__(self):
        super().__init__("brake", outputs(heat="J", residual="J"))
        self.leak = 0.0

    def read(self):
        return {"heat": 3.0 * self.time, "residual": self.leak}


class Disc(Model):
    """Takes up the part `keeps` of the heat."""

    def __init__(self, keeps=1.0):
        super().__init__("disc", inputs(heat="J") + outputs(heat_received="J"))
        self.received, self.keeps = 0.0, keeps

    def read(self):
        return {"heat_received": self.received}

    def step(self, time, size):
        super().step(time, size)
        self.received = self.keeps * self.given["heat"]


def clock_and_follower():
    return CoupledSystem([Clock(), Follower("mirror")], [Connection("clock.now", "mirror.seen")])


def test_later_participants_see_the_new_values():
    result = run(clock_and_follower(), GaussSeidel(("clock", "mirror")), stop=1.0, macro_step=0.25)
    assert result.status == "complete" and result.reason == "" and result.steps == 4
    np.testing.assert_array_equal(result["mirror.shown"], result["clock.now"])


def test_earlier_participants_see_the_values_of_the_step_s_start():
    result = run(clock_and_follower(), GaussSeidel(("mirror", "clock")), stop=1.0, macro_step=0.25)
    np.testing.assert_array_equal(result["mirror.shown"][1:], result["clock.now"][:-1])


def test_initial_exchange_reaches_the_end_of_a_chain_against_the_order():
    names = ["d", "c", "b", "a"]
    chain = [Follower(name, add=1.0) for name in names] + [Clock()]
    links = ["clock.now", "a.shown", "b.shown", "c.shown"]
    system = CoupledSystem(
        chain,
        [Connection(s, f"{t}.seen") for s, t in zip(links, reversed(names), strict=True)],
    )
    result = run(system, GaussSeidel((*names, "clock")), start=5.0, stop=6.0, macro_step=1.0)
    assert [result[f"{name}.shown"][0] for name in "abcd"] == [6.0, 7.0, 8.0, 9.0]
    assert result.sweeps == 4


def loop(factor):
    return CoupledSystem(
        [Follower("a", add=1.0, factor=factor), Follower("b", add=1.0, factor=factor)],
        [Connection("a.shown", "b.seen"), Connection("b.shown", "a.seen")],
    )


def test_initial_exchange_settles_a_loop_with_feedthrough():
    result = run(loop(0.5), GaussSeidel(("a", "b")), stop=1.0, macro_step=1.0)
    assert result["a.shown"][0] == pytest.approx(2.0, rel=1e-14)


def test_initial_exchange_solves_a_loop_that_amplifies():
    """x = 1.5 (1 + x): plain sweeps run away from the solution."""
    result = run(loop(1.5), GaussSeidel(("a", "b")), stop=1.0, macro_step=1.0)
    assert result["a.shown"][0] == pytest.approx(-2.0, rel=1e-11)


def test_a_loop_without_a_solution_is_reported_with_what_changes_and_the_remedy():
    with pytest.raises(CouplingError, match=r"not settled after \d+ sweeps: [ab]\.shown.*break it"):
        run(loop(1.0), GaussSeidel(("a", "b")), stop=1.0, macro_step=1.0)


@pytest.mark.parametrize("stop, macro_step", [(30.0, 0.01), (1.0, 0.3), (0.7, 0.1), (1e3, 1 / 3)])
def test_grid_hits_the_end_exactly_and_does_not_drift(stop, macro_step):
    times = list(Grid(0.0, stop, macro_step))
    assert times[-1] == stop
    assert times[:-1] == [n * macro_step for n in range(len(times) - 1)]
    assert len(times) - 1 == math.ceil(round(stop / macro_step, 6))
    assert 0 < times[-1] - times[-2] <= macro_step * (1 + 1e-9)


@pytest.mark.parametrize(
    "change, message",
    [
        ({"macro_step": 0.0}, "macro_step = 0 s: must be greater than 0"),
        ({"macro_step": math.nan}, "macro_step = nan: must be a finite"),
        ({"stop": -1.0}, "stop = -1 s: must be later than start = 0 s"),
        ({"start": 1e16, "stop": 1e16 + 64, "macro_step": 0.1}, "too small to advance"),
        ({"record_every": 0}, "record_every = 0: must be at least 1"),
    ],
)
def test_a_run_that_makes_no_sense_is_refused(change, message):
    with pytest.raises(CouplingError, match=message):
        arguments = {"stop": 1.0, "macro_step": 0.1} | change
        run(clock_and_follower(), GaussSeidel(("clock", "mirror")), **arguments)


def test_every_nth_point_is_recorded_and_the_last():
    result = run(
        clock_and_follower(),
        GaussSeidel(("clock", "mirror")),
        stop=1.0,
        macro_step=0.1,
        record_every=4,
    )
    np.testing.assert_allclose(result.time, [0.0, 0.4, 0.8, 1.0], rtol=1e-15)
    assert result.units == {"clock.now": "s", "mirror.shown": "s", "mirror.seen": "s"}
    np.testing.assert_array_equal(result["mirror.seen"], result["mirror.shown"])


def test_an_unknown_result_name_is_answered_with_the_nearest():
    result = run(clock_and_follower(), GaussSeidel(("clock", "mirror")), stop=1.0, macro_step=1.0)
    with pytest.raises(KeyError, match="nearest: 'clock.now'"):
        result["clock.nom"]


def braked(keeps=1.0):
    return CoupledSystem(
        [Brake(), Disc(keeps)],
        [Connection("brake.heat", "disc.heat", taken="heat_received")],
        residuals=["brake.residual"],
    )


def test_ledger_closes_when_the_sink_takes_what_it_is_given():
    result = run(braked(), GaussSeidel(("brake", "disc")), stop=2.0, macro_step=0.1)
    assert exchanged(result.ledger) == pytest.approx(6.0, rel=1e-15)
    assert largest_residual(result.ledger) == 0.0


def test_ledger_shows_the_joules_in_transit_when_the_sink_steps_first():
    result = run(braked(), GaussSeidel(("disc", "brake")), stop=2.0, macro_step=0.1)
    np.testing.assert_allclose(result.ledger.flows[0].in_transit[1:], 0.3, rtol=1e-12)


def test_ledger_hands_over_what_a_factor_leaves():
    """Of the 6 J that a brake makes a third goes over: that is handed, and nothing is missing."""
    links = [
        Connection(
            "brake.heat", "disc.heat", taken="heat_received", transformation=Affine(1.0 / 3.0)
        )
    ]
    system = CoupledSystem([Brake(), Disc(1.0)], links)
    result = run(system, GaussSeidel(("brake", "disc")), stop=2.0, macro_step=0.1)
    assert exchanged(result.ledger) == pytest.approx(2.0, rel=1e-12)
    assert largest_residual(result.ledger) < 1e-12


def test_ledger_shows_what_a_sink_loses_and_what_a_participant_is_off_by():
    system = braked(keeps=0.9)
    system.participants["brake"].leak = 0.25
    result = run(system, GaussSeidel(("brake", "disc")), stop=2.0, macro_step=0.1)
    assert result.ledger.residual[-1] == pytest.approx(0.6 + 0.25, rel=1e-12)


class Failing(Clock):
    """Fails in the step that starts at or after `at`."""

    def __init__(self, at, error):
        super().__init__("failing")
        self.at, self.error = at, error

    def step(self, time, size):
        super().step(time, size)
        if time >= self.at:
            raise self.error


def test_a_failing_participant_ends_the_run_and_nothing_is_lost():
    system = CoupledSystem([Failing(0.5, RuntimeError("spring\nbroke"))], [])
    result = run(system, GaussSeidel(("failing",)), stop=1.0, macro_step=0.125, record_every=3)
    assert result.status == "failed" and result.steps == 4
    assert result.reason == "failing: failed in the step from t = 0.5 s: spring broke"
    assert isinstance(result.error, ParticipantError)
    assert isinstance(result.error.__cause__, RuntimeError)
    assert result.time[-1] == 0.5 and result["failing.now"][-1] == 0.5


def test_an_output_that_is_no_number_is_a_failure():
    system = CoupledSystem([Follower("mirror"), Clock()], [Connection("clock.now", "mirror.seen")])
    system.participants["clock"].read = lambda: {"now": math.nan}
    with pytest.raises(ParticipantError, match="clock: .*initialisation: output now is nan"):
        run(system, GaussSeidel(("clock", "mirror")), stop=1.0, macro_step=0.5)


def test_an_interrupt_inside_a_participant_keeps_the_steps_before():
    system = CoupledSystem([Failing(0.5, KeyboardInterrupt())], [])
    result = run(system, GaussSeidel(("failing",)), stop=1.0, macro_step=0.125)
    assert result.status == "interrupted" and result.time[-1] == 0.5
    assert result.reason == "interrupted at t = 0.5 s"


@pytest.mark.parametrize("event", [0.6, 0.3, math.nextafter(0.2, 1.0), 0.25])
def test_an_event_that_is_a_communication_point_but_for_rounding_makes_no_sliver(event):
    """6 steps of 0.1 s end at 0.6000000000000001 s; a step of 1e-16 s would be no step."""
    system = clock_and_follower()
    result = run(system, GaussSeidel(("clock", "mirror")), stop=1.0, macro_step=0.1, events=[event])
    sizes = [size for _, size in system.participants["clock"].steps]
    assert min(sizes) > 0.04 and len(sizes) == (11 if event == 0.25 else 10)
    # between two points of the grid it makes no row
    assert (event in result.time) == (event != 0.25) and result.time[-1] == 1.0


def test_ctrl_c_waits_for_the_end_of_the_macro_step(ctrl_c):
    reached = []

    def progress(time):
        reached.append(time)
        if len(reached) == 3:
            os.kill(os.getpid(), signal.SIGINT)

    before = signal.getsignal(signal.SIGINT)
    result = run(
        clock_and_follower(),
        GaussSeidel(("clock", "mirror")),
        stop=1.0,
        macro_step=0.125,
        record_every=100,
        progress=progress,
    )
    assert result.status == "interrupted" and result.steps == 3
    assert signal.getsignal(signal.SIGINT) is before
    assert result.time.tolist() == [0.0, 0.375]

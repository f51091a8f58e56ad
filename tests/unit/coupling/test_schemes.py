"""Schemes and step control on small participants: events, what is taken back, what is refused."""

import math
import re
from itertools import count

import numpy as np
import pytest
from linear_participant import Linear
from part import Part, Restorable

from cosim.coupling import (
    AdaptiveStep,
    Aitken,
    Capabilities,
    Connection,
    CoupledSystem,
    CouplingError,
    Defect,
    Doubling,
    GaussSeidel,
    Iterated,
    Jacobi,
    QuasiNewton,
    Relaxation,
    Tolerance,
    Waveform,
    inputs,
    outputs,
    port_table,
    run,
)
from cosim.coupling.waveform import through

LINKS = [Connection("a.x", "b.u"), Connection("b.x", "a.u")]


class Bouncer(Restorable):
    """Ends a step at each of its events; gives how many there were."""

    ports = port_table(inputs(seen="1") + outputs(count="1"))

    name, capabilities = "bouncer", Capabilities(restores=True, ends_early=True)

    def __init__(self, events):
        self.events, self.time, self.given = events, 0.0, 0.0

    def enter_initialisation(self, start, stop):
        self.time = start

    def write(self, values):
        self.given = values["seen"]

    def read(self):
        return {"count": float(sum(event <= self.time for event in self.events))}

    def step(self, time, size):
        inside = [event for event in self.events if time < event < time + size]
        self.time = min(inside, default=time + size)
        return self.time


class Plain(Part):
    """Can do no more than it must: follows a mean, integrates it."""

    name, ports = "plain", port_table(inputs(u="m/s") + outputs(x="m"))

    def __init__(self):
        self.x, self.u, self.steps = 0.0, 0.0, []

    def write(self, values):
        self.u = values["u"]

    def read(self):
        return {"x": self.x}

    def step(self, time, size):
        self.steps.append((time, size))
        self.x += self.u * size


def decay(name="decay", start=1.0):
    """x' = u - x."""
    return Linear(name, [[-1.0]], [[1.0]], [[1.0]], ins={"u": "1"}, outs={"x": "1"}, x=[start])


@pytest.mark.parametrize("order", [("bouncer", "decay"), ("decay", "bouncer")])
@pytest.mark.parametrize("scheme", [GaussSeidel, Jacobi, Iterated])
def test_a_step_that_one_ends_early_ends_for_all(order, scheme):
    links = [Connection("bouncer.count", "decay.u"), Connection("decay.x", "bouncer.seen")]
    system = CoupledSystem([Bouncer([0.13, 0.57]), decay()], links)
    result = run(system, scheme(order), stop=1.0, macro_step=0.25)
    assert result.status == "complete", result.reason
    np.testing.assert_allclose(result.time, [0, 0.25, 0.5, 0.75, 1.0], atol=1e-15)
    # 4 steps of the grid, two of them in two parts
    assert result.steps == 6
    assert result["bouncer.count"].tolist() == [0, 1, 1, 2, 2]
    assert result.statistics.events == 2


def test_a_step_that_an_event_cuts_short_says_nothing_of_the_next_size():
    """Behind 1 ms of 0.1 s the steps are what they were, and do not grow anew from there."""
    links = [Connection("bouncer.count", "decay.u"), Connection("decay.x", "bouncer.seen")]
    system = CoupledSystem([Bouncer([0.401]), decay()], links)
    control = AdaptiveStep(Doubling(Tolerance(1e-3)), 0.1, 1e-6, 0.1)
    result = run(system, Jacobi(("bouncer", "decay")), stop=0.701, control=control)
    np.testing.assert_allclose(result.time, [0, 0.1, 0.2, 0.3, 0.4, 0.401, 0.501, 0.601, 0.701])


def test_who_may_end_a_step_that_others_made_is_refused_where_those_cannot_go_back():
    plain = Plain()
    system = CoupledSystem([plain, Bouncer([0.1])], [])
    says = r"plain: cannot go back .* bouncer, which may end a step .* Jacobi and GaussSeidel"
    with pytest.raises(CouplingError, match=says):
        run(system, GaussSeidel(("plain", "bouncer")), stop=1.0, macro_step=0.25)
    # first it may, and Jacobi lets it be first; the others make the part that was made
    for scheme in (GaussSeidel(("bouncer", "plain")), Jacobi(("plain", "bouncer"))):
        plain.steps.clear()
        assert run(system, scheme, stop=1.0, macro_step=0.25).steps == 5
        np.testing.assert_allclose([size for _, size in plain.steps[:3]], [0.1, 0.15, 0.25])


class Clock(Bouncer):
    """Gives its time as a speed."""

    ports = port_table(outputs(time="m/s"))

    def read(self):
        return {"time": self.time}


@pytest.mark.parametrize("own, known", [([0.35], ()), ([], (0.35,))])
def test_what_is_extrapolated_is_over_the_step_that_was_made_and_held_behind_an_event(own, known):
    """In Jacobi, too, in which the clock ends the step for all; u of the steps: 0, then the mean of
    the straight line, 0.325 of the one that ends at the event, 0.35 of the one behind it."""
    links = [Connection("bouncer.time", "plain.u")]
    scheme = Jacobi(("plain", "bouncer"), "linear")
    system = CoupledSystem([Plain(), Clock(own)], links)
    result = run(system, scheme, stop=0.4, macro_step=0.1, events=known)
    x = 0.1 * (0.0 + 0.15 + 0.25) + 0.05 * (0.325 + 0.35)
    assert result["plain.x"][-1] == pytest.approx(x, rel=1e-12)


@pytest.mark.parametrize("how", [
    {"scheme": Iterated(("plain",)), "macro_step": 0.1},
    {"scheme": Jacobi(("plain",)), "control": AdaptiveStep(Defect(), 0.1, 0.01, 1.0)},
    {"scheme": Jacobi(("plain",)), "macro_step": 0.1, "on_divergence": "halve"},
])  # fmt: skip
def test_what_takes_steps_back_needs_participants_that_can(how):
    with pytest.raises(CouplingError, match="plain: cannot go back to an earlier state, and"):
        run(CoupledSystem([Plain()], []), stop=1.0, **how)


def test_a_participant_that_does_not_come_back_as_it_says_is_refused():
    class Forgetful(Bouncer):
        def set_state(self, state):
            super().set_state(state | {"time": state["time"] + 1e-9})

        def read(self):
            return {"count": self.time}

    with pytest.raises(CouplingError, match="bouncer: says that it can go back .* not .* exactly"):
        run(CoupledSystem([Forgetful([])], []), Iterated(("bouncer",)), stop=1.0, macro_step=0.1)


def decays():
    """Two that pass on to each other what they have come to."""
    return CoupledSystem([decay("a"), decay("b", 0.0)], LINKS)


def loop(gain):
    """Two that pass on at once, gain between them, with a state each."""
    pair = [
        Linear(name, [[0.0]], [[1.0]], [[1.0]], [[gain]], ins={"u": "1"}, outs={"x": "1"}, x=[1.0])
        for name in ("a", "b")
    ]
    return CoupledSystem(pair, LINKS)


def test_an_iteration_that_does_not_converge_follows_the_policy():
    scheme = Iterated(("a", "b"), acceleration=Relaxation(), most_iterations=5)

    remarks = []

    def divergent(**how):
        system = loop(1.02)
        system.listen(remarks.append)
        return run(system, scheme, stop=1.0, macro_step=0.5, **how)

    stopped = divergent()
    assert stopped.status == "failed" and stopped.time.tolist() == [0.0]
    says = "step from t = 0 s of 0.5 s has not converged in 5 iterations: [ab].x still changes by"
    assert re.search(says, stopped.reason) and "acceleration" in stopped.reason
    accepted = divergent(on_divergence="accept")
    assert accepted.status == "complete" and accepted.statistics.unconverged == [0.0, 0.5]
    assert [remark.time for remark in remarks] == [0.0, 0.5]
    says = r"^\(master\): t = 0 s: warning \[not converged\]: a step of 0.5 s has not converged in"
    assert re.search(says, str(remarks[0])) and "and is accepted" in remarks[0].text
    halved = divergent(on_divergence="halve", smallest_step=0.2)
    assert halved.status == "failed" and "0.25 s has not converged" in halved.reason
    assert halved.statistics.rejected == 1


def test_halving_makes_what_converges_for_short_steps():
    """The change from one plain iteration to the next goes with the square of the step here."""
    scheme = Iterated(("a", "b"), acceleration=Relaxation(), most_iterations=4)
    result = run(
        decays(), scheme, stop=1.0, macro_step=1.0, on_divergence="halve", smallest_step=1e-6
    )
    assert result.status == "complete" and result.statistics.rejected > 0
    # the sum stays, the difference decays twice as fast; second order in steps of a quarter or less
    assert result["a.x"][-1] + result["b.x"][-1] == pytest.approx(1.0, abs=1e-4)
    assert result["a.x"][-1] - result["b.x"][-1] == pytest.approx(math.exp(-2.0), abs=5e-3)


def test_steps_that_are_made_again_and_again_are_worth_a_remark():
    remarks, calls = [], count(1)

    def end_after_three(_):
        if next(calls) % 3 == 0:
            raise KeyboardInterrupt

    def remarked(scheme, **how):
        system = decays()
        system.listen(remarks.append)
        result = run(system, scheme, stop=1.0, progress=end_after_three, **how)
        assert result.status == "interrupted" and result.steps == 3
        found = [(remark.time, remark.text) for remark in remarks]
        remarks.clear()
        return found

    # held inputs: a step of h is off by about h^2, which at 1e-6 is a thousand times too much
    control = AdaptiveStep(Doubling(Tolerance(1e-15)), 0.5, 1e-6, 1.0)
    first, again, *rest = remarked(Jacobi(("a", "b")), control=control)
    assert first[0] == again[0] == 0.0 and first[1].startswith("a step of 1e-06 s, the smallest, ")
    assert re.fullmatch(r"was taken back \d+ times, to be of 1e-06 s", again[1])
    assert not any("was taken back" in text for _, text in rest)
    control = AdaptiveStep(Doubling(Tolerance(1e-3)), 0.01, 1e-8, 1.0)
    assert remarked(Jacobi(("a", "b")), control=control) == []

    tight = Iterated(
        ("a", "b"), acceleration=Relaxation(), most_iterations=2, tolerance=Tolerance(1e-9)
    )
    said = remarked(tight, macro_step=0.5, on_divergence="halve", smallest_step=1e-12)
    assert said[0][0] == 0.0
    assert re.fullmatch(r"did not converge until it was halved \d+ times", said[0][1])


def test_who_cannot_follow_a_waveform_gets_its_mean():
    """x' = u of u' = -u: of second order with linear inputs, in spite of held ones."""

    def error(macro_step):
        source = Linear(
            "source", [[-1.0]], np.zeros((1, 0)), [[1.0]], ins={}, outs={"x": "m/s"}, x=[1.0]
        )
        system = CoupledSystem([source, Plain()], [Connection("source.x", "plain.u")])
        scheme = Jacobi(("source", "plain"), "linear")
        result = run(system, scheme, stop=1.0, macro_step=macro_step)
        return abs(result["plain.x"][-1] - (1.0 - math.exp(-1.0)))

    assert math.log2(error(0.02) / error(0.01)) == pytest.approx(2.0, abs=0.1)


def test_a_waveform_s_parts_are_the_waveform():
    wave = through([(-1.0, 2.0), (0.0, 1.0), (0.5, 3.0)], 0.5)
    assert [wave.at(t) for t in (-1.0, 0.0, 0.5)] == pytest.approx([2.0, 1.0, 3.0])
    part = wave.after(0.2, 0.3)
    assert part.end == pytest.approx(wave.end) and part.start == pytest.approx(wave.at(0.2))
    halves = (wave.after(0.0, 0.25).mean + wave.after(0.25, 0.25).mean) / 2
    assert halves == pytest.approx(wave.mean)
    assert Waveform((1.0, 2.0, 3.0), 1.0).rates == (2.0, 6.0)


@pytest.mark.parametrize("acceleration", [Relaxation(0.25), Aitken(), QuasiNewton()])
def test_an_acceleration_solves_what_plain_iteration_runs_away_from(acceleration):
    """x = A x + b with eigenvalues beyond 1; scalar steps of Aitken need one value.

    Of x = 1 - 3 x a relaxation of a quarter takes all of the error away.
    """
    many = isinstance(acceleration, QuasiNewton)
    a = np.array([[2.0, 1.0], [-1.0, -3.0]]) if many else np.array([[-3.0]])
    b = np.ones(len(a))
    x = np.zeros(len(a))
    acceleration.begin()
    for _ in range(2 * len(a) + 1):
        x = acceleration.next(x, a @ x + b)
    assert x == pytest.approx(np.linalg.solve(np.eye(len(a)) - a, b), rel=1e-9)


@pytest.mark.parametrize("make, says", [
    (lambda: Relaxation(0.0), "relaxation = 0: must be above 0"),
    (lambda: Tolerance(0.0), "relative_tolerance = 0: must be"),
    (lambda: Tolerance(1e-3, {"a.x": -1.0}), "absolute tolerance of a.x = -1"),
    (lambda: AdaptiveStep(Defect(), 1.0, 2.0, 3.0), "macro_step = 1 s: must lie between"),
    (lambda: AdaptiveStep(Defect(), 1.0, 0.1, 3.0, 1.0), "safety = 1: must lie"),
    (lambda: Jacobi(("a", "b"), "cubic").check(loop(0.1)), "extrapolation = 'cubic'"),
    (lambda: Iterated(("a", "b"), sweep="both").check(loop(0.1)), "sweep = 'both'"),
    (lambda: run(loop(0.1), Jacobi(("a", "b")), stop=1.0), "either macro_step or control"),
    (lambda: run(loop(0.1), Jacobi("ab"), stop=1.0, macro_step=0.1, on_divergence="pray"),
     "on_divergence = 'pray'"),
])  # fmt: skip
def test_settings_that_cannot_be_are_refused(make, says):
    with pytest.raises(CouplingError, match=says):
        make()

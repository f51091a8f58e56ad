"""Models of the ladder: where fits set out, what they gain, when a finding is lost or felt."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from test_agreement import finding, part

from cosim.gap import models
from cosim.gap.extended import Part
from cosim.gap.models import Models, _same
from cosim.gap.result import Score
from cosim.gap.weak_form.ladder import Finding
from cosim.gap.windows.fitted import Fitted, FittedRun
from cosim.gap.windows.numbers import Number


def test_a_problem_of_least_squares_is_the_same_from_any_start():
    free = Number("friction.mu_k", 0.2, None, 0.0, 1.0)
    known = Number("offset.x", 0.0, 1e-3, -3e-3, 3e-3, "run")
    same = _same([free, known], {"a.b": 1.0}, 0.02)
    assert _same([known, replace(free, start=0.3)], {"a.b": 1.0}, 0.02) == same
    assert _same([free, replace(known, start=1e-4)], {"a.b": 1.0}, 0.02) != same  # of its prior
    assert _same([free, known], {"a.b": 2.0}, 0.02) != same
    assert _same([free, known], {"a.b": 1.0}, 0.03) != same


@pytest.mark.parametrize(("reached", "again"), [(1.209, False), (1.211, True)])
def test_a_model_that_comes_out_worse_than_the_one_it_holds_sets_out_from_it(
    monkeypatch, reached, again
):
    started, gaps = [], iter([1.2, reached, 1.1])

    def fit(campaign, windows, numbers, settings, scatter, starts, near, jobs):
        started.append(starts)
        return SimpleNamespace(gap=(next(gaps), 1.0), values={"friction.mu_k": 0.2}, simulated=7)

    monkeypatch.setattr(models, "fit", fit)
    monkeypatch.setattr(models, "started_from", lambda campaign, rows: {})
    kinetic = Number("friction.mu_k", 0.3, None, 0.0, 1.0)
    more = [Number("friction.transition_speed", 4e-3, None, 3e-4, 2e-2, log=True),
            Number("friction.stick_creep", 1e-3, None, 0.0, 1e-2)]  # fmt: skip
    ladder = Models(None, None, {}, [], 1)
    ladder.fits = [ladder._fit(([kinetic], {}), 0.0, None)]
    ladder.free = [([kinetic], {}, 0.0)]
    found = ladder._fit(([kinetic, *more], {}), 0.0, None)
    assert found.gap[0] == (1.1 if again else reached)
    nested = {"friction.mu_k": 0.2, "friction.transition_speed": 3e-4, "friction.stick_creep": 2e-5}
    assert started[2:] == ([[nested]] if again else [])
    assert ladder.work.simulated == 7 * (2 + again)


@pytest.mark.parametrize(("cost", "again"), [(99.9, False), (100.1, True)])
def test_a_finding_sets_out_from_the_rows_and_once_from_next_to_nothing(monkeypatch, cost, again):
    """What scatter explains nearly as well holds a fit that begins without it."""
    started, costs = [], iter([cost, 98.0])

    def fit(campaign, windows, numbers, settings, scatter, starts, near, jobs):
        started.extend(starts)
        return SimpleNamespace(cost=next(costs), simulated=7)

    monkeypatch.setattr(models, "fit", fit)
    monkeypatch.setattr(models, "started_from", lambda campaign, rows: {"friction.mu_k": 0.21})
    ladder = Models(None, SimpleNamespace(rung=lambda added: None), {}, [], 1)
    ladder.fits = [SimpleNamespace(cost=100.0, values={"friction.mu_k": 0.2})]
    ladder.free = [([], {}, 0.0)]
    rate = Number("static_strengthening.rate", 0.5, None, 0.0, 1.0)
    asked = Part(finding("static_strengthening", 9.0), None, (), (rate,))
    found = [ladder._beside(asked)[0].cost for _ in range(2)]
    assert found == [98.0 if again else cost] * 2
    inside = {"friction.mu_k": 0.2, rate.key: 0.01}
    assert started == [{"friction.mu_k": 0.21}, *[inside] * again]


def test_a_rung_of_what_moves_the_block_across_has_the_evidence_of_the_plane(monkeypatch):
    """Rows along x have none of it: the table of the ladder would say 0."""
    rows = SimpleNamespace(evidence=-5.0, gap=1.0, held_out_gap=None)
    system = SimpleNamespace(rung=lambda *added, **kinds: rows)
    fitted = SimpleNamespace(gap=(1.0, 1.0))
    monkeypatch.setattr(Models, "_fit", lambda *given: fitted)
    turned = Finding("spring_misalignment", (), 250.0, numbers={"turn": (0.1, 0.01)})
    ladder = Models(None, system, {}, [Part(turned)], 1)
    ladder._add("user's model", "", ([], {}), rows)
    ladder._add_parts()
    assert [rung.evidence for rung in ladder.ladder] == [None, 250.0]


def fitted(residual, cost, held_out=0.0):
    rows, zeros = np.arange(4), np.zeros(4, dtype=int)
    run = FittedRun("a", {}, np.zeros((4, 3)), np.zeros((1, 6)), np.full(4, residual), zeros,
                    False, rows, zeros)  # fmt: skip
    return Fitted({}, {}, {}, (run,), cost + held_out, held_out_cost=held_out)


def test_what_noise_does_not_explain_counts_as_noise():
    """A likelihood ratio, priors of the numbers included; in units of what the better one leaves"""
    assert fitted(1.0, 10.0).gain_over(fitted(1.0, 30.0)) == 10.0
    assert fitted(2.0, 10.0).gain_over(fitted(3.0, 30.0)) == 2.5


@pytest.mark.parametrize(
    ("of_fitted", "of_held_out", "gain"),
    [(20.0, 8.0, 14.0), (20.0, 900.0, 20.0), (-4.0, 900.0, -2.0), (20.0, -60.0, -20.0)],
)
def test_runs_held_out_gain_no_more_than_those_fitted(of_fitted, of_held_out, gain):
    """The fit of one of them may be lost with the other model, which asks for nothing."""
    other = fitted(1.0, 30.0 + of_fitted, 1000.0 + of_held_out)
    assert fitted(1.0, 30.0, 1000.0).gain_over(other) == gain


def test_two_findings_are_compared_in_units_of_one_noise(monkeypatch):
    """Beside the model without either, ten thousand would be divided by two noises: 100 of it."""
    fits = {"film_drag": fitted(1.02, 14283.0), "run_in": fitted(1.03, 14281.0)}
    monkeypatch.setattr(models, "averaged_over", lambda *given: 0.0)
    monkeypatch.setattr(Models, "_beside", lambda self, one: (fits[one.finding.name], 0.0))
    campaign = SimpleNamespace(errors=SimpleNamespace(friction=0.02))
    ladder = Models(campaign, None, {}, [], 1, [fitted(2.0, 36000.0)], [([], {}, 0.0)])
    drag, worn = part(finding("film_drag", 30.0)), part(finding("run_in", 30.0))
    assert ladder.gained(worn, drag) == pytest.approx(1.0 / 1.02**2)
    assert ladder.gained(drag, worn) == -ladder.gained(worn, drag)
    assert ladder.gained(drag) - ladder.gained(worn) > 100.0


@pytest.mark.parametrize(
    ("fit", "held_out", "lost"), [(2.9, 1.5, False), (3.1, 1.0, True), (2.0, 1.6, True)]
)
def test_half_as_much_more_than_without_is_lost_in_either_kind_of_runs(fit, held_out, lost):
    with_it, without = (Models(None, None, {}, [], 1) for _ in range(2))
    with_it.ladder = [SimpleNamespace(name="contact", gap=Score(fit, held_out))]
    without.ladder = [SimpleNamespace(name="contact", gap=Score(2.0, 1.0))]
    assert with_it.is_lost_beside(without) == lost


@pytest.mark.parametrize(
    ("after", "felt", "lost"),
    [(1.983, True, False), (1.987, False, False), (2.9, False, False), (3.1, False, True)],
)
def test_what_findings_do_to_the_gap_by_themselves(after, felt, lost):
    """3 beyond noise, of which 2 % is felt; half as much more is lost."""
    models = Models(None, None, {}, [None], 1)
    models.ladder = [SimpleNamespace(name="", gap=Score(gap, None)) for gap in (2.0, after)]
    assert (models.is_felt, models.is_lost) == (felt, lost)


def test_simulated_runs_tell_in_which_of_them_a_fault_is_by_a_factor_of_e6(monkeypatch):
    """costs : of a run without it and with it; else it stays as the rows have it"""
    costs = {"run1": (30.0, 10.0), "run2": (10.0, 30.0), "run3": (10.0, 20.0), "run4": (20.0, 10.0)}
    there = {f"measurement.smoothing_in@{name}": float(n % 2) for n, name in enumerate(costs)}
    monkeypatch.setattr(
        models, "judge",
        lambda campaign, windows, numbers, values, runs, **_: fitted(
            1.0, costs[runs[0].name][int(values[f"measurement.smoothing_in@{runs[0].name}"])]
        ),
    )  # fmt: skip
    runs = [SimpleNamespace(name=name, states=None) for name in costs]
    ladder = Models(SimpleNamespace(runs=runs), None, {}, [], 1)
    ladder.free, ladder.fits = [([], there, 0.0)], [SimpleNamespace(runs=runs, values={})]
    assert ladder.runs_with("measurement.smoothing") == ["run1", "run4"]

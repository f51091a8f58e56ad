"""What rows would nearly have in a finding's place, and what simulated runs make of it."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from test_agreement import finding, part

from cosim.gap import fitting, rivals
from cosim.gap.extended import Part
from cosim.gap.fitting import Fitting
from cosim.gap.naming import Named
from cosim.gap.result import Score
from cosim.gap.weak_form.added import Added
from cosim.gap.weak_form.ladder import Finding
from cosim.gap.weak_form.unknowns import Unknown


@pytest.fixture
def asked(monkeypatch):
    """A lone finding with rivals: Fitting, parts and `Named`, of models that are all the same."""

    def made(gain, others, models, beside=()):
        wave = Added(Unknown("surface_pattern", "", None, np.eye(1)))
        found = (*beside, Finding("run_in", (wave,), gain, others))
        rung = SimpleNamespace(evidence=0.0)
        system = SimpleNamespace(rung=lambda added=(): rung)
        offers = {name: (gain + less, (wave,)) for name, less in others.items()}
        named = Named(SimpleNamespace(first_offers=offers, system=system), found, system, rung, {})
        monkeypatch.setattr(fitting, "part_of", lambda campaign, system, rung, one, law: (
            Part(one) if one.name == "other.order" else part(one)))  # fmt: skip
        fits = Fitting(None, lambda: None, 1)
        monkeypatch.setattr(fits, "fitted", lambda named, parts, **_: models)
        return fits, list(map(part, found)), named

    return made


def models(gained, promised, reached=1.0):
    """Models that gain and promise so much, and leave this gap."""
    ladder = [SimpleNamespace(gap=Score(reached, reached))]
    return SimpleNamespace(gained=gained, promised=promised, ladder=ladder)


@pytest.mark.parametrize(
    ("gain", "rows", "gained", "told"),
    [
        (30.0, -2.9, 14.1, -2.9),  # a class, which simulated runs do not tell apart
        (30.0, -2.9, 13.9, -6.1),
        (30.0, -2.9, 20.1, -2.9),  # or prefer, who would be as probable
        (30.0, -3.1, 19.9, -3.1),
        (30.0, -3.1, 14.1, -3.1),
        (30.0, -3.1, 13.9, -6.1),  # nor can noise confuse what simulated runs tell apart
        (499.0, -11.9, 20.1, 0.0),  # they contradict the rows
        (2e4, -2.9, 13.9, -6.1),
        (2e4, -11.9, 20.1, 0.0),
        (30.0, -12.1, 40.0, -12.1),
    ],
)
@pytest.mark.parametrize("across", [0, 1])
def test_rivals_of_a_finding_are_simulated(asked, gain, rows, gained, told, across):
    """Beside 20 of the finding; what no model has stays as the rows have it."""
    gains = {"run_in": 20.0, "film_drag": gained}
    same = models(
        lambda part, over: gains[part.finding.name] - gains[over.finding.name],
        lambda parts: [9.0] * len(parts),
    )
    beside = [Finding("turning_surface", (), 900.0, {})] * across
    fits, parts, named = asked(gain, {"film_drag": rows, "other.order": -1.0}, same, beside)
    alike = rivals.rivals_of(fits, parts, named, same)
    *kept, again = rivals.told_apart(named, alike).findings
    assert again.others == pytest.approx({"film_drag": told, "other.order": -1.0})
    assert kept == beside
    assert rivals.overruled(fits, parts, named, alike) is None


@pytest.mark.parametrize(
    ("promised", "own", "reached", "told"),
    [
        (49.0, 100.0, 1.29, -51.0),  # half, and what plainly tells
        (51.0, 100.0, 1.29, -7.0),
        (5.0, 17.1, 1.29, -12.1),
        (5.0, 16.9, 1.29, -7.0),
        (49.0, 100.0, 1.31, -7.0),  # nor where the finding does not explain the runs
        (None, 100.0, 1.29, -7.0),
        (49.0, None, 1.29, -7.0),
    ],
)
def test_no_model_is_fitted_with_a_rival_of_which_derivatives_promise_little(
    asked, promised, own, reached, told
):
    gains = {"run_in": own, "film_drag": promised}
    same = models(lambda *_: -7.0, lambda parts: [gains[one.effect] for one in parts], reached)
    fits, parts, named = asked(30.0, {"film_drag": -11.9}, same)
    ((_, more),) = rivals.rivals_of(fits, parts, named, same).values()
    assert more == pytest.approx(told)


@pytest.mark.parametrize(
    ("rows", "other", "told"),
    [(-2.9, 49.0, -51.0), (-2.9, 51.0, -7.0), (-2.9, None, -7.0), (-3.1, 51.0, -52.0)],
)
def test_where_rows_hardly_tell_a_rival_derivatives_are_asked_of_any_form_of_its_law(
    asked, monkeypatch, rows, other, told
):
    def forms(self, part, named):
        yield from (part, replace(part, settings={"root": 1.0}))

    def promised(parts):
        own = {"run_in": 100.0, "film_drag": 48.0}
        return [other if "root" in one.settings else own[one.effect] for one in parts]

    monkeypatch.setattr(Fitting, "forms", forms)
    same = models(lambda part, over: -7.0, promised)
    fits, parts, named = asked(30.0, {"film_drag": rows}, same)
    ((_, more),) = rivals.rivals_of(fits, parts, named, same).values()
    assert more == pytest.approx(told)


@pytest.mark.parametrize(
    ("rows", "more", "own", "held_out", "gone"),
    [(-4.0, 499.0, 1.05, 1.0, False), (-4.0, 501.0, 1.05, 1.0, True),
     (-4.0, 501.0, 1.05, 1.06, False), (-4.0, 501.0, 2.0, 1.29, True),
     (-4.0, 501.0, 2.0, 1.31, True), (-4.0, 501.0, None, 1.29, True),
     (-4.0, 501.0, None, 1.31, False), (-2.0, 201.0, 1.05, 1.0, True),
     (-2.0, 199.0, 1.05, 1.0, False), (-2.0, 201.0, 1.05, 1.06, False)],
)  # fmt: skip
def test_simulated_runs_overrule_rows_that_a_contact_may_have_turned(
    monkeypatch, rows, more, own, held_out, gone
):
    """rows : ln of how much more probable these are with it; own : gap with what the rows have;
    None where no effect stands for it"""
    lone = finding("run_in", 30.0, {"film_drag": rows})
    gaps = {"run_in": own or 2.0, "film_drag": held_out}
    assert overruled(monkeypatch, part(lone) if own else Part(lone), more, gaps) is gone


def overruled(monkeypatch, lone, more, gaps):
    """Whether film_drag overrules; gaps : of held-out runs with each, 2 without any."""

    def fitted(self, named, parts, **_):
        gap = Score(1.0, gaps[parts[0].effect] if parts else 2.0)
        return SimpleNamespace(gained=lambda part: 20.0, ladder=[SimpleNamespace(gap=gap)])

    monkeypatch.setattr(Fitting, "fitted", fitted)
    others = {"film_drag": (part(finding("film_drag", 30.0)), more)}
    fits = Fitting(None, lambda: None, 1)
    return rivals.overruled(fits, [lone], None, others) is not None

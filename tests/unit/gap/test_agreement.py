"""What the rows ask for and the simulated runs do without is not asked of the rows again."""

from dataclasses import dataclass, replace
from types import SimpleNamespace

import numpy as np
import pytest
from stickslip.effects.candidate import Candidate

from cosim.gap import agreement, find, models
from cosim.gap.extended import Part
from cosim.gap.judge import SURE
from cosim.gap.laws import LawFit
from cosim.gap.models import Models, _same
from cosim.gap.naming import Named
from cosim.gap.result import Doubt, Rejected, Score
from cosim.gap.weak_form.added import Added
from cosim.gap.weak_form.ladder import Finding
from cosim.gap.weak_form.unknowns import Unknown
from cosim.gap.windows.fitted import Fitted, FittedRun
from cosim.gap.windows.numbers import Number
from cosim.gap.windows.run_model import LOADING


def finding(name, gain):
    return Finding(name, (Added(Unknown(name, "", None, np.eye(1))),), gain, {})


class Rows:
    """Ask for the first of some findings that is not barred, or for so many of them.

    offers : what they ask for too little
    """

    def __init__(self, *findings, most=1, offers=()):
        self.findings, self.most, self.asked = findings, most, []
        self.offers = {one.name: (one.gain, one.added) for one in offers}

    def named(self, without, most):
        self.asked.append(tuple(without))
        left = [one for one in self.findings if one.name not in without][:most]
        system = SimpleNamespace(rung=lambda added: None)
        return Named(SimpleNamespace(first_offers=self.offers), tuple(left[: self.most]), system,
                     None, {})  # fmt: skip


def agreed(
    monkeypatch, rows, gained, reached=1.0, halved=(1.0, 1.0), felt=True, lost=False, sooner=0.0,
    rounding=None,
):  # fmt: skip
    """Findings and what was pretended; gained : name -> what simulated runs gain by it.

    reached : gap at the end of ladders, of all findings where two; halved : what the contact
    leaves, without and with; felt, lost : what findings do by themselves; sooner : by which a
    contact lets go, s
    """
    monkeypatch.setattr(agreement.Naming, "of", lambda campaign: rows)
    monkeypatch.setattr(
        agreement,
        "part_of",
        lambda campaign, system, rung, one, law: Part(one, None, (), (), {"on": 1.0}),
    )

    monkeypatch.setattr(agreement, "rounding_of", lambda campaign: rounding)

    class Models:
        def __init__(self, parts):
            whole = len(parts) == len(rows.findings)
            self.is_felt, self.is_lost = felt, lost and bool(parts)
            ends = np.broadcast_to(reached, 2)[int(whole)]
            self.ladder = [SimpleNamespace(name="user's model", gap=Score(ends, ends))]
            left = halved[whole]
            self.unscattered = Score(left, left)
            self.fits = [SimpleNamespace(values={LOADING: sooner})]

        def is_lost_beside(self, other):
            return self.is_lost

        def let_scatter(self):
            pass

        def gained(self, part):
            return gained[part.finding.name]

    fitting = agreement.Fitting(None, lambda: None, 1)
    monkeypatch.setattr(fitting, "_fitted", lambda named, parts, **_: Models(parts))
    answer = agreement.confirmed_findings(None, fitting)
    rejected = tuple(one.effect for one in answer.rejected)
    return [part.finding.name for part in answer.parts], rejected


def test_the_true_one_is_found_behind_a_pretended_one(monkeypatch):
    rows = Rows(finding("spring_hardening", 205.0), finding("velocity_weakening", 134.0))
    gained = {"spring_hardening": -906.0, "velocity_weakening": 140.0}
    assert agreed(monkeypatch, rows, gained) == (["velocity_weakening"], ("spring_hardening",))
    assert rows.asked == [(), ("spring_hardening",)]


@pytest.mark.parametrize(("gained", "names"), [(5.9, []), (6.1, ["film_drag"])])
def test_simulated_runs_ask_by_as_much_as_the_rows(monkeypatch, gained, names):
    found, spurious = agreed(monkeypatch, Rows(finding("film_drag", 12.0)), {"film_drag": gained})
    assert found == names
    assert spurious == (() if names else ("film_drag",))


@pytest.mark.parametrize(("gain", "names"), [(499.0, []), (501.0, ["film_drag"])])
def test_beside_coarse_steps_only_what_is_sure_is_asked_for(monkeypatch, gain, names):
    rows, gained = Rows(finding("film_drag", gain)), {"film_drag": 100.0}
    assert agreed(monkeypatch, rows, gained, rounding="coarse")[0] == names
    assert agreed(monkeypatch, rows, gained)[0] == ["film_drag"]


def test_after_four_rounds_rows_are_asked_for_one_finding_alone(monkeypatch):
    names = [f"pretended {number}" for number in range(5)]
    gained = dict.fromkeys(names, 0.0) | {"true": 100.0, "second": 100.0}
    findings = [finding(name, 20.0) for name in [*names[:4], "true", "second"]]
    rows = Rows(*findings, most=1)
    assert agreed(monkeypatch, rows, gained)[0] == ["true"]
    rows = Rows(*(finding(name, 20.0) for name in [*names, "true"]), most=1)
    assert agreed(monkeypatch, rows, gained)[0] == []
    assert rows.asked[-1] == tuple(names)


@pytest.mark.parametrize(("gained", "found"), [(8.9, False), (9.1, True)])
def test_a_fault_of_the_camera_is_less_probable_beforehand(monkeypatch, gained, found):
    name = "measurement.scale"
    assert agreed(monkeypatch, Rows(finding(name, 12.0)), {name: gained})[0] == [name] * found


@pytest.mark.parametrize(("reached", "names"), [(1.29, ["run_in"]), (1.31, [])])
def test_what_is_sure_is_asked_of_runs_that_it_does_not_explain(monkeypatch, reached, names):
    rows = Rows(finding("run_in", 2.0 * SURE))
    assert agreed(monkeypatch, rows, {"run_in": 0.0}, reached)[0] == names


@pytest.mark.parametrize(
    ("reached", "halved", "named"),
    [
        (1.0, (1.31, 1.0), 2),
        (1.0, (1.29, 1.0), 1),  # explained without it, but for what a law not quite right leaves
        (1.0, (2.0, 1.48), 2),
        (1.0, (2.0, 1.6), 1),
        ((1.2, 1.09), (1.31, 1.31), 2),
        ((1.2, 1.15), (1.31, 1.31), 1),
        ((2.0, 1.55), (2.0, 2.0), 2),
        ((1.29, 1.21), (1.31, 1.31), 1),
    ],
)
def test_a_lesser_finding_makes_up_for_half_of_what_is_missing(monkeypatch, reached, halved, named):
    """Simulated runs may be more probable with it, and come to their noise without it."""
    rows = Rows(finding("run_in", 2.0 * SURE), finding("surface_pattern", 80.0), most=2)
    gained = {"surface_pattern": 15.0, "run_in": 1e3}
    found, _ = agreed(monkeypatch, rows, gained, reached, halved)
    assert found == ["run_in", "surface_pattern"][:named]


@pytest.mark.parametrize(("gained", "named"), [(499.0, 1), (501.0, 2)])
def test_what_simulated_runs_are_sure_of_is_named_where_scatter_takes_it_up(
    monkeypatch, gained, named
):
    rows = Rows(finding("run_in", 2.0 * SURE), finding("film_drag", 30.0), most=2)
    simulated = {"film_drag": gained, "run_in": 1e3}
    found, _ = agreed(monkeypatch, rows, simulated, 1.0, (1.31, 1.31))
    assert found == ["run_in", "film_drag"][:named]


@pytest.mark.parametrize(
    ("left", "gained", "named", "asked"),
    [
        (1.29, 15.0, 1, 2),  # both go at once
        (1.31, 5.0, 1, 3),  # one by one
        (1.29, 1.01 * SURE, 3, 1),  # simulated runs are sure of both
    ],
)
def test_lesser_findings_go_at_once_where_the_greatest_explains_the_runs(
    monkeypatch, left, gained, named, asked
):
    rows = Rows(finding("run_in", 2.0 * SURE), finding("film_drag", 20.0),
                finding("surface_pattern", 80.0), most=3)  # fmt: skip
    simulated = {"run_in": 1e3, "film_drag": gained, "surface_pattern": gained}
    found, _ = agreed(monkeypatch, rows, simulated, halved=(left, 1.0))
    assert found == ["run_in", "film_drag", "surface_pattern"][:named]
    assert len(rows.asked) == asked


def test_the_least_finding_is_asked_first_and_the_greatest_of_what_is_left(monkeypatch):
    """With what it leaves gone the greatest is beyond doubt: no model is fitted without it."""
    rows = Rows(finding("run_in", 2.0 * SURE), finding("film_drag", 9.0 * SURE),
                finding("surface_pattern", 80.0), most=3)  # fmt: skip
    gained = {"surface_pattern": 0.0, "run_in": 0.0}  # film_drag: KeyError
    assert agreed(monkeypatch, rows, gained) == (["film_drag"], ("surface_pattern", "run_in"))


@pytest.mark.parametrize(
    ("gain", "rows", "gained", "told"),
    [
        (30.0, -2.9, 14.1, -2.9),  # a class, which simulated runs do not tell apart
        (30.0, -2.9, 13.9, -6.1),
        (30.0, -3.1, 19.9, -3.1),
        (499.0, -11.9, 20.1, 0.0),  # they contradict the rows
        (2e4, -2.9, 13.9, -6.1),
        (2e4, -11.9, 20.1, -11.9),
        (30.0, -12.1, 40.0, -12.1),
    ],
)
@pytest.mark.parametrize("across", [0, 1])
def test_rivals_of_a_finding_are_simulated(monkeypatch, gain, rows, gained, told, across):
    """Beside 20 of the finding; what no model has stays as the rows have it."""
    wave = Added(Unknown("surface_pattern", "", None, np.eye(1)))
    one = Finding("run_in", (wave,), gain, {"film_drag": rows, "other.order": -1.0})
    beside = [Finding("turning_surface", (), 900.0, {})] * across
    rung = SimpleNamespace(evidence=0.0)
    system = SimpleNamespace(rung=lambda added=(): rung)
    offers = {name: (gain + less, (wave,)) for name, less in one.others.items()}
    found = (*beside, one)
    named = Named(SimpleNamespace(first_offers=offers, system=system), found, system, rung, {})
    monkeypatch.setattr(
        agreement, "part_of", lambda campaign, system, rung, one, law: Part(
            one, None, (), (), {} if one.name == "other.order" else {"on": 1.0})
    )  # fmt: skip
    fitting = agreement.Fitting(None, lambda: None, 1)
    gains = {"run_in": 20.0, "film_drag": gained}
    ends = [SimpleNamespace(gap=Score(1.0, 1.0))]
    models = SimpleNamespace(gained=lambda part: gains[part.finding.name], ladder=ends)
    monkeypatch.setattr(fitting, "_fitted", lambda named, parts, **_: models)
    parts = [Part(each, None, (), (), {"on": 1.0}) for each in found]
    rivals = fitting.rivals(parts, named, models)
    *kept, again = fitting.told_apart(named, rivals).findings
    assert again.others == pytest.approx({"film_drag": told, "other.order": -1.0})
    assert kept == beside
    assert fitting.overruled(parts, named, rivals) is None


@pytest.mark.parametrize(
    ("more", "own", "held_out", "gone"),
    [(499.0, 1.05, 1.0, False), (501.0, 1.05, 1.0, True), (501.0, 1.05, 1.06, False),
     (501.0, 2.0, 1.29, True), (501.0, 2.0, 1.31, True),
     (501.0, None, 1.29, True), (501.0, None, 1.31, False)],
)  # fmt: skip
def test_simulated_runs_overrule_rows_that_a_contact_may_have_turned(
    monkeypatch, more, own, held_out, gone
):
    """own : gap with what the rows have; None where no effect stands for it"""
    part, rival = (Part(finding(name, 30.0), None, (), (), settings)
                   for name, settings in (("run_in", {"on": 1.0} if own else {}),
                                          ("film_drag", {"on": 1.0})))  # fmt: skip
    gaps = {(): 2.0, ("run_in",): own or 2.0, ("film_drag",): held_out}
    monkeypatch.setattr(
        agreement.Fitting, "_fitted", lambda self, named, parts, **_: SimpleNamespace(
            gained=lambda part: 20.0, ladder=[
                SimpleNamespace(gap=Score(1.0, gaps[tuple(part.effect for part in parts)]))])
    )  # fmt: skip
    rejected = agreement.Fitting(None, lambda: None, 1).overruled(
        [part], None, {"film_drag": (rival, more)}
    )
    assert (rejected is not None) is gone


@pytest.mark.parametrize(("own", "gone"), [(1.29, False), (1.31, True)])
def test_a_curve_that_is_the_law_stays_where_it_explains_the_runs(monkeypatch, own, gone):
    """Its points are not fitted to the simulated runs, a rival's numbers are."""
    lone = Part(finding("spring_hardening", 39.0), object(), (), (), {"points": 1.0})
    rival = Part(finding("measurement.clock", 32.0), None, (), (), {"on": 1.0})
    gaps = {("spring_hardening",): own, ("measurement.clock",): 1.0}
    monkeypatch.setattr(
        agreement.Fitting, "_fitted", lambda self, named, parts, **_: SimpleNamespace(
            gained=lambda part: 20.0, ladder=[SimpleNamespace(
                gap=Score(1.0, gaps.get(tuple(part.effect for part in parts), 2.0)))])
    )  # fmt: skip
    rejected = agreement.Fitting(None, lambda: None, 1).overruled(
        [lone], None, {"measurement.clock": (rival, 6e4)}
    )
    assert (rejected is not None) is gone


@pytest.mark.parametrize(
    ("reached", "gained", "names"),
    [(1.0, 80.0, 1), (1.09, 80.0, 1), (1.15, 80.0, 0), (1.15, 499.0, 0), (1.15, 501.0, 1)],
)
def test_a_lone_finding_takes_what_is_missing(monkeypatch, reached, gained, names):
    rows = Rows(finding("speed_ripple", 56.0))
    found, _ = agreed(monkeypatch, rows, {"speed_ripple": gained}, (1.19, reached), (2.0, 1.6))
    assert len(found) == names


@pytest.mark.parametrize("felt", [True, False])
def test_what_takes_nothing_of_the_gap_is_asked_of_the_runs_however_sure(monkeypatch, felt):
    rows = Rows(finding("speed_ripple", 2400.0))
    found, _ = agreed(monkeypatch, rows, {"speed_ripple": 5.0}, felt=felt)
    assert len(found) == felt


def test_what_makes_the_model_much_worse_is_none(monkeypatch):
    rows = Rows(finding("static_strengthening", 11.0))
    assert agreed(monkeypatch, rows, {"static_strengthening": 20.0}, lost=True)[0] == []


def test_what_scatter_takes_up_is_asked_before_friction_may_scatter(monkeypatch):
    rows = Rows(finding("load_dependence", 30.0))
    gained, same = {"load_dependence": 30.0}, (1.17, 1.17)
    assert agreed(monkeypatch, rows, gained, same, (2.0, 1.48))[0] == ["load_dependence"]
    assert agreed(monkeypatch, rows, gained, same, (2.0, 1.6))[0] == []


@pytest.mark.parametrize(("reached", "named"), [(1.29, 1), (1.31, 2)])
def test_what_no_effect_stands_for_beside_a_greater_finding_is_asked_of_runs_it_explains(
    monkeypatch, reached, named
):
    rows = Rows(finding("run_in", 2.0 * SURE), finding("other.time", 30.0), most=2)
    monkeypatch.setattr(Part, "in_kernel", property(lambda part: part.effect == "run_in"))
    found, _ = agreed(monkeypatch, rows, {"run_in": 50.0}, (reached, 1.0), (1.4, 1.0))
    assert found == ["run_in", "other.time"][:named]


@pytest.mark.parametrize(
    ("sooner", "gained", "named"), [(0.031, 31.0, 1), (0.029, 31.0, 0), (0.031, 29.0, 0)]
)
def test_a_contact_that_lets_go_very_soon_has_aged_less(monkeypatch, sooner, gained, named):
    """Rows do not tell the one from the other; simulated runs may."""
    rows = Rows(offers=[finding("static_strengthening", 0.1)])
    found, _ = agreed(monkeypatch, rows, {"static_strengthening": gained}, sooner=sooner)
    assert found == ["static_strengthening"] * named


def test_what_is_lost_by_itself_goes_before_the_others_are_asked_beside_it(monkeypatch):
    rows = Rows(finding("spring_hardening", 58.0), finding("film_drag", 20.0), most=2)
    gained = {"spring_hardening": -9e3}  # film_drag: KeyError
    with pytest.raises(KeyError, match="film_drag"):
        agreed(monkeypatch, rows, gained, lost=True)
    assert rows.asked == [(), ("spring_hardening",)]


@pytest.mark.parametrize(("gained", "lost"), [(29.0, True), (31.0, False)])
def test_a_lost_finding_stays_where_simulated_runs_ask_for_it_by_more(monkeypatch, gained, lost):
    """Beside contact and scatter, from next to nothing of it: e^30."""
    part = Part(finding("spring_hardening", 58.0), None, (), (), {"on": 1.0})
    models = SimpleNamespace(
        is_lost_beside=lambda other: True, let_scatter=lambda: None, gained=lambda part: gained
    )
    fitting = agreement.Fitting(None, lambda: None, 1)
    monkeypatch.setattr(fitting, "_fitted", lambda named, parts, **_: models)
    assert bool(fitting.lost([part], None, {"spring_hardening"})) == lost


def law(effect, form, price=0.0):
    return LawFit(effect, Candidate(effect, form, ()), {}, np.zeros(2), 1.0, price)


@pytest.mark.parametrize(
    ("first", "power", "gained"),
    [(5.9, 31.0, 31.0), (5.9, 29.0, 5.9), (-5.9, 31.0, 31.0), (6.1, 40.0, 6.1), (-6.1, 40.0, -6.1)],
)
def test_another_form_of_a_law_is_tried_where_runs_are_of_two_minds(
    monkeypatch, first, power, gained
):
    """Of its own effect, and not one that is far from the curve."""
    own = "static_strengthening"
    forms = [law(own, "logarithmic"), law(own, "power", 5.9), law(own, "saturating", 6.1)]
    forms.append(law("mine", "kinked", 1.0))
    gains = {"logarithmic": first, "power": power, "saturating": 80.0, "kinked": 90.0}
    monkeypatch.setattr(
        agreement,
        "part_of",
        lambda campaign, system, rung, one, law: Part(one, None, (law,), (), {}),
    )
    campaign = SimpleNamespace(catalogue=SimpleNamespace(effects=()))
    without = SimpleNamespace(gained=lambda part: gains[part.fits[0].candidate.form])
    part = Part(finding(own, 10.0), None, tuple(forms), (), {})
    named = Named(None, (), None, None, {})
    assert agreement.Fitting(campaign, lambda: None, 1)._gained(part, without, named) == gained


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
        return SimpleNamespace(gap=(next(gaps), 1.0), values={"friction.mu_k": 0.2})

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


def test_a_rung_of_what_moves_the_block_across_has_the_evidence_of_the_plane(monkeypatch):
    """Rows along x have none of it: the table of the ladder would say 0."""
    rows = SimpleNamespace(evidence=-5.0, gap=1.0, held_out_gap=None)
    system = SimpleNamespace(rung=lambda *added, **kinds: rows)
    fitted = SimpleNamespace(gap=(1.0, 1.0))
    monkeypatch.setattr(Models, "_fit", lambda *given: fitted)
    turned = Finding("spring_misalignment", (), 250.0, numbers={"turn": (0.1, 0.01)})
    ladder = Models(None, system, {}, [Part(turned, None, (), (), {})], 1)
    ladder._add("user's model", "", ([], {}), rows)
    ladder._add_parts()
    assert [rung.evidence for rung in ladder.ladder] == [None, 250.0]


def test_what_was_rejected_is_kept_with_both_gains(monkeypatch):
    rows = Rows(finding("spring_hardening", 205.0))
    monkeypatch.setattr(agreement.Naming, "of", lambda campaign: rows)
    monkeypatch.setattr(
        agreement,
        "part_of",
        lambda campaign, system, rung, one, law: Part(one, None, (), (), {"on": 1.0}),
    )
    monkeypatch.setattr(agreement, "rounding_of", lambda campaign: None)
    fitting = agreement.Fitting(None, lambda: None, 1)
    noise = SimpleNamespace(name="user's model", gap=Score(1.0, 1.0))
    models = SimpleNamespace(
        ladder=[noise], gained=lambda part: -906.0, is_felt=True,
        is_lost_beside=lambda other: False, fits=[SimpleNamespace(values={})],
    )  # fmt: skip
    monkeypatch.setattr(fitting, "_fitted", lambda named, parts, **_: models)
    assert agreement.confirmed_findings(None, fitting).rejected == (
        Rejected("spring_hardening", 205.0, -906.0),
    )


@pytest.mark.parametrize(
    ("check", "blocked"),
    [
        ("units", True),
        ("direction", True),
        ("sampling", True),
        ("springs", False),
        ("speed", False),
    ],
)
def test_no_effect_is_searched_for_where_none_would_be_named(check, blocked, monkeypatch):
    """Doubts are asked first; one that a finding may answer does not stop the search."""
    doubt = Doubt(check, "run01: surface_speed = 60 m/s", ("run01",), True)
    monkeypatch.setattr(find, "doubts_of", lambda campaign: (doubt,))
    taken = []
    for name in ("_unsearched", "confirmed_findings"):
        monkeypatch.setattr(find, name, lambda *given, name=name: taken.append(name))
    monkeypatch.setattr(find, "_answer", lambda campaign, agreed, doubts: doubts)
    assert find.find_gap(Campaign()) == (doubt,)
    assert taken == ["_unsearched" if blocked else "confirmed_findings"]


@pytest.mark.parametrize(
    ("check", "gap", "names", "severe"),
    [
        ("springs", 1.29, ["run_in"], False),
        ("springs", 1.31, ["run_in"], True),
        ("springs", 1.0, [], True),
        ("sampling", 1.0, [], False),
        ("sampling", 1.0, ["run_in"], True),
        ("speed", 2.0, ["speed_ripple"], False),
        ("speed", 1.0, ["run_in"], True),
    ],
)
def test_what_answers_a_severe_doubt(check, gap, names, severe):
    doubts = (Doubt(check, "run01: ...", ("run01",), True),)
    ladder = [SimpleNamespace(gap=Score(1.0, gap))]
    assert [one.severe for one in find._unanswered(doubts, ladder, names)] == [severe]


@dataclass(frozen=True)
class Campaign:
    """One without runs."""

    runs: tuple = ()


def fitted(residual, cost):
    run = FittedRun("a", {}, np.zeros((4, 3)), np.zeros((1, 6)), np.full(4, residual),
                    np.zeros(4, dtype=int), False)  # fmt: skip
    return Fitted({}, {}, {}, (run,), cost)


def test_what_noise_does_not_explain_counts_as_noise():
    """A likelihood ratio, priors of the numbers included; in units of what the better one leaves"""
    assert fitted(1.0, 10.0).gain_over(fitted(1.0, 30.0)) == 10.0
    assert fitted(2.0, 10.0).gain_over(fitted(3.0, 30.0)) == 2.5


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

"""The decision: every threshold where it is, and parts of an answer that cannot contradict."""

from dataclasses import dataclass, field, replace
from types import SimpleNamespace

import numpy as np
import pytest
from stickslip.catalogue import CATALOGUE
from stickslip.effects.contact.static_strengthening import EFFECT
from stickslip.effects.effect import Scales

from cosim.gap import models
from cosim.gap.extended import Part
from cosim.gap.judge import (
    Verdict,
    halves,
    is_strained,
    judge,
    may_be_spurious,
    not_by_scatter_alone,
    rivals_of,
    with_steps,
)
from cosim.gap.laws import Context, FreeCurve, laws_of
from cosim.gap.models import Models
from cosim.gap.plan.next_run import NextRun
from cosim.gap.report_of_findings import exponents_of, law_of, ranking_of, sentence_of
from cosim.gap.result import Doubt, Rates, Rung, Score
from cosim.gap.weak_form.added import Added
from cosim.gap.weak_form.ladder import BY_SPEED, FALLS, GROWS, Finding, Search, _is_better
from cosim.gap.weak_form.unknowns import Unknown
from cosim.gap.windows.numbers import Number

PHYSICS = {"run_in", "film_drag", "structural_damping", "speed_ripple"}


def finding(name, **others):
    return Finding(name, (), 50.0, others)


def rung(fit, held_out, share=0.0):
    return Rung("", "", Score(fit, held_out), Score(1.0, 1.0), share)


def judged(names, before, after, share=1.0, **others):
    """Verdict and effects; before, after : gaps of runs held out, or of fitted ones where alone."""
    ladder = [rung(9.0, before), rung(9.0, after, share)]
    found = [finding(name, **others) for name in names]
    verdict = judge(found, names, ladder, PHYSICS)
    return verdict.verdict, verdict.effects


@pytest.mark.parametrize(("gap", "verdict"), [(1.09, "none"), (1.11, "unknown")])
def test_nothing_is_missing_up_to_a_tenth_more_than_noise(gap, verdict):
    for score in (Score(gap, 1.0), Score(1.0, gap)):
        last = Rung("", "", score, Score(1.0, 1.0), 0.0)
        assert judge([], [], [rung(9.0, 9.0), last], PHYSICS).verdict == verdict


def test_no_run_alone_shows_that_nothing_is_missing():
    alone = [rung(9.0, None), rung(1.0, None)]
    assert judge([], [], alone, PHYSICS).verdict == "unknown"
    gap = SimpleNamespace(verdict="unknown", effects=(), doubts=(), ladder=alone)
    assert "no run is held out" in sentence_of(gap, [])


#: An effect, and what no effect stands for, within twenty to one.
TWO_NEAR = {"film_drag": -2.9, "other.time": -1.0}


@pytest.mark.parametrize(
    ("names", "before", "after", "share", "others", "told"),
    [
        # what is named explains the runs; a part is most of the misfit
        (["run_in"], 5.0, 1.29, 0.81, {}, ("named", ("run_in",))),
        (["run_in"], 5.0, 1.31, 0.79, {}, ("unknown", ())),
        # fitted runs stay at 9: most of their misfit must be gone
        (["run_in"], 5.0, 1.29, 0.79, {}, ("unknown", ())),
        (["run_in"], 5.0, 2.0, 0.79, {}, ("unknown", ())),
        (["run_in"], 5.0, 2.0, 0.81, {}, ("partial", ("run_in",))),
        # twenty to one tells two apart
        (["run_in"], 5.0, 1.0, 1.0, {"film_drag": -2.9}, ("class", ("run_in", "film_drag"))),
        (["run_in"], 5.0, 1.0, 1.0, TWO_NEAR, ("class", ("run_in", "film_drag"))),
        (["run_in"], 5.0, 1.0, 1.0, {"other.time": -1.0}, ("class", ("run_in", "other.time"))),
        (["run_in"], 5.0, 1.0, 1.0, {"film_drag": -3.1}, ("named", ("run_in",))),
        # held-out runs judge where there are some: fitted ones have 9 before and after; worse
        (["run_in"], 5.0, None, 1.0, {}, ("unknown", ())),
        (["run_in"], 1.2, 1.25, 1.0, {}, ("unknown", ())),
        (["run_in"], 2.0, 2.1, 0.9, {}, ("unknown", ())),
        # noise before and after is no worse
        (["run_in"], 1.0, 1.019, 1.0, {}, ("named", ("run_in",))),
        (["run_in"], 1.0, 1.021, 1.0, {}, ("unknown", ())),
        # two that explain the runs; one of them may be another's
        (["run_in", "film_drag"], 5.0, 1.0, 1.0, {}, ("named", ("run_in", "film_drag"))),
        (
            ["run_in", "film_drag"],
            5.0,
            1.0,
            1.0,
            {"speed_ripple": -1.0},
            ("class", ("run_in", "speed_ripple", "film_drag")),
        ),
        # what has no name
        (["other.time"], 5.0, 1.0, 1.0, {}, ("unknown", ())),
        (["run_in", "other.time"], 5.0, 1.0, 1.0, {}, ("unknown", ())),
    ],
)
def test_verdicts_change_at_the_limits(names, before, after, share, others, told):
    assert judged(names, before, after, share, **others) == told


@pytest.mark.parametrize(
    ("less", "verdict"), [(5.9, ("class", ("run_in", "film_drag"))), (6.1, ("named", ("run_in",)))]
)
def test_what_the_design_confuses_is_told_apart_by_four_hundred_to_one(less, verdict):
    """This name would be given to 20 of 50 campaigns with the other."""
    rates = Rates(50, {"run_in": {"run_in": 50}, "film_drag": {"run_in": 20, "film_drag": 30}})
    ladder = [rung(9.0, 5.0), rung(9.0, 1.0, 1.0)]
    found = judge([finding("run_in", film_drag=-less)], ["run_in"], ladder, PHYSICS, rates)
    assert (found.verdict, found.effects) == verdict


def test_the_table_of_confusions_is_asked_by_the_finding_s_name():
    """Not by that of the user's own law which follows its curve: no drawn campaign has it."""
    rates = Rates(50, {"run_in": {"run_in": 50}, "film_drag": {"run_in": 20, "film_drag": 30}})
    ladder = [rung(9.0, 5.0), rung(9.0, 1.0, 1.0)]
    one = finding("run_in", film_drag=-5.9)
    found = judge([one], ["my_wear"], ladder, {*PHYSICS, "my_wear"}, rates)
    assert (found.verdict, found.effects) == ("class", ("my_wear", "film_drag"))


@pytest.mark.parametrize(
    ("low", "before", "strained"),
    [(0.045, 1.4, True), (0.035, 1.4, False), (0.045, 1.2, False)],
)
def test_a_scatter_far_beyond_what_is_stated_stands_for_something_else(low, before, strained):
    """2 % are stated; where runs are explained without it nothing rests on it."""
    ladder = [
        rung(9.0, 9.0),
        rung(before, before, 0.6),
        replace(rung(1.0, 1.0, 1.0), name="scatter"),
    ]
    assert is_strained(ladder, (0.07, low, 0.1), 0.02) == strained
    assert not is_strained(ladder[:2], (0.07, low, 0.1), 0.02)


@pytest.mark.parametrize(
    ("name", "gained", "nearer", "asked"),
    [
        ("surface_pattern", 29.0, 3.1, True),
        ("surface_pattern", 29.0, 2.9, False),
        ("surface_pattern", 49.0, 2.9, False),
        ("surface_pattern", 51.0, 0.0, True),
        ("load_dependence", 7.0, 0.0, True),
        # contacts imitate ageing
        ("static_strengthening", 99.0, 20.0, False),
        ("static_strengthening", 101.0, 11.9, False),
        ("static_strengthening", 101.0, 12.1, True),
    ],
)
def test_what_scatter_alone_makes_probable_is_not_asked_for(name, gained, nearer, asked):
    """But for a trend over the runs, which scatter takes up."""
    assert not_by_scatter_alone(name, gained, nearer) == asked


@pytest.mark.parametrize(("share", "verdict"), [(0.55, "partial"), (0.45, "unknown")])
def test_what_scatter_alone_explains_is_not_named(share, verdict):
    ladder = [rung(9.0, 9.0), rung(4.0, 4.0, share), rung(1.0, 1.0, 1.0)]
    found = [finding("run_in")]
    assert judge(found, ["run_in"], ladder, PHYSICS).verdict == "named"
    assert judge(found, ["run_in"], ladder, PHYSICS, strained=True).verdict == verdict
    assert judge([], [], ladder, PHYSICS, strained=True).verdict == "unknown"


@pytest.mark.parametrize(
    ("held_out", "share", "verdict"),
    [((1.0, 1.01), 0.81, "named"), ((1.0, 1.01), 0.79, "unknown"), ((None, None), 1.0, "unknown")],
)
def test_noise_before_and_after_is_no_worse_in_runs_held_out(held_out, share, verdict):
    """Where most of what fitted runs miss is gone; without any held out these must get better."""
    before, after = held_out
    fit = (1.2, 1.1) if before else (0.99, 1.0)
    ladder = [rung(fit[0], before), rung(fit[1], after, share)]
    assert judge([finding("run_in")], ["run_in"], ladder, PHYSICS).verdict == verdict


def test_fitted_runs_judge_where_none_is_held_out():
    ladder = [rung(9.0, None), rung(1.0, None, 1.0)]
    assert judge([finding("run_in")], ["run_in"], ladder, PHYSICS).verdict == "named"


@pytest.mark.parametrize(("left", "halved"), [(1.48, True), (1.6, False)])
@pytest.mark.parametrize("of_fitted", [True, False])
def test_a_lesser_finding_halves_what_the_contact_alone_leaves(left, halved, of_fitted):
    """2^2 - 1 without it, half of which is (1.58)^2 - 1; of fitted runs and of held-out ones."""
    after = Score(left, 1.0) if of_fitted else Score(1.0, left)
    assert halves(after, Score(2.0, 2.0)) is halved


def test_faint_findings_along_x_may_be_a_contact_s_and_further_ones_what_the_first_leaves():
    added = (Added(Unknown("run_in", "", None, np.eye(1))),)
    faint, sure = (Finding("run_in", added, gain, {}) for gain in (499.0, 501.0))
    assert may_be_spurious(faint, True) and not may_be_spurious(sure, True)
    assert may_be_spurious(sure, False)
    assert not may_be_spurious(Finding("lateral_friction", (), 200.0, {}), False)


def test_rivals_are_the_best_few_that_rows_do_not_rule_out():
    near = {"film_drag": -199.0, "structural_damping": -201.0, "other.time": -4.0}
    clear = Finding("run_in", (), 300.0, near)
    assert rivals_of(clear, True) == ["other.time", "film_drag"]
    many = {f"e{n}": -float(n) for n in range(9)}
    assert rivals_of(finding("run_in", **many), True) == ["e0", "e1", "e2"]
    faint = Finding("run_in", (), 8.0, {"film_drag": -4.9, "other.time": -5.1})
    assert rivals_of(faint, True) == ["film_drag"]  # the other is not asked for by itself
    sure = Finding("run_in", (), 501.0, {"film_drag": -11.9, "other.time": -12.1})
    assert rivals_of(sure, True) == rivals_of(sure, False) == ["film_drag"]
    clear = Finding("run_in", (), 2e4, {"film_drag": -99.0, "other.time": -101.0})
    assert rivals_of(clear, True) == [] and rivals_of(clear, False) == ["film_drag"]


def test_a_part_is_half_of_what_contact_and_scatter_leave():
    ladder = [rung(9.0, 5.0), Rung("", "", Score(2.0, 2.0), Score(1.0, 1.0), 0.9)]
    for before, verdict in ((2.7, "partial"), (2.6, "unknown")):  # 1 + 2 (2^2 - 1) is 2.65^2
        left = Score(before, before)
        told = judge([finding("run_in")], ["run_in"], ladder, PHYSICS, None, left)
        assert told.verdict == verdict


@dataclass
class Rows:
    """Stands for the rows: each unknown adds its own to the evidence and takes its own misfit."""

    gains: dict
    misfits: dict
    added: list = field(default_factory=list)

    def rung(self, added=(), **_):
        return Rows(self.gains, self.misfits, list(added))

    @property
    def system(self):
        return self

    @property
    def evidence(self):
        return sum(self.gains[one] for one in self.added)

    @property
    def misfit(self):
        return sum(self.misfits.values()) - sum(self.misfits[one] for one in self.added)

    def with_more(self, added):
        return Rows(self.gains, self.misfits, (*self.added, *added))

    def offered(self, variants):
        return self.evidence + self.gains[variants[0].name], variants[0].name


def climbed(**unknowns):
    """Names of the findings; unknowns : name -> gain, part of the misfit's root mean square."""
    gains = {name: gain for name, (gain, _) in unknowns.items()}
    misfits = {name: part**2 for name, (_, part) in unknowns.items()}
    offered = {name: [SimpleNamespace(name=name)] for name in unknowns}

    class Plain(Search):
        def _finer(self, rung, name, offer):
            return offer

        def offers(self, rung, without=()):
            return {
                name: (rung.offered(each)[0], (rung.offered(each)[1],))
                for name, each in offered.items() if name not in without
            }  # fmt: skip

    return [each.name for each in Plain(Rows(gains, misfits), offered, ()).climb().findings]


@pytest.mark.parametrize(
    ("old", "new", "gained", "better"),
    [
        ("run_in", "film_drag", 6.1, True),
        ("run_in", "film_drag", 5.9, False),
        # what has no name is less probable beforehand by e^3, and goes for a name as probable
        ("other.hysteresis", "film_drag", -2.9, True),
        ("other.hysteresis", "film_drag", -3.1, False),
        ("other.hysteresis", "other.time", 5.9, False),
        ("run_in", "other.time", 8.9, False),
    ],
)
def test_what_has_no_name_goes_for_a_name_that_is_as_probable(old, new, gained, better):
    assert _is_better(old, new, gained) is better


@pytest.mark.parametrize(
    ("unknowns", "found"),
    [
        # the first is e^3 times as probable, as simulated runs are asked for it too; others e^6
        ({"a": (2.9, 1.0)}, ""),
        ({"a": (3.1, 1.0)}, "a"),
        ({"a": (90.0, 1.0), "b": (5.9, 1.0)}, "a"),
        ({"a": (90.0, 1.0), "b": (6.1, 1.0)}, "ab"),
        # a second one takes a part that counts; misfits add up as squares
        ({"a": (90.0, 1.0), "b": (50.0, 0.115)}, "a"),
        ({"a": (90.0, 1.0), "b": (50.0, 0.126)}, "ab"),
        # where nuisances take all misfit it is told by evidence
        ({"a": (90.0, 0.0), "b": (12.1, 0.0)}, "ab"),
        ({"a": (90.0, 0.0), "b": (11.9, 0.0)}, "a"),
        # a trend over the runs, which scatter takes up, by evidence alone; also behind a better one
        ({"a": (90.0, 1.0), "load_dependence": (20.0, 0.0)}, ("a", "load_dependence")),
        (
            {"a": (90.0, 1.0), "b": (50.0, 0.1), "load_dependence": (20.0, 0.0)},
            ("a", "load_dependence"),
        ),
        # what has no name, and a fault, e^3 more, also where it is asked whether it stays
        ({"a": (90.0, 1.0), "other.b": (8.9, 1.0)}, ("a",)),
        ({"a": (90.0, 1.0), "other.b": (9.1, 1.0)}, ("a", "other.b")),
        # more than three are no explanation
        ({name: (90.0 - at, 1.0) for at, name in enumerate("abcd")}, "abc"),
    ],
)
def test_what_rows_ask_for(unknowns, found):
    assert climbed(**unknowns) == list(found)


@pytest.mark.parametrize(("ends", "offered"), [((1.0, 1.0), []), ((1.0, -1.0), ["falls"])])
def test_what_grows_with_the_speed_is_found_once(ends, offered):
    """As a force or as a coefficient: with the one found, the other is no second effect."""
    force, coefficient = (SimpleNamespace(name=name) for name in BY_SPEED)

    class Speeds:
        added, evidence = (), 0.0
        system = SimpleNamespace(offers={})

        def offered(self, variants):
            return 9.0, variants[0]

        def with_more(self, more):
            end = ends[BY_SPEED.index(more[0].name)]
            return SimpleNamespace(posterior=([np.array([end])],), part_of=lambda one: 0)

    search = Search(Speeds.system, {one.name: [one] for one in (force, coefficient)}, ())
    names = {GROWS: "grows", FALLS: "falls"}
    assert set(search.offers(Speeds())) == {GROWS, *([FALLS] if offered else [])}
    assert [names[name] for name in search.offers(Speeds(), [GROWS])] == offered


def test_what_moves_the_block_across_has_a_name_and_no_curve():
    """It has numbers, and no rows along x."""
    across = Finding("turning_surface", (), 50.0, numbers={"curvature": (0.1, 0.01)})
    key = "turning_surface.curvature"
    part = Part(across, numbers=(Number(key, 0.1, None, -20.0, 20.0),))
    fitted = SimpleNamespace(values={key: 0.995}, sd={key: 0.00638}, at_bound={})
    gap = SimpleNamespace(
        campaign=SimpleNamespace(catalogue=CATALOGUE), verdict="named",
        effects=("turning_surface",), exponents=(), classes=(), doubts=(), extended=fitted,
    )  # fmt: skip
    said = "turning_surface, curvature = 0.995 1/m (0.985 to 1.005)."
    assert sentence_of(gap, [part]).endswith(said)
    assert law_of(None, None, part, 1.0) is None and list(exponents_of(part, None, {})) == []


@pytest.mark.parametrize(
    ("share", "said"),
    [(0.9, "explains 90.0 % of the misfit, and something else is missing."),
     (1.0, "explains all of the misfit of the fitted runs, and in the runs that were held out "
           "something is missing.")],
)  # fmt: skip
def test_nothing_else_is_missing_of_what_all_is_explained(share, said):
    gap = SimpleNamespace(
        verdict="partial", effects=("run_in",), exponents=(), classes=(), doubts=(), share=share,
        ladder=[rung(5.0, 5.0), rung(1.0, 1.8)], extended=SimpleNamespace(values={}),
    )  # fmt: skip
    assert sentence_of(gap, [Part(finding("run_in"))]).endswith(said)


@pytest.mark.parametrize("parts", [[], [Part(finding("run_in"))]])
def test_where_only_a_strained_scatter_explains_the_runs_that_is_said(parts):
    """No run is off any more: neither "in the runs held out" nor "explains nothing" is so."""
    gap = SimpleNamespace(
        verdict="partial" if parts else "unknown", effects=(), exponents=(), classes=(), share=1.0,
        doubts=(Doubt("scatter", "friction scatters ...", (), False),), ladder=[rung(1.0, 1.0)],
        extended=SimpleNamespace(values={}),
    )  # fmt: skip
    said = "something differs between the runs by more than friction is stated to scatter."
    assert sentence_of(gap, parts).endswith(said)


@pytest.mark.parametrize(("separation", "hardly"), [(2.9, True), (3.1, False)])
def test_a_run_that_hardly_tells_is_said_to(separation, hardly):
    text = NextRun(0.1, 1.0, 20.0, 10.0, ("run_in", "film_drag"), separation, 0.0).text
    assert ("hardly tells run_in from film_drag" in text) is hardly
    odds = "18 to 1" if hardly else "22 to 1"
    assert text.endswith(f"{odds}, 1 to 1 without that run" + "; 20 to 1 would tell" * hardly)


def test_data_in_doubt_are_said_to_be_the_reason():
    """Not the model, of which nothing can be said."""
    doubt = Doubt("units", "run01: mass in g?", ("run01",), True)
    gap = SimpleNamespace(verdict="unknown", effects=(), exponents=(), doubts=(doubt,))
    assert sentence_of(gap, []) == "Nothing is named while the data are in doubt. run01: mass in g?"


@pytest.mark.parametrize(
    ("verdict", "effects", "told"),
    [
        ("none", (), ("named", ("steps",))),
        ("named", ("run_in",), ("named", ("steps", "run_in"))),
        ("partial", ("run_in",), ("partial", ("steps", "run_in"))),
        ("unknown", (), ("unknown", ())),
        ("class", ("run_in", "film_drag"), ("class", ("run_in", "film_drag"))),
    ],
)
def test_coarse_steps_are_named_where_nothing_else_is_unknown(verdict, effects, told):
    answer = with_steps(Verdict(verdict, effects, ()), "steps")
    assert (answer.verdict, answer.effects) == told


# --- laws of the catalogue beside the curves that the runs have drawn ---


def test_a_law_and_what_the_curve_has_beside_it():
    """Ageing is drawn from the shortest hold on: by then mu_s has grown already."""
    at = np.log([0.2, 0.4, 0.8, 1.6, 3.2])
    grown = 0.08 * np.log10(1.0 + np.exp(at) / 0.01) / 0.25
    curve = FreeCurve(at, grown - grown[0], 1e-6 * np.eye(at.size))
    scales = Scales(0.05, 1.0, 1.0, 20.0, 50.0, 0.02, 0.9, 9.0)
    campaign = SimpleNamespace(catalogue=SimpleNamespace(effects=[EFFECT]))
    best = laws_of(EFFECT.id, curve, Context(campaign, scales, {"mu_s": 0.25}))[0]
    assert best.candidate.form == "logarithmic"
    assert best.values["static_strengthening.rate"] == pytest.approx(0.08, rel=1e-3)
    assert best.level == pytest.approx(-grown[0], rel=1e-3)


def test_a_fit_sets_out_from_what_the_rows_have_beside_the_laws(monkeypatch):
    known = {"friction.mu_s": 0.4, "friction.mu_k": 0.2}
    monkeypatch.setattr(models, "started_from", lambda campaign, rows: dict(known))
    aged = Part(Finding(EFFECT.id, (), 30.0), None, (), (), {}, shifts={"friction.mu_s": -0.1})
    assert Models(None, None, {}, [aged], 1)._by_rows(None) == {**known, "friction.mu_s": 0.4 - 0.1}
    assert Models(None, None, {}, [], 1)._by_rows(None) == known


MODEL = SimpleNamespace(values={}, sd={}, at_bound=())


def test_the_ranking_is_of_what_was_found_first_and_of_its_rivals():
    parts = [
        SimpleNamespace(
            finding=SimpleNamespace(name=name, gain=gain, others=others, added=(), variant=""),
            effect=name, curve=None, fits=(), numbers=(),
        )
        for name, gain, others in (
            ("run_in", 30.0, {"film_drag": -1.0, "stick_stiffness": 2.0}), ("film_drag", 12.0, {}),
        )
    ]  # fmt: skip
    rows = ranking_of(SimpleNamespace(first_offers={}), parts, MODEL, Score(1.0, 1.0))
    expected = {"stick_stiffness": 32.0, "run_in": 30.0, "film_drag": 29.0}
    assert [(row.effect, row.evidence) for row in rows] == [*expected.items()]
    weights = np.exp([0.0, -2.0, -3.0])
    assert [row.probability for row in rows] == pytest.approx(weights / weights.sum())


@pytest.mark.parametrize(("gain", "nothing"), [(3.0, 6.0), (9.0, 9.0 + 3.0)])
def test_with_nothing_found_that_nothing_is_missing_is_more_probable(gain, nothing):
    system = SimpleNamespace(rung=lambda: SimpleNamespace(evidence=1.0))
    ladder = SimpleNamespace(first_offers={"run_in": (1.0 + gain, None)}, system=system)
    (row,) = ranking_of(ladder, [], MODEL, Score(1.0, 1.0))
    assert (row.effect, row.evidence) == ("run_in", gain)
    assert row.probability == pytest.approx(1.0 / (1.0 + np.exp(nothing - gain)))

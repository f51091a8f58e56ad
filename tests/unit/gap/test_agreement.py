"""What the rows ask for and the simulated runs do without is not asked of the rows again."""

from dataclasses import dataclass, replace
from types import SimpleNamespace

import numpy as np
import pytest
from stickslip.effects.effect import Candidate

from cosim.gap import agreement, find, fitting, models, rejection
from cosim.gap.extended import CURVE_NUMBERS, Part
from cosim.gap.fitting import Fitting
from cosim.gap.judge import SURE
from cosim.gap.laws import LawFit
from cosim.gap.naming import Named
from cosim.gap.result import Doubt, Rejected, Score
from cosim.gap.weak_form.added import Added
from cosim.gap.weak_form.camera_faults import SMOOTHING
from cosim.gap.weak_form.ladder import Finding, Ladder
from cosim.gap.weak_form.unknowns import Unknown
from cosim.gap.windows.run_model import LOADING


def finding(name, gain, others=None):
    return Finding(name, (Added(Unknown(name, "", None, np.eye(1))),), gain, others or {})


def part(found):
    """A finding that the model has."""
    return Part(found, None, (), (), {"on": 1.0})


class Rows:
    """Ask for the first of some findings that is not barred, or for so many of them.

    offers : what else there is, as simulated runs promise it; hinted : and rows; left : gap that
    these leave
    """

    def __init__(self, *findings, most=1, offers=(), hinted=0.0, left=1.0):
        self.findings, self.most, self.asked, self.left = findings, most, [], left
        self.offers = {one.name: (hinted, one.added) for one in offers}
        self.promises = {one.name: one.gain for one in offers}

    def named(self, without, most):
        self.asked.append(tuple(without))
        left = [one for one in self.findings if one.name not in without][:most]
        system = SimpleNamespace(rung=lambda added: None)
        found = tuple(left[: self.most])
        along = [one for one in found if one.added]
        rung = SimpleNamespace(gap=self.left, evidence=0.0)
        ladder = SimpleNamespace(findings=along, further_offers=self.offers, rung=rung)
        return Named(ladder, found, system, None, {})


def agreed(
    monkeypatch, rows, gained, reached=1.0, halved=(1.0, 1.0), felt=True, lost=False, sooner=0.0,
    rounding=None, nearer=9.0,
):  # fmt: skip
    """Findings and what was pretended; gained : name -> what simulated runs gain by it.

    reached : gap at the end of ladders, of all findings where two; halved : what the contact
    leaves, without and with; felt, lost : what findings do by themselves; sooner : by which a
    contact lets go, s; nearer : ln of that gain that is no scatter's, or by what the model has
    """
    monkeypatch.setattr(agreement.Naming, "of", lambda campaign: rows)
    monkeypatch.setattr(fitting, "part_of", lambda campaign, system, rung, one, law: part(one))
    for module in (agreement, rejection):
        monkeypatch.setattr(module, "rounding_of", lambda campaign: rounding)

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

        def gained(self, part, over=None):
            form = gained.get((part.finding.name, *part.settings), gained[part.finding.name])
            return form - (gained[over.finding.name] if over else 0.0)

        def nearer(self, part):
            return nearer[next(iter(part.settings))] if isinstance(nearer, dict) else nearer

        def promised(self, parts):
            return [rows.promises.get(part.finding.name) for part in parts]

    fits = Fitting(None, lambda: None, 1)
    monkeypatch.setattr(fits, "fitted", lambda named, parts, **_: Models(parts))
    answer = agreement.confirmed_findings(None, fits)
    return [part.finding.name for part in answer.parts], answer.rejected


def test_what_the_model_has_not_is_doubted_before_a_lesser_one(monkeypatch):
    """Beside it simulated runs tell nothing: they would do without both."""
    rows = Rows(finding("other.hysteresis", 80.0), finding("load_dependence", 12.0), most=2)
    monkeypatch.setattr(Part, "in_kernel", property(lambda part: "other" not in part.effect))
    found, rejected = agreed(monkeypatch, rows, {"load_dependence": 20.0})
    assert found == ["load_dependence"]
    assert [one.effect for one in rejected] == ["other.hysteresis"]


def test_the_true_one_is_found_behind_a_pretended_one(monkeypatch):
    """What is not confirmed is kept with both gains."""
    rows = Rows(finding("spring_hardening", 205.0), finding("velocity_weakening", 134.0))
    gained = {"spring_hardening": -906.0, "velocity_weakening": 140.0}
    rejected = (Rejected("spring_hardening", 205.0, -906.0),)
    assert agreed(monkeypatch, rows, gained) == (["velocity_weakening"], rejected)
    assert rows.asked == [(), *[("spring_hardening",)] * 2]


@pytest.mark.parametrize(
    ("hinted", "gained", "named"),
    [(6.1, 54.0, "clock"), (5.9, 54.0, "scale"), (6.1, 52.0, "scale")],
)
def test_behind_a_pretended_one_simulated_runs_choose_from_what_rows_hint_at(
    monkeypatch, hinted, gained, named
):
    """They are asked by e^50, and e^3 for a fault, before rows are asked again."""
    names = ["static_strengthening", "measurement.scale", "measurement.clock"]
    *findings, hint = (finding(name, 40.0) for name in names)
    rows = Rows(*findings, offers=[replace(hint, gain=0.0)], hinted=hinted)
    found, _ = agreed(monkeypatch, rows, dict(zip(names, (0.0, 40.0, gained), strict=True)))
    assert found == [f"measurement.{named}"]


FIRST = {"run_in": 2.0 * SURE}
PATTERN, DRAG, DRIFT, TREND = (FIRST | {name: gain} for name, gain in (
    ("surface_pattern", 80.0), ("film_drag", 30.0), ("other.time", 30.0),
    ("load_dependence", 10.0)))  # fmt: skip
#: What rows gain by each finding, simulated runs by the last, what else is so, how many are named.
DECIDED = [
    # simulated runs ask by as much as the rows, for a fault of the camera by e^3 more
    ({"film_drag": 12.0}, 5.9, {}, 0),
    ({"film_drag": 12.0}, 6.1, {}, 1),
    ({"measurement.scale": 12.0}, 8.9, {}, 0),
    ({"measurement.scale": 12.0}, 9.1, {}, 1),
    # no fit is worth while of what plainly explains the runs, but of what scatter may take up
    ({"film_drag": 12.0}, 0.0, {"halved": (2.1, 1.29)}, 1),
    ({"film_drag": 12.0}, 0.0, {"halved": (1.9, 1.29)}, 0),
    ({"film_drag": 12.0}, 0.0, {"halved": (2.1, 1.31)}, 0),
    ({"load_dependence": 12.0}, 0.0, {"halved": (2.1, 1.29)}, 0),
    # beside coarse steps only what is sure is asked for
    ({"film_drag": 499.0}, 100.0, {"rounding": "coarse"}, 0),
    ({"film_drag": 499.0}, 100.0, {}, 1),
    ({"film_drag": 501.0}, 100.0, {"rounding": "coarse"}, 1),
    # what is sure is asked of runs that it does not explain
    (FIRST, 0.0, {"reached": 1.29}, 1),
    (FIRST, 0.0, {"reached": 1.31}, 0),
    # a lesser one makes up for half of what is missing, though runs may be more probable with it
    # and come to their noise without it: explained but for what a law not quite right leaves
    (PATTERN, 15.0, {"halved": (1.31, 1.0)}, 2),
    (PATTERN, 15.0, {"halved": (1.29, 1.0)}, 1),
    (PATTERN, 15.0, {"halved": (2.0, 1.48)}, 2),
    (PATTERN, 15.0, {"halved": (2.0, 1.6)}, 1),
    (PATTERN, 15.0, {"halved": (1.31, 1.31), "reached": (1.2, 1.09)}, 2),
    (PATTERN, 15.0, {"halved": (1.31, 1.31), "reached": (1.2, 1.15)}, 1),
    (PATTERN, 15.0, {"halved": (2.0, 2.0), "reached": (2.0, 1.55)}, 2),
    (PATTERN, 15.0, {"halved": (1.31, 1.31), "reached": (1.29, 1.21)}, 1),
    # what simulated runs are sure of is named where scatter takes it up
    (DRAG, 499.0, {"halved": (1.31, 1.31)}, 1),
    (DRAG, 501.0, {"halved": (1.31, 1.31)}, 2),
    # and a trend over the runs, which scatter takes up, beside another
    (TREND, 11.9, {"halved": (2.0, 1.6)}, 1),
    (TREND, 12.1, {"halved": (2.0, 1.6)}, 2),
    # a lone finding takes what is missing
    ({"speed_ripple": 56.0}, 80.0, {"reached": (1.19, 1.0), "halved": (2.0, 1.6)}, 1),
    ({"speed_ripple": 56.0}, 80.0, {"reached": (1.19, 1.09), "halved": (2.0, 1.6)}, 1),
    ({"speed_ripple": 56.0}, 80.0, {"reached": (1.19, 1.15), "halved": (2.0, 1.6)}, 0),
    ({"speed_ripple": 56.0}, 499.0, {"reached": (1.19, 1.15), "halved": (2.0, 1.6)}, 0),
    ({"speed_ripple": 56.0}, 501.0, {"reached": (1.19, 1.15), "halved": (2.0, 1.6)}, 1),
    # what takes nothing of the gap is asked of the runs, however sure; so is what scatter takes up,
    # before friction may scatter; what makes the model much worse is none
    ({"speed_ripple": 2400.0}, 5.0, {"felt": True}, 1),
    ({"speed_ripple": 2400.0}, 5.0, {"felt": False}, 0),
    ({"load_dependence": 30.0}, 30.0, {"reached": (1.17, 1.17), "halved": (2.0, 1.48)}, 1),
    ({"load_dependence": 30.0}, 30.0, {"reached": (1.17, 1.17), "halved": (2.0, 1.6)}, 0),
    ({"static_strengthening": 11.0}, 20.0, {"lost": True}, 0),
    ({"load_dependence": 11.0}, 900.0, {"lost": True}, 0),
    # what no effect stands for beside a greater finding is asked of runs that it explains
    (DRIFT, None, {"reached": (1.29, 1.0), "halved": (1.4, 1.0)}, 1),
    (DRIFT, None, {"reached": (1.31, 1.0), "halved": (1.4, 1.0)}, 2),
]


@pytest.mark.parametrize(("rows", "gained", "beside", "named"), DECIDED)
def test_what_rows_ask_for_is_named_where_simulated_runs_need_it(
    monkeypatch, rows, gained, beside, named
):
    kernel = property(lambda part: bool(part.settings) and not part.effect.startswith("other."))
    monkeypatch.setattr(Part, "in_kernel", kernel)
    asked = Rows(*(finding(*each) for each in rows.items()), most=len(rows))
    gains = dict.fromkeys(rows, 1e3) | {list(rows)[-1]: gained}
    assert agreed(monkeypatch, asked, gains, **beside)[0] == list(rows)[:named]


def test_after_four_rounds_rows_are_asked_for_one_finding_alone(monkeypatch):
    names = [f"pretended {number}" for number in range(5)]
    gained = dict.fromkeys(names, 0.0) | {"true": 100.0, "second": 100.0}
    findings = [finding(name, 20.0) for name in [*names[:4], "true", "second"]]
    rows = Rows(*findings, most=1)
    assert agreed(monkeypatch, rows, gained)[0] == ["true"]
    rows = Rows(*(finding(name, 20.0) for name in [*names, "true"]), most=1)
    assert agreed(monkeypatch, rows, gained)[0] == []
    assert rows.asked[-1] == tuple(names)


def test_the_least_finding_is_asked_first_and_the_greatest_of_what_is_left(monkeypatch):
    """With what it leaves gone the greatest is beyond doubt: no model is fitted without it."""
    rows = Rows(finding("run_in", 2.0 * SURE), finding("film_drag", 9.0 * SURE),
                finding("surface_pattern", 80.0), most=3)  # fmt: skip
    gained = {"surface_pattern": 0.0, "run_in": 0.0}  # film_drag: KeyError
    found, rejected = agreed(monkeypatch, rows, gained)
    assert found == ["film_drag"]
    assert [one.effect for one in rejected] == ["surface_pattern", "run_in"]


@pytest.mark.parametrize(
    ("left", "reached", "names"), [(1.9, 1.11, 1), (2.1, 1.11, 3), (2.1, 1.09, 1)]
)
def test_nothing_is_doubted_where_three_findings_leave_twice_the_noise(
    monkeypatch, left, reached, names
):
    """It is unknown whatever is dropped, and each fit to runs that are so far off is long; not
    where simulated runs miss nothing, and so the rows must err."""
    gains = {"run_in": 900.0, "film_drag": 200.0, "other.time": 100.0}
    rows = Rows(*(finding(*each) for each in gains.items()), most=3, left=left)
    found, _ = agreed(monkeypatch, rows, dict.fromkeys(gains, 0.0), reached=reached)
    assert len(found) == names


def test_two_findings_are_doubted_however_much_they_leave(monkeypatch):
    """Without the one that is none they are one finding, which may be named."""
    rows = Rows(finding("run_in", 900.0), finding("film_drag", 200.0), most=2, left=2.1)
    found, _ = agreed(monkeypatch, rows, {"run_in": 900.0, "film_drag": 0.0}, reached=1.11)
    assert found == ["run_in"]


@pytest.mark.parametrize(("gained", "asked"), [(499.0, 2), (501.0, 3)])
def test_lesser_findings_go_at_once_where_the_greatest_explains_the_runs(
    monkeypatch, gained, asked
):
    """But where simulated runs are sure of one: then they are asked one by one."""
    gains = {"run_in": 2.0 * SURE, "film_drag": 200.0, "surface_pattern": 100.0}
    rows = Rows(*(finding(*each) for each in gains.items()), most=3)
    agreed(monkeypatch, rows, {"run_in": 900.0, "film_drag": gained, "surface_pattern": 0.0})
    assert len(rows.asked[1]) == 4 - asked


def test_ageing_is_asked_for_beside_another_finding_too(monkeypatch):
    rows = Rows(finding("run_in", 2.0 * SURE), offers=[finding("static_strengthening", 0.1)])
    gains = {"run_in": 900.0, "static_strengthening": 900.0}
    found, _ = agreed(monkeypatch, rows, gains, sooner=0.02, nearer=20.0)
    assert found == ["run_in", "static_strengthening"]


def test_rivals_are_beside_the_law_that_is_named_not_the_first_that_was_tried(monkeypatch):
    """Runs that only the first law leaves off are none of the rival's."""
    asked, best = [], Fitting.best_of

    def by_another_law(self, parts, named):
        return [replace(one, settings={"another": 1.0}) for one in parts], best(self, [], named)[1]

    monkeypatch.setattr(Fitting, "best_of", by_another_law)
    monkeypatch.setattr(agreement, "rivals_of", lambda fits, parts, *_: asked.append(parts) or {})
    agreed(monkeypatch, Rows(finding("run_in", 2.0 * SURE)), {"run_in": 900.0})
    assert [one.settings for one in asked[0]] == [{"another": 1.0}]


@pytest.mark.parametrize(
    ("sooner", "gained", "nearer", "named"),
    [
        (0.0105, 101.0, 12.1, 1),
        (0.0095, 101.0, 12.1, 0),
        (0.0105, 99.0, 12.1, 0),
        (0.0105, 101.0, 11.9, 0),
    ],
)
@pytest.mark.parametrize("across", [0, 1])
def test_a_contact_that_lets_go_soon_has_aged_less(
    monkeypatch, sooner, gained, nearer, named, across
):
    """Rows do not tell the one from the other; simulated runs may, by more than scatter is
    worth. Also where the block moves across."""
    turned = Finding("turning_surface", (), 2.0 * SURE, numbers={"curvature": (0.1, 0.01)})
    rows = Rows(*[turned] * across, offers=[finding("static_strengthening", 0.1)])
    gains = {"static_strengthening": gained, "turning_surface": 900.0}
    found, _ = agreed(monkeypatch, rows, gains, sooner=sooner, nearer=nearer)
    assert found == ["turning_surface"] * across + ["static_strengthening"] * named


@pytest.mark.parametrize(
    ("name", "promised", "left", "named"),
    [
        ("film_drag", 0.9, 1.09, 0),
        ("film_drag", 1.1, 1.09, 1),
        ("film_drag", 0.9, 1.11, 1),  # something is missing without it
        ("film_drag", None, 1.09, 1),
        # of these derivatives tell nothing
        ("load_dependence", 0.0, 1.09, 1),
        ("static_strengthening", 0.0, 1.09, 1),
    ],
)
def test_what_derivatives_of_the_runs_ask_nothing_of_is_not_fitted(
    monkeypatch, name, promised, left, named
):
    rows = Rows(finding(name, 20.0))
    rows.promises[name] = promised
    found, rejected = agreed(
        monkeypatch, rows, {name: 900.0}, reached=(left, 1.0), halved=(2.0, 1.0), nearer=20.0
    )
    assert found == [name] * named and [one.simulated for one in rejected] == [0.9] * (1 - named)


def test_beside_coarse_steps_no_promise_is_followed(monkeypatch):
    rows = Rows(finding("run_in", 2.0 * SURE), offers=[finding("film_drag", 90.0)])
    gains = {"film_drag": 900.0}
    assert agreed(monkeypatch, rows, gains, rounding="coarse")[0] == ["run_in"]
    assert agreed(monkeypatch, rows, gains)[0] == ["run_in", "film_drag"]


@pytest.mark.parametrize("across", [0, 1])
def test_beside_a_fault_of_the_camera_no_promise_is_followed(monkeypatch, across):
    """What its course leaves of it is no noise."""
    drift = finding("measurement.drift", 2.0 * SURE)
    turned = Finding("measurement.rotation", (), 2.0 * SURE, numbers={"rotation": (0.1, 0.01)})
    rows = Rows(turned if across else drift, offers=[finding("film_drag", 90.0)])
    found, _ = agreed(monkeypatch, rows, {"film_drag": 900.0})
    assert found == [turned.name if across else drift.name]


@pytest.mark.parametrize(
    ("name", "promised", "gained", "nearer", "named"),
    [
        ("film_drag", 25.1, 50.1, 6.1, 1),
        ("film_drag", 24.9, 50.1, 6.1, 0),
        ("film_drag", 25.1, 49.9, 6.1, 0),
        ("film_drag", 25.1, 50.1, 5.9, 0),
        ("measurement.scale", 28.1, 52.9, 6.1, 0),
        ("measurement.scale", 28.1, 53.1, 6.1, 1),
        ("measurement.scale", 27.9, 53.1, 6.1, 0),
        ("other.hysteresis", 90.0, 900.0, 90.0, 0),
    ],
)
def test_what_simulated_runs_promise_is_found_where_they_are_then_sure(
    monkeypatch, name, promised, gained, nearer, named
):
    """Contact and scatter may leave rows next to nothing of a second effect."""
    rows = Rows(finding("run_in", 2.0 * SURE), offers=[finding(name, promised)])
    found, _ = agreed(monkeypatch, rows, {name: gained}, nearer=nearer)
    assert found == ["run_in", *[name] * named]


@pytest.mark.parametrize(("gained", "named"), [(99.0, 1), (101.0, 2)])
def test_a_hidden_one_is_no_part_of_what_the_law_of_another_leaves(monkeypatch, gained, named):
    """A law that is followed to 7 % leaves a 200th of its squares, here of e^20 000."""
    rows = Rows(finding("run_in", 2e4), offers=[finding("film_drag", 60.0)])
    found, _ = agreed(monkeypatch, rows, {"film_drag": gained})
    assert len(found) == named


@pytest.mark.parametrize(
    ("reached", "promised", "hinted", "named"),
    [(1.09, 90.0, 0.0, 1), (1.11, 90.0, 0.0, 0), (1.11, 90.0, 5.9, 0), (1.11, 0.0, 6.1, 1),
     (1.09, 0.0, 5.9, 0)],
)  # fmt: skip
def test_what_runs_still_miss_is_in_the_rows_too(monkeypatch, reached, promised, hinted, named):
    """What these ask for and hardly miss needs no promise."""
    offers = [finding("film_drag", promised)]
    rows = Rows(finding("run_in", 2.0 * SURE), offers=offers, hinted=hinted)
    found, _ = agreed(monkeypatch, rows, {"film_drag": 90.0}, reached=reached)
    assert found == ["run_in", *["film_drag"] * named]


@pytest.mark.parametrize(("gain", "asked"), [(60.1, False), (59.9, True)])
def test_a_lesser_finding_is_asked_again_beside_what_is_found(monkeypatch, gain, asked):
    """That may be what the rows took it for: here simulated runs no longer miss it."""
    rows = Rows(finding("run_in", gain), offers=[finding("film_drag", 40.0)])
    gains = iter([30.0, 30.0, 0.0])  # of run_in, alone and beside film_drag
    monkeypatch.setattr(Fitting, "gained", lambda self, part, *beside: (next(gains), part))
    monkeypatch.setattr(rejection, "_makes_up", lambda *given: True)
    found, rejected = agreed(monkeypatch, rows, {"film_drag": 60.0, "run_in": 30.0})
    assert [one.effect for one in rejected[:1]] == ["run_in"] * asked
    assert (found == ["run_in", "film_drag"]) is not asked


def test_of_what_is_promised_the_best_is_found_and_what_is_nearly_as_good_is_alike(monkeypatch):
    """Three are asked, not a fourth; none beside two findings: three explain nothing."""
    names = ["film_drag", "structural_damping", "spring_hardening", "fourth"]
    offers = [finding(name, 40.0 - place) for place, name in enumerate(names)]
    gains = {"film_drag": 90.0, "structural_damping": 92.0, "spring_hardening": 40.0}
    one, two = finding("run_in", 9.0 * SURE), finding("load_dependence", 2.0 * SURE)
    given = {"monkeypatch": monkeypatch, "nearer": 9.0}
    found, _ = agreed(rows=Rows(one, offers=offers), gained=gains, **given)
    assert found == ["run_in", "structural_damping"]
    third = gains | {"spring_hardening": 900.0}
    assert agreed(rows=Rows(one, offers=offers), gained=third, **given)[0][1] == "spring_hardening"
    gains |= {"load_dependence": 9.0 * SURE}
    found, _ = agreed(rows=Rows(one, two, most=2, offers=offers), gained=gains, **given)
    assert found == ["run_in", "load_dependence"]


def test_no_wave_is_promised_that_rows_do_not_find(monkeypatch):
    """Neither contact nor scatter takes it up; but with a size and a phase of every run it fits
    what a contact leaves."""
    wave = Added(Unknown("speed_ripple", "", None, np.eye(1), wave="of some length"))
    rows = Rows(offers=[Finding("speed_ripple", (wave,), 900.0)])
    assert agreed(monkeypatch, rows, {"speed_ripple": 900.0})[0] == []


@pytest.mark.parametrize(("simulated", "too_long"), [(1.4e8, False), (1.6e8, True)])
def test_a_search_has_an_end(simulated, too_long):
    fitted = SimpleNamespace(work=models.Work(simulated))
    assert Fitting(None, None, 1, [(fitted, True)]).is_too_long is too_long
    assert not Fitting(None, None, 1).is_too_long


@pytest.mark.parametrize("is_cut", [False, True])
def test_a_search_that_takes_too_long_asks_for_nothing_more(monkeypatch, is_cut):
    """Neither the rows after what they pretended, nor for what is hidden."""

    def named(rows):
        cut = iter([False])  # before the first round
        monkeypatch.setattr(Fitting, "is_too_long", property(lambda fits: next(cut, is_cut)))
        gained = {"spring_hardening": 0.0, "film_drag": 90.0, "run_in": 90.0}
        return agreed(monkeypatch, rows, gained)[0]

    rows = Rows(finding("spring_hardening", 205.0), finding("film_drag", 134.0))
    assert named(rows) == ["film_drag"] * (not is_cut)
    rows = Rows(finding("film_drag", 2.0 * SURE), offers=[finding("run_in", 90.0)])
    assert named(rows) == ["film_drag"] + ["run_in"] * (not is_cut)


@pytest.mark.parametrize("is_found", [False, True])
def test_a_search_that_was_cut_short_says_so(is_found):
    doubt = find._cut_short(150_000_000, is_found)
    assert doubt.text.startswith("The search ended after 150 million simulated samples")
    assert doubt.severe is not is_found


@pytest.mark.parametrize(
    ("least", "gain", "name"),
    [
        (60.0, 199.0, "film_drag"),
        (60.0, 201.0, "structural_damping"),
        (610.0, 390.0, "film_drag"),
        (590.0, 410.0, "structural_damping"),
    ],
)
def test_of_two_hidden_ones_near_each_other_every_form_of_their_laws_is_tried(
    monkeypatch, least, gain, name
):
    """structural_damping is ahead of film_drag by so much until another form of that is tried."""

    def forms(self, part, named):
        yield from (part, replace(part, settings={"root": 1.0}))

    monkeypatch.setattr(Fitting, "forms", forms)
    offers = [finding(one, 90.0) for one in ("film_drag", "structural_damping")]
    gains = {"film_drag": least, "structural_damping": least + gain}
    gains |= {("film_drag", "root"): 2000.0, "run_in": 900.0}
    rows = Rows(finding("run_in", 2.0 * SURE), offers=offers)
    assert agreed(monkeypatch, rows, gains)[0] == ["run_in", name]


def test_what_is_lost_by_itself_goes_before_the_others_are_asked_beside_it(monkeypatch):
    rows = Rows(finding("spring_hardening", 58.0), finding("film_drag", 20.0), most=2)
    gained = {"spring_hardening": -9e3}  # film_drag: KeyError
    with pytest.raises(KeyError, match="film_drag"):
        agreed(monkeypatch, rows, gained, lost=True)
    assert rows.asked == [(), ("spring_hardening",)]


@pytest.mark.parametrize(("gained", "lost"), [(29.0, True), (31.0, False)])
def test_a_lost_finding_stays_where_simulated_runs_ask_for_it_by_more(monkeypatch, gained, lost):
    """Beside contact and scatter, from next to nothing of it: e^30."""
    models = SimpleNamespace(
        is_lost_beside=lambda other: True, let_scatter=lambda: None, gained=lambda part: gained
    )
    fits = Fitting(None, lambda: None, 1)
    monkeypatch.setattr(fits, "fitted", lambda named, parts, **_: models)
    found = part(finding("spring_hardening", 58.0))
    assert bool(rejection.lost(fits, [found], None, {"spring_hardening"})) == lost


def law(effect, form, price=0.0):
    return LawFit(effect, Candidate(effect, form, ()), {}, np.zeros(2), 1.0, price)


@pytest.mark.parametrize(("off", "follows"), [(0.045, True), (0.055, False)])
def test_a_law_near_its_curve_is_tried_before_the_curve_itself(off, follows):
    """However small the curve's own errors are: smoothing turns it by some percent."""
    cubic = replace(law("spring_hardening", "cubic"), misfit=50.0, off=off)
    assert cubic.follows == follows


@pytest.mark.parametrize(
    ("numbers", "tried"), [((), ["as installed"]), (CURVE_NUMBERS, ["cubic", "as installed"])]
)
def test_where_the_curve_is_in_the_model_the_best_law_is_its_rival(numbers, tried):
    forms = tuple(law("spring_hardening", form) for form in ("cubic", "as installed"))
    found = Part(finding("spring_hardening", 10.0), None, forms, numbers)
    campaign = SimpleNamespace(catalogue=SimpleNamespace(effects=()))
    assert [fit.candidate.form for fit in found.rivals(campaign)] == tried


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
        fitting, "part_of", lambda campaign, system, rung, one, law: Part(one, None, (law,))
    )
    campaign = SimpleNamespace(catalogue=SimpleNamespace(effects=()))
    without = SimpleNamespace(gained=lambda part: gains[part.fits[0].candidate.form])
    tried, named = Part(finding(own, 10.0), None, tuple(forms)), Named(None, (), None, None, {})
    found, form = Fitting(campaign, lambda: None, 1).gained(tried, without, named)
    assert found == gained and (form is not tried) == (found != first)


@pytest.mark.parametrize(("nearer", "named"), [(3.1, ["run_in"]), (2.9, [])])
def test_distances_are_asked_of_the_law_that_simulated_runs_ask_for(monkeypatch, nearer, named):
    """The first of its laws gains nothing, and comes no nearer."""

    def asked(self, part, *beside):
        return 40.0, replace(part, settings={"form": 1.0})

    monkeypatch.setattr(Fitting, "gained", asked)
    monkeypatch.setattr(rejection, "_makes_up", lambda *given: True)
    rows, by_law = Rows(finding("run_in", 20.0)), {"form": nearer, "on": 0.0}
    assert agreed(monkeypatch, rows, {"run_in": 0.0}, nearer=by_law)[0] == named


@pytest.mark.parametrize("check", ["units", "direction", "sampling", "springs", "speed"])
def test_no_effect_is_searched_for_where_none_would_be_named(check, monkeypatch):
    """Doubts are asked first; one that a finding may answer does not stop the search."""
    doubt = Doubt(check, "run01: surface_speed = 60 m/s", ("run01",), True)
    monkeypatch.setattr(find, "doubts_of", lambda campaign: (doubt,))
    taken = []
    for name in ("_unsearched", "confirmed_findings"):
        monkeypatch.setattr(find, name, lambda *given, name=name: taken.append(name))
    monkeypatch.setattr(find, "_answer", lambda campaign, agreed, doubts: doubts)
    assert find.find_gap(Campaign()) == (doubt,)
    answerable = check in ("springs", "speed")
    assert taken == ["confirmed_findings" if answerable else "_unsearched"]


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
    assert find._unanswered(doubts, ladder, names) == doubts * severe


@dataclass(frozen=True)
class Campaign:
    """One without runs."""

    runs: tuple = ()


@pytest.mark.parametrize(("with_it", "with_them"), [(1.3, 1.4), (1.4, 1.3)])
def test_simulated_runs_choose_between_a_long_filter_and_what_rows_find(
    monkeypatch, with_it, with_them
):
    """A filter reaches into slips, where rows then find more of a clock than of it."""
    missed = {SMOOTHING: with_it, "measurement.clock": with_them}
    monkeypatch.setattr(agreement, "likeliest_filters", lambda rows, variants: [(9.0, "in all")])
    system = SimpleNamespace(rung=lambda added=(): None)

    def named(found, filtered=None):
        ladder = Ladder(system, (found,), None, {}, {})
        return Named(ladder, (found,), system, None, {SMOOTHING: []}, filtered)

    runs = SimpleNamespace(
        part=lambda form, found: found.name,
        fitted=lambda form, parts, **as_asked: SimpleNamespace(
            unscattered=Score(max(missed[name] for name in parts), None),
            runs_with=lambda fault: [],
        ),
    )
    found = named(finding("measurement.clock", 10.0), named(finding(SMOOTHING, 10.0)))
    (chosen,) = agreement._with_likeliest_filter(runs, found).findings
    assert chosen.name == min(missed, key=missed.get)

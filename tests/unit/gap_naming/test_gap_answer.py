"""What is said of a finding: models in long segments, ladder, ranking, odds, curves, remarks."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from settled_campaigns import campaign_of, prepared_of, settled_on, strength
from stickslip.effects.candidate import Candidate

from cosim.gap.answer import longer
from cosim.gap.answer.answer import answer
from cosim.gap.answer.lacking import lacking
from cosim.gap.answer.laws import laws_found, table_found
from cosim.gap.answer.models import Bench, glance, long_fit
from cosim.gap.camera.quantisation import Quantisation
from cosim.gap.candidates.extend import extended
from cosim.gap.evidence.products import Spreads
from cosim.gap.evidence.settled import TURNS, ended, settled
from cosim.gap.selection.probability import posterior
from cosim.gap.selection.tried import Tried, gain
from cosim.gap.selection.verdict import Finding, Rung
from cosim.processes import map_here

KEY, TRUE = "velocity_weakening.hyperbolic", 1.0
LAW = Candidate("velocity_weakening", "hyperbolic", (strength(KEY, 1.0, 0.5),))
DRAG = Candidate("film_drag", "linear", (strength("film_drag.coefficient", 0.5, 0.1),))
GONE = Tried(Candidate("run_in", "exponential", (strength("run_in.change", 0.1, 0.1),)), -4.0)
ROUNDED = Quantisation(2e-4, 0.99, 1e-9)


@pytest.fixture(scope="module")
def campaign(tmp_path_factory):
    folder = tmp_path_factory.mktemp("answer")
    return campaign_of(folder, lambda mass, speed: {"velocity_weakening": {"hyperbolic": TRUE}}, 1)


@pytest.fixture(scope="module")
def finding(campaign):
    """As the search would have it, with the law that is hidden on its first step."""
    segmented = prepared_of(campaign)
    base = settled_on(campaign, segmented, turns=TURNS)
    tried = []
    for law in (LAW, DRAG):
        model = extended(base.model, law, {})
        found = ended(settled(segmented, campaign.runs, model, base))
        tried.append(Tried(law, gain(found, base), found))
    first, _ = tried
    ladder = (Rung((), base, 0.0), Rung((LAW.effect,), first.model, first.gain, (first,)))
    return Finding("named", (LAW.effect,), ladder, 1, (*tried, GONE), 0.99, ())


@pytest.fixture(scope="module")
def bench(campaign):
    return Bench.of(campaign, planar=False)


@pytest.fixture(scope="module")
def gap(campaign, bench, finding):
    return answer(campaign, bench, finding, {}, None, map_here)


def test_the_gap_closes_and_the_number_is_the_true_one(gap):
    assert gap.gap_before[0] > 1.1 and max(gap.gap_after) < 1.05
    low, high = gap.extended.intervals[KEY]
    assert low < TRUE < high and gap.extended.values[KEY] == pytest.approx(TRUE, rel=0.05)
    assert gap.plain.gap == gap.gap_before and gap.extended.gap == gap.gap_after


def test_the_ladder_goes_from_the_plain_model_to_noise(gap):
    plain, first = gap.ladder
    assert plain.effects == () and plain.share == 0.0 and not plain.members
    assert first.effects == (LAW.effect,) and first.members == {LAW.effect: pytest.approx(1.0)}
    assert (first.fit_gap, first.held_out_gap) == pytest.approx(gap.gap_after)
    assert 0.5 < first.share <= 1.0


def test_the_ranking_has_the_numbers_that_are_shown_and_none_that_are_not(gap):
    first, other, gone, *silent = gap.ranking
    assert first.parameters[KEY] == gap.extended.values[KEY]
    assert first.intervals[KEY] == gap.extended.intervals[KEY]
    assert first.probability > 0.999 > other.probability
    # with nothing of a law the model is the plain one: none leaves more
    assert (other.fit_gap, other.held_out_gap) <= gap.gap_before
    assert gone.fit_gap is None and gone.held_out_gap is None and not gone.parameters
    # waves without a period, and what this finding had not looked at
    assert "surface_pattern" in {row.effect for row in silent}
    assert all(row.delta_bic is None and row.probability is None for row in silent)


def test_the_curve_of_what_was_found_falls_with_the_speed(gap):
    (law,) = gap.laws
    assert (law.effect, law.curve.axis) == (LAW.effect, "sliding speed") and not law.in_model
    assert law.curve.mean[0] > law.curve.mean[-1]


def test_what_was_not_tried_is_said(gap):
    text = " ".join(gap.remarks)
    assert "lateral_friction" in text and "y was not measured" in text


def test_a_glance_sees_what_a_fit_leaves(bench, finding):
    """From numbers that the algebra of short segments found: the same within some parts."""
    last = finding.ladder[1].settled
    trial = long_fit(bench, last, last.spreads)
    assert glance(bench, last, last.spreads) == pytest.approx(
        (trial.fit_rms, trial.held_out_rms), rel=0.05
    )


def test_a_class_beside_steps_of_the_tracker(campaign, bench, finding):
    """Its members would be told apart by a run; the steps are certain."""
    rung = replace(finding.ladder[1], members=finding.ranking[:2])
    alike = replace(finding, verdict="class", ladder=(finding.ladder[0], rung))
    gap = answer(campaign, bench, alike, {}, ROUNDED, map_here)
    members = (LAW.effect, DRAG.effect)
    assert gap.effects == ("measurement.quantisation", *members) and gap.classes == (members,)
    assert gap.quantisation["step"] == 2e-4 and "200 µm" in gap.remarks[0]
    assert [pair[:2] for pair in gap.next_experiment["separates"]] == [[*members]]


def test_steps_of_the_tracker_alone_are_named(campaign, bench, finding):
    nothing = replace(finding, verdict="none", effects=(), ladder=finding.ladder[:1], chosen=0)
    alone = answer(campaign, bench, nothing, {}, ROUNDED, map_here)
    assert (alone.verdict, alone.effects) == ("named", ("measurement.quantisation",))


@pytest.mark.slow
def test_where_nothing_has_a_name_a_curve_takes_its_place(bench, finding):
    unknown = replace(finding, verdict="unknown", effects=(), ladder=finding.ladder[:1], chosen=0)
    laws = laws_found(bench, unknown, map_here)
    assert all(not law.effect for law in laws)
    law, after = table_found(bench, unknown, laws, map_here)
    assert law.in_model and (law.curve.axis, law.curve.on) == ("sliding speed", "mu_k")
    assert any("table_part" in key for key in after.model.settings)
    assert gain(after, finding.ladder[0].settled) > 0.5 * finding.ladder[1].gain
    assert table_found(bench, finding, laws, map_here) is None


def test_odds_are_those_of_bayes():
    """Of four effects two were tried to the end, one of them as good as nothing."""
    one, two = 0.5 * 9.0 / 4.0, 0.5 / 4.0
    whole = 0.5 + one + two
    found = posterior({"a": 2.0 * np.log(9.0), "b": 0.0}, 4)
    assert found == pytest.approx({"a": one / whole, "b": two / whole})
    assert posterior({"a": 1e6, "b": 0.0}, 2)["a"] == 1.0


def test_a_campaign_without_a_name_says_what_it_lacks(campaign):
    lines = lacking(campaign, Spreads(stretch=0.14))
    assert any("14 % from stretch to stretch" in line for line in lines)
    assert any("neither y nor phi was measured in any run" in line for line in lines)
    rig = campaign.rig.model_copy(update={"degrees_of_freedom": ("x",)})
    guided = lacking(replace(campaign, rig=rig), Spreads(stretch=0.14))
    assert not any("phi" in line for line in guided)
    twice = replace(campaign, runs=(*campaign.runs, campaign.runs[0]))
    once = [line for line in lines if "settings was run once" in line]
    assert len(once) == 1 and once[0] not in lacking(twice, Spreads(stretch=0.14))
    # what scatters as a rig's does is no reason
    assert not any("stretch to stretch" in line for line in lacking(campaign, Spreads()))


@pytest.mark.parametrize(
    ("verdict", "short", "anew", "hidden"),
    [
        ("none", 1.2, 3.7, 0.0),  # it fits in long segments as it stands
        ("none", 2.9, 1.05, 0.0),  # and set out anew
        ("none", 2.9, 3.7, 3.7),
        ("named", 2.9, 3.7, 0.0),  # the plain model need not fit
    ],
)
def test_none_must_hold_in_longer_segments(
    monkeypatch, bench, finding, verdict, short, anew, hidden
):
    laid = SimpleNamespace(evidence=anew**2 * 1000.0, rows=1000)
    monkeypatch.setattr(longer, "settled", lambda *call, **options: laid)
    plain = SimpleNamespace(fit_rms=short)
    found = longer.left_in_longer(bench, replace(finding, verdict=verdict), plain, map_here)
    assert found == pytest.approx(hidden)


def test_what_is_named_lacks_nothing(gap):
    assert gap.lacks == ()

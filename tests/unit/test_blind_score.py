"""Scoring of hidden campaigns: counts by hand, a benchmark that goes on where it stopped."""

import math

import pytest
from blind import score
from blind.campaign import draw_campaign
from blind.next_experiment import separation
from blind.score_table import markdown


def row(kind, hidden, verdict, effects=(), size=8.0, after=1.1):
    """A campaign with its answer; verdict None: the product failed."""
    found = {
        "verdict": verdict,
        "effects": list(effects),
        "gap": {"before": {"held_out": 9.0}, "after": {"held_out": after}},
    }
    truth = {"kind": kind, "hidden": list(hidden), "size_alone": [size] * len(hidden)}
    return {"truth": truth, "found": found if verdict else None, "seconds": 1.0}


ROWS = [
    row("effects", ["run_in"], "named", ["run_in"]),
    row("effects", ["run_in"], "named", ["film_drag"]),
    row("effects", ["run_in"], "named", ["run_in", "film_drag"]),
    row("effects", ["film_drag"], "class", ["structural_damping", "film_drag"], after=2.0),
    row("effects", ["film_drag"], "class", ["run_in", "load_dependence"]),
    row("effects", ["film_drag"], "none", size=1.0),
    row("effects", ["speed_ripple"], None),
    row("none", [], "none"),
    row("none", [], "unknown"),
    row("unknown", ["play"], "unknown"),
    row("unknown", ["magnet"], "named", ["run_in"]),
    row("two", ["run_in", "speed_ripple"], "named", ["speed_ripple", "run_in"]),
    row("two", ["run_in", "speed_ripple"], "named", ["run_in"]),
]


def test_right_answers_by_hand():
    effects = score.of_kind(ROWS, "effects")
    assert [score.is_exact(each) for each in effects] == [True] + 6 * [False]
    assert [score.is_in_class(each) for each in effects] == [False] * 3 + [True] + [False] * 3
    assert score.share(score.large(effects), score.is_right).total == 6
    assert math.isnan(score.gap(effects[-1], "before"))
    assert score.closes_gap(effects[0]) and not score.closes_gap(effects[3])


def test_confusion_matrix_by_hand():
    labels, columns, counts = score.confusion(ROWS)
    assert labels == ["film_drag", "run_in", "speed_ripple", "none", "magnet", "play"]
    table = {
        (label, column): counts[i, j]
        for i, label in enumerate(labels)
        for j, column in enumerate(columns)
        if counts[i, j]
    }
    assert table == {
        ("run_in", "run_in"): 1,
        ("run_in", "film_drag"): 1,
        ("run_in", "several"): 1,
        ("film_drag", "class with it"): 1,
        ("film_drag", "class without it"): 1,
        ("film_drag", "none"): 1,
        ("speed_ripple", "failed"): 1,
        ("none", "none"): 1,
        ("none", "unknown"): 1,
        ("play", "unknown"): 1,
        ("magnet", "run_in"): 1,
    }


def test_table_states_every_figure():
    text = markdown(ROWS, 42)
    assert "seed 42" in text
    assert "| one effect ≥ 5 units: it or its class | 33.3 % (2/6;" in text
    assert "| effect-free: false positives | 50.0 % (1/2;" in text
    assert "| … a name given | 0.0 % (0/2;" in text
    assert "`unknown` | 50.0 % (1/2;" in text
    assert "| two effects, each ≥ 5 units: both | 50.0 % (1/2;" in text
    assert "| … ≤ 1.5 after, from ≥ 5 before | 50.0 % (1/2;" in text


@pytest.mark.slow
@pytest.mark.parametrize("seed, effect", [(1, "film_drag"), (2, "structural_damping")])
def test_one_speed_cannot_tell_drag_from_damping_but_another_can(seed, effect):
    drawn = draw_campaign(seed, "single_speed", [effect], tries=1)
    while "root" in drawn.ingredients[0].form:  # drag with the root of the speed has no twin
        seed += 10
        drawn = draw_campaign(seed, "single_speed", [effect], tries=1)
    p = drawn.plan.runs[0].hidden
    assert separation(drawn, {"surface_speed": p.speed}) < 0.2
    assert separation(drawn, {"surface_speed": 3 * p.speed}) > 5.0

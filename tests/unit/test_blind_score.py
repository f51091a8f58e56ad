"""Scoring of hidden campaigns: counts by hand, a benchmark that goes on where it stopped."""

import json
import math

import blind_campaigns as benchmark
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


def test_interval_of_a_share():
    # Wilson's interval of 8 of 10, from his formula worked by hand
    low, high = score.Share(8, 10).interval
    assert low == pytest.approx(0.4902, abs=1e-3) and high == pytest.approx(0.9433, abs=1e-3)
    assert score.Share(0, 0).interval == (0.0, 1.0)


def test_table_states_every_figure():
    text = markdown(ROWS, 42)
    assert "seed 42" in text
    assert "| one effect ≥ 5 units: it or its class | 33.3 % (2/6;" in text
    assert "| effect-free: false positives | 50.0 % (1/2;" in text
    assert "| … a name given | 0.0 % (0/2;" in text
    assert "`unknown` | 50.0 % (1/2;" in text
    assert "| two effects, each ≥ 5 units: both | 50.0 % (1/2;" in text
    assert "| … ≤ 1.5 after, from ≥ 5 before | 50.0 % (1/2;" in text


def test_cells_keep_their_seeds_whatever_else_is_run():
    everything = list(benchmark.cells(benchmark.KINDS, None, 7, (), []))
    assert len({cell.name for cell in everything}) == len(everything) >= 200
    assert len({cell.seed for cell in everything}) == len(everything)
    few = list(benchmark.cells(["effects", "none"], 1, 7, ["run_in"], []))
    assert len(few) == 6 and set(few) <= set(everything)
    assert not {c.seed for c in everything} & {
        c.seed for c in benchmark.cells(benchmark.KINDS, None, 8, (), [])
    }


def test_benchmark_does_only_what_is_missing(tmp_path, monkeypatch):
    asked = []

    def answer(campaign, folder):
        asked.append(campaign)
        assert campaign.is_file() and not list(folder.rglob("*answer*"))
        assert not any(word in str(campaign.relative_to(tmp_path)) for word in ("none", "clean"))
        return {"verdict": "none", "effects": []}, "exit 0: ", 0.1

    monkeypatch.setattr(benchmark, "ask", answer)
    cells = list(benchmark.cells(["none"], 1, 7, (), []))
    first = benchmark.run_missing(cells[:1], tmp_path, 1, keep=False)
    file = tmp_path / "campaigns.jsonl"
    with open(file, "a", encoding="utf-8") as lines:
        lines.write('{"name": "cut o')
    both = benchmark.run_missing(cells, tmp_path, 1, keep=False)
    assert len(asked) == 2 and both[0] == json.loads(json.dumps(first[0]))
    assert benchmark.run_missing(cells, tmp_path, 1, keep=False) == json.loads(json.dumps(both))
    assert len(asked) == 2
    assert not list((tmp_path / "campaigns").iterdir())
    benchmark.score_figure(both, tmp_path / "scores.png")
    assert (tmp_path / "scores.png").stat().st_size > 10_000


@pytest.mark.slow
def test_failures_are_asked_again_when_told(tmp_path, monkeypatch):
    cells = list(benchmark.cells(["none"], 1, 7, (), []))[:1]
    monkeypatch.setattr(benchmark, "ask", lambda *_: (None, "exit 1: broken", 0.1))
    assert benchmark.run_missing(cells, tmp_path, 1, keep=False)[0]["found"] is None
    found = {"verdict": "none", "effects": []}
    monkeypatch.setattr(benchmark, "ask", lambda *_: (found, "exit 0: ", 0.1))
    assert benchmark.run_missing(cells, tmp_path, 1, keep=False)[0]["found"] is None
    assert benchmark.run_missing(cells, tmp_path, 1, keep=False, again=True)[0]["found"] == found
    assert benchmark.run_missing(cells, tmp_path, 1, keep=False)[0]["found"] == found


def test_seed_is_kept_in_the_folder(tmp_path):
    seed = benchmark.seed_of(tmp_path / "new", None)
    assert benchmark.seed_of(tmp_path / "new", None) == seed
    assert benchmark.seed_of(tmp_path / "other", 5) == 5
    with pytest.raises(SystemExit, match="begun with seed 5"):
        benchmark.seed_of(tmp_path / "other", 6)


@pytest.mark.parametrize("seed, effect", [(1, "film_drag"), (2, "structural_damping")])
def test_one_speed_cannot_tell_drag_from_damping_but_another_can(seed, effect):
    drawn = draw_campaign(seed, "single_speed", [effect], tries=1)
    while "root" in drawn.ingredients[0].form:  # drag with the root of the speed has no twin
        seed += 10
        drawn = draw_campaign(seed, "single_speed", [effect], tries=1)
    p = drawn.plan.runs[0].hidden
    assert separation(drawn, {"surface_speed": p.speed}) < 0.2
    assert separation(drawn, {"surface_speed": 3 * p.speed}) > 5.0

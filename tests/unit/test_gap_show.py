"""The answer shown: JSON, the extended model as a scenario, words, figures, the page."""

import json
import re
import tomllib
from dataclasses import replace

import numpy as np
import pytest
from gap_answers import ADDED, SPEEDS, TRUE, answer
from gap_campaigns import NOISE
from stickslip import simulate

from cosim import read_scenario
from cosim.cli import main
from cosim.gap.show.files import write_page
from cosim.gap.show.model_file import model_text, safe_name, scenario_of, shown_run
from cosim.gap.show.numbers import DIGITS, as_data, as_json
from cosim.gap.show.quantities import quantities
from cosim.gap.show.score_figures import draw_ranking
from cosim.gap.show.words import closing_lines, fitted_quantities, reason

PROMISED = (
    "verdict", "effects", "classes", "where", "ranking", "gap", "next_experiment", "model",
)  # fmt: skip


@pytest.fixture(scope="module")
def gap(tmp_path_factory):
    return answer(tmp_path_factory.mktemp("campaign"))


def test_the_answer_made_by_hand_is_one(gap):
    """What is shown below is a true repair: from far off to the noise, and the true number."""
    assert gap.gap_before[1] > 5.0 and gap.gap_after[1] < 1.2
    assert gap.extended.values[ADDED.key] == pytest.approx(
        TRUE["velocity_weakening"]["linear"], rel=0.05
    )
    assert [run.name for run in gap.plain.runs] == ["run01", "run02", "run03"]


# --- gap.json ---


def test_json_holds_what_is_promised(gap):
    data = json.loads(as_json(gap, "model.toml"))
    assert set(PROMISED) <= set(data)
    assert (data["verdict"], data["effects"]) == ("named", ["velocity_weakening"])
    assert set(data["where"]) == {"channel", "regime", "runs", "text"}
    assert {"effect", "held_out_gap", "delta_bic", "parameters", "intervals"} <= set(
        data["ranking"][0]
    )
    assert set(data["gap"]) == {"before", "after"}
    assert data["gap"]["before"]["held_out"] == pytest.approx(gap.gap_before[1], rel=1e-5)
    assert data["gap"]["after"]["fit"] == pytest.approx(gap.gap_after[0], rel=1e-5)
    assert data["model"] == "model.toml" and data["next_experiment"] is None
    assert data["noise"] == {"x": {"value": NOISE, "estimated": False}}
    assert "a remark" in data["remarks"]


def test_json_has_so_many_digits_no_nan_and_no_place(gap):
    text = as_json(gap, "model.toml")
    assert as_json(gap, "model.toml") == text
    assert str(gap.campaign.path) not in text
    numbers = re.findall(r"\d+\.\d+", text)
    digits = [len(number.replace(".", "").lstrip("0")) for number in numbers]
    assert max(digits) <= DIGITS + 1  # 123457.0
    assert as_data(gap, "")["ranking"][1]["intervals"]["film_drag.coefficient"] == [0.0, None]


# --- model.toml ---


def test_model_holds_the_fitted_numbers(gap, tmp_path):
    (tmp_path / "model.toml").write_text(model_text(gap), encoding="utf-8")
    scenario = read_scenario(tmp_path / "model.toml")
    for key in ("friction.mu_s", "friction.mu_k", ADDED.key):
        block, name = key.split(".")
        assert getattr(getattr(scenario, block), name) == pytest.approx(
            gap.extended.values[key], rel=1e-11
        )
    assert scenario.surface.speed == SPEEDS[-1]  # of the run that was held out
    assert scenario.name == "cold-room-week-3-model"
    assert scenario == scenario_of(gap, shown_run(gap))


def test_model_moves_as_the_fitted_one_did(gap):
    """From the first segment's start to its end, far closer than the noise."""
    run = shown_run(gap)
    trajectory = simulate(scenario_of(gap, run).mechanics, run.track.time[-1], 0.01)
    segment = np.flatnonzero(run.track.segments == 0)
    x = trajectory["x"][segment] + gap.extended.values["offset.x"]
    # the fit integrates to 1e-7 of the motion's scale, the file to 1e-11
    assert np.max(np.abs(x - run.track.x[segment])) < 1e-2 * NOISE


def test_stickslip_simulate_takes_the_model(gap, tmp_path):
    (tmp_path / "model.toml").write_text(model_text(gap), encoding="utf-8")
    assert main(["simulate", str(tmp_path / "model.toml"), "-o", str(tmp_path / "out")]) == 0
    summary = json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))
    assert summary["status"] == "complete"


@pytest.mark.parametrize("verdict", ["none", "unknown"])
def test_model_without_a_name_is_the_plain_one(gap, verdict):
    nothing = replace(
        gap, verdict=verdict, effects=(), extended=None, gap_after=gap.gap_before,
        empirical={"text": "F = -0.3 v"},
    )  # fmt: skip
    text = model_text(nothing)
    tables = tomllib.loads(text)
    assert "velocity_weakening" not in tables
    assert tables["friction"]["mu_s"] == pytest.approx(gap.plain.values["friction.mu_s"])
    assert verdict.capitalize() in text and "empirical formula" in text


def test_model_of_a_slab_turns_about_its_centre(gap):
    rig = gap.campaign.rig.model_copy(update={"surface": "slab", "slab_radius": 0.8})
    extended = replace(gap.extended, settings={"turning_surface.curvature": 1.6})
    slab = replace(gap, campaign=replace(gap.campaign, rig=rig), extended=extended)
    scenario = scenario_of(slab, shown_run(slab))
    assert scenario.rig.slab_radius == pytest.approx(1.0 / 1.6)
    assert scenario.mechanics.flat()["turning_surface.curvature"] == pytest.approx(1.6)


def test_a_surface_that_is_faster_than_it_says_is_so_in_the_model(gap):
    values = {**gap.extended.values, "offset.speed": 0.1}
    faster = replace(gap, extended=replace(gap.extended, values=values))
    scenario = scenario_of(faster, shown_run(faster))
    assert scenario.surface.speed == pytest.approx(1.1 * SPEEDS[-1])
    assert "offset.speed = 0.1" in "\n".join(closing_lines(faster))


def test_a_warm_room_is_left_to_the_default(gap):
    run = shown_run(gap)
    warm = replace(run.track.run, ambient_degC=21.0)
    scenario = scenario_of(gap, replace(run, track=replace(run.track, run=warm)))
    assert scenario.ambient.temperature_degC == -8.0


@pytest.mark.parametrize(
    "name, safe", [("a/b: c", "a-b-c"), ("...", "campaign"), ("x" * 200, "x" * 80)]
)
def test_names_that_files_may_have(name, safe):
    assert safe_name(name) == safe


# --- words ---


def test_closing_lines_say_everything(gap):
    text = "\n".join(closing_lines(replace(gap, next_experiment={"surface_speed": 0.4})))
    assert "Named: velocity_weakening (kinetic friction falls" in text
    assert f"held out {gap.gap_before[1]:.3g} → {gap.gap_after[1]:.3g} noise units" in text
    assert gap.where.text in text
    assert re.search(r"velocity_weakening.linear = 0\.\d+ s/m \(0\.\d+ to 0\.\d+\)", text)
    assert "surface_speed = 0.4 m/s" in text


def test_reasons(gap):
    pair = ("film_drag", "structural_damping")
    members = replace(gap, verdict="class", effects=(*pair, "run_in"), classes=(pair,))
    assert reason(members) == (
        "film_drag or structural_damping, beside run_in; these data cannot tell which."
    )
    assert "no catalogued effect" in reason(replace(gap, verdict="unknown", effects=()))
    assert "run_in" in reason(replace(gap, verdict="unknown", effects=("run_in",)))
    assert "only noise" in reason(replace(gap, verdict="none", effects=()))


def test_an_interval_that_says_nothing_is_not_shown():
    pairs = {"friction.mu_s": (0.3, 0.3), "friction.mu_k": (0.1, np.inf)}
    shown = quantities({"friction.mu_s": 0.3, "friction.mu_k": 0.2}, pairs)
    assert [one.text for one in shown] == ["friction.mu_s = 0.3", "friction.mu_k = 0.2"]


def test_numbers_are_those_of_the_model_that_is_left(gap):
    assert [one.key for one in fitted_quantities(gap)] == [
        "friction.mu_s", "friction.mu_k", ADDED.key,
    ]  # fmt: skip
    plain = replace(gap, extended=None)
    assert [one.key for one in fitted_quantities(plain)] == ["friction.mu_s", "friction.mu_k"]


# --- figures and page ---


def test_effects_named_together_have_a_bar_of_their_own(gap):
    two = ("velocity_weakening", "film_drag")
    for effects, count in ((two[:1], 2), (two, 3)):
        axis = draw_ranking.__wrapped__(replace(gap, effects=effects)).axes[0]
        assert len(axis.patches) == count
    names = [label.get_text() for label in axis.get_yticklabels()]
    together = axis.patches[names.index("velocity_weakening\nand film_drag")]
    assert together.get_width() == pytest.approx(gap.gap_after[1])


@pytest.mark.parametrize("extended", [True, False])
def test_page_is_whole_by_itself(gap, tmp_path, extended):
    if not extended:
        gap = replace(gap, verdict="unknown", effects=(), extended=None, gap_after=gap.gap_before)
    else:
        gap = replace(gap, next_experiment={"text": "slower", "separates": [["a", "b", 7.25]]})
    drawn = []
    write_page(gap, tmp_path, tmp_path / "report.html", lambda: drawn.append(1))
    html = (tmp_path / "report.html").read_text(encoding="utf-8")
    pictures = sorted(file.stem for file in tmp_path.glob("*.png"))
    assert pictures == sorted(
        ["atlas", "fmu", "gaps", "overlay_x", "parameters", "ranking", "residuals"]
    )
    assert html.count("data:image/png;base64,") == len(pictures) == len(drawn)
    assert "http" not in html and "None" not in html.split("<h2>")[1]
    assert gap.where.text.split(";")[0].replace("'", "&#39;") in html
    assert "velocity_weakening" in html and "film_drag" in html and "a remark" in html
    assert ("7.25" in html) == extended

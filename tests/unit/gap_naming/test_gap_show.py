"""The answer shown: JSON, the extended model as a scenario, words, figures, the page."""

import json
import re
import tomllib
from dataclasses import replace

import numpy as np
import pytest
from gap_answers import ADDED, SPEEDS, TRUE
from gap_campaigns import NOISE
from stickslip import simulate
from stickslip.effects.candidate import FreeParameter

from cosim import read_scenario
from cosim.cli import main
from cosim.gap import read_campaign
from cosim.gap.estimation.intervals import undetermined
from cosim.gap.result import Power
from cosim.gap.show.files import write_corrected_data, write_page
from cosim.gap.show.model_file import model_text, safe_name, scenario_of, shown_run
from cosim.gap.show.numbers import DIGITS, as_data, as_json
from cosim.gap.show.page import page
from cosim.gap.show.quantities import quantities
from cosim.gap.show.score_figures import draw_parameters, draw_ranking
from cosim.gap.show.words import (
    closing_lines,
    fitted_quantities,
    percent,
    powers_lines,
    probability,
    reason,
    spreads_line,
)

PROMISED = (
    "verdict", "effects", "classes", "where", "ranking", "gap", "next_experiment", "model",
)  # fmt: skip


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
    assert data["ranking"][0]["probability"] == 0.9995
    assert data["ranking"][2]["held_out_gap"] is None and not data["ranking"][2]["parameters"]
    assert [step["effects"] for step in data["ladder"]] == [[], ["velocity_weakening"]]
    assert data["share"] == 0.998 and data["spreads"] == {"friction_from_run_to_run": 0.021}
    (curve,) = data["curves"]
    assert (curve["effect"], curve["axis"], curve["unit"]) == (
        "velocity_weakening", "sliding speed", "m/s",
    )  # fmt: skip
    assert len(curve["values"]) == len(curve["mean"]) == len(curve["low"]) == 41


def test_where_nothing_was_held_out_json_says_so(gap):
    def fitted(run):
        return replace(run, track=replace(run.track, run=replace(run.track.run, hold_out=False)))

    plain = replace(gap.plain, runs=tuple(map(fitted, gap.plain.runs)))
    data = as_data(replace(gap, plain=plain), "")
    assert data["gap"]["after"]["held_out"] is None and data["gap"]["after"]["fit"] is not None
    assert {row["held_out_gap"] for row in (*data["ladder"], *data["ranking"])} == {None}


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
    assert reason(replace(gap, verdict="unknown", effects=(), reasons=("springs 9 % off",))) == (
        "the plain model does not fit, and no catalogued effect repairs it; velocity_weakening "
        "would take 99.8 % of the misfit, with springs 9 % off."
    )
    nothing = replace(gap, verdict="none", effects=(), ladder=gap.ladder[:1])
    assert "only noise" in reason(nothing)
    assert reason(replace(nothing, verdict="unknown")) == (
        "the plain model does not fit, and no catalogued effect repairs it."
    )


def test_what_is_partial_says_how_much_and_what_remains(gap):
    one = replace(gap, verdict="partial", effects=("run_in",), share=0.83)
    assert reason(one) == "run_in takes 83 % of the misfit and helps in every run."
    two = replace(
        one, effects=("run_in", "film_drag"), reasons=("friction that scatters by 9 % in a run",)
    )
    assert reason(two) == (
        "run_in and film_drag together take 83 % of the misfit and help in every run; what "
        "remains needs friction that scatters by 9 % in a run."
    )
    assert f"  remains    {gap.remains.text}" in closing_lines(one)


@pytest.mark.parametrize(
    ("quantity", "value", "low", "high", "instead", "said"),
    [
        (
            "mass",
            -1.02,
            -1.15,
            -0.89,
            (),
            "per kilogram: its strength goes with mass^-1 (90 % interval",
        ),
        ("speed", 1.1, 0.9, 1.3, (), "in proportion to speed: "),
        ("mass", 0.5, 0.4, 0.6, ("speed",), "0.4 to 0.6); these runs cannot tell mass from speed"),
    ],
)
def test_scaling_in_words(gap, quantity, value, low, high, instead, said):
    power = Power("run_in", quantity, value, low, high, 1e-3, True, instead)
    (line,) = powers_lines(replace(gap, powers=(power, replace(power, stated=False))))
    assert line.startswith("run_in, ") and said in line


def test_spreads_and_odds_in_words(gap):
    assert spreads_line(gap) == "friction from run to run 2.1 %"
    assert [probability(p) for p in (0.0001, 0.5, 0.9999)] == ["< 0.001", "0.500", "> 0.999"]
    assert [percent(part) for part in (0.831, 0.9994, 1.0)] == ["83.1 %", "99.9 %", "all"]


# --- faults of the measurement ---


@pytest.fixture(scope="module")
def faulty(gap):
    """A camera that is 3 % off, named beside an effect."""
    values = {**gap.extended.values, "measurement.scale": 0.03}
    effects = ("measurement.scale", "velocity_weakening")
    return replace(gap, effects=effects, extended=replace(gap.extended, values=values))


def test_a_fault_is_named_and_not_part_of_the_model(faulty):
    text = model_text(faulty)
    assert "measurement" not in tomllib.loads(text)
    assert "of the camera: measurement.scale" in text
    assert "Named: measurement.scale (the camera's scale is off)" in closing_lines(faulty)[0]


def test_data_freed_of_a_fault_are_left_beside_the_report(faulty, gap, tmp_path):
    assert write_corrected_data(gap, tmp_path) == []
    first, *files = write_corrected_data(faulty, tmp_path)
    assert first == tmp_path / "corrected" / "campaign.toml" and len(files) == len(SPEEDS)
    again, before = read_campaign(first).runs[0].motion.x, gap.campaign.runs[0].motion.x
    assert again == pytest.approx(before / 1.03, abs=1e-9)
    alike = replace(faulty, verdict="class", classes=(("measurement.scale", "run_in"),))
    assert write_corrected_data(alike, tmp_path) == []


# --- a table in the model ---


def test_a_curve_in_the_model_is_a_table_of_the_file(gap):
    speeds, parts = (0.0, 0.1, 0.4), (1.2, 1.0, 0.9)
    settings = {}
    for number, (speed, part) in enumerate(zip(speeds, parts, strict=True), 1):
        settings |= {f"friction.table_speed[{number}]": speed}
        settings |= {f"friction.table_part[{number}]": part}
    values = {key: value for key, value in gap.extended.values.items() if key != ADDED.key}
    extended = replace(gap.extended, values=values, settings=settings)
    laws = (replace(gap.laws[0], effect="", in_model=True),)
    unknown = replace(gap, verdict="unknown", effects=(), extended=extended, laws=laws)
    scenario = scenario_of(unknown, shown_run(unknown))
    mu_k = values["friction.mu_k"]
    assert scenario.friction.table_speed == speeds
    assert scenario.friction.table_mu == pytest.approx([mu_k * part for part in parts])
    assert "in the model as a table" in "\n".join(closing_lines(unknown))
    assert not any("table" in one.key for one in fitted_quantities(unknown))
    begun = scenario_of(unknown, replace(shown_run(unknown), stretch=(0.9, 1.1)), begun=True)
    assert begun.friction.table_mu == pytest.approx([1.1 * mu_k * part for part in parts])
    assert begun.friction.mu_s == pytest.approx(0.9 * values["friction.mu_s"])


def test_an_interval_that_says_nothing_is_not_shown():
    pairs = {"friction.mu_s": (0.3, 0.3), "friction.mu_k": (0.1, np.inf)}
    shown = quantities({"friction.mu_s": 0.3, "friction.mu_k": 0.2}, pairs)
    assert [one.text for one in shown] == ["friction.mu_s = 0.3", "friction.mu_k = 0.2"]


def test_a_number_that_may_be_anything_is_not_shown_as_measured(gap):
    """On the terminal, on the page and in gap.json; what the interval ends at decides."""
    speed = FreeParameter("friction.transition_speed", 1.5e-3, 0.3, 3e-4, 0.05, log=True)
    pairs = {speed.key: (3e-4, 0.05)}
    assert undetermined([speed], pairs) == (speed.key,)
    assert undetermined([speed], {speed.key: (3e-4, 0.04)}) == ()  # known from one side
    assert undetermined([replace(speed, high=np.inf)], pairs) == ()  # no range to fill
    extended = replace(
        gap.extended,
        values={**gap.extended.values, speed.key: 1.5e-3, "offset.loading": 0.03},
        intervals={**gap.extended.intervals, **pairs, "offset.loading": (0.0, 0.4)},
        undetermined=(speed.key,),
    )
    left = replace(gap, extended=extended)
    said = next(line for line in closing_lines(left) if line.startswith("  numbers"))
    assert "friction.transition_speed not determined, anything from 0.0003 to 0.05 m/s" in said
    assert "offset.loading = 0.03 s^0.5 (0 to 0.4), static friction lost to fast loading" in said
    html = page(left, ())
    assert "not determined</td>" in html and "anything from 0.0003 to 0.05" in html
    assert as_data(left, "")["extended"]["undetermined"] == [speed.key]
    drawn = [
        text.get_text() for axis in draw_parameters.__wrapped__(left).axes for text in axis.texts
    ]
    assert drawn == ["not determined"]


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
        [
            *("atlas", "curves", "fmu", "gaps", "ladder", "overlay_x", "parameters", "ranking"),
            "residuals",
        ]
    )
    assert html.count("data:image/png;base64,") == len(pictures) == len(drawn)
    assert "http" not in html and "None" not in html.split("<h2>")[1]
    assert gap.where.text.split(";")[0].replace("'", "&#39;") in html
    assert "velocity_weakening" in html and "film_drag" in html and "a remark" in html
    assert ("7.25" in html) == extended

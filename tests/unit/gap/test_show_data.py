"""The answer as data: gap.json, model.toml, and data freed of a camera's fault."""

import json
import re
import tomllib
from dataclasses import replace
from types import SimpleNamespace

import gap_answers as answers
import numpy as np
import pytest
from gap_campaigns import NOISE
from stickslip import simulate
from stickslip.packing import GRAVITY

from cosim import read_scenario
from cosim.gap import read_campaign
from cosim.gap.data import Track
from cosim.gap.quantities import digits, fitted_quantities, quantity, with_digits
from cosim.gap.result import RigNumber
from cosim.gap.show.files import rig_rows, write_corrected
from cosim.gap.show.model_file import model_text, safe_name, scenario_of, shown_run
from cosim.gap.show.numbers import DIGITS, as_data, as_json
from cosim.gap.show.tracks import residuals, starts
from cosim.gap.windows import camera
from cosim.gap.windows.run_model import LOADING

PROMISED = {
    "verdict", "effects", "classes", "where", "ranking", "gap", "next_experiment", "model",
    "exponents", "curves", "ladder", "scatter", "rig", "rates", "doubts", "remarks",
    "campaign", "sentence", "share",
}  # fmt: skip
OF_RANKING = {
    "effect", "form", "held_out_gap", "fit_gap", "delta_bic", "probability", "parameters",
    "intervals",
}  # fmt: skip


@pytest.mark.parametrize("verdict", answers.VERDICTS)
def test_json_holds_what_is_promised(gap, verdict):
    gap = answers.other(gap, verdict)
    text = as_json(gap, "model.toml")
    data = json.loads(text)
    assert set(data) >= PROMISED and data["verdict"] == verdict
    assert set(data["where"]) == {"channel", "regime", "runs", "text"}
    assert all(set(row) >= OF_RANKING for row in data["ranking"])
    assert data["gap"]["before"] == data["ladder"][0]["gap"]
    assert data["gap"]["after"] == data["ladder"][-1]["gap"]
    assert set(data["ladder"][0]) == {"name", "text", "gap", "weak", "share", "evidence"}
    best, row = gap.ranking[0], data["ranking"][0]
    assert row["delta_bic"] == pytest.approx(2.0 * best.evidence, rel=1e-5)
    for curve in data["curves"]:
        assert len(curve["values"]) == len(curve["mean"]) == len(curve["low"]) == 31
        assert [point["run"] for point in curve["points"]] == ["run01", "run02", "run03"]
    assert str(gap.campaign.path) not in text and as_json(gap, "model.toml") == text
    numbers = re.findall(r"\d+\.\d+", text)
    assert max(len(number.replace(".", "").lstrip("0")) for number in numbers) <= DIGITS + 1


def test_what_was_not_held_out_is_null(gap):
    data = as_data(answers.without_held_out(gap), "")
    scores = [*data["gap"].values(), *(rung["gap"] for rung in data["ladder"])]
    assert all(one["held_out"] is None and one["fit"] > 0.0 for one in scores)
    assert {row["held_out_gap"] for row in data["ranking"]} == {None}


def test_model_moves_as_the_fitted_one_did(gap, tmp_path):
    """Read back and simulated, until the fit sets out anew from the data."""
    (tmp_path / "model.toml").write_text(model_text(gap), encoding="utf-8")
    scenario, run = read_scenario(tmp_path / "model.toml"), shown_run(gap)
    assert run.hold_out and scenario == scenario_of(gap, run)
    fitted = gap.extended.run(run.name)
    end = starts(fitted)[0]
    state = scenario.initial
    assert (state.x, state.vx) == pytest.approx(fitted.states[0, [0, 3]], rel=1e-11)
    x = simulate(scenario.mechanics, run.motion.time[-1], 0.01)["x"][:end]
    off = x + fitted.values["offset.x"] - fitted.track[:end, 0]
    assert end > 20 and np.max(np.abs(off)) < 1e-2 * NOISE


@pytest.mark.parametrize("verdict", answers.VERDICTS)
def test_model_says_what_was_named_and_how_well(gap, verdict):
    gap = answers.other(gap, verdict)
    text = model_text(gap)
    said = " ".join(line.removeprefix("# ") for line in text.splitlines() if line[:1] == "#")
    assert gap.sentence in said and digits(gap.after.held_out) in said
    assert ("velocity_weakening" in tomllib.loads(text)) == bool(gap.effects)
    assert ("velocity_weakening.linear = " in said) == bool(gap.effects)


def with_run(gap, run, **changes):
    """One run of the extended model otherwise."""
    runs = tuple(replace(one, **changes) if one.name == run.name else one
                 for one in gap.extended.runs)  # fmt: skip
    return replace(gap, extended=replace(gap.extended, runs=runs))


def test_a_run_s_own_numbers_are_in_its_model(gap):
    run = shown_run(gap)
    own = {"offset.speed": 0.1, "offset.friction": 0.05, "offset.stiffness": 0.02}
    own["offset.loading"] = 0.0  # takes of mu_s by the run's own stiffness
    values = gap.extended.run(run.name).values | own
    scenario = scenario_of(with_run(gap, run, values=values), run)
    assert scenario.surface.speed == pytest.approx(1.1 * run.surface_speed)
    mu_s = gap.extended.run(run.name).values["friction.mu_s"]
    assert scenario.friction.mu_s == pytest.approx(mu_s * np.exp(0.05))
    assert scenario.springs.stiffness == pytest.approx(run.stiffness * np.exp(0.02))


def test_residuals_stand_at_their_samples(gap):
    run = shown_run(gap)
    fitted = gap.extended.run(run.name)
    left = residuals(run, fitted, "x")
    expected = (fitted.track[:, 0] - run.motion.x) / NOISE
    there = np.isfinite(left)
    assert left[there] == pytest.approx(expected[there], abs=1e-6)
    assert there[fitted.begin :].mean() > 0.98  # but for crests that graze the surface's speed
    assert fitted.begin > 0 and np.isnan(left[: fitted.begin]).all()
    assert np.isnan(residuals(run, fitted, "y")).all()


def test_a_block_that_rides_on_the_surface_does_so_in_the_model(gap):
    """Where a window begins in a stick its velocity is that of the surface."""
    run = shown_run(gap)
    fitted = gap.extended.run(run.name)
    states = fitted.states.copy()
    states[0, 3] = np.nan
    scenario = scenario_of(with_run(gap, run, states=states), run)
    assert scenario.initial.vx == scenario.surface.speed != 0.0


# --- measurement faults ---


def test_a_fault_is_undone_in_the_data():
    """Its inverse, exactly, of a picture that was scaled, turned, shifted and badly timed."""
    rng, n = np.random.default_rng(0), 50
    time, x, y = np.linspace(0.0, 5.0, n), *rng.standard_normal((2, n))
    numbers = {"scale": 0.03, "clock": -0.01, "rotation": 0.2, "drift": 0.01, "drift_course": 2.0}
    numbers["drift_y"] = -0.02
    c, s = np.cos(0.2), np.sin(0.2)
    seen_x = 1.03 * (c * x + s * y) + 0.01 * np.sqrt(time / 5.0)
    seen_y = 1.03 * (c * y - s * x) - 0.02 * np.sqrt(time / 5.0)
    values = {f"measurement.{name}": value for name, value in numbers.items()}
    written = camera.seen(np.column_stack([x, y, 0.0 * x]), time, values)
    np.testing.assert_allclose(written, np.column_stack([seen_x, seen_y, 0.0 * x]), atol=1e-12)
    freed = camera.undone(Track(time=0.99 * time, x=seen_x, y=seen_y), values)
    for found, truth in ((freed.time, time), (freed.x, x), (freed.y, y)):
        assert found == pytest.approx(truth, abs=1e-12)


def test_corrected_data_are_a_campaign(gap, tmp_path):
    assert write_corrected(gap, tmp_path) == []
    scaled = answers.with_a_fault(gap, scale=0.02)
    files = write_corrected(scaled, tmp_path)
    freed = read_campaign(files[0])
    for before, after in zip(gap.campaign.runs, freed.runs, strict=True):
        assert after.motion.x == pytest.approx(before.motion.x / 1.02, abs=1e-12)
        assert (after.mass, after.hold_out) == (before.mass, before.hold_out)
    text = model_text(scaled)
    assert "not part of the model: measurement.scale" in text
    assert "measurement" not in tomllib.loads(text)
    assert write_corrected(answers.with_a_fault(gap, smoothing=0.01), tmp_path) == []


@pytest.mark.parametrize(("sooner", "says"), [(0.02, "falls"), (-0.02, "rises"), (0.0, "")])
def test_a_contact_that_lets_go_sooner_holds_less_on_a_faster_surface(gap, sooner, says):
    """Of which a scenario has one coefficient: that of the run's own speed."""
    run = shown_run(gap)
    values = {**gap.extended.run(run.name).values, LOADING: sooner}
    said = model_text(with_run(gap, run, values=values)).replace("\n# ", " ")
    less = 0.1 * abs(sooner) * run.total_stiffness / (run.mass * GRAVITY)
    line = f"for each 0.1 m/s that the surface is faster it {says} by {less:.2g}"
    assert (line in said) == bool(says)


# --- numbers in words ---


def test_nothing_is_said_to_be_determined_that_is_not(gap):
    key, sd = answers.ADDED.key, gap.extended.sd
    extended = replace(gap.extended, at_bound={"friction.mu_s": 2.0}, sd=sd | {key: 2.0})
    by_key = {one.key: one for one in fitted_quantities(replace(gap, extended=extended))}
    assert by_key["friction.mu_s"].text == "friction.mu_s at its bound"
    assert by_key[key].text == f"{key} not determined" and not by_key[key].interval
    assert as_data(replace(gap, extended=extended), "")["extended"]["undetermined"] == [key]


def test_numbers_have_the_digits_that_they_deserve():
    assert with_digits(0.06012, 0.0541, 0.0659) == ["0.0601", "0.0541", "0.0659"]
    assert with_digits(1234.6, 1200.0, 1300.0) == ["1235", "1200", "1300"]
    assert [digits(one) for one in (11.52, 0.9996, 1234.5, -0.05, None)] == [
        "11.5", "1.00", "1230", "−0.0500", "–",
    ]  # fmt: skip
    zero = quantity("offset.x@run01", 3e-4, (-1e-4, 7e-4))
    assert zero.text == "tracker's zero along x = 0.30 mm (−0.10 to 0.70)"
    assert zero.owner == "run01" and "offset" not in zero.text


def test_names_that_files_may_have():
    names = ("a/b: c", "...", "x" * 200)
    assert list(map(safe_name, names)) == ["a-b-c", "campaign", "x" * 80]


def test_a_number_of_the_rig_at_its_bound_is_no_estimate():
    zero = RigNumber("zero of x, run06", "m", 0.0, 5e-4, -1.5e-3, 1.9e-4, True)
    (row,) = rig_rows(SimpleNamespace(rig=(zero,)))
    assert (row["stated"], row["found"]) == ("0.00 ± 0.50", "at its bound, −1.50")

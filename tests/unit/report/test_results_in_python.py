"""What results do in Python: names shared with the dataset, tables, summaries, files, pages."""

import json

import pytest
import xarray as xr

import cosim
from cosim import read_scenario, simulate_scenario, stability, sweep


@pytest.fixture(scope="module", params=[cosim.run_scenario, simulate_scenario])
def run(request):
    return request.param(read_scenario("reference").changed(run_duration=1.0))


def test_variables_have_the_names_of_the_dataset(run):
    data = run.to_xarray()
    assert set(run) == set(data.variables) and "x" in run and "z" not in run
    for name in ("x", "time", "heat"):
        xr.testing.assert_identical(run[name], data[name])
        xr.testing.assert_identical(getattr(run, name), data[name])
        assert name in dir(run) and name in run._ipython_key_completions_()


def test_a_name_that_is_none_is_told_the_nearest(run):
    with pytest.raises(KeyError, match="nearest: 'sliding_speed'"):
        run["sliding_sped"]
    with pytest.raises(AttributeError, match="has no attribute 'slidingspeed'.*'sliding_speed'"):
        run.slidingspeed  # noqa: B018


def test_a_table_has_the_time_series_alone(run):
    table = run.to_dataframe()
    assert table.index.name == "time" and len(table) == 101
    assert "x" in table and not any("belt_temperature" in name for name in table)
    assert table["x"].to_numpy() == pytest.approx(run["x"].values)


def test_it_shows_itself_in_a_notebook(run):
    html = run._repr_html_()
    assert html.startswith("<p><strong>The block") and html.count("<tr>") <= 4
    assert len(repr(run).splitlines()) == 1


def test_files_and_page_are_those_of_the_command(run, tmp_path):
    folder = run.save(tmp_path / "saved")
    made = {file.name for file in folder.iterdir()}
    assert made >= {"result.nc", "result.csv", "summary.json", "report.html"}
    numbers = json.loads((folder / "summary.json").read_text("utf-8"))
    assert numbers["rows"] == run.summary()["rows"] == 101
    page = run.report(tmp_path / "page.html").read_text("utf-8")
    assert "result.nc" not in page  # which is not beside it
    assert "result.nc" in (folder / "report.html").read_text("utf-8")


def test_a_scenario_is_looked_at_in_twenty_lines():
    scenario = read_scenario("meltwater")
    shown = repr(scenario)
    assert shown.startswith("<Scenario meltwater") and len(shown.splitlines()) <= 20
    assert "rig.spring_natural_length = 0.17 m" in shown or "more, see to_toml()" in shown
    assert "<table>" in scenario._repr_html_()
    assert not [name for name in dir(scenario) if name.startswith("model_")]
    assert "rig" in dir(scenario) and "mass" in dir(scenario.rig)
    assert "structural_damping.coefficient = 0.07 N s/m" in repr(read_scenario("reference"))
    with pytest.raises(AttributeError, match=r"Surface\.speed: .*scenario\.changed\("):
        scenario.surface.speed = 0.3


@pytest.mark.parametrize("scenario", ["study", read_scenario("study")])
def test_every_study_takes_a_scenario_by_its_name(scenario):
    assert simulate_scenario(scenario).scenario.name == "study"
    assert stability(scenario).case.name == "study"
    assert cosim.how_long(scenario, samples=0).scenario.startswith('name = "study"')
    swept = sweep(scenario, {"surface.speed": [0.1]}, duration=1.0, jobs=1)
    assert swept.attrs["scenario"].startswith('name = "study"')
    assert len(repr(swept).splitlines()) <= 20
    (point,) = cosim.friction_map(scenario, [0.1], [-8.0], duration=0.5).points
    assert point.speed == pytest.approx(0.1)


def test_keywords_change_a_scenario_as_keys_do():
    scenario = read_scenario("reference")
    by_key = scenario.changed({"surface.speed": 0.2, "run_in.change": 0.1})
    assert scenario.changed(surface_speed=0.2, run_in_change=0.1) == by_key
    nested = scenario.changed(surface={"speed": 0.2}, run_in={"change": 0.1})
    assert nested == by_key and nested.surface.run_up_time == scenario.surface.run_up_time
    for wrong, near in (("speed", "surface.speed"), ("rig_mas", "rig.mass"), ("mas", "rig.mass")):
        with pytest.raises(ValueError, match=f"nearest known: {near}"):
            scenario.changed(**{wrong: 1.0})


def swept(folder):
    return sweep(read_scenario("study").changed(run_duration=1.0), {"rig.mass": [0.6, 0.7]}, jobs=1)


def compared(folder):
    short = read_scenario("study").changed(run_duration=1.0)
    runs = [simulate_scenario(short.changed(rig_mass=mass)) for mass in (0.6, 0.7)]
    return cosim.compare(
        *(cosim.read_result(run.save(folder / f"{i}")) for i, run in enumerate(runs))
    )


def assessed(folder):
    return stability(read_scenario("study").changed(run_duration=20.0))


def reproduced(folder):
    return cosim.reproduce(["C1"])


@pytest.mark.parametrize("made, numbers", [
    (swept, "sweep.nc"),
    (compared, "compare.json"),
    (assessed, "stability.json"),
    (reproduced, "reproduction.json"),
])  # fmt: skip
def test_a_study_has_the_files_and_the_page_of_its_command(made, numbers, tmp_path):
    found = made(tmp_path)
    folder = found.save(tmp_path / "saved")
    assert {numbers, "report.html"} <= {file.name for file in folder.iterdir()}
    page = found.report(tmp_path / "page.html").read_text("utf-8")
    assert page.lstrip().lower().startswith("<!doctype html>")
    told = json.loads(json.dumps(found.summary()))
    if numbers.endswith(".json"):
        assert told == json.loads((folder / numbers).read_text("utf-8"))
    else:
        assert [row["rig.mass"] for row in told["runs"]] == [0.6, 0.7]

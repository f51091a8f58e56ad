"""Sweeps over any key of a scenario, and over scenarios; what the figure and the page say."""

import json

import numpy as np
import pytest
import xarray as xr
from command_line import executed
from stickslip.trajectory import counted_break_aways

from cosim import Scenario, run_scenario
from cosim.cli.studies import sweep as sweep_command
from cosim.fmu.build import ensure_fmu
from cosim.studies.sweep import SweepError, features, product_grid, result, sweep
from cosim.studies.sweep.axis import parse_vary

LAYERS = [
    {"thickness": 1e-3, "density": 2400.0, "heat_capacity": 800.0, "conductivity": 1.5},
    {"thickness": 1e-3, "density": 1200.0, "heat_capacity": 1900.0, "conductivity": 0.2},
]
SHORT = Scenario.from_tables(dict(
    name="short", rig={"degrees_of_freedom": ["x"]}, belt={"layers": LAYERS, "length": 0.4},
    surface={"speed": 0.15, "run_up_time": 0.2}, run={"duration": 1.0, "output_interval": 0.01},
))  # fmt: skip


@pytest.fixture(scope="module")
def coupled():
    """Two belts, coupled: the layers' conductivity is varied inside the list."""
    ensure_fmu("build")
    return sweep(SHORT, {"belt.layers[2].conductivity": [0.2, 5.0]}, jobs=1)


def test_a_coupled_sweep_has_the_numbers_of_its_runs(coupled):
    assert coupled.attrs["coupled"] == 1
    one = SHORT.changed({"belt.layers": [LAYERS[0], LAYERS[1] | {"conductivity": 5.0}]})
    done = run_scenario(one)
    run = done.result
    rise = run["thermal.interface_temperature"][-1] - one.ambient.temperature_degC
    assert coupled["interface_rise"].values[1] == pytest.approx(rise, rel=1e-12)
    assert coupled["interface_rise"].values[0] != coupled["interface_rise"].values[1]
    alone = features(done.to_xarray())
    assert coupled["x_mean"].values[1] == pytest.approx(alone["x_mean"], rel=1e-12)
    starts = counted_break_aways(run.time, run["mechanics.slip_count"])
    starts = starts[starts >= 0.2]
    # one over the mean period, each break-away to half a row
    assert starts.size > 1
    period = np.diff(starts).mean()
    assert coupled["frequency"].values[1] == pytest.approx(1.0 / period, rel=1e-12)


def test_the_unit_of_an_entry_of_a_list_is_told(coupled):
    attributes = coupled["belt.layers[2].conductivity"].attrs
    assert attributes == {"units": "W/(m.K)", "long_name": "thermal conductivity"}


def test_what_does_not_vary_is_told_and_not_drawn(coupled):
    drawn, still = result.shown_features(coupled)
    assert "interface_rise" in drawn and "x_mean" in still and "phi_max" in still
    assert "largest rotation 0 °" in result.still_sentence(coupled, still)
    never = coupled[["frequency"]] * 0.0
    assert result.still_sentence(never, ["frequency"]) == "The same in all runs: no stick-slip."
    assert result.shown_features(coupled, ["x_mean", "heat"]) == (["x_mean", "heat"], [])
    with pytest.raises(SweepError, match="--show: no feature .*'x_men'; nearest: 'x_mean'"):
        result.check_shown(["x_men"], coupled)


def test_scenarios_are_an_axis_of_their_own():
    other = SHORT.changed({"name": "soft", "springs.stiffness": 10.0})
    done = sweep([SHORT, other], {"surface.speed": [0.1, 0.2]}, jobs=1)
    assert dict(done.sizes) == {"scenario": 2, "surface.speed": 2}
    assert list(done["scenario"].values) == ["short", "soft"] and done.attrs["coupled"] == 0
    alone = sweep(other, {"surface.speed": [0.2]}, jobs=1)
    assert done.x_mean.values[1, 1] == alone.x_mean.values[0]
    assert alone.attrs["duration"] == 1.0 and 'name = "soft"' in alone.attrs["scenario"]


def test_scenarios_that_differ_in_heat_are_run_coupled():
    other = SHORT.changed({"name": "long", "belt.length": 1.0})
    assert product_grid([SHORT, other], {}).run.coupled
    assert not product_grid([SHORT, other], {}, coupled=False).run.coupled
    with pytest.raises(SweepError, match="belt.length: does nothing in the mechanics alone"):
        product_grid(SHORT, {"belt.length": [1.0, 2.0]}, coupled=False)
    with pytest.raises(SweepError, match="two scenarios are named short"):
        product_grid([SHORT, SHORT], {})


@pytest.mark.parametrize(("vary", "coupled"), [
    ({"run.duration": [0.5, 1.0]}, False),
    ({"ambient.temperature_degC": [-8.0, -2.0]}, False),
    ({"rig.degrees_of_freedom": [("x",), ("x", "y", "phi")]}, False),
    ({"belt.layers": [LAYERS[:1], LAYERS]}, True),
    ({"contact.conductance": [1e3, 1e4], "rig.mass": [0.5, 1.0]}, True),
    ({"coupling.scheme": ["gauss_seidel", "jacobi"], "ice.height": [0.1]}, True),
])  # fmt: skip
def test_any_key_may_be_varied(vary, coupled):
    grid = product_grid(SHORT, vary)
    assert grid.run.coupled is coupled
    assert len(set(grid.keys())) == len(grid)


@pytest.mark.parametrize(("texts", "line"), [
    (["belt.lenth=1"], "belt.lenth: no such key of a scenario, nearest: belt.length"),
    (["belt.layers[3].conductivity=1"], "the scenario has 2 of belt.layers, counted from 1"),
    (["belt.layers[1].colour=1"], r"belt.layers\[1\].colour: no such key of a scenario"),
    (["belt.layers[1].conductivity=-1"], r"belt.layers\[1\].conductivity: out of range"),
    (["belt.layers=[{thickness=1e-3}]"], r"belt.layers\[1\].density: missing"),
    (["belt.layers=[{thickness=1]"], "is no TOML|is not closed"),
    (["ice.height=true"], "ice.height: not a number"),
    (["run.duration=1e9"], "run.duration"),
    (["belt.length=0.01"], "belt.length"),
    (["coupling.scheme=seidel"], "coupling.scheme: not known"),
])  # fmt: skip
def test_what_cannot_be_is_refused_before_anything_runs(texts, line, monkeypatch):
    def never(*arguments, **options):
        raise AssertionError("nothing is to be run")

    monkeypatch.setattr("cosim.studies.sweep.combination.compute", never)
    with pytest.raises(SweepError, match=line) as refused:
        sweep(SHORT, parse_vary(texts), jobs=1)
    assert "\n" not in str(refused.value)


def test_the_command_leaves_a_page_and_a_table(tmp_path, capsys):
    """A block that never sticks has no frequency: neither a curve at 0 Hz nor a number."""
    file, out = tmp_path / "short.toml", tmp_path / "out"
    file.write_text(SHORT.changed({"run.duration": 3.0}).to_toml())
    asked = [str(file), "--vary", "surface.speed=0.15,5", "--jobs", "1", "-o", str(out), "--json"]
    assert executed(sweep_command, *asked) == 0
    rows = json.loads(capsys.readouterr().out)["runs"]
    assert [row["surface.speed"] for row in rows] == [0.15, 5.0]
    assert rows[1]["frequency"] == 0.0 and rows[1]["slip_time"] is None
    text = (out / "report.html").read_text()
    at = "sticks and slips at surface.speed = 0.15 m/s and slides at surface.speed = 5 m/s."
    assert f"<h1>The block {at}</h1>" in text
    places = [text.index(each) for each in ("<h1>", 'class="tiles"', "<figure", "<h2")]
    assert places == sorted(places)
    assert 'class="warning"' not in text
    assert text.count("<img") == 1 and 'src="data:image/png' in text
    assert len((out / "sweep.csv").read_text().splitlines()) == 3
    with xr.open_dataset(out / "sweep.nc") as done:
        assert result.records(done.load())[0]["surface.speed"] == 0.15
        assert np.all(done["status"].values == 0)


def run_row(mass, frequency, share=0.9, status="complete"):
    return {"rig.mass": mass, "frequency": frequency, "slip_share": share, "status": status,
            "x_std": 1e-3 * mass}  # fmt: skip


@pytest.mark.parametrize(
    ("rows", "told"),
    [
        ([run_row(1, 2.0), run_row(2, 1.5)], "sticks and slips in all 2 runs."),
        ([run_row(1, 2.0), run_row(2, 0.0, 1.0), run_row(3, 0.0, 0.0)],
         "sticks and slips at rig.mass = 1 kg, slides at rig.mass = 2 kg and never slips at "
         "rig.mass = 3 kg."),
        ([run_row(1, 0.0, 1.0), run_row(2, 1.5), run_row(3, 0.0, 1.0), run_row(4, 2.0),
          run_row(5, 0.0, 1.0), run_row(6, np.nan, np.nan, "failed")],
         "slides in 3 of 5 runs and sticks and slips in 2; 1 failed."),
        ([run_row(1, np.nan, np.nan, "failed")], "None of 1 runs is complete."),
    ],
)  # fmt: skip
def test_the_page_says_first_what_the_block_does_where(rows, told):
    assert result.sentence(rows, {"rig.mass": " kg"}).removeprefix("The block ") == told
    assert len(result.tiles(rows, {"rig.mass": " kg"})) <= 4

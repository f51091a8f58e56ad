"""The page of a system's run: what it says first, what it draws and what it leaves out."""

import json

import numpy as np
import pytest
from lag_unit import lag_unit

from cosim.cli import main
from cosim.report.columns import Column, Columns
from cosim.systems.show.figures import signals
from cosim.systems.show.page import ways

TIME = np.linspace(0.0, 1.0, 11)
PAIR = """
connections = [{{ from = "other.y", to = "rig.u" }}]
coupling.macro_step = 0.1
run.stop = 1.0
units.rig = {{ file = "rig.fmu", parameters = {{ "part.gain" = {gain} }} }}
units.other = {{ file = "other.fmu", parameters.y = 1.0 }}
"""


def output(values, unit="m", nominal=1.0, participant="a", name="a.x"):
    attributes = {"units": unit, "nominal": nominal, "participant": participant}
    attributes |= {"causality": "output", "long_name": name}
    return Column(("time",), np.asarray(values, float), attributes)


def over_time(**outputs):
    named = {f"a.{name}": column for name, column in outputs.items()}
    return Columns(named, {"time": Column(("time",), TIME, {"units": "s"})})


def labels(described):
    return [panel.label for panel in described.panels]


def test_rounding_is_not_drawn_and_said_to_be_left_out():
    columns = over_time(
        x=output(0.02 * TIME), y=output(1e-17 * np.sin(9.0 * TIME)), residual=output(1e-14 * TIME),
        turn=output(1e-15 * TIME, "rad", nominal=0.1), small=output(1e-9 * TIME, "rad"),
        still=output(np.full(11, 3.0), "1"),
    )  # fmt: skip
    drawn = signals(columns)
    assert labels(drawn) == ["a.x [mm]", "a.small [nrad]"]
    assert drawn.note == (
        "Not drawn, as they do not change: a.still 3. "
        "Not drawn, as they are 0 but for rounding: a.y, a.residual, a.turn."
    )


def test_where_there_is_nothing_but_rounding_it_is_drawn_as_nothing():
    (panel,) = signals(over_time(y=output(1e-17 * TIME))).panels
    assert panel.label == "a.y [m]"


def test_the_first_figure_has_four_and_every_panel_names_quantity_and_unit():
    columns = over_time(**{f"p{k}": output((k + 1) * TIME, "N") for k in range(6)})
    assert labels(signals(columns)) == [f"a.p{k} [N]" for k in range(4)]
    assert labels(signals(columns, more=True)) == ["a.p4 [N]", "a.p5 [N]"]


@pytest.fixture
def pair(tmp_path):
    """Runs two units, of which the first can have a port by which it says that it left its rig."""

    def run(port="y", unit="", gain=1.0):
        lag_unit(tmp_path / "rig.fmu", unit, y=port)
        lag_unit(tmp_path / "other.fmu", unit, unit)
        (tmp_path / "pair.toml").write_text(PAIR.format(gain=gain))
        folder = tmp_path / "out"
        assert main(["couple", str(tmp_path / "pair.toml"), "-o", str(folder), "--force"]) == 0
        page = (folder / "report.html").read_text(encoding="utf-8")
        return json.loads((folder / "summary.json").read_text()), page

    return run


@pytest.mark.parametrize("port, says", [
    ("off_belt", "the block has left the belt"),
    ("spring_overstretched", "a spring is longer than it can be"),
])  # fmt: skip
def test_a_run_that_left_its_rig_is_not_simply_complete(pair, port, says):
    numbers, page = pair(port)
    (found,) = numbers["beyond_rig"]
    assert (found["unit"], found["output"]) == ("rig", port) and found["since"] > 0.0
    heading = page[page.index("<main") : page.index("</h1>")]
    assert "complete, but left the rig" in heading and says in heading
    numbers, page = pair(port, gain=0.0)
    assert numbers["beyond_rig"] == [] and "left the rig" not in page


def test_a_sentence_a_picture_and_four_figures_come_first(pair):
    numbers, page = pair()
    end = numbers["outputs"]["rig.y"]["end"]
    assert f"<h1>In 1 s rig.y goes from 0 to {end:.3g} and rig.taken" in page
    places = [page.index(each) for each in ("<h1>", "<figure", 'class="tiles"', "<h2")]
    assert places == sorted(places)
    assert "2 coupled units ran for 1 s in 10 steps." in page
    tiles = page[places[2] : page.index('<p class="soft">From')]
    assert tiles.count("<b>") == 4


@pytest.mark.parametrize("unit, start, end, low, high, way", [
    ("m", 0.0, 0.0094, -1.295e-5, 0.03148, "is between 0 and 31.5 mm"),
    ("degC", -8.0, -7.937321, -8.0, -7.937321, "goes from −8 to −7.9373 °C"),
    ("1", 0.0, 24123.4, 0.0, 24123.4, "goes from 0 to 24100"),
])  # fmt: skip
def test_the_headline_has_digits_by_the_range_and_readable_units(unit, start, end, low, high, way):
    output = {"start": start, "end": end, "lowest": low, "highest": high, "unit": unit}
    numbers = {"outputs": {"a.x": output | {"rounding": False}}, "connections": []}
    assert ways(numbers) == [f"a.x {way}"]

"""[block]: of any material, at any temperature; [ice] is one of ice."""

import json
import math

import pytest
from refusals import one_line

from cosim.report.contents import tables_of
from cosim.report.material import live_of_material, of_material, page_of_material
from cosim.scenario import Scenario, ScenarioError, read_scenario
from cosim.studies.belt_length import how_long, scenario_case
from thermal.materials import MATERIALS
from thermal.model import BeltIceModel
from thermal.work import seconds_to_run

WARM = {"ambient.temperature_degC": 20.0, "block.material": "steel"}
PEEK = {
    "block.material": "PEEK", "block.density": 1300.0, "block.heat_capacity": 1340.0,
    "block.conductivity": 0.25,
}  # fmt: skip


@pytest.fixture(scope="module")
def steel():
    return read_scenario("reference", WARM)


def test_a_material_brings_its_numbers(steel):
    block = steel.thermal.ice
    assert (block.conductivity, block.density) == (60.5, MATERIALS["steel"].density)
    assert block.height == 0.1, "the shape is that of the file's [ice]"
    assert steel.changed({"block.material": "rubber"}).ice.conductivity == 0.16
    own = read_scenario("reference", PEEK)
    assert own.thermal.ice.conductivity == 0.25 and own.thermal.ice.material == "PEEK"


def test_a_scenario_with_a_block_is_written_and_read_again(steel):
    tables = steel.to_tables()
    assert "ice" not in tables and tables["block"]["material"] == "steel"
    assert Scenario.from_tables(tables) == steel
    assert [name for name in tables_of(steel) if name in ("ice", "block")] == ["ice"]
    assert "block" not in read_scenario("reference").to_tables()


def test_only_ice_melts(steel):
    """In 20 degC a face of ice would be above its melting point at once."""
    model = BeltIceModel(steel.thermal)
    for _ in range(5):
        model.step(0.1, 2.0, 0.015)
    found = model.outputs()
    assert found["melted_mass"] == found["meltwater_heat"] == 0.0
    assert found["interface_temperature"] > 20.0
    assert abs(found["heat_residual"]) < 1e-12 * found["heat_received"]  # rounding of 10 J
    assert math.isfinite(seconds_to_run(steel.thermal, 30.0, 0.01, 0.15, 0.2))


@pytest.mark.parametrize(("changes", "says"), [
    ({"ambient.temperature_degC": 20.0}, "ambient.temperature_degC: 20.0: ice melts in air of 0"),
    ({"block.height": 0.1}, "ice.height: and the table [block] are both given"),
    ({"block.conductivity": 0.2}, "block.material: is missing, needed is ice, steel"),
    ({"block.material": "PEEK"}, "so density is to be given"),
    (WARM | {"ice.conductivity": 2.0}, "ice.conductivity: and the table [block] are both given"),
])  # fmt: skip
def test_what_cannot_be_is_refused_in_one_line(changes, says):
    assert says in one_line(ScenarioError, read_scenario, "reference", changes)


def test_belt_length_answers_for_a_block_of_steel(steel):
    answer = how_long(steel, samples=0)
    assert answer.run.rise < 0.3 * how_long(read_scenario("reference"), samples=0).run.rise
    (known,) = (one for one in scenario_case(steel).ranges if one.key == "ice_conductivity")
    assert known.basis.startswith("block.material of the scenario")


def test_the_words_follow_the_material():
    said = "A {0} block: face of the {0}"
    assert of_material("An ice block: face of the ice", "steel") == said.format("steel")
    assert of_material("an ice block", "oak") == "an oak block"
    assert of_material("ice.height, ice_face", "steel") == "ice.height, ice_face"
    page = '<p>in the ice</p><code>[ice]</code><img src="data:ab/ice/cd"><script>ice</script>'
    assert page_of_material(page, "steel") == page.replace("the ice", "the steel")
    assert page_of_material(page, "ice") == page
    live = {"title": "ice and belt", "data": "A/ice/" * 100, "at": [1.0]}
    told = live | {"title": "steel and belt"}
    assert json.dumps(live_of_material(live, "steel")) == json.dumps(told)

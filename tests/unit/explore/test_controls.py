"""Sliders of the explorer: every key has one, where its declaration says it makes sense."""

import math

import pytest
from stickslip import EFFECTS, Parameters

from cosim.explore.controls import OF_RUN, RANGES, groups
from cosim.explore.explorer import page_data, preset
from cosim.scenario import Scenario, read_scenario

CONTROLS = {each["key"]: each for group in groups() for each in group["controls"]}


def test_every_key_of_the_mechanics_has_a_control():
    keys = {
        f"{table}.{name}"
        for table, field in Parameters.model_fields.items()
        for name in field.annotation.model_fields
    }
    assert CONTROLS.keys() == keys - {"friction.table"} | set(OF_RUN)


@pytest.mark.parametrize("key", [key for key, each in CONTROLS.items() if each["slider"]])
def test_a_slider_stays_within_the_bounds_and_holds_the_default(key):
    control = CONTROLS[key]
    slider, bounds = control["slider"], control["bounds"]
    low, high = slider["low"], slider["high"]
    assert math.isfinite(low) and math.isfinite(high) and low < high
    assert low >= bounds.get("ge", -math.inf) and high <= bounds.get("le", math.inf)
    assert low > bounds.get("gt", -math.inf)
    assert low > 0.0 or not slider["log"]
    if isinstance(control["default"], float):
        assert low <= control["default"] <= high or (slider["zero"] and control["default"] == 0.0)


@pytest.mark.parametrize("effect", EFFECTS, ids=lambda effect: effect.id)
def test_an_effect_can_be_turned_off_and_over_its_typical_range(effect):
    for name in effect.switch:
        control = CONTROLS[f"{effect.id}.{name}"]
        slider, off = control["slider"], control["default"]
        assert control["switch"]
        assert slider["zero"] or slider["low"] <= off <= slider["high"]
        typical = effect.table.model_fields[name].json_schema_extra["typical"]
        assert slider["low"] <= typical[0] and typical[1] <= slider["high"]


def test_the_air_can_be_warmer_than_ice():
    slider = CONTROLS["ambient.temperature_degC"]["slider"]
    assert slider["low"] <= -16.0 and slider["high"] >= 25.0


def test_ranges_are_of_keys_that_there_are():
    assert RANGES.keys() <= CONTROLS.keys()


@pytest.mark.parametrize("name", ["reference", "slab", "meltwater"])
def test_a_preset_is_the_whole_scenario(name):
    """What departs from the plain model, with the plain model's rest, is what was read."""
    scenario = read_scenario(name)
    told = preset(scenario)
    back = Scenario.from_tables({**told["top"], **told["tables"]})
    assert back.model_dump() == scenario.model_dump()


def test_a_scenario_that_is_asked_for_comes_first():
    mine = read_scenario("reference").changed({"name": "mine", "rig.mass": 1.0})
    data = page_data(mine)
    assert data["presets"][data["chosen"]]["name"] == "mine"
    assert [each["name"] for each in data["presets"]] == ["mine", "reference", "study", "slab"]
    assert page_data(read_scenario("slab"))["chosen"] == 2

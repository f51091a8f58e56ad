"""Layers of the belt in a scenario: tables of a list, on a belt and on a slab."""

import tomllib

import pytest

from cosim.scenario import Scenario
from cosim.scenario.validation import ScenarioError

LAYERS = """
[[belt.layers]]
thickness = 3e-4
density = 2600.0
heat_capacity = 780.0
conductivity = 2.0
[[belt.layers]]
thickness = 7e-4
density = 500.0
heat_capacity = 1300.0
conductivity = 0.12
"""


def read(text):
    return Scenario.from_tables(tomllib.loads(text))


@pytest.mark.parametrize("rig", ["", '[rig]\nsurface = "slab"\nslab_radius = 0.5\n'])
def test_layers_reach_the_thermal_model_and_come_back(rig):
    case = read(rig + LAYERS)
    assert [layer.conductivity for layer in case.thermal.belt.stack] == [2.0, 0.12]
    again = read(case.to_toml())
    assert again.thermal == case.thermal and again.to_toml() == case.to_toml()


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        (
            "conductivity = 0.12",
            "conductivty = 0.12",
            "belt.layers[2].conductivity: missing, needed is a number greater than 0",
        ),
        (
            "thickness = 3e-4",
            "thickness = 0.0",
            "belt.layers[1].thickness: out of range (0.0), allowed is a number greater than 0",
        ),
        (
            "[[belt.layers]]",
            "[belt]\nthickness = 2e-3\n[[belt.layers]]",
            "belt.thickness: 0.002 and belt.layers are both given",
        ),
    ],
)
def test_faults_of_layers_are_one_line(old, new, says):
    with pytest.raises(ScenarioError) as refused:
        read(LAYERS.replace(old, new, 1))
    assert says in str(refused.value)
    assert "\n" not in str(refused.value)

import pytest
from refusals import one_line

from thermal import ParameterError, ThermalParameters
from thermal.belt.air import moving_belt


def test_every_number_states_its_unit():
    schema = ThermalParameters.model_json_schema()
    for block in ("Ambient", "Belt", "Layer", "Ice", "Contact"):
        for name, entry in schema["$defs"][block]["properties"].items():
            dimensionless = entry["type"] in ("integer", "array", "string")
            assert "unit" in entry or dimensionless, f"{block}.{name}"


@pytest.mark.parametrize(("blocks", "says"), [
    ({"belt": {"thickness": 0.0}}, "belt.thickness = 0.0: Input should be greater than 0"),
    ({"belt": {"still_air_speed": 50.0}}, "belt.still_air_speed: speed = 50 m/s over a span of"),
    ({"belt": {"rollers": 20}}, "too short for a railing of 0 m and 20 rollers"),
    ({"belt": {"layers": [dict.fromkeys(("thickness", "density", "heat_capacity", "conductivity"),
                     0.1)], "density": 1.0}}, "belt.density = 1 and belt.layers are both given"),
    ({"contact": {"length": 0.5}}, "more than the ice's face"),
    ({"belt": {"length": 0.07}}, "shorter than the contact"),
    ({"belt": {"cell_length": 1e-7}}, "more than 200000 cells"),
    ({"belt": {"conductivity": float("nan")}}, "belt.conductivity = nan"),
    ({"belt": {"lenght": 2.0}}, "belt.lenght is not a parameter: did you mean length?"),
    ({"bellt": {}}, "did you mean belt?"),
    ({"ice": {"latent_heat": "much"}}, "ice.latent_heat = 'much'"),
])  # fmt: skip
def test_bad_input_is_refused_in_one_line(blocks, says):
    assert says in one_line(ParameterError, ThermalParameters.checked, blocks)


def test_air_of_a_moving_belt_takes_the_place_of_the_number():
    belt = ThermalParameters.checked({"belt": {"still_air_speed": 0.82}}).belt
    assert belt.film == moving_belt(0.82, 0.5)
    assert ThermalParameters().belt.film == 15.0

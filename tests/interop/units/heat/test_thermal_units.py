"""BeltIceThermal, whole and reduced: what they say of themselves, and what they compute."""

import re
import zipfile

import fmpy
import numpy as np
import pytest
from fmpy.validation import validate_fmu
from heat_instance import OUTPUTS, H, constant, instance
from stickslip.generation.platforms import this_platform

from cosim import read_scenario, run_scenario
from cosim.fmu.thermal import native_unit, resources
from cosim.fmu.thermal.python_unit import parameters
from cosim.fmu.thermal.variables import ERRORS, REFERENCE, reduced
from thermal import BeltIceModel, ThermalParameters

# --- description ---


def test_inputs_and_outputs(unit):
    description = fmpy.read_model_description(unit)
    inputs, outputs = (
        [each.name for each in description.modelVariables if each.causality == causality]
        for causality in ("input", "output")
    )
    assert inputs == ["heat_flow", "surface_speed", "x", "heat"] and tuple(outputs) == OUTPUTS
    (heat_flow,) = (each for each in description.modelVariables if each.name == "heat_flow")
    assert float(heat_flow.min) == 0.0
    assert {unknown.variable.name for unknown in description.initialUnknowns} == set(OUTPUTS)
    assert not description.coSimulation.canInterpolateInputs


def test_both_units_start_as_the_reference_scenario():
    """Their declarations import no scenario, and the reduced one's no heat model."""
    reference = read_scenario("reference").thermal
    given = ThermalParameters.checked(tables_of(REFERENCE))
    assert given == reference
    starts = resources.starts(resources.reduction(reference))
    declared = [each for each in reduced() if each.causality == "parameter"]
    assert list(starts) == [each.name for each in declared]
    for each in declared:
        assert each.start == pytest.approx(starts[each.name], rel=1e-14), each.name


def tables_of(values):
    tables = {}
    for name, value in values.items():
        table, _, key = name.partition(".")
        tables.setdefault(table, {})[key] = value
    return tables


def test_the_reduced_unit_s_bounds_are_within_the_heat_model_s():
    known = {each.name: each for each in parameters()}
    for each in reduced():
        if each.causality == "parameter":
            model = known[each.name]
            assert each.unit == model.unit
            assert each.min >= model.min and each.max <= model.max
            assert each.above_min or not model.above_min


# --- what they compute ---


def coupled(speed):
    """Outputs of a coupled run's heat model, and what it was given, as inputs of a unit."""
    scenario = read_scenario("reference").changed({"surface.speed": speed})
    result = run_scenario(scenario).result
    assert result.status == "complete"
    x, times = result["mechanics.x"], result.time
    sizes = np.diff(times)
    given = (
        np.diff(result["mechanics.heat"]) / sizes,
        np.diff(result["mechanics.surface_travel"]) / sizes, x[1:], times,
    )  # fmt: skip
    expected = np.stack([of_model(result, name) for name in OUTPUTS], axis=1)
    # still air takes more of a belt that is warmer
    start = {"x": x[0], "belt__air_heat_transfer": scenario.thermal.belt.air_heat_transfer}
    return given, start, expected


def of_model(result, name):
    """An output of the unit, of those of the heat model."""
    parts = {
        "heat_stored": ("belt_heat", "ice_heat", "meltwater_heat"),
        "heat_to_air": ("air_heat", "support_heat"),
    }
    return sum(result[f"thermal.{part}"] for part in parts.get(name, (name,)))


SPEEDS = (0.15, 0.82)


@pytest.fixture(scope="module", params=SPEEDS)
def reference(request):
    return request.param, *coupled(request.param)


def test_the_whole_model_s_unit_computes_what_the_coupled_case_does(whole, reference, tmp_path):
    """Step by step, of which a third shows it."""
    _, (flow, speed, x, times), start, expected = reference
    n = len(flow) // 3
    given = flow[:n], speed[:n], x[:n], times[: n + 1]
    with instance(whole, tmp_path / "unit") as heat:
        found = heat.start(**start).run(*given)
    np.testing.assert_allclose(found, expected[: n + 1], rtol=0, atol=1e-11)


def test_the_documentation_explains_what_is_fixed(native):
    """By key, value, unit and meaning; nothing that a reduced belt has none of."""
    with zipfile.ZipFile(native) as archive:
        page = archive.read("documentation/index.html").decode()
    table = page[page.index("What is fixed") : page.index("<h2>Inputs")]
    rows = re.findall(r"<tr><td><code>(.*?)</code></td>" + r"<td.*?>(.*?)</td>" * 3, table)
    assert {"belt.length", "ice.height", "contact.radius"} <= {row[0] for row in rows}
    assert all(value and meaning for _, value, _, meaning in rows)
    assert not any("rail" in row[0] or "roller" in row[0] for row in rows)


def test_the_reduced_unit_is_as_near_as_its_documentation_says(native, reference, tmp_path):
    speed, given, start, expected = reference
    with instance(native, tmp_path / "unit") as heat:
        error = np.abs(heat.start(**start).run(*given) - expected).max(axis=0)
    place = SPEEDS.index(speed)
    said = {name: float(errors[place].split()[0]) for name, errors in ERRORS.items()}
    assert len(said) == 7 and not expected[:, 5:7].any()
    for name, found in zip(OUTPUTS, error, strict=True):
        assert said.get(name, 0.0) / 3.0 <= found <= said.get(name, 1e-13), name


FREE = [
    {"ice__air_heat_transfer": 300.0},
    {"belt__air_heat_transfer": 30.0},
    {"contact__conductance": 300.0, "contact__belt_side": 1.0},
    {"ambient__temperature_degC": -16.0, "belt__air_heat_transfer": 0.0},
]


@pytest.mark.parametrize("values", FREE)
def test_the_reduced_unit_s_parameters_are_free(native, whole, values, tmp_path):
    """Also backwards, stopped, and while the block moves."""
    n = np.arange(1000)
    speed = np.where(n < 400, 0.3, np.where(n < 700, -0.2, 0.0))
    given = (0.5 + 0.3 * np.sin(n / 50), speed, 0.01 * np.sin(n / 30), np.arange(1001) * H)
    rows = []
    for k, fmu in enumerate((native, whole)):
        with instance(fmu, tmp_path / str(k)) as heat:
            # of the speed through still air follows a heat transfer in place of the one given
            more = {"belt__still_air_speed": 0.0} if "belt__air_heat_transfer" in values else {}
            more = more if fmu is whole else {}
            rows.append(heat.start(**values, **more).run(*given))
    rise = np.ptp(rows[1][:, :4], axis=0)
    assert np.all(np.abs(rows[0] - rows[1]).max(axis=0)[:4] <= 2e-4 * rise)


@pytest.mark.parametrize("wiper", [0.0, 0.3])
def test_ice_melts_in_the_reduced_unit_as_in_the_whole_model(native, whole, wiper, tmp_path):
    """On, off, and the film freezes again."""
    n = np.arange(1800)
    flow = np.where(n < 900, 3.0 + 2.0 * np.sin(n / 100), 0.2)
    given = (flow, np.full(1800, 0.3), np.zeros(1800), np.arange(1801) * H)
    rows = []
    for k, fmu in enumerate((native, whole)):
        with instance(fmu, tmp_path / str(k)) as heat:
            heat.start(ambient__temperature_degC=-0.3, contact__wiper=wiper)
            rows.append(heat.run(*given))
    melted = rows[1][:, 6]
    assert melted.max() > 2e-5 and melted[-1] < melted.max()
    np.testing.assert_allclose(rows[0][:, 6], melted, rtol=0, atol=2e-5 * melted.max())
    np.testing.assert_allclose(rows[0][:, :4], rows[1][:, :4], rtol=0, atol=1e-4)


def test_other_belts_and_ice_are_other_matrices(tmp_path):
    """A long layered belt and a flat block, in a unit of their own; a reset leaves it so."""
    layers = [
        {"thickness": 3e-4, "density": 1500.0, "heat_capacity": 900.0, "conductivity": 0.3},
        {"thickness": 2e-3, "density": 900.0, "heat_capacity": 1500.0, "conductivity": 0.2},
    ]
    tables = {
        "ambient": {"temperature_degC": -5.0},
        "belt": {"length": 3.0, "cell_length": 2e-3, "layers": layers},
        "ice": {"height": 0.03, "air_heat_transfer": 0.0},
        "contact": {"radius": 0.06, "conductance": 2e3, "strips": 8},
    }
    parameters = ThermalParameters.checked(tables)
    fmu = native_unit.build_for(parameters, tmp_path / "other.fmu", [this_platform()])
    assert validate_fmu(str(fmu)) == []
    model = BeltIceModel(parameters)
    expected = []
    for _ in range(500):
        model.step(H, 0.02, 0.5 * H)
        expected.append([model.outputs()[name] for name in OUTPUTS[:4]])
    with instance(fmu, tmp_path / "unit") as heat:
        heat.slave.reset()
        found = heat.start().run(*constant(500, 2.0, 0.5))[1:]
    np.testing.assert_allclose(found[:, :4], expected, rtol=0, atol=3e-5)

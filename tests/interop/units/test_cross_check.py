"""What each unit brings along: licences, icon, terminals, and a run that it reproduces, as the FMI
cross-check asks: inputs, times and tolerance, and outputs, computed by the models in Python."""

import zipfile
from importlib.metadata import distribution
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.util import read_csv, read_ref_opt_file
from fmpy.validation import validate_fmu
from lxml import etree

from cosim.fmu.build import FMI3, NATIVE, PYTHON, THERMAL, THERMAL_FMI3, THERMAL_PYTHON

SCHEMA = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd"
HEAT = (THERMAL, THERMAL_FMI3, THERMAL_PYTHON)


@pytest.fixture(scope="module")
def units(fmu, fmu3, python_fmu, once, tmp_path_factory):
    """Name -> file and what is beside its page, of every unit."""
    folder = tmp_path_factory.mktemp("units")
    heat = [once(name) for name in HEAT]
    found = {}
    for unit in (fmu, fmu3, python_fmu, *heat):
        with zipfile.ZipFile(unit) as archive:
            archive.extractall(folder / unit.stem)
        found[unit.name] = (unit, folder / unit.stem / "documentation")
    return found


def run(units, name):
    """Outputs of the run and those to compare with."""
    unit, folder = units[name]
    model = fmpy.read_model_description(unit).modelName
    options = read_ref_opt_file(folder / f"{model}_ref.opt")
    found = fmpy.simulate_fmu(
        str(unit), fmi_type="CoSimulation", input=read_csv(folder / f"{model}_in.csv"),
        start_time=options["StartTime"], stop_time=options["StopTime"],
        output_interval=options["StepSize"], relative_tolerance=options["RelTol"],
    )  # fmt: skip
    expected = read_csv(folder / f"{model}_ref.csv")
    causes = {v.name: v.causality for v in fmpy.read_model_description(unit).modelVariables}
    assert 7 <= len(expected.dtype.names) - 1 <= 10  # as the rules recommend
    assert {causes[each] for each in expected.dtype.names[1:]} == {"output"}
    assert found["time"][-1] == options["StopTime"]
    return found, expected


@pytest.mark.parametrize("name", [NATIVE, FMI3, PYTHON, *HEAT])
def test_every_variable_says_what_it_is(units, name):
    description = fmpy.read_model_description(units[name][0], validate_model_structure=True)
    known = {each.name for each in description.unitDefinitions}
    for variable in description.modelVariables:
        assert variable.description, variable.name
        if variable.type in ("Real", "Float64"):
            assert variable.unit in known, variable.name
        if variable.causality == "parameter":
            tunable = variable.name in ("friction.mu_s", "friction.mu_k")
            assert variable.variability == ("tunable" if tunable else "fixed")
            assert variable.initial == "exact"
            assert variable.start is not None and "." in variable.name
    assert description.coSimulation.canGetAndSetFMUstate
    assert description.coSimulation.canSerializeFMUstate
    if name == PYTHON or name in HEAT:  # for co-simulation alone
        assert description.modelExchange is None
        assert all(unknown.dependencies == [] for unknown in description.outputs)


def test_fmpy_validates_each_and_prints_nothing(units, capfd):
    for name, (unit, _) in units.items():
        assert (validate_fmu(str(unit)), *capfd.readouterr()) == ([], "", ""), name


@pytest.mark.parametrize(
    "name", ["StickSlip3DOF.fmu", "StickSlip3DOF-fmi3.fmu", "StickSlip3DOF-python.fmu"]
)
def test_the_block_moves_as_in_the_reference(units, name):
    """The same arithmetic; fmpy's times differ by rounding, which each of the slips passes on."""
    found, expected = run(units, name)
    np.testing.assert_allclose(found["time"], expected["time"], rtol=0, atol=1e-12)
    for each in expected.dtype.names[1:]:
        size = np.abs(expected[each]).max()
        np.testing.assert_allclose(found[each], expected[each], rtol=0, atol=1e-8 * size)
    assert expected["slip_count"][-1] > 6 and np.ptp(expected["x"]) > 0.01


#: What the reduced unit leaves out, K, 1 and J: of the size that its documentation says.
REDUCED = {"temperature": 2e-6, "belt_share": 2e-5, "melt": 1e-12, "heat": 2e-6}


@pytest.mark.parametrize("name", HEAT)
def test_belt_and_ice_warm_as_in_the_reference(units, name):
    found, expected = run(units, name)
    for each in expected.dtype.names[1:]:
        kind = next(key for key in REDUCED if key in each)
        allowed = 1e-10 if name == THERMAL_PYTHON else REDUCED[kind]  # the same model, told as CSV
        np.testing.assert_allclose(found[each], expected[each], rtol=0, atol=allowed)
    assert np.ptp(expected["interface_temperature"]) > 0.05


# --- what is in it ---


@pytest.fixture(params=[NATIVE, FMI3, PYTHON, *HEAT])
def archive(request, units):
    """A unit, opened."""
    with zipfile.ZipFile(units[request.param][0]) as opened:
        yield opened


def facts(archive):
    """Version of FMI, name, and whether it is made with pythonfmu."""
    root = etree.fromstring(archive.read("modelDescription.xml"))
    tool = root.get("generationTool")
    return root.get("fmiVersion"), root.get("modelName"), "pythonfmu" in tool


def test_its_licences_are_in_it(archive):
    own = archive.read("documentation/licenses/license.txt").decode()
    assert own.startswith("BSD 3-Clause License") and "Redistribution" in own
    is_python = facts(archive)[2]
    names = {name for name in archive.namelist() if "/licenses/" in name}
    assert len(names) == 1 + is_python
    if is_python:
        said = archive.read("documentation/licenses/pythonfmu.txt").decode()
        assert said == distribution("pythonfmu").read_text("licenses/LICENSE")


def test_its_icon_and_terminals_are_where_its_fmi_has_them(archive):
    version, name, _ = facts(archive)
    icon = "model.png" if version == "2.0" else "terminalsAndIcons/icon.png"
    assert archive.read(icon).startswith(b"\x89PNG")
    if version == "2.0":
        return
    assert etree.fromstring(archive.read("terminalsAndIcons/icon.svg")).tag.endswith("}svg")
    root = etree.fromstring(archive.read("terminalsAndIcons/terminalsAndIcons.xml"))
    etree.XMLSchema(etree.parse(SCHEMA)).assertValid(root)
    described = etree.fromstring(archive.read("modelDescription.xml"))
    known = {each.get("name") for each in described.find("ModelVariables")}
    members = {
        terminal.get("name"): {m.get("memberName"): m.get("variableName") for m in terminal}
        for terminal in root.iter("Terminal")
    }
    more = {"motion", "external_load"} if name == "StickSlip3DOF" else set()
    assert members.keys() == {"interface"} | more
    assert {variable for each in members.values() for variable in each.values()} <= known
    assert [*members["interface"]] == ["heat", "surface_speed", "x", "interface_temperature"]

"""BeltIceThermal, whole and reduced: what they say of themselves, and what they compute."""

import os
import re
import struct
import subprocess
import sys
import urllib.parse
import zipfile
from contextlib import contextmanager
from ctypes import POINTER, byref, c_double, c_int, c_size_t, c_uint, c_void_p
from pathlib import Path

import fmpy
import numpy as np
import pytest
from c_library import compiler
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave, fmi2Error
from fmpy.validation import validate_fmu
from native_unit import ERROR, MODEL_EXCHANGE, OF_EXCHANGE, OK, Unit, references

from cosim import read_scenario, run_scenario
from cosim.coupling.fmu.log import FmuLog
from cosim.fmu.build import build_fmu
from cosim.fmu.native import native_folder
from cosim.fmu.platforms import this_platform
from cosim.fmu.thermal import native_unit, resources
from cosim.fmu.thermal.python_unit import parameters
from cosim.fmu.thermal.variables import NAME, REFERENCE, reduced
from thermal import BeltIceModel, ThermalParameters

OUTPUTS = (
    "interface_temperature",
    "belt_entry_temperature",
    "belt_exit_temperature",
    "ice_face_temperature",
    "belt_share",
    "melt_rate",
    "melted_mass",
)
H = 0.01  # s, between communication points
HOST = Path(__file__).with_name("c_host") / "host.c"
SANITIZERS = "-g -O1 -fsanitize=address,undefined -fno-sanitize-recover=all"


@pytest.fixture(scope="module")
def native(tmp_path_factory):
    return build_fmu(tmp_path_factory.mktemp("heat"), native_unit.FMU, [this_platform()])


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    return build_fmu(tmp_path_factory.mktemp("heat_python"), f"{NAME}-python.fmu")


@pytest.fixture(params=["native", "whole"])
def unit(request):
    return request.getfixturevalue(request.param)


class Heat:
    """An instance in fmpy, addressed by names."""

    def __init__(self, description, slave, log):
        self.slave, self.log = slave, log
        self.references = {each.name: each.valueReference for each in description.modelVariables}
        self.whole = {each.name for each in description.modelVariables if each.type == "Integer"}
        self.outputs = [self.references[name] for name in OUTPUTS]

    def set(self, **values):
        for name, value in values.items():
            name = name.replace("__", ".")
            kind = self.slave.setInteger if name in self.whole else self.slave.setReal
            kind([self.references[name]], [value])

    def get(self):
        return np.array(self.slave.getReal(self.outputs))

    def begin(self, **values):
        self.set(**values)
        self.slave.setupExperiment()
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()
        return self

    def run(self, heat_flow, surface_speed, x, times):
        """Outputs (steps + 1, outputs) with inputs (steps,)."""
        rows = [self.get()]
        for n in range(len(times) - 1):
            self.set(heat_flow=heat_flow[n], surface_speed=surface_speed[n], x=x[n])
            self.slave.doStep(times[n], times[n + 1] - times[n])
            rows.append(self.get())
        return np.array(rows)


@contextmanager
def instance(fmu, directory):
    description = fmpy.read_model_description(fmu)
    folder = fmpy.extract(fmu, unzipdir=directory)
    log = FmuLog()
    slave = FMU2Slave(
        guid=description.guid,
        unzipDirectory=str(folder),
        modelIdentifier=description.coSimulation.modelIdentifier,
    )
    slave.instantiate(callbacks=log.callbacks, loggingOn=True)
    try:
        yield Heat(description, slave, log)
    finally:
        slave.freeInstance()
        log.close()


@pytest.fixture
def heat(unit, tmp_path):
    with instance(unit, tmp_path / "unit") as one:
        yield one


def constant(steps, heat_flow=0.3, surface_speed=0.15, x=0.0):
    """Inputs of sliding, and the times."""
    flat = np.ones(steps)
    return heat_flow * flat, surface_speed * flat, x * flat, np.arange(steps + 1) * H


# --- description ---


def test_validation_finds_nothing(unit):
    assert validate_fmu(str(unit)) == []
    command = [sys.executable, "-m", "fmpy", "validate", str(unit)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stderr == "" and "No problems found" in done.stdout


def test_every_variable_says_what_it_is(unit):
    description = fmpy.read_model_description(unit, validate_model_structure=True)
    units = {each.name for each in description.unitDefinitions}
    for variable in description.modelVariables:
        assert variable.description, variable.name
        assert variable.type == "Integer" or variable.unit in units, variable.name
    inputs, outputs = (
        [each.name for each in description.modelVariables if each.causality == causality]
        for causality in ("input", "output")
    )
    assert inputs == ["heat_flow", "surface_speed", "x"] and tuple(outputs) == OUTPUTS
    assert all(unknown.dependencies == [] for unknown in description.outputs)
    assert {unknown.variable.name for unknown in description.initialUnknowns} == set(OUTPUTS)
    assert description.coSimulation.canGetAndSetFMUstate
    assert description.coSimulation.canSerializeFMUstate
    assert not description.coSimulation.canInterpolateInputs
    assert description.modelExchange is None


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
        np.diff(result["mechanics.surface_travel"]) / sizes,
        x[1:],
        times,
    )
    return given, x[0], np.stack([result[f"thermal.{name}"] for name in OUTPUTS], axis=1)


SPEEDS = (0.15, 0.82)


@pytest.fixture(scope="module", params=SPEEDS)
def reference(request):
    return request.param, *coupled(request.param)


def test_the_whole_model_s_unit_computes_what_the_coupled_case_does(whole, reference, tmp_path):
    _, given, x, expected = reference
    with instance(whole, tmp_path / "unit") as heat:
        np.testing.assert_allclose(heat.begin(x=x).run(*given), expected, rtol=0, atol=1e-11)


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
    speed, given, x, expected = reference
    with instance(native, tmp_path / "unit") as heat:
        error = np.abs(heat.begin(x=x).run(*given) - expected).max(axis=0)
    said = {row[0]: float(row[1 + SPEEDS.index(speed)].split()[0]) for row in native_unit.ERRORS}
    assert len(said) == 5 and not expected[:, 5:].any()
    for name, found in zip(OUTPUTS, error, strict=True):
        assert said.get(name, 0.0) / 3.0 <= found <= said.get(name, 0.0), name


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
            rows.append(heat.begin(**values, **more).run(*given))
    rise = np.ptp(rows[1][:, :4], axis=0)
    assert np.all(np.abs(rows[0] - rows[1]).max(axis=0)[:4] <= 2e-4 * rise)


@pytest.mark.parametrize("wiper", [0.0, 0.3])
def test_ice_melts_in_the_reduced_unit_as_in_the_whole_model(native, whole, wiper, tmp_path):
    """On, off, and the film freezes again."""
    n = np.arange(3000)
    flow = np.where(n < 1500, 3.0 + 2.0 * np.sin(n / 100), 0.2)
    given = (flow, np.full(3000, 0.3), np.zeros(3000), np.arange(3001) * H)
    rows = []
    for k, fmu in enumerate((native, whole)):
        with instance(fmu, tmp_path / str(k)) as heat:
            heat.begin(ambient__temperature_degC=-0.3, contact__wiper=wiper)
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
        expected.append([model.outputs()[name] for name in OUTPUTS])
    with instance(fmu, tmp_path / "unit") as heat:
        heat.slave.reset()
        found = heat.begin().run(*constant(500, 2.0, 0.5))[1:]
    np.testing.assert_allclose(found[:, :4], np.array(expected)[:, :4], rtol=0, atol=3e-5)


# --- states ---


def test_a_state_is_all_that_a_continuation_needs(heat):
    """Also as bytes, and in the middle of melting."""
    given = constant(60, 5.0, 0.4)
    heat.begin(ambient__temperature_degC=-0.05)
    heat.run(*given)
    state = heat.slave.getFMUState()
    first = continued(heat)
    saved = heat.slave.serializeFMUState(state)
    heat.slave.setFMUState(state)
    assert np.array_equal(continued(heat), first)
    heat.slave.setFMUState(heat.slave.deserializeFMUState(saved))
    assert np.array_equal(continued(heat), first)
    assert first[-1, 6] > 0.0


def continued(heat):
    rows = []
    for n in range(60, 100):
        heat.slave.doStep(n * H, H)
        rows.append(heat.get())
    return np.array(rows)


def test_a_reset_forgets_the_run(heat):
    given = constant(30)
    first = heat.begin(x=0.02).run(*given)
    heat.slave.reset()
    assert np.array_equal(heat.begin(x=0.02).run(*given), first)


def test_before_the_first_step_the_block_stands_where_the_host_has_put_it(heat):
    """x of the initialisation is where it moves from, not what comes in the first step."""
    heat.begin(x=0.5)
    heat.set(x=0.5 + 0.15 * H, surface_speed=0.15, heat_flow=0.0)
    heat.slave.doStep(0.0, H)
    state = heat.get()
    np.testing.assert_allclose(state[:4], -8.0, atol=1e-12)
    heat.set(x=0.5 + 0.15 * H, heat_flow=1.0)
    heat.slave.doStep(H, H)
    # the belt runs on by 1.5 mm: what was heated is at the exit, not an eighth behind it
    assert heat.get()[0] > -8.0 + 1e-3


# --- refusals ---


def refusal(heat, call, *arguments):
    with pytest.raises(FMICallException) as caught:
        call(*arguments)
    assert caught.value.status == fmi2Error
    return heat.log.take_errors()


def test_what_cannot_be_is_refused_with_a_reason(unit, tmp_path):
    cases = [
        ({"heat_flow": -1.0}, "must not be negative"),
        ({"surface_speed": 2e5}, "1000 loops"),
        ({"heat_flow": 1e12}, "many times over"),
        ({"heat_flow": 1e308}, "many times over"),
    ]
    for k, (values, reason) in enumerate(cases):
        with instance(unit, tmp_path / str(k)) as heat:
            heat.begin()
            state = heat.slave.getFMUState()
            heat.set(**values)
            assert reason in refusal(heat, heat.slave.doStep, 0.0, H)
            heat.slave.setFMUState(state)
            heat.set(heat_flow=0.1, surface_speed=0.1)
            heat.slave.doStep(0.0, H)


def test_parameters_that_contradict_each_other_are_refused(whole, tmp_path):
    with instance(whole, tmp_path / "unit") as heat:
        heat.begin(belt__length=0.07)
        assert "is shorter than the contact" in refusal(heat, heat.slave.doStep, 0.0, H)


def test_the_whole_model_s_unit_says_in_a_line_what_its_host_lacks(whole, tmp_path):
    """A Python that has pythonfmu and not the heat model."""
    with zipfile.ZipFile(whole) as archive:
        door = next(
            archive.read(name).decode()
            for name in archive.namelist()
            if name.startswith("resources/beltice_thermal_")
        )
    program = f"import sys; sys.modules['thermal'] = None; exec({door!r}, {{}})"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert "needs the package `stickslip` in the host's Python" in done.stderr.splitlines()[-1]


# --- the native unit's sources and resources ---


def test_a_wheel_s_libraries_are_made_without_the_heat_model(tmp_path):
    """Where a wheel is made there are pydantic and a compiler; the unit is the same."""
    missing = ("numpy", "scipy", "skfem", "meshio", "jinja2", "fmpy", "pythonfmu", "thermal")
    program = """
import sys
sys.modules.update(dict.fromkeys(sys.argv[1:]))
from cosim.fmu.thermal import native_unit
print(len(native_unit.sources()), native_unit.guid())
"""
    told = [
        subprocess.run(
            [sys.executable, "-P", "-c", program, *blocked],
            check=True,
            capture_output=True,
            text=True,
            cwd=tmp_path,
        ).stdout.split()
        for blocked in (missing, ())
    ]
    assert told[0] == told[1] and int(told[0][0]) > 20


@pytest.fixture(scope="module")
def library(native, tmp_path_factory):
    return Unit(native, tmp_path_factory.mktemp("library"), NAME, reduced(), OF_EXCHANGE)


@pytest.fixture
def folder(native, tmp_path):
    """Resources in a folder with a name that has to be escaped."""
    with zipfile.ZipFile(native) as archive:
        content = archive.read(f"resources/{resources.FILE}")
    place = tmp_path / "räum 1 %20#?[x]"
    place.mkdir()
    (place / resources.FILE).write_bytes(content)
    return place


def locations(folder):
    path = urllib.parse.quote(str(folder))
    lower = "".join(c.lower() if i and path[i - 1 : i] == "%" else c for i, c in enumerate(path))
    bare = str(folder).replace("%", "%25")
    return [
        f"file://{path}",
        f"file:{path}",
        f"FILE://LocalHost{path}",
        f"file://{path}/",
        f"file://{lower}",
        f"file://{bare}",
    ]


@pytest.mark.skipif(sys.platform == "win32", reason="other paths")
def test_every_way_to_write_where_the_resources_are_is_read(library, folder):
    for uri in locations(folder):
        with library.instance(resources=uri.encode()) as heat:
            assert heat.handle, (uri, heat.messages)
            heat.begin()


NOWHERE = [
    (None, "is not given"),
    ("", "does not begin with file:"),
    ("/abs/resources", "does not begin with file:"),
    ("http://host/resources", "does not begin with file:"),
    ("file:resources", "is not absolute"),
    ("file:", "is not absolute"),
    ("file://elsewhere/resources", "another machine"),
    ("file:///a%2", "two hexadecimal digits"),
    ("file:///a%", "two hexadecimal digits"),
    ("file:///a%zz", "two hexadecimal digits"),
    ("file:///a%00b", "zero byte"),
    ("file:///" + "a" * 5000, "too long"),
    ("file:///not/there", "cannot be read"),
]


@pytest.mark.parametrize(("uri", "reason"), NOWHERE)
def test_what_says_no_place_is_refused_with_a_reason(library, uri, reason):
    heat = library.instance(resources=uri and uri.encode())
    assert not heat.handle
    ((status, category, text),) = heat.messages
    assert (status, category) == (ERROR, "logStatusError") and reason in text, text


def damaged(content):
    """Files that are not what they must be, and what is said of them."""
    yield b"", "no file of this unit"
    yield b"PK" + content, "no file of this unit"
    yield content[:-8], "damaged"
    yield content + b"\0", "damaged"
    yield content[:8] + struct.pack(">I", 0x01020304) + content[12:], "another order"
    yield content[:16] + struct.pack("<i", 10**6) + content[20:], "no room for|has room for"
    for place in (20, 48, 64, 70, len(content) // 2, len(content) - 1):
        broken = bytearray(content)
        broken[place] ^= 1
        yield bytes(broken), "damaged|has room for"


def test_damaged_matrices_are_refused(library, folder):
    file = folder / resources.FILE
    for content, reason in list(damaged(file.read_bytes())):
        file.write_bytes(content)
        heat = library.instance(resources=f"file://{urllib.parse.quote(str(folder))}".encode())
        assert not heat.handle
        ((_, _, text),) = heat.messages
        assert any(each in text for each in reason.split("|")), (reason, text)


# --- the native unit in a host without Python ---


@pytest.fixture
def place(folder):
    return f"file://{urllib.parse.quote(str(folder))}".encode()


def test_calls_of_what_it_does_not_offer_are_refused(library, place):
    heat = library.instance(kind=MODEL_EXCHANGE, resources=place)
    assert not heat.handle and "for co-simulation" in heat.messages[0][2]
    function = library.library.fmi2SetRealInputDerivatives
    function.argtypes = (c_void_p, POINTER(c_uint), c_size_t, POINTER(c_int), POINTER(c_double))
    with library.instance(resources=place) as heat:
        heat.begin()
        arguments = (byref(c_uint(0)), 1, byref(c_int(1)), byref(c_double(1.0)))
        assert function(heat.handle, *arguments) == ERROR
        assert "heat_flow is held over a step" in heat.messages[-1][2]


def test_a_state_of_other_bytes_is_refused(library, place):
    with library.instance(resources=place) as heat:
        heat.begin(heat_flow=1.0, surface_speed=0.15)
        heat.march(range(20), H)
        state = heat.save()
        saved = bytearray(heat.as_bytes(state))
        assert heat.call("DoStep", 20 * H, H, 1) == OK
        again = heat.from_bytes(bytes(saved))
        heat.restore(again)
        saved[len(saved) // 2] ^= 1
        reason = heat.reason("DeSerializeFMUstate", bytes(saved), len(saved), byref(c_void_p()))
        assert "damaged" in reason


@pytest.mark.skipif(sys.platform != "linux", reason="the host is written for Linux")
@pytest.mark.skipif(not compiler(), reason="needs a C compiler")
def test_a_host_in_c_finds_no_fault(native, place, tmp_path):
    """Sanitizers over sources and host: two threads of two instances, melting, states."""
    options = [*SANITIZERS.split(), "-std=c99", "-Wall", "-Wextra", "-Werror"]
    with zipfile.ZipFile(native) as archive:
        archive.extractall(tmp_path, [n for n in archive.namelist() if n.startswith("sources/")])
    sources = sorted((tmp_path / "sources").glob("*.c"))
    library = tmp_path / "unit.so"
    compiled([*options, "-fPIC", "-shared", *sources, "-o", library, "-lm"])
    host = tmp_path / "host"
    headers = f"-I{native_folder() / 'headers'}"
    compiled([*SANITIZERS.split(), headers, HOST, "-o", host, "-ldl", "-lpthread"])
    places = references(reduced())
    values = {"heat_flow": 20.0, "surface_speed": 0.5, "ambient.temperature_degC": -0.05}
    guid = native_unit.guid()
    command = [host, library, guid, 300, H, places["melted_mass"], 2, 2]
    command += [f"{places[name]}={value!r}" for name, value in values.items()]
    done = subprocess.run(
        list(map(str, command)),
        capture_output=True,
        text=True,
        env=os.environ | {"RESOURCES": place.decode()},
    )
    assert done.returncode == 0, done.stderr
    melted = {float.fromhex(line) for line in done.stdout.split()}
    assert len(melted) == 1 and melted.pop() > 1e-5


def compiled(arguments):
    command = [*compiler(), *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0 and done.stderr == "", done.stderr

"""The unit for FMI 3.0: the motion of the one for FMI 2.0, and what is FMI 3's alone."""

import ctypes
import random
import shutil
import subprocess
import zipfile
from ctypes import byref, c_double, c_uint
from xml.etree import ElementTree

import fmpy
import numpy as np
import pytest
from c_instance import ERROR, OK, functions
from fmi3_unit import Unit
from stickslip import Parameters, simulate

OUTPUTS = ["x", "y", "mode", "slip_count", "heat", "heat_flow", "friction_force_x"]
PLANE = {"lateral_friction": {"ratio": 1.0}, "initial": {"phi": 0.05, "y": 0.005}}
CASES = {
    "line": {},
    "plane": {**PLANE, "surface": {"speed": 0.05}},
    "bristles": {
        "surface": {"speed": 0.03},
        "initial": {"vx": 0.03},
        "friction": {"transition_speed": 5e-3, "presliding_distance": 1e-4},
    },
    "run-up": {"surface": {"speed": 0.05, "run_up_time": 0.9}},
    "strengthening": {"static_strengthening": {"rate": 0.02}},
}


@pytest.fixture(scope="module")
def unit(fmu3, tmp_path_factory):
    return Unit(fmu3, tmp_path_factory.mktemp("unit"))


def scalars(tables):
    """Start values by FMI 2's names."""
    parameters = Parameters(**tables)
    return {**parameters.flat(), "surface_speed": parameters.surface.speed}


def values(tables):
    """Start values by FMI 3's names: lists for arrays."""
    found = {}
    for name, value in scalars(tables).items():
        array, _, element = name.partition("[")
        if element:
            found.setdefault(array, []).append(value)
        else:
            found[name] = value
    return found


# --- description ---


def test_value_references_are_those_of_fmi_2(fmu, fmu3):
    old = {v.name: v.valueReference for v in fmpy.read_model_description(fmu).modelVariables}
    new = fmpy.read_model_description(fmu3).modelVariables
    added = {"time", *(v.name for v in new if v.name.startswith("event_indicators."))}
    arrays = {v.name: v for v in new if v.dimensions}
    assert {name: int(v.dimensions[0].start) for name, v in arrays.items()} == {
        "rig.attachment_angles_deg": 4,
        "springs.force_curve_extension": 16,
        "springs.force_curve_force": 16,
        "friction.table_speed": 16,
        "friction.table_mu": 96,
        "friction.table_temperature_degC": 6,
    }
    for variable in new:
        name = f"{variable.name}[1]" if variable.name in arrays else variable.name
        assert variable.name in added or variable.valueReference == old[name]
        assert variable.description, variable.name
    assert all(v.valueReference > max(old.values()) for v in new if v.name in added)


def test_the_named_sources_make_the_library(fmu3, tmp_path):
    compiler = next(filter(None, map(shutil.which, ("cc", "gcc", "clang"))), None)
    if compiler is None:
        pytest.skip("needs a C compiler")
    with zipfile.ZipFile(fmu3) as archive:
        archive.extractall(tmp_path)
    sources = tmp_path / "sources"
    assert not [*sources.glob("fmi2*")]
    described = ElementTree.parse(sources / "buildDescription.xml")
    named = [file.get("name") for file in described.iter("SourceFile")]
    assert sorted(named) == sorted(file.name for file in sources.glob("*.c"))
    library = tmp_path / "own.so"
    options = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-O0", "-fPIC", "-shared"]
    done = subprocess.run(
        [compiler, *options, "-o", library, *named, "-lm"],
        cwd=sources,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    ctypes.CDLL(str(library)).fmi3DoStep.restype = ctypes.c_int


def test_every_function_of_the_standard_is_there_and_wants_an_instance(unit):
    found = functions(3)
    assert len(found) == 70
    for name, arguments in found.items():
        nothing = [kind() for kind in arguments]
        assert getattr(unit.library, f"fmi3{name}")(None, *nothing) == ERROR, name
    version = unit.library.fmi3GetVersion
    version.restype = ctypes.c_char_p
    assert version() == b"3.0"


# --- the same motion ---


@pytest.mark.parametrize("case", CASES)
def test_co_simulation_is_that_of_fmi_2_to_the_last_bit(fmu, fmu3, case):
    given = {"stop_time": 3.0, "output_interval": 0.01, "output": OUTPUTS}
    old = fmpy.simulate_fmu(str(fmu), start_values=scalars(CASES[case]), **given)
    new = fmpy.simulate_fmu(str(fmu3), start_values=values(CASES[case]), **given)
    assert old.tobytes() == new.tobytes()


# --- early return ---


def marched(block, steps, size, watch=lambda block: None):
    """Times of events, on the way through so many steps."""
    events = []
    for n in range(steps):
        end = (n + 1) * size
        while block.time < end:
            event, early = block.step(end - block.time)
            assert early is (block.time < end) and (event or not early)
            if event:
                events.append((block.time, block.get("mode")))
                block.handle_event()
        watch(block)
    return events


@pytest.mark.parametrize("case", CASES)
def test_steps_end_at_the_models_own_events(unit, case):
    rows, plain = [], []
    with unit.instance(events=True, early=True) as block, unit.instance() as other:
        block.begin(**values(CASES[case]))
        block.done("EnterStepMode")
        names = ["time", "x", "y", "heat", "mode", "slip_count", "energy_residual"]
        events = marched(block, 128, 0.03125, lambda b: rows.append([*map(b.get, names)]))
        other.begin(**values(CASES[case]))
        for _ in range(128):
            assert other.step(0.03125) == (False, False)
            plain.append([*map(other.get, names)])
    own = simulate(Parameters(**CASES[case]), duration=4.0).events
    assert len(own) >= 3
    assert events == [(time, int(mode)) for time, mode, _ in own]
    assert rows == plain


@pytest.mark.parametrize(("events", "early"), [(False, False), (False, True), (True, False)])
def test_a_host_that_allows_no_early_return_gets_none(unit, events, early):
    with unit.instance(events=events, early=early) as block:
        block.begin()
        if events:
            block.done("EnterStepMode")
        assert block.step(1.0) == (False, False) and block.time == 1.0
        assert block.get("slip_count") > 0


def driven(block, steps, drive):
    """The block after steps of 0.01 s, its inputs set before each call; times of events."""
    events = []
    for n in range(steps):
        end = (n + 1) * 0.01
        while block.time < end:
            for name, value in drive(block.time).items():
                block.set(name, value)
            if block.step(end - block.time)[0]:
                events.append(block.time)
                block.handle_event()
    return events


@pytest.mark.parametrize("seed", range(12))
def test_whatever_the_inputs_do_at_events_the_ledger_stays_closed(unit, seed):
    numbers = random.Random(seed)

    def drive(_):
        return {
            "surface_speed": numbers.uniform(-0.2, 0.2),
            "external_force_x": numbers.uniform(-3.0, 3.0),
            "external_moment": numbers.uniform(-0.1, 0.1),
        }

    with unit.instance(events=True, early=True) as block:
        block.begin(**values(CASES[numbers.choice([*CASES])]))
        block.done("EnterStepMode")
        events = driven(block, 200, drive)
        assert len(events) < 2000
        assert abs(block.get("energy_residual")) < 1e-9
        assert np.all(np.isfinite([block.get("x"), block.get("heat")]))


def test_tunable_parameters_change_in_event_mode(unit):
    with unit.instance(events=True) as block:
        block.begin().set("friction.mu_k", 0.2)
        block.done("EnterStepMode")
        block.step(0.01)
        said = block.reason("SetFloat64", *block._values("friction.mu_k", [0.1])[1])
        assert said == "friction.mu_k cannot be set in step mode: enter event mode"


# --- arrays ---


def test_an_array_is_one_variable(unit):
    speeds, mus = [0.0, 0.1, 0.3, *[0.0] * 13], [0.4, 0.3, 0.2, *[0.0] * 93]
    with unit.instance() as block:
        block.begin(**{"friction.table_speed": speeds, "friction.table_mu": mus})
        assert block.get("friction.table_speed") == speeds
        assert block.get("friction.table_mu") == mus
        # three variables, one of them an array, in one call
        names = ["rig.mass", "rig.attachment_angles_deg", "time"]
        numbers = (c_double * 6)()
        wanted = (c_uint * 3)(*(unit.references[name] for name in names))
        block.done("GetFloat64", wanted, 3, numbers, 6)
        assert numbers[0] == block.get("rig.mass") and numbers[5] == 0.0
        assert numbers[1:5] == block.get("rig.attachment_angles_deg")


# --- rates of outputs ---


def test_derivatives_of_outputs_are_what_differences_come_to(unit):
    names = ["x", "vx", "phi", "heat", "friction_force_x", "spring_force_x", "sliding_speed"]
    names = [name for name in names if name in unit.references]
    count = len(names)
    wanted = (c_uint * count)(*(unit.references[name] for name in names))
    size = 1e-4
    with unit.instance() as block:
        block.begin(**PLANE_VALUES)
        block.step(0.02)  # in slip
        seen = []
        for _ in range(2):
            block.step(size)
            rates = (c_double * count)()
            block.done(
                "GetOutputDerivatives",
                wanted,
                count,
                (ctypes.c_int32 * count)(*[1] * count),
                rates,
                count,
            )
            seen.append(([block.get(name) for name in names], list(rates)))
        assert seen[1][1][0] == block.get("der(x)")
        (first, before), (second, after) = seen
        assert block.get("mode") == 1
        change = (np.array(second) - np.array(first)) / size
        middle = (np.array(before) + np.array(after)) / 2
        np.testing.assert_allclose(middle, change, rtol=2e-4, atol=1e-6)


PLANE_VALUES = {"lateral_friction.ratio": 1.0, "initial.phi": 0.05, "surface_speed": 0.1}


def test_looking_at_indicators_leaves_a_step_as_it_is(unit):
    ends = []
    for looks in (False, True):
        with unit.instance() as block:
            block.begin(**PLANE_VALUES)
            for _ in range(100):
                block.step(0.01)
                if looks:
                    place = unit.references["time"] + 1
                    block.done("GetFloat64", byref(c_uint(place)), 1, (c_double * 1)(), 1)
                    rate = (c_double * 1)()
                    x = byref(c_uint(unit.references["x"]))
                    block.done("GetOutputDerivatives", x, 1, (ctypes.c_int32 * 1)(1), rate, 1)
            ends.append(block.everything())
    assert ends[0] == ends[1]


# --- saved states ---


def test_a_state_is_of_an_instance_of_its_kind(unit):
    kinds = [{}, {"events": True}, {"exchanges": True}]
    for own in kinds:
        with unit.instance(**own) as block:
            state = block.save()
            for kind in kinds:
                with unit.instance(**kind) as other:
                    assert other.call("SetFMUState", state) == (OK if kind == own else ERROR)
            block.forget(state)

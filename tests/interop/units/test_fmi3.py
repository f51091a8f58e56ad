"""The unit for FMI 3.0: the motion of the one for FMI 2.0, and what is FMI 3's alone."""

import ctypes
from ctypes import byref, c_double, c_uint
from xml.etree import ElementTree

import fmpy
import pytest
from c_library import compiled, compiler, unpacked
from c_unit import ERROR, OK, Unit
from plain_start import values
from stickslip import Parameters, simulate

OUTPUTS = ["x", "y", "mode", "slip_count", "heat", "heat_flow", "friction_force_x"]
PLANE = {"lateral_friction": {"ratio": 1.0}, "initial": {"phi": 0.05, "y": 0.005}}
CASES = {
    "line": {},
    "plane": {**PLANE, "surface": {"speed": 0.05}},
    "bristles": {"surface": {"speed": 0.03}, "initial": {"vx": 0.03},
        "friction": {"transition_speed": 5e-3, "presliding_distance": 1e-4}},
    "run-up": {"surface": {"speed": 0.05, "run_up_time": 0.9}},
    "strengthening": {"static_strengthening": {"rate": 0.02}},
}  # fmt: skip


@pytest.fixture(scope="module")
def unit(fmu3, tmp_path_factory):
    return Unit(fmu3, tmp_path_factory.mktemp("unit"))


def arrays(scalars):
    """Start values by FMI 3's names, of those of FMI 2: lists for arrays."""
    found = {}
    for name, value in scalars.items():
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
    sizes = {"rig.attachment_angles_deg": 4, "friction.table_mu": 96}
    sizes |= {"friction.table_speed": 16, "friction.table_temperature_degC": 6}
    sizes |= {"springs.force_curve_extension": 16, "springs.force_curve_force": 16}
    assert {name: int(v.dimensions[0].start) for name, v in arrays.items()} == sizes
    for variable in new:
        name = f"{variable.name}[1]" if variable.name in arrays else variable.name
        assert variable.name in added or variable.valueReference == old[name]
    assert all(v.valueReference > max(old.values()) for v in new if v.name in added)


@pytest.mark.skipif(not compiler(), reason="needs a C compiler")
def test_the_named_sources_make_the_library(fmu3, tmp_path):
    sources = unpacked(fmu3, tmp_path, "sources")
    assert not [*sources.glob("fmi2*")]
    described = ElementTree.parse(sources / "buildDescription.xml")
    named = [file.get("name") for file in described.iter("SourceFile")]
    assert sorted(named) == sorted(file.name for file in sources.glob("*.c"))
    library = tmp_path / "own.so"
    options = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-O0", "-fPIC", "-shared"]
    compiled(*options, "-o", library, *named, "-lm", folder=sources)
    assert ctypes.CDLL(str(library)).fmi3DoStep


# --- the same motion ---


@pytest.mark.parametrize("case", CASES)
def test_co_simulation_is_that_of_fmi_2_to_the_last_bit(fmu, fmu3, case):
    given = {"stop_time": 3.0, "output_interval": 0.01, "output": OUTPUTS}
    starts = values(CASES[case])
    old = fmpy.simulate_fmu(str(fmu), start_values=starts, **given)
    new = fmpy.simulate_fmu(str(fmu3), start_values=arrays(starts), **given)
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
        block.begin(**arrays(values(CASES[case])))
        block.done("EnterStepMode")
        names = ["time", "x", "y", "heat", "mode", "slip_count", "energy_residual"]
        events = marched(block, 128, 0.03125, lambda b: rows.append([*map(b.get, names)]))
        other.begin(**arrays(values(CASES[case])))
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


def test_tunable_parameters_change_in_event_mode(unit):
    with unit.instance(events=True) as block:
        block.begin().set("friction.mu_k", 0.2)
        block.done("EnterStepMode")
        block.step(0.01)
        said = block.reason(*block.set_arguments("friction.mu_k", 0.1))
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

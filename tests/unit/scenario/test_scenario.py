"""Scenarios: what they hold, what one line says of each fault, and the way there and back."""

import math
import warnings

import pytest
from command_line import written
from hypothesis import given
from hypothesis import strategies as st
from refusals import one_line
from stickslip import Parameters
from stickslip.contradictions import COMPUTABLE

from cosim.scenario import Scenario, ScenarioError, packaged_scenarios, read_scenario
from thermal import ThermalParameters


def fault(tmp_path, text):
    """The line that a file gets, without the file."""
    path = written(tmp_path, text)
    line = one_line(ScenarioError, read_scenario, path)
    assert line.startswith(f"{path}: ")
    return line.removeprefix(f"{path}: ")


def test_what_the_reference_leaves_out_or_states_is_the_default():
    """Its comment promises so."""
    plain = Scenario().to_tables()
    plain["name"], plain["lateral_friction"]["ratio"] = "study", 1.0
    plain["surface"]["run_up_time"] = 10.0
    plain["run"]["output_interval"] = Scenario().run.output_interval
    assert read_scenario("study").to_tables() == plain
    reference = read_scenario("reference").to_tables()
    plain["name"], plain["rig"]["spring_natural_length"] = "reference", 0.17
    plain["belt"]["still_air_speed"] = 0.15
    for block in ("structural_damping", "imperfections"):
        plain[block] = reference[block]
    assert reference == plain


def test_every_parameter_of_both_models_has_one_key():
    tables = Scenario().to_tables()
    for model in (Parameters(), ThermalParameters()):
        for block, entries in model.model_dump().items():
            from_block = {"radius", "load"} if block == "contact" else set()
            expected = set(entries) - from_block
            assert set(tables[block]) == expected


@pytest.mark.parametrize("name", packaged_scenarios())
def test_a_packaged_scenario_goes_to_toml_and_back(name, tmp_path):
    case = read_scenario(name)
    again = read_scenario(written(tmp_path, case.to_toml()))
    assert again == case and again.name == name
    assert again.thermal == case.thermal and again.mechanics.flat() == case.mechanics.flat()


@given(
    mass=st.floats(1e-3, 1e3),
    speed=st.floats(-10, 10),
    inertia=st.sampled_from(["disc", "ring"]) | st.floats(1e-9, 1.0),
    angles=st.tuples(*[st.floats(-360, 360)] * 4),
)
def test_any_scenario_comes_back_bit_for_bit(tmp_path_factory, mass, speed, inertia, angles):
    rig = {"rig.mass": mass, "rig.inertia": inertia, "rig.attachment_angles_deg": angles}
    case = Scenario().changed(rig | {"surface.speed": speed})
    path = tmp_path_factory.mktemp("case") / "case.toml"
    path.write_text(case.to_toml(), encoding="utf-8")
    assert read_scenario(path) == case


def test_one_contact_radius_for_both_models(tmp_path):
    case = read_scenario(written(tmp_path, "[rig]\ncontact_radius = 0.03"))
    assert case.thermal.contact.radius == case.mechanics.rig.contact_radius == 0.03
    line = fault(tmp_path, "[contact]\nradius = 0.03")
    assert line == "contact.radius: no such key, the contact's radius is rig.contact_radius"


def test_the_way_round_a_slab_follows_from_its_radius(tmp_path):
    slab = "[rig]\nsurface = 'slab'\nslab_radius = -0.4\n"
    case = read_scenario(written(tmp_path, slab))
    assert case.belt.length == case.thermal.belt.length == 2 * math.pi * 0.4
    assert "belt.length: 1 m cannot be given for a slab" in fault(
        tmp_path, slab + "[belt]\nlength = 1"
    )


def test_name_defaults_to_the_file_s_and_whole_numbers_are_numbers(tmp_path):
    case = read_scenario(written(tmp_path, "[rig]\nmass = 2", "heavy one.toml"))
    assert case.name == "heavy one" and case.rig.mass == 2.0


def test_a_byte_order_mark_is_no_fault(tmp_path):
    assert read_scenario(written(tmp_path, b"\xef\xbb\xbf[rig]\nmass = 2")).rig.mass == 2.0


LAYER = """
[[belt.layers]]
thickness = 3e-4
density = 2600.0
heat_capacity = 780.0
conductivity = 2.0
"""


@pytest.mark.parametrize("rig", ["", '[rig]\nsurface = "slab"\nslab_radius = 0.5\n'])
def test_layers_reach_the_thermal_model_and_come_back(tmp_path, rig):
    case = read_scenario(written(tmp_path, rig + LAYER + LAYER.replace("2.0", "0.12")))
    assert [layer.conductivity for layer in case.thermal.belt.stack] == [2.0, 0.12]
    again = read_scenario(written(tmp_path, case.to_toml()))
    assert again.thermal == case.thermal and again.to_toml() == case.to_toml()


NUMBER = "allowed is a number greater than 0 kg"


@pytest.mark.parametrize("text, line", [
    ("[rig]\nmass = 0", f"rig.mass: out of range (0), {NUMBER}"),
    ("[rig]\nmass = nan", f"rig.mass: not a finite number (nan), {NUMBER}"),
    ("[rig]\nmass = '1'", f'rig.mass: not a number ("1"), {NUMBER}'),
    ("[rig]\nmass = '870 N'", f'kg, such as g or mg ("870 N"), {NUMBER}'),
    ("[rig]\nmass = true", f"rig.mass: not a number (true), {NUMBER}"),
    ("[belt]\nelements = 6.0", "belt.elements: not a whole number (6.0), allowed is a whole"),
    ("[rig]\nmass = 1e308", f"rig.mass: 1e+308: {COMPUTABLE}"),
    ("[rig]\nmass = 5e-324", f"rig.mass: 4.94066e-324: {COMPUTABLE}"),
    ("[friction]\ntable_temperature_degC = [-1e308, 0]",
     "friction.table_temperature_degC: out of range (-1e+308), allowed is a list of a number"
     " at least -273.15 and at most 1000 degC"),
    ("[rig]\nmas = 1", "rig.mas: no such key, nearest known: rig.mass"),
    ("mass = 1", "mass: no such key, nearest known: rig.mass"),
    ("[friction]\nmass = 1", "friction.mass: no such key, nearest known: rig.mass"),
    ("[rgi]\nmass = 1", "rgi: no such key, nearest known: rig"),
    ("rig = 3", "rig: not a table (3), allowed is a table [rig] with mass, inertia"),
    ("[[rig]]\nmass = 1", "rig: not a table ([a table with mass]), allowed is a table [rig]"),
    ("[rig]\ninertia = 'disk'", 'rig.inertia: not possible ("disk"), allowed is "disc" or'),
    ("[rig]\nattachment_angles_deg = [1, 2, 3]", "too few entries ([1, 2, 3]), allowed is"),
    ("[rig]\ndegrees_of_freedom = ['z']", 'not known ("z"), allowed is a list of "x" or'),
    ("[rig]\ndegrees_of_freedom = []", 'rig.degrees_of_freedom: must contain "x"'),
    ("[rig]\nspring_natural_length = 0.5", "rig.spring_natural_length: 0.5 m is more than"),
    ("[rig]\nsurface = 'slab'\n[turning_surface]\ncurvature = 1.0",
     'rig.surface: "slab" already sets turning_surface.curvature'),
    ("[rig]\ncontact_radius = 0.6", "must exceed 2 rig.contact_radius = 1.2 m"),
    ("[friction]\nmu_s = -1\nmu_k = -1\n[x]", "(-1), allowed is a number at least 0 (and 2 mo"),
    (LAYER + LAYER.replace("conductivity", "conductivty"),
     "belt.layers[2].conductivity: missing, needed is a number greater than 0"),
    (LAYER.replace("3e-4", "0.0"),
     "belt.layers[1].thickness: out of range (0.0), allowed is a number greater than 0"),
    ("[belt]\nthickness = 2e-3\n" + LAYER, "belt.thickness: 0.002 and belt.layers are both given"),
    ("[ice]\nmesh = 3", "ice.mesh: not a text (3), allowed is a text"),
    ('[ice]\nmesh = "a.msh"\n[contact]\nlength = 0.05',
     "contact.length: 0.05 m and ice.mesh are both given"),
    ("[run]\nduration = 1e300", "run.output_interval: 0.01 s cuts run.duration = 1e+300 s"),
    ("[coupling]\nmacro_step = 0", "coupling.macro_step: out of range (0), allowed is a num"),
    ("name = '../up'", 'name: not fit for the name of a folder ("../up"), allowed is'),
    ("[rig\nmass = 1", "not TOML: expected ']' at the end of a table declaration (at line 1,"),
    ("a = " + "[" * 5000, "not TOML"),
    ("a = " + "1" * 5000, "not TOML"),
    ("[rig]\nmass = 1" + "0" * 400, "not a number (an integer of over 300 digits)"),
    (b"\xff\xfe", "byte 1 is not UTF-8, allowed is a TOML file in UTF-8"),
])  # fmt: skip
def test_every_fault_is_one_line_with_key_value_and_what_is_allowed(tmp_path, text, line):
    assert line in fault(tmp_path, text)


def test_what_is_no_file_is_said_to_be_none(tmp_path):
    for source, line in [
        (tmp_path, "is a folder"),
        (tmp_path / "nix.toml", "no such file"),
        ("refrence", "did you mean reference?"),
        ("/dev/zero", "is not a file"),
    ]:
        with pytest.raises(ScenarioError, match=line):
            read_scenario(source)


def test_kinetic_above_static_friction_is_allowed_with_a_warning(tmp_path):
    with pytest.warns(UserWarning, match="mu_k = 0.5 exceeds friction.mu_s"):
        case = read_scenario(written(tmp_path, "[friction]\nmu_k = 0.5"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert case.mechanics.friction.mu_k == 0.5


def test_an_output_interval_not_given_gives_way_to_the_macro_step():
    for macro_step, every in ((0.01, 1), (0.005, 2), (0.007, 1), (0.02, 1)):
        assert Scenario().changed({"coupling.macro_step": macro_step}).record_every == every


def test_rows_of_a_coupled_run_fall_on_macro_steps():
    case = Scenario().changed({"run.output_interval": 0.3, "coupling.macro_step": 0.1})
    assert case.record_every == 3
    for interval in (0.25, 0.05):
        with pytest.raises(ScenarioError, match="whole multiple of coupling.macro_step = 0.1 s"):
            assert case.changed({"run.output_interval": interval}).record_every
    with pytest.raises(ScenarioError, match="coupling.macro_step: 1e-12 s cuts run.duration"):
        assert case.changed({"coupling.macro_step": 1e-12}).record_every

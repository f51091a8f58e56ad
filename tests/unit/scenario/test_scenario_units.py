"""Grams and millimetres where a scenario has SI units: one line, and no rig that there is."""

import re

import pytest
from stickslip import Parameters
from stickslip.units import in_unit

from cosim.cli import main
from cosim.scenario import ScenarioError, packaged_scenarios, read_scenario
from cosim.scenario.validation import WORDS, not_in
from cosim.scenario.work import doubted


def said(**numbers):
    tables = {}
    for key, value in numbers.items():
        table, name = key.split("__")
        tables.setdefault(table, {})[name] = value
    return doubted(Parameters.model_validate(tables))


def test_numbers_that_no_rig_has_are_named_with_the_unit_that_they_may_be_in():
    assert said(rig__mass=670.0, rig__spring_length=170.0, surface__speed=-150.0) == (
        "rig.mass = 670 (g?), rig.spring_length = 170 (mm?), surface.speed = -150 (mm/s?): no rig "
        "has that in SI units"
    )
    assert said(rig__spring_length=19.0, rig__spring_natural_length=17.0) == (
        "rig.spring_length = 19 (cm?), rig.spring_natural_length = 17 (cm?): no rig has that in SI "
        "units"
    )
    assert said(rig__contact_radius=4.0).startswith("rig.contact_radius = 4 (cm?)")
    assert "springs.stiffness = 0.02017 (N/mm?)" in said(springs__stiffness=0.02017)


@pytest.mark.parametrize("name", packaged_scenarios())
def test_a_scenario_that_ships_is_not_doubted(name):
    assert doubted(read_scenario(name).mechanics) == ""


def test_a_small_or_large_rig_is_not_doubted():
    assert said(rig__mass=0.002, surface__speed=0.0) == ""
    assert said(rig__mass=95.0, rig__spring_length=3.0, surface__speed=-2.9) == ""
    assert said(surface__speed=5e-7) == ""
    assert said(surface__speed=8.0).startswith("surface.speed = 8 (cm/s?): ")


def test_it_is_said_in_one_line(tmp_path, capsys):
    changes = ("surface.speed=150", "run.duration=0.1", "surface.run_up_time=0")
    settings = [word for change in changes for word in ("--set", change)]
    main(["simulate", "reference", "-q", *settings, "-o", str(tmp_path / "out")])
    (line,) = [line for line in capsys.readouterr().err.splitlines() if "SI units" in line]
    assert line == "warning: surface.speed = 150 (mm/s?): no rig has that in SI units"


@pytest.mark.parametrize(("key", "text", "value"), [
    ("rig.mass", "870 g", 0.87),
    ("surface.speed", "60 mm/s", 0.06),
    ("springs.stiffness", "2 N/mm", 2000.0),
    ("ambient.temperature_degC", "265.15 K", -8.0),
    ("belt.air_heat_transfer", "15 W/(m^2 K)", 15.0),
    ("run.duration", "2 min", 120.0),
])  # fmt: skip
def test_a_number_may_have_its_unit(key, text, value):
    """As pint reads it; in a file, in Python, or behind --set."""
    table, _, name = key.partition(".")
    scenario = read_scenario("reference", {key: text})
    assert getattr(getattr(scenario, table), name) == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize("text", ["870 mm", "870", "heavy", "870 g g", "1 g/", "0.87 furlong"])
def test_a_unit_of_another_kind_is_refused(text):
    wrong = "a number" if text in ("870", "heavy") else "in a unit of kg, such as g or mg"
    with pytest.raises(ScenarioError, match=rf"rig\.mass: not {wrong} .*greater than 0 kg"):
        read_scenario("reference", {"rig.mass": text})


@pytest.mark.parametrize("unit, others", WORDS["read"].items())
def test_units_that_a_refusal_names_are_read(unit, others):
    for other in re.split(", | or ", others):
        assert in_unit(f"300 {other}", unit) is not None
        assert other in not_in(unit)


def test_a_plain_number_has_no_unit():
    with pytest.raises(ScenarioError, match=r'friction\.mu_s: has no unit \("0\.3 N"\), allowed'):
        read_scenario("reference", {"friction.mu_s": "0.3 N"})

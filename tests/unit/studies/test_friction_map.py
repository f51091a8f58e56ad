"""`stickslip friction-map`: slopes and minimum of known curves, what is left, bad input."""

import csv
import json
from dataclasses import replace
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest
from command_line import executed
from stickslip import friction_coefficient

from cosim import read_scenario
from cosim.cli import is_bad_input
from cosim.cli.studies import friction_map as friction_regimes_command
from cosim.studies.friction_map import FrictionMap, friction_map
from cosim.studies.friction_map import map as map_module
from cosim.studies.friction_map.laws import conducted_share, differences, measured_beside, own_point
from cosim.studies.friction_map.map import SteadySliding, decade_slopes
from cosim.studies.friction_map.page import page, tiles

CASE = read_scenario("melting_friction").changed(
    {"ice.radial_elements": 2, "ice.axial_elements": 3, "belt.cell_length": 4e-3}
)


call = partial(executed, friction_regimes_command)


def test_slope_of_a_power_over_each_decade():
    speed = np.geomspace(0.1, 100.0, 10)
    slopes = decade_slopes(speed, 3.0 * speed**-0.5)
    assert [entry["slope"] for entry in slopes] == pytest.approx([-0.5] * 7, rel=1e-12)
    assert (slopes[0]["low"], slopes[0]["high"]) == pytest.approx((0.1, 1.0))
    assert (slopes[-1]["low"], slopes[-1]["high"]) == pytest.approx((10.0, 100.0))


def test_less_than_a_decade_has_no_slope():
    assert decade_slopes([1.0, 2.0, 3.0, 4.0, 9.0], np.ones(5)) == []


def test_minimum_of_a_parabola_on_logarithmic_axes():
    speed = np.array([0.2, 0.5, 1.0, 2.0, 7.0])
    value = 0.03 * np.exp(0.3 * np.log(speed / 1.2) ** 2)
    assert map_module.lowest_friction(speed, value) == pytest.approx((1.2, 0.03), rel=1e-9)
    assert map_module.lowest_friction(speed, speed) is None


def test_the_block_stands_at_its_balance_from_the_start():
    case = map_module.steady_scenario(CASE, 0.1, -8.0, 1.0)
    (point,) = friction_map(CASE, [0.1], [-8.0], 0.1).points
    force = 4.0 * case.springs.stiffness * case.initial.x
    assert force == pytest.approx(point.law * 0.67 * 9.81, rel=1e-12)
    assert point.speed == pytest.approx(0.1, rel=1e-4)
    assert point.friction == pytest.approx(point.law, rel=1e-3)


def test_what_the_command_leaves(tmp_path, capsys):
    file = tmp_path / "case.toml"
    file.write_text(CASE.to_toml())
    speeds = [0.02, 0.05, 0.1, 0.2]
    argv = [file, "--speed", *speeds, "--ambient", -8, "--duration", 0.1, "-o", tmp_path]
    assert call(*argv) == 0
    said = capsys.readouterr().out
    assert "-8 degC" in said and "steepest fall: slope -0.5" in said and "4 coupled runs" in said
    assert "steepest rise" not in said, "it falls at all these speeds"
    found = json.loads((tmp_path / "friction_map.json").read_text())
    assert found["regimes"][0]["steepest_fall"]["slope"] == pytest.approx(-0.55, abs=0.01)
    assert found["regimes"][0]["minimum"] is None
    with (tmp_path / "friction_map.csv").open() as table:
        rows = list(csv.DictReader(table))
    assert [float(row["speed"]) for row in rows] == pytest.approx(speeds, rel=1e-3)
    assert (tmp_path / "friction_map.png").read_bytes().startswith(b"\x89PNG")
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "-0.54" in page.replace("\u2212", "-") and "All 4 runs" in page


@pytest.mark.parametrize("changes, speed, ambient, line", [
    ({}, 0.0, -8.0, "speed = 0 m/s: allowed is above 0"),
    ({}, 0.1, 1.0, "ambient.temperature_degC"),
    ({"springs.stiffness": 0.0}, 0.1, -8.0, "springs.stiffness = 0 N/m: friction of 0.209 N"),
    ({"springs.stiffness": 0.2}, 0.1, -8.0, "into the springs' anchors"),
])  # fmt: skip
def test_what_cannot_slide_steadily_is_refused_in_one_line(changes, speed, ambient, line):
    with pytest.raises(ValueError, match=line) as refused:
        friction_map(CASE.changed(changes), [speed], [ambient], 0.1)
    assert is_bad_input(refused.value)
    assert "\n" not in str(refused.value)


def test_a_point_that_fails_costs_one_point(tmp_path, capsys):
    """Springs so soft that friction at the slower speed carries the block into their anchors."""
    file = tmp_path / "case.toml"
    file.write_text(CASE.changed({"springs.stiffness": 0.2}).to_toml())
    argv = [file, "--speed", 0.1, 0.4, "--ambient", -8, "--duration", 0.1, "-o", tmp_path / "out"]
    assert call(*argv) == 0
    told = capsys.readouterr()
    assert told.err.count("\n") == 1 and "left out: springs.stiffness" in told.err
    found = json.loads((tmp_path / "out" / "friction_map.json").read_text())
    assert len(found["points"]) == len(found["failed"]) == 1
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "Points without steady sliding" in page


def test_each_law_says_for_which_contact_it_holds():
    found = FrictionMap(CASE, 2.0, (point(1e-4), point(1.0)))
    laws = {law["name"]: law for law in found.laws}
    assert list(laws) == ["asperity_melting", "melt_film"]
    # 6.57 N on 20 MPa, ice of 1.17e-6 m2/s over 1 cm
    assert "N/H = 0.33 mm²" in laws["asperity_melting"]["here"]
    assert "above 1 from 0.00012 m/s on, 1 of 2 runs slower" in laws["asperity_melting"]["here"]
    assert all("assumed" in law["numbers"] for law in laws.values())


def test_what_is_conducted_is_that_of_a_disc_on_two_half_spaces():
    """4 k r dT over pi r^2, over C e dT sqrt(v / l): what passes takes."""
    flux = 4.0 * (2.2 + 0.5) / (np.pi * 5e-3)
    assert conducted_share(CASE, 0.1) == pytest.approx(flux / (1.128 * 2034.0 * 10.0**0.5))


def test_measured_friction_lies_beside_the_law():
    """The rig's 0.2086 is 8 times what the packaged case says there, and the page says so."""
    found = FrictionMap(CASE, 2.0, (point(0.15), point(1.0)))
    assert own_point(found.scenario).friction == (0.2086,) and own_point(found.scenario).speeds == (
        0.15,
    )
    assert "0.0256 where the source study's rig has 0.2086 (0.15 m/s, −8 °C)" in differences(
        found.scenario
    )
    text = page(found, "command")[0]
    assert "Law and measurement differ by more than a factor of 2" in text
    assert text.count("Seppyo 61 (1999)") == 1
    assert found.summary()["measured"][0]["friction"] == [0.2086]


def test_a_roughness_of_an_eighth_of_a_micrometre_is_the_rig_s():
    """As the scenario says: 1.36e-7 m gives the rig's friction, and nothing is said of it then."""
    rough = CASE.changed({"asperity_melting.roughness": 1.36e-7})
    found = FrictionMap(rough, 2.0, (point(0.15),))
    (mu,) = friction_coefficient(rough.mechanics, [0.15], -8.0)
    assert mu == pytest.approx(0.2086, rel=0.01)
    assert "the source study's rig" not in differences(found.scenario)


def test_no_measured_ice_beside_another_block():
    """Nor the rig's own where the scenario is the user's, or its block another."""
    steel = CASE.changed({"ice.material": "steel"})
    assert measured_beside(steel) == []
    for other in (CASE.changed({"rig.mass": 1.0}), CASE.changed({"name": "mine"})):
        assert own_point(other) is None


def point(speed):
    return SteadySliding(speed, -8.0, -8.0, 0.1, 0.1, 0.0, 0.0)


def test_a_run_that_was_interrupted_ends_the_map(monkeypatch):
    stopped = SimpleNamespace(result=SimpleNamespace(status="interrupted"))
    monkeypatch.setattr(map_module, "run_scenario", lambda case: stopped)
    with pytest.raises(KeyboardInterrupt):
        friction_map(CASE, [0.1, 0.2], [-8.0], 0.1)


DRY = read_scenario("reference").changed({"ice.radial_elements": 2, "ice.axial_elements": 3})
SPEEDS = (0.05, 0.1, 0.2, 0.5)


@pytest.fixture(scope="module")
def dry():
    return friction_map(DRY, SPEEDS, [-10.0], 1.0)


def test_a_dry_block_slides_at_the_speed_of_the_belt(dry):
    """Else 0.05 to 0.5 m/s, at which blocks that swing are a little slower, were no decade."""
    assert [each.speed for each in dry.points] == pytest.approx(SPEEDS, rel=1e-3)
    fall = dry.regimes(-10.0)["steepest_fall"]
    assert fall["slope"] == pytest.approx(0.0, abs=1e-3)
    assert dry.regimes(-10.0)["minimum"] is None  # of rounding


def flowing(*speeds):
    return FrictionMap(CASE, 2.0, tuple(point(speed) for speed in speeds))


def test_why_there_is_no_slope():
    assert flowing(0.05, 0.1).no_slope(-8.0) == "less than a decade of speeds"
    assert flowing(0.05, 0.5).no_slope(-8.0) == "fewer than 4 speeds in a decade"


def test_the_page_begins_with_a_sentence_a_picture_and_figures():
    found = FrictionMap(
        CASE, 2.0, tuple(replace(point(v), friction=f) for v, f in ((0.1, 0.3), (1, 0.1), (9, 0.2)))
    )
    text = page(found, "command")[0]
    places = [
        text.index(each) for each in ("<h1>Friction falls", "<figure", 'class="tiles"', "<h2")
    ]
    assert places == sorted(places) and 2 <= len(tiles(found)) <= 4
    # one minimum: that between the speeds
    (name, value), least = tiles(found)[0], found.regimes(-8.0)["minimum"]
    assert name == f"least friction, at {least['speed']:.3g} m/s" and f"{value} at " in text
    assert float(value) == pytest.approx(least["friction"], rel=1e-2) and float(value) < 0.1
    assert "rises to 0.2 at 9 m/s, in air of −8\u00a0°C." in text

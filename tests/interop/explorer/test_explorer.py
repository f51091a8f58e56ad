"""The explorer in Chromium: its numbers are those of `stickslip simulate`, and it can be used.

One file for all, so that one browser is started.
"""

import json
import time
import warnings

import numpy as np
import pytest
from browser import PHONE, Browser
from explorer_page import address_of
from stickslip import EFFECTS, Parameters, friction_coefficient, simulate
from stickslip.packing import in_order
from stickslip.steady_motion import Interface
from stickslip.steady_motion.regimes import (
    CREEPING,
    ENDED,
    SLIDING,
    STICK_SLIP,
    STICKING,
    regime_of,
)

from cosim import read_scenario, run_scenario
from cosim.report import trajectory_columns
from cosim.report.run_summary import after_ramp
from cosim.scenario import ScenarioError
from cosim.studies.effects.page import PLAIN

#: Lengths, angles and energies are the same to this, m, rad, J: what is asked for. The browser has
#: another libm, whose last bit the sharpest break-away makes a thousand times larger.
SAME = 1e-9
#: Velocities are those times the rates of the motion, some 10/s, in a creeping contact 50/s.
SAME_SPEED = 50 * SAME
#: A contact that slides at a millionth of the surface's speed lands by its rate of that moment, in
#: some 1e-7 s; where the last bit begins that a step later, the end differs by a part of it, s.
WHEN_LANDED = 1e-8
#: A creeping contact comes to rest without end: when it counts as stuck, s, is known the less
#: exactly the slower it gets.
WHEN_CREEP_ENDS = 1e-5
#: Friction that rises within a millimetre per second of rest, as of asperities whose melt no longer
#: carries, makes more of the last bit: at 0.1 m/s2 speeds that are the same come to rest within, s.
WHEN_STEEP = SAME_SPEED / 0.1
WHEN = {"rate_and_state": WHEN_CREEP_ENDS, "asperity_melting": WHEN_STEEP}
DURATION = 10.0
COLUMNS = ("x", "y", "phi", "vx", "vy", "heat", "surface_work", "sliding_distance", "mode")


def assert_same(found, run, when=WHEN_LANDED):
    assert found["reason"] == run.reason == ""
    assert np.array_equal(found["time"], run.time)
    for name in COLUMNS:
        bound = SAME_SPEED if name in ("vx", "vy") else SAME
        assert np.max(np.abs(found["columns"][name] - run[name])) <= bound, name
    assert len(found["events"]) == len(run.events)
    assert np.allclose(np.reshape(found["events"], (-1, 3)), run.events, rtol=0.0, atol=when)


@pytest.mark.parametrize("preset", ["reference", "study", "slab"])
def test_a_packaged_scenario(page, preset):
    scenario = read_scenario(preset)
    found = page.ended(address_of(preset, {"run.duration": DURATION}), COLUMNS)
    assert_same(found, simulated(scenario, DURATION))


def simulated(scenario, duration):
    return simulate(
        scenario.mechanics, duration, scenario.run.output_interval,
        interface_temperature=scenario.ambient.temperature_degC,
    )  # fmt: skip


@pytest.mark.parametrize("effect", EFFECTS, ids=lambda effect: effect.id)
def test_an_effect(page, effect):
    """In the rig in which it shows, after a ramp and with every random part of the rig."""
    changes = {
        f"{table}.{key}": value
        for table, keys in {**PLAIN, **effect.case.rig}.items()
        for key, value in {**PLAIN.get(table, {}), **keys}.items()
    }
    changes |= {f"{effect.id}.{name}": value for name, value in effect.case.effect.items()}
    changes |= {"imperfections.seed": 7, "imperfections.spring_stiffness": 0.02}
    warmth = {"ambient.temperature_degC": -3.0} if "reference_degC" in effect.case.effect else {}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        scenario = read_scenario("study").changed(changes | warmth)
    asked = changes | warmth | {"run.duration": DURATION}
    found = page.ended(address_of("study", asked), COLUMNS)
    assert_same(found, simulated(scenario, DURATION), WHEN.get(effect.id, WHEN_LANDED))
    speeds, curve = map(np.array, found["curve"])
    law = friction_coefficient(scenario.mechanics, speeds, scenario.ambient.temperature_degC)
    assert np.allclose(curve, law, rtol=0.0, atol=SAME)


#: Of every kind of control, what the kernel is told otherwise than it is said.
SAID_OTHERWISE = [
    {},
    {"rig.inertia": "ring", "rig.attachment_radius": 0.03},
    {"rig.inertia": 4e-4, "rig.degrees_of_freedom": ["x", "phi"]},
    {"rig.surface": "slab", "rig.slab_radius": -0.7,
     "rig.attachment_angles_deg": [150, 30, 190, 350]},
    {"springs.force_curve_extension": [-0.1, 0.0, 0.1], "springs.force_curve_force": [-2, 0, 2.5],
     "friction.table_speed": [0, 0.1], "friction.table_mu": [0.2, 0.15], "initial.vx": -0.0125},
]  # fmt: skip


@pytest.mark.parametrize("changes", SAID_OTHERWISE)
def test_the_kernel_is_told_the_same(page, changes):
    tables = {}
    for key, value in changes.items():
        table, _, name = key.partition(".")
        tables.setdefault(table, {})[name] = tuple(value) if isinstance(value, list) else value
    if "degrees_of_freedom" in tables.get("rig", {}):
        tables["rig"]["degrees_of_freedom"] = tuple(changes["rig.degrees_of_freedom"])
    base = read_scenario("study").mechanics.model_dump()
    for table, entries in tables.items():
        base[table] |= entries
    expected = in_order(Parameters.model_validate(base).flat())
    page.ended(address_of("study", changes))
    told = page.tell("return [...explorer.values()]")
    assert told == expected


def test_the_numbers_are_those_of_the_summary(page):
    changes = {"run.duration": 20.0}
    scenario = read_scenario("reference").changed(changes)
    found = page.ended(address_of("reference", changes))["statistics"]
    dataset = trajectory_columns(simulated(scenario, 20.0), scenario, "").to_xarray()
    expected = after_ramp(dataset)
    assert expected["break_aways"] > 10
    assert found.keys() == expected.keys()
    for name, value in expected.items():
        assert found[name] == pytest.approx(value, rel=0.0, abs=1e-7 if "deg" in name else SAME), (
            name
        )


@pytest.mark.usefixtures("reference")
def test_a_saved_scenario_gives_the_same_motion(page):
    """Turned, typed, saved by the button, and read as `stickslip simulate` reads it."""
    name = page.by_id("name")
    name.clear()
    name.send_keys("turned around\n")
    type_into(page, "rig.mass", "812 g")
    type_into(page, "velocity_weakening.hyperbolic", "1.5")
    type_into(page, "surface_scatter.deviation", "4 %")
    type_into(page, "run.duration", "8")
    found = page.ended(None, COLUMNS)
    page.by_id("save").click()
    file = page.driver.downloads / "turned around.toml"
    wait_for(file)
    scenario = read_scenario(file)
    assert scenario.name == "turned around" and scenario.rig.mass == 0.812
    assert scenario.imperfections == read_scenario("reference").imperfections
    assert scenario.surface_scatter.deviation == 0.04 and scenario.run.duration == 8.0
    assert scenario.belt == read_scenario("reference").belt
    assert_same(found, simulated(scenario, scenario.run.duration))


def type_into(page, key, text):
    field = page.driver.find_element("css selector", f'[id="{field_id(key)}"]')
    page.tell("arguments[0].closest('details').open = true", field)
    field.clear()
    field.send_keys(text + "\n")


def field_id(key):
    return "key-" + "".join(each if each.isalnum() or each == "_" else "-" for each in key)


def wait_for(file, tries=100):
    for _ in range(tries):
        if file.exists():
            return
        time.sleep(0.05)
    raise AssertionError(f"{file} has not come; there are {list(file.parent.iterdir())}")


def test_what_is_copied_as_python_is_the_scenario_that_is_seen(page):
    changes = {"rig.mass": 1.2, "rig.degrees_of_freedom": ["x", "phi"], "surface.speed": 0.21}
    page.ended(address_of("slab", changes))
    told = page.tell("return explorer.python()")
    said = {}
    exec(told.partition("run = ")[0], said)  # what is behind it computes and draws
    assert said["scenario"].model_dump() == read_scenario("slab", changes).model_dump()
    assert told.splitlines()[-2:] == ["run = simulate_scenario(scenario)", 'run.plot("motion")']


# --- in use: keys, words for what is refused, folds, sizes, and who cannot see it ---

REFUSED = [
    {"rig.mass": -1}, {"imperfections.seed": -1}, {"rig.inertia": 0},
    {"rig.attachment_angles_deg": [1, 2, 3]}, {"rig.mass": 1e120},
    {"rig.surface": "slab", "rig.slab_radius": 0.02},
    {"springs.force_curve_extension": [0, 0.1], "springs.force_curve_force": [0]},
    {"friction.stick_creep": 0.2}, {"friction.stick_creep": 0.01, "rate_and_state.evolution": 0.02},
    {"rig.spring_natural_length": 0.5},
    {"speed_ripple.amplitude": 1, "speed_ripple.frequency": 150},
    {"run.duration": 300, "run.output_interval": 1e-5},
]  # fmt: skip


@pytest.mark.usefixtures("reference")
@pytest.mark.parametrize("changes", REFUSED, ids=lambda changes: " ".join(changes))
def test_what_is_refused_is_refused_in_the_same_words(page, changes):
    with pytest.raises(ScenarioError) as error:
        read_scenario("study").changed(changes)
    assert page.ended(address_of("study", changes)) is None
    assert page.text("fault") == str(error.value)
    assert page.tell("return document.querySelectorAll('[aria-invalid=true]').length") == 1
    # and what was there before is still there, and comes back
    assert page.tell("return explorer.seen.rows") == 3001
    assert page.ended(address_of("study", {}))["reason"] == ""
    assert page.text("fault") == ""


@pytest.mark.parametrize(
    "changes", [{"friction.mu_k": 0.3}, {"rig.spring_natural_length": 0.21}], ids=str
)
def test_what_is_warned_of_is_warned_of_in_the_same_words(page, changes):
    with pytest.warns(UserWarning) as told:
        read_scenario("study").changed(changes)
    page.ended(address_of("study", changes))
    assert page.text("remark") == str(told[0].message)


@pytest.mark.usefixtures("reference")
def test_by_keyboard_alone(page):
    """Tab reaches every control in turn; arrows, digits and Enter are all it takes."""
    from selenium.webdriver.common.keys import Keys

    driver = page.driver
    page.by_id("find").send_keys("surface speed velocity")  # nothing has all three
    assert not visible(page)
    page.by_id("find").clear()
    page.by_id("find").send_keys("speed negative runs backwards")
    assert visible(page) == ["surface.speed"]
    active = driver.switch_to.active_element
    for _ in range(3):  # the fold's heading, the slider
        active.send_keys(Keys.TAB)
        active = driver.switch_to.active_element
        if active.get_attribute("type") == "range":
            break
    assert active.get_attribute("aria-label") == "surface.speed, slider"
    active.send_keys(Keys.ARROW_RIGHT)
    assert page.ended() is not None
    turned = page.tell("return explorer.scenario.get('surface.speed')")
    assert 0.15 < turned < 0.155
    active.send_keys(Keys.TAB)
    field = driver.switch_to.active_element
    field.send_keys(Keys.CONTROL, "a")
    field.send_keys("12 cm/s", Keys.ENTER)
    page.ended()
    assert page.tell("return explorer.run.scenario.get('surface.speed')") == 0.12
    field.send_keys(Keys.CONTROL, "a")
    field.send_keys("12 kg", Keys.ENTER)
    assert page.text("fault").startswith(
        'surface.speed: not in a unit of m/s, such as mm/s or cm/s ("12 kg"), allowed is a number'
    )
    field.send_keys(Keys.TAB)
    driver.switch_to.active_element.send_keys(Keys.ENTER)  # back to where it began
    page.ended()
    assert page.tell("return explorer.run.scenario.get('surface.speed')") == 0.15


def visible(page):
    """Keys of the rows that are to be seen."""
    return page.tell(
        "return [...document.querySelectorAll('.row')]"
        ".filter((row) => row.offsetParent).map((row) => row.title)"
    )


TYPED = [
    ("rig.mass", "670 g", 0.67),
    ("rig.mass", "3 m", None),
    ("rig.mass", "heavy", None),
    ("rig.inertia", "ring", "ring"),
    ("rig.inertia", "5 kg.cm2", 5e-4),
    ("rig.attachment_angles_deg", "150, 30, 210, 330", [150, 30, 210, 330]),
    ("surface.speed", "-0.9 km/h", -0.25),
    ("friction.stick_creep", "3 µm/s", 3e-6),
    ("friction.mu_s", "28 %", 0.28),
    ("initial.phi", "180 deg", 3.14159265358979),  # to the fifteen digits that a unit leaves
    ("ambient.temperature_degC", "-5 °C", -5),
    ("ambient.temperature_degC", "260 K", -13.15),
    ("ambient.temperature_degC", "260 W", None),
    ("film_drag.coefficient", "1 N.s/mm", 1000),
    ("asperity_melting.effusivity", "2 kW.s0.5/(m2.K)", 2000),
    ("surface_scatter.seed", "3.5", None),
]


@pytest.mark.parametrize("key, text, value", TYPED)
def test_values_are_typed_with_units(opened, key, text, value):
    assert opened.tell("return explorer.read(...arguments) ?? null", key, text) == value


def test_a_link_opens_the_same_numbers(page):
    changes = {"rig.mass": 1.25, "surface_scatter.deviation": 0.05, "rig.inertia": "ring"}
    address = address_of("slab", changes)
    page.open(address)
    assert json.loads(page.tell("return JSON.stringify(explorer.scenario.changed())")) == [
        "rig.mass", "rig.inertia", "surface_scatter.deviation",
    ]  # fmt: skip
    assert page.by_id("group-surface_scatter").text.split()[-1] in ("changed", "on,")
    again = page.tell("return explorer.address()")
    page.open(again)
    assert page.tell("return explorer.scenario.get('rig.mass')") == 1.25
    page.by_id("reset").click()
    page.ended()
    assert page.tell("return explorer.scenario.changed()") == []
    page.open("#preset=nobody&rig.mas=1&rig.mass=much")
    assert page.text("done") == (
        "not understood in the address: preset=nobody, rig.mas=1, rig.mass=much"
    )


@pytest.mark.usefixtures("reference")
def test_a_run_is_kept_for_comparison(page):
    page.by_id("freeze").click()
    before = page.tell("return explorer.kept.statistics || explorer.statistics(explorer.kept)")
    page.ended(address_of("reference", {"rig.mass": 1.5}))
    told = page.text("statistics")
    assert f"kept: {before['break_aways']} in 20 s" in told
    assert page.tell("return explorer.pictures.over.x.spec.curves.length") == 2
    page.by_id("freeze").click()
    assert page.tell("return explorer.kept") is None


def test_a_run_that_ends_early_says_why(page):
    found = page.ended(address_of("study", {"springs.stiffness": 2, "friction.mu_s": 3}))
    assert "the block was carried into the anchor of a spring" in found["reason"]
    assert page.text("fault") == found["reason"]


def test_it_is_one_small_file(explorer_file):
    text = explorer_file.read_text(encoding="utf-8")
    assert explorer_file.stat().st_size < 1_000_000
    assert "http://" not in text and "https://" not in text and "src=" not in text


@pytest.mark.parametrize("width", [1400, PHONE])
def test_no_serious_barrier(page, width):
    """axe-core, with all folds open; on a phone nothing sticks out, and the numbers come first."""
    browser = Browser(page.driver)
    browser.resize(width)
    try:
        page.open()
        assert browser.overhang() <= 0
        below = "return document.querySelector(arguments[0]).getBoundingClientRect().bottom"
        assert width > PHONE or page.tell(below, "#ledger") < page.tell(below, "#preset")
        page.tell("document.querySelectorAll('details').forEach((each) => (each.open = true))")
        assert browser.barriers() == []
    finally:
        browser.command("Emulation.clearDeviceMetricsOverride")


def test_paper_is_drawn_for_anew(page):
    """On a sheet, narrower than the window, no plot is squeezed, cut or covered by its front."""
    width = "return [explorer.top.canvas.width, explorer.pictures.over.x.uplot.width]"
    wide = page.tell(width)
    page.tell("dispatchEvent(new Event('beforeprint'))")
    narrow = page.tell(width)
    front = page.tell("return getComputedStyle(document.querySelector('.front')).display")
    page.tell("dispatchEvent(new Event('afterprint'))")
    assert narrow == [703, 703] and front == "none"
    assert page.tell(width) == wide and wide[0] > 703


# --- the heat, and the regimes around a run ---

SETTLED = """
const back = arguments[0];
(function look() {
  const { run, map } = explorer;
  if (READY) back(run.heat.why);
  else requestAnimationFrame(look);
})();
"""
#: Waits in the page until the heat has been computed, and until the regimes, which take longer.
WARMED = SETTLED.replace("READY", "run.heat.why || run.warmed === run.rows")
MAPPED = SETTLED.replace("READY", "map.cells.length && map.regimes.length === map.cells.length")
#: In the middle of the map.
CLICK = """
const { over } = explorer.map.plot.uplot, place = over.getBoundingClientRect();
over.dispatchEvent(new MouseEvent("click", {
  clientX: place.left + place.width / 2, clientY: place.top + place.height / 2,
}));
"""
#: K, of the reduced model beside the finite elements; the belt around the slab's ring is cut into
#: cells that are half as long again.
NEAR = {"reference": 2e-6, "slab": 1e-5}


@pytest.mark.parametrize("preset", NEAR)
def test_the_interface_warms_as_in_a_coupled_run(page, preset):
    changes = {"run.duration": 5.0, "surface.run_up_time": 2.0, "ambient.temperature_degC": -5.0}
    page.ended(address_of(preset, changes))
    assert page.driver.execute_async_script(WARMED) == ""
    found = page.tell("return [...explorer.run.column('interface_temperature')]")
    held = {"belt.still_air_speed": 0.0}  # the page keeps the heat transfer that it was made with
    film = page.tell("return explorer.scenario.preset.heat.parameters['belt.air_heat_transfer']")
    scenario = read_scenario(preset, changes | held | {"belt.air_heat_transfer": film})
    expected = run_scenario(scenario).result["thermal.interface_temperature"]
    assert np.ptp(expected) > 500 * NEAR[preset]
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=NEAR[preset])


#: Turns a key while the run before is still being warmed; what is then heard of the last run.
TURNED_ON_AND_ON = """
const back = arguments[0], heard = [], { told } = explorer.runs;
explorer.runs.told = (run, message) => {
  if (run.scenario.get("run.duration") === 14) heard.push(Object.keys(message).sort().join(" "));
  told(run, message);
};
let duration = 5, after = 0;
(function turn() {
  const { run, pending } = explorer;
  const there = !pending && run.state === "done";
  if (duration < 14 && there) explorer.set("run.duration", ++duration);
  if (duration === 14 && there && run.heat.ended && ++after > 20) {
    explorer.runs.told = told;
    back(heard);
  } else requestAnimationFrame(turn);
})();
"""


def test_a_run_is_computed_once_whatever_was_going_on_before(page):
    page.ended(address_of("reference", {"run.duration": 5.0}))
    heard = page.driver.execute_async_script(TURNED_ON_AND_ON)
    for ending in ("done reason run", "reason run warmed"):
        assert heard.count(ending) == 1, heard


def test_where_there_is_no_heat_it_says_why(page):
    page.ended(address_of("reference", {"rig.contact_radius": 0.03}))
    assert "rig.contact_radius" in page.driver.execute_async_script(WARMED)
    page.ended(address_of("reference", {"ambient.temperature_degC": 3.0}))
    assert "would not be ice" in page.driver.execute_async_script(WARMED)


def test_the_regimes_are_those_of_the_stability_study(page):
    """At some cells of the map; a click goes to one."""
    changes = {"run.duration": 12.0, "surface.run_up_time": 4.0, "rig.mass": 1.0}
    page.ended(address_of("study", changes))
    page.driver.execute_async_script(MAPPED)
    known = page.tell("return [explorer.map.regimes, explorer.map.cells, explorer.map.tops]")
    regimes, cells, tops = known
    names = [ENDED, STICKING, STICK_SLIP, SLIDING, CREEPING]
    seen = set()
    for place in range(0, len(cells), 23):
        speed, damping = page.tell("return explorer.map.middle(arguments[0])", place)
        here = {"surface.speed": speed, "structural_damping.coefficient": damping}
        scenario = read_scenario("study", changes | here)
        interface = Interface(scenario.ambient.temperature_degC)
        regime = regime_of(scenario.mechanics, scenario.run.duration, interface)
        assert names[regimes[place]] == regime.name, here
        seen.add(regime.name)
    assert seen == {STICK_SLIP, SLIDING}
    page.tell(CLICK)
    page.ended()
    assert page.tell("return explorer.scenario.get('surface.speed')") == pytest.approx(
        0.5 * tops[0], rel=0.05
    )
    assert page.tell("return explorer.map.regimes.length") == len(cells)  # it is the same map

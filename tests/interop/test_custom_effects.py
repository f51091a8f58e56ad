"""Custom effects are values: any number in one process, whenever they are named, and in others."""

import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from itertools import permutations

import numpy as np
import pytest
from stickslip import Parameters, simulate

from cosim import read_scenario, run_scenario
from cosim.cli.authoring.effect import text_of
from cosim.processes import processes

SCENARIO = """
name = "short"
effects = ["{name}.py"]
defaults = "plain"
rig.spring_natural_length = 0.17
initial.vx = 0.15
{name}.fall = {fall}
run.duration = 1.0
"""
#: Remembers a heat of its own: the kernel's memory is longer, not its parameters alone.
STATE = '''
def rate(friction_power: float, memory: float) -> float:
    """J/s"""
    return friction_power - memory


def kinetic_factor(memory: float, fall: float) -> float:
    """mu_k over its value without a memory."""
    return 1.0 - fall * memory / (0.1 + memory)


EFFECT = Effect(
    id="brush", table=Brush, switch=("fall",), enters="friction", source="a test",
    terms=(kinetic_factor,), states=(State("memory", rate),), case=Case({"fall": 0.3}),
)
'''


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Two effects of one form, one that remembers, and a scenario with each of the two."""
    place = tmp_path_factory.mktemp("custom")
    for name, fall in (("brush", 0.2), ("grease", 0.6)):
        (place / f"{name}.py").write_text(text_of(name), encoding="utf-8")
        text = SCENARIO.format(name=name, fall=fall)
        (place / f"{name}.toml").write_text(text, encoding="utf-8")
    begins = text_of("brush").replace("Effect,", "Effect, State,").partition("# A term")[0]
    (place / "memory").mkdir()
    (place / "memory" / "brush.py").write_text(begins + STATE, encoding="utf-8")
    return place


def test_coupled_runs_with_and_without_a_custom_effect_in_one_process(folder):
    plain = read_scenario("reference").changed({"run.duration": 1.0})
    before = run_scenario(plain).result["mechanics.x"]
    run = run_scenario(folder / "brush.toml")
    assert run.result.status == "complete"
    assert run.scenario.catalogue.effects[-1].id == "brush"
    found = run.result["mechanics.x"]
    alone = simulate(run.scenario.mechanics, 1.0, 0.01, interface_temperature=-8.0)
    assert np.abs(alone["x"] - found).max() < 1e-6
    off = run.scenario.mechanics.model_copy(update={"brush": type(run.scenario.brush)()})
    assert np.abs(simulate(off, 1.0, 0.01)["x"] - found).max() > 1e-4
    assert np.array_equal(before, run_scenario(plain).result["mechanics.x"])


ON = {"rig": {"spring_natural_length": 0.17}, "initial": {"vx": 0.15}}


def kinds(folder):
    """Name -> parameters of the house's catalogue and of three others."""
    brush, grease = folder / "brush.py", folder / "grease.py"
    half = {**ON, "brush": {"fall": 0.5}}
    return {
        "house": Parameters(**ON),
        "brush": Parameters.with_effects(brush)(**half),
        "both": Parameters.with_effects(brush, grease)(**half, grease={"fall": 0.2}),
        "memory": Parameters.with_effects(folder / "memory" / "brush.py")(**half),
    }


def motion(parameters):
    return simulate(parameters, 1.0, 0.02)["x"]


@pytest.fixture(scope="module")
def motions(folder):
    return {name: motion(each) for name, each in kinds(folder).items()}


def test_each_has_a_kernel_of_its_own(folder, motions):
    for one, other in permutations(motions, 2):
        assert np.abs(motions[one] - motions[other]).max() > 1e-4, (one, other)
    for name, each in kinds(folder).items():
        slow = simulate(each, 0.5, 0.02, interpreted=True)
        assert np.array_equal(slow["x"], motions[name][:26])
        assert np.abs(slow["energy_residual"]).max() < 1e-9


def test_threads_and_processes_have_them(folder, motions):
    asked = kinds(folder)
    with ThreadPoolExecutor(2) as pool:
        assert all(map(np.array_equal, pool.map(motion, asked.values()), motions.values()))
    with processes(2) as mapped:
        found = mapped(motion, [(each,) for each in asked.values()])
        assert all(map(np.array_equal, found, motions.values()))


UNPICKLED = """
import pickle, sys
from stickslip import simulate
scenario = pickle.load(sys.stdin.buffer)
print(simulate(scenario.mechanics, 0.1)["x"][-1], scenario.changed({"rig.mass": 1.0}).brush.fall)
"""


def test_a_scenario_takes_its_effects_along_to_where_the_file_is_not(folder, tmp_path):
    import pickle

    file = tmp_path / "here" / "brush.py"
    file.parent.mkdir()
    file.write_text(text_of("brush"), encoding="utf-8")
    (file.parent / "brush.toml").write_text((folder / "brush.toml").read_text(), encoding="utf-8")
    scenario = read_scenario(file.parent / "brush.toml")
    sent = pickle.dumps(scenario)
    file.unlink()
    done = subprocess.run(
        [sys.executable, "-c", UNPICKLED], input=sent, capture_output=True, check=True, cwd=tmp_path
    )
    x, fall = map(float, done.stdout.split())
    assert (x, fall) == (simulate(scenario.mechanics, 0.1)["x"][-1], 0.2)
    assert pickle.loads(sent) == scenario and type(pickle.loads(sent)) is type(scenario)


def test_a_file_that_is_edited_is_another_effect(tmp_path):
    file = tmp_path / "brush.py"
    file.write_text(text_of("brush"), encoding="utf-8")
    before = Parameters.with_effects(file)
    assert Parameters.with_effects(file) is before
    file.write_text(text_of("brush").replace("1.0 - fall", "1.0 - 0.5 * fall"), encoding="utf-8")
    after = Parameters.with_effects(file)
    assert after is not before and after.catalogue.text != before.catalogue.text
    runs = [
        simulate(kind(**ON, brush={"fall": fall}), 0.5, 0.02, interpreted=True)["x"]
        for kind, fall in ((before, 0.4), (after, 0.4), (before, 0.2))
    ]
    assert np.abs(runs[0] - runs[1]).max() > 1e-4 and np.array_equal(runs[1], runs[2])

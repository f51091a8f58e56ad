"""README and pages do what they say: Python runs, input is read, commands print what is shown.

The pages are those of the site that are no notebooks: the cells of these are executed when the
site is built (`test_site.py`). A session in a terminal that takes half a minute and more, and those
of tutorials, are run by `pytest -m slow`. That every block is run is seen to in `test_blocks.py`.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from command_line import stickslip_here
from notebooks import PAGES, source
from sessions import fences, timeless, typed

from cosim import read_scenario
from cosim.cli.arguments import COMMANDS
from cosim.fmu.build import NATIVE, THERMAL, ensure_fmu
from cosim.gap import read_campaign
from cosim.scenario import packaged_scenarios
from cosim.systems import read_system

ROOT = Path(__file__).resolve().parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
SITE = Path(__file__).parent / "site"
TEXTS = {"README.md": README} | {
    str(file.relative_to(SITE)): file.read_text(encoding="utf-8") for file in SITE.rglob("*.md")
}
#: Page, language and text of each block of code.
BLOCKS = [
    (page, fence.info.strip(), fence.content)
    for page, text in TEXTS.items()
    for fence in fences(text)
]
#: Lines that install, of which .ci/run is the second; what is typed after the first.
SHELL = [
    "python3 -m venv .venv && .venv/bin/pip install . && .venv/bin/stickslip run",
    'python3 -m venv .venv && .venv/bin/pip install -q ".[test]" && .venv/bin/pytest -q -n 2',
    ". .venv/bin/activate\nstickslip new my_rig\nstickslip run my_rig.toml",
]
#: Sessions that take long, and what the page has typed before.
SLOW = {
    "plan next_week": "plan --write-example next_week",
    "gap cold_room": "gap --write-example cold_room",
}


def blocks(language):
    """Page and text of each block of a language."""
    return [(page, text) for page, found, text in BLOCKS if found == language]


def toml_with(table):
    (found,) = [text for _, text in blocks("toml") if table in text]
    return found


#: Command -> options that a page gives it anywhere.
NAMED = {}
for command, rest in re.findall(r"`stickslip ([a-z][a-z-]*)([^`]*)`", "\n".join(TEXTS.values())):
    NAMED.setdefault(command, set()).update(re.findall(r"--[a-z][a-z-]+", rest))

#: Sessions in a terminal that no tutorial has: a command, and what it prints.
SESSIONS = {
    command.removeprefix("stickslip "): printed
    for page, text in blocks("")
    for command, printed in typed(text)
    if not page.startswith("tutorials/")
}


@pytest.mark.parametrize(("page", "code"), blocks("python"), ids=lambda text: text.split("\n")[0])
def test_python_runs(page, code, at_home):
    ensure_fmu("build")
    exec(compile(code, page, "exec"), {})


def test_the_scenario_is_one(at_home):
    Path("soft_springs.toml").write_text(toml_with("[springs]"), encoding="utf-8")
    scenario = read_scenario("soft_springs.toml")
    assert (scenario.springs.stiffness, scenario.rig.spring_natural_length) == (12.0, 0.17)


def test_the_campaign_is_one(tmp_path):
    rows = [f"{0.01 * i:.2f},{1e-3 * (i % 50):.6f}" for i in range(1000)]
    (tmp_path / "run01.csv").write_text("\n".join(["t,x", *rows]), encoding="utf-8")
    (tmp_path / "campaign.toml").write_text(toml_with("[[run]]"), encoding="utf-8")
    campaign = read_campaign(tmp_path)
    assert campaign.noise == {"x": 2e-4}
    assert campaign.runs[0].surface_speed == 0.15


def test_the_system_is_one(tmp_path):
    (tmp_path / "system.toml").write_text(toml_with("[units]"), encoding="utf-8")
    with read_system(tmp_path / "system.toml") as system:
        assert [str(link) for link in system.links] == [
            "mechanics.heat -> thermal.heat",
            "mechanics.surface_speed_actual -> thermal.surface_speed",
            "mechanics.x -> thermal.x",
            "thermal.interface_temperature -> mechanics.interface_temperature",
        ]
        assert [unit.isolate for unit in system.units] == [False, True]
        assert [unit.file.name for unit in system.units] == [NATIVE, THERMAL]


def test_what_is_typed_next_makes_a_rig_and_runs_it(tmp_path):
    """In the environment that runs the tests, in place of the one that the line before made."""
    for command in SHELL[2].splitlines()[1:]:
        done = stickslip_here(tmp_path, *command.split()[1:])
        assert done.returncode == 0, done.stderr
    assert (tmp_path / "results" / "my_rig" / "report.html").exists()


def test_ci_runs_the_line_that_tests():
    assert SHELL[1] in (ROOT / ".ci" / "run").read_text(encoding="utf-8").splitlines()


@pytest.mark.parametrize(
    "command", [pytest.param(c, marks=[pytest.mark.slow] * (c in SLOW)) for c in SESSIONS]
)
def test_a_session_prints_what_is_shown(command, elsewhere):
    if command in SLOW:
        stickslip_here(".", *SLOW[command].split())
    done = stickslip_here(".", *command.split())
    assert done.returncode == 0, done.stderr
    said = set(timeless((done.stdout + done.stderr).splitlines()))
    assert said >= set(timeless(SESSIONS[command]))


def do(cell, names, folder):
    """A cell of a tutorial, as its reader does it: a file is written, a shell or Python runs it."""
    magic, _, rest = cell.partition("\n")
    if magic.startswith("%%writefile "):
        file = folder / magic.split()[1]
        file.parent.mkdir(exist_ok=True)
        file.write_text(rest, encoding="utf-8")
    elif magic == "%%bash":
        subprocess.run(["bash", "-e", "-c", rest], cwd=folder, check=True, timeout=900)
    else:
        exec(cell, names)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["add_an_effect", "belt_length"])
def test_a_tutorial_s_sessions_print_what_is_shown(name, tmp_path, monkeypatch):
    """In a folder where its cells have been done."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "Agg")
    monkeypatch.setenv("PATH", str(Path(sys.executable).parent), prepend=os.pathsep)
    names = {}
    for cell in source(PAGES / f"{name}.md").cells:
        if cell.cell_type == "code":
            do(cell.source, names, tmp_path)
            continue
        for fence in fences(cell.source):
            for command, printed in typed(fence.content):
                done = stickslip_here(tmp_path, *command.split()[1:])
                assert done.returncode == 0, done.stderr
                said = set(timeless((done.stdout + done.stderr).splitlines()))
                assert said >= set(timeless(printed))


@pytest.mark.parametrize("command", NAMED)
def test_commands_have_the_options_that_are_named(command):
    said = stickslip_here(".", command, "--help").stdout
    assert NAMED[command] <= set(re.findall(r"--[a-z][a-z-]+", said))


def test_every_command_is_in_the_readme():
    cells = re.findall(r"\| (`stickslip [^|]+)\|$", README, re.MULTILINE)
    named = re.findall(r"`(?:stickslip )?([a-z-]+)", " ".join(cells))
    assert set(named) == set(COMMANDS)


def test_the_readme_is_two_screens():
    assert len(README.split()) < 800


def test_the_packaged_scenarios_that_are_named_are_there():
    (named,) = re.findall(r"Packaged scenarios: ((?:`\w+`(?:, )?)+)", README)
    names = re.findall(r"`(\w+)`", named)
    assert sorted(names) == packaged_scenarios()
    for name in names:
        assert read_scenario(name).name == name


@pytest.mark.parametrize("name", TEXTS)
def test_files_that_are_named_are_there(name):
    paths = r"`((?:tests|cosim|thermal|build|fmu_src)/[\w/]+\.(?:py|c))`"
    named = re.findall(paths, TEXTS[name])
    if name == "README.md":
        named += re.findall(r"\]\(((?!http)[^)#]+)\)", README)
        assert len(named) > 15
    assert [path for path in named if not (ROOT / path).exists()] == []

"""The README does what it says: its Python runs, its input is read, its commands print that.

Commands that take long are run elsewhere (`stickslip gap` on its example in
tests/interop/test_gap_example.py); here it is asked that they and their options exist.
"""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from cosim import read_scenario
from cosim.cli import main
from cosim.fmu.build import NATIVE, THERMAL, ensure_fmu
from cosim.gap import read_campaign
from cosim.systems import read_system

ROOT = Path(__file__).resolve().parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def blocks(language):
    """Texts of the fenced blocks of a language."""
    return re.findall(rf"^```{language}\n(.*?)^```$", README, re.DOTALL | re.MULTILINE)


def toml_with(table):
    (found,) = [text for text in blocks("toml") if f"[{table}]" in text]
    return found


#: Command -> options that the README gives it anywhere.
COMMANDS = {}
for command, rest in re.findall(r"`stickslip ([a-z][a-z-]*)([^`]*)`", README):
    COMMANDS.setdefault(command, set()).update(re.findall(r"--[a-z][a-z-]+", rest))

#: Sessions in a terminal: a command, and what it prints.
SESSIONS = [
    (command, printed)
    for text in blocks("")
    for command, printed in re.findall(r"^\$ stickslip (.+)\n((?:(?!\$).*\n)*)", text, re.MULTILINE)
]


@pytest.mark.parametrize("number", range(len(blocks("python"))))
def test_python_runs(number, at_home):
    ensure_fmu("build")
    exec(compile(blocks("python")[number], f"README, Python block {number + 1}", "exec"), {})


def test_the_scenario_is_one(at_home):
    Path("soft_springs.toml").write_text(toml_with("springs"), encoding="utf-8")
    scenario = read_scenario("soft_springs.toml")
    assert (scenario.springs.stiffness, scenario.rig.spring_natural_length) == (12.0, 0.17)


def test_the_campaign_is_one(tmp_path):
    rows = [f"{0.01 * i:.2f},{1e-3 * (i % 50):.6f}" for i in range(1000)]
    (tmp_path / "run01.csv").write_text("\n".join(["t,x", *rows]), encoding="utf-8")
    (tmp_path / "campaign.toml").write_text(toml_with("[run]"), encoding="utf-8")
    campaign = read_campaign(tmp_path)
    assert campaign.noise == {"x": 2e-4}
    assert campaign.runs[0].surface_speed == 0.15


def test_the_system_is_one(tmp_path):
    (tmp_path / "system.toml").write_text(toml_with("units"), encoding="utf-8")
    with read_system(tmp_path / "system.toml") as system:
        assert [str(link) for link in system.links] == [
            "mechanics.heat_flow -> thermal.heat_flow",
            "mechanics.surface_speed_actual -> thermal.surface_speed",
            "mechanics.x -> thermal.x",
            "thermal.interface_temperature -> mechanics.interface_temperature",
        ]
        assert [unit.isolate for unit in system.units] == [False, True]
        assert [unit.file.name for unit in system.units] == [NATIVE, THERMAL]


def timeless(line):
    """A line of output without the seconds that computing took."""
    return re.sub(r"[\d.e-]+ s of (wall time|them)", r"... s of \1", line).rstrip()


@pytest.mark.parametrize(("command", "printed"), SESSIONS, ids=lambda text: text.split("\n")[0])
def test_a_session_prints_what_is_shown(command, printed, at_home):
    done = subprocess.run(
        [sys.executable, "-m", "cosim", *command.split()], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    said = {timeless(line) for line in (done.stdout + done.stderr).splitlines()}
    assert said >= {timeless(line) for line in printed.splitlines()}


@pytest.mark.parametrize("command", COMMANDS)
def test_commands_have_the_options_that_are_named(command, capsys):
    with pytest.raises(SystemExit) as end:
        main([command, "--help"])
    assert end.value.code == 0
    assert COMMANDS[command] <= set(re.findall(r"--[a-z][a-z-]+", capsys.readouterr().out))


def test_the_readme_is_what_was_looked_at():
    """There are blocks of every kind; a pattern that finds nothing passes always."""
    assert len(blocks("python")) >= 3 and len(blocks("toml")) >= 2 and SESSIONS
    assert {"run", "simulate", "build", "gap", "belt-length"} <= set(COMMANDS)


def test_the_packaged_scenarios_that_are_named_are_there():
    (named,) = re.findall(r"packaged scenario: ((?:`\w+`(?:, )?)+)", README)
    for name in re.findall(r"`(\w+)`", named):
        assert read_scenario(name).name == name


def test_files_that_are_named_are_there():
    named = re.findall(r"\]\((\.readme/[^)]+)\)", README)
    named += re.findall(r"`((?:tests|cosim|thermal|build|fmu_src)/[\w/]+\.py)`", README)
    assert named and [name for name in named if not (ROOT / name).exists()] == []

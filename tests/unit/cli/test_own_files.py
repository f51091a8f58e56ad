"""What a command finds in the folder that it writes to: its own goes, others' files stay."""

import json
import os
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import pytest
from command_line import SHORT_CASE, refusal

import cosim.files
from cosim import manifest
from cosim.cli import main
from cosim.files import OutputRefused, writable, write_text
from cosim.manifest import MANIFEST, made_by, results_in

SHORT = SHORT_CASE.format(run_up=0.2, duration=0.5, snapshots=0.1)


pytestmark = pytest.mark.usefixtures("elsewhere")


def names_in(folder):
    return {file.relative_to(folder).as_posix() for file in folder.rglob("*") if file.is_file()}


@pytest.mark.parametrize("command", ["gap", "plan"])
def test_an_example_does_not_overwrite_a_campaign(capsys, tmp_path, command):
    example = (command, "--write-example", "mine")
    assert main(example) == 0
    assert main(example) == 0, "what is there is the example itself"
    campaign = tmp_path / "mine" / "campaign.toml"
    written = campaign.read_text()
    campaign.write_text("name = 'three weeks of work'\n")
    line = refusal(capsys, *example)
    assert line.startswith("mine/campaign.toml: is there with other content, allowed is")
    assert "--force" in line
    assert campaign.read_text() == "name = 'three weeks of work'\n"
    assert main([*example, "--force"]) == 0
    assert campaign.read_text() == written


def test_an_example_that_is_refused_writes_none_of_its_files(capsys, tmp_path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "run02.csv").write_bytes(b"\xff measured")
    assert "mine/run02.csv: is there" in refusal(capsys, "gap", "--write-example", "mine")
    assert names_in(tmp_path / "mine") == {"run02.csv"}


def test_the_figures_of_run_do_not_stay_where_simulate_writes(tmp_path):
    """Nor its temperature fields; what somebody else put there does."""
    (tmp_path / "short.toml").write_text(SHORT)
    out = tmp_path / "out"
    assert main(["run", "short.toml", "--fields", "--figures", "-o", "out"]) == 0
    coupled = names_in(out)
    listed = json.loads((out / MANIFEST).read_text())
    assert coupled == {*listed["files"], MANIFEST} and listed["status"] == "complete"
    assert "fields/temperature.pvd" in coupled and "duration = 0.5" in listed["scenario"]
    assert listed["stickslip"] == version("stickslip") and listed["command"]
    (out / "thesis.png").write_text("my own")
    assert main(["simulate", "short.toml", "-o", "out"]) == 0
    assert main(["simulate", "short.toml", "-o", "alone"]) == 0
    assert names_in(out) == names_in(tmp_path / "alone") | {"thesis.png"}
    assert names_in(out) < coupled | {"thesis.png"}
    assert not (out / "fields").exists()


@pytest.mark.parametrize("argv, name", [
    (("simulate", "short.toml"), "result.csv"),
    (("run", "short.toml", "--fields"), "fields/temperature.pvd"),
    (("effects", "film_drag"), "film_drag.png"),
    (("friction-map",), "friction_map.csv"),
    (("stability",), "report.html"),
    (("belt-length",), "doubt.csv"),
    (("sweep", "reference", "--vary", "rig.mass=1"), "sweep.nc"),
    (("reproduce", "C6"), "reproduction.json"),
], ids=lambda given: given[0] if isinstance(given, tuple) else "")  # fmt: skip
def test_a_file_of_somebody_else_is_not_overwritten(capsys, tmp_path, argv, name):
    (tmp_path / "short.toml").write_text(SHORT)
    theirs = tmp_path / "out" / name
    theirs.parent.mkdir(parents=True)
    theirs.write_text("my own")
    line = refusal(capsys, *argv, "-o", "out")
    assert line.startswith(f"out/{name}: is no result of an earlier run")
    assert "--force" in line and theirs.read_text() == "my own"


def test_what_nobody_could_know_of_before_is_kept_beside_it(tmp_path):
    """Names of figures depend on what came out; hours of computing are not refused for one."""
    write_text("my own", tmp_path / "motion.png")
    for kept in ("motion.png.kept1", "motion.png.kept2"):
        write_text("my own", tmp_path / "motion.png")
        (tmp_path / MANIFEST).unlink(missing_ok=True)
        with (
            pytest.warns(UserWarning, match=f"was no result of ours; it is kept as {kept}"),
            results_in(tmp_path, made_by()),
        ):
            write_text("a figure", tmp_path / "motion.png")
        assert (tmp_path / kept).read_text() == "my own"
    assert (tmp_path / "motion.png").read_text() == "a figure"


def test_results_that_were_cut_off_say_so(tmp_path):
    with pytest.raises(RuntimeError), results_in(tmp_path, made_by()):
        write_text("rows", tmp_path / "result.csv")
        raise RuntimeError
    made = json.loads((tmp_path / MANIFEST).read_text())
    assert (made["status"], made["files"]) == ("incomplete", ["result.csv"])


def test_nothing_written_changes_nothing(tmp_path):
    with results_in(tmp_path, made_by()) as results:
        write_text("rows", tmp_path / "result.csv")
        results.complete = True
    before = (tmp_path / MANIFEST).read_bytes()
    with pytest.raises(RuntimeError), results_in(tmp_path, made_by(), ["result.csv"]):
        raise RuntimeError
    assert (tmp_path / MANIFEST).read_bytes() == before
    assert names_in(tmp_path) == {"result.csv", MANIFEST}


@pytest.mark.parametrize(
    "text", ["", "[]", '{"files": 3}', '{"files": ["../mine.txt", "/etc/passwd", "", 3]}']
)
def test_a_list_that_is_damaged_or_leaves_the_folder_owns_nothing(tmp_path, text):
    (tmp_path / "mine.txt").write_text("my own")
    folder = tmp_path / "out"
    folder.mkdir()
    (folder / MANIFEST).write_text(text)
    (folder / "report.html").write_text("my own")
    assert manifest.files_of_earlier(folder) == set()
    with pytest.raises(OutputRefused, match="is no result of an earlier run"):
        manifest.require_own(folder, ["report.html"])
    with results_in(folder, made_by()):
        write_text("rows", folder / "result.csv")
    assert (tmp_path / "mine.txt").read_text() == "my own"


@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="no such device here")
def test_a_device_is_not_read_to_its_end():
    with pytest.raises(OutputRefused, match="no result of this command"):
        manifest.require_json(Path("/dev/zero"), ("status",))


@pytest.mark.skipif(os.name == "nt", reason="whether a process lives is not asked there")
def test_what_a_killed_process_was_writing_goes_with_the_next_run(tmp_path):
    dead = subprocess.Popen([sys.executable, "-c", ""])
    dead.wait()
    host = cosim.files._HOST
    names = [f".result.csv.{host}-{number}.partial" for number in (dead.pid, os.getpid(), 1)]
    others = [".result.csv.another-1.partial", ".result.csv.1.partial", ".partial", "x.partial"]
    for name in names + others:
        (tmp_path / name).touch()
    writable(tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(names[1:] + others)


def test_results_of_another_command_are_not_replaced_without_a_word(tmp_path, capsys, monkeypatch):
    (tmp_path / "short.toml").write_text(SHORT)
    said = "note: out: what this writes replaces the results of `stickslip run short.toml -o out`"
    commands = "run", "run", "simulate", "simulate"
    for command, replaces in zip(commands, (False, False, True, False), strict=True):
        argv = [command, "short.toml", "-o", "out"]
        monkeypatch.setattr("sys.argv", ["stickslip", *argv])
        assert main(argv) == 0
        assert (said in capsys.readouterr().err.splitlines()) == replaces


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="the system has no named pipes")
@pytest.mark.parametrize("name, argv", [
    ("page.html", ["explore", "-o", "page.html", "--no-open"]),
    ("brush.py", ["effect", "new", "brush.py"]),
    ("mine.toml", ["new", "mine"]),
])  # fmt: skip
def test_a_pipe_that_has_a_files_name_is_refused_and_not_read(
    capsys, tmp_path, monkeypatch, name, argv
):
    """Nobody may ever write to it."""
    monkeypatch.chdir(tmp_path)
    os.mkfifo(tmp_path / name)
    assert refusal(capsys, *argv).startswith(f"{name}: ")

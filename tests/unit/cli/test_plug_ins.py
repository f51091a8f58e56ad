"""Commands and custom effects: written, found in what is named, refused in one line."""

import json
import os
import subprocess
import sys

import pytest

from cosim.cli import main
from cosim.cli.plug_ins import digests, files_named
from cosim.coupling.record.folder import UNFINISHED


@pytest.fixture
def brush(tmp_path):
    assert main(["effect", "new", str(tmp_path / "brush.py")]) == 0
    return tmp_path / "brush.py"


def test_a_new_file_does_not_replace_one(brush, capsys):
    brush.write_text("mine", encoding="utf-8")
    assert main(["effect", "new", str(brush)]) == 2
    assert "brush.py" in capsys.readouterr().err and brush.read_text() == "mine"
    assert main(["effect", "new", str(brush), "--force"]) == 0
    assert "EFFECT = Effect(" in brush.read_text()


@pytest.mark.parametrize(
    "name", ["Brush.py", "brush.txt", "2.py", "class.py", "rig.py", "run_in.py"]
)
def test_a_name_that_no_effect_can_have(name, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    try:
        assert main(["effect", "new", name]) == 2
    except SystemExit as stop:  # argparse
        assert stop.code == 2
    assert "allowed is" in capsys.readouterr().err and not list(tmp_path.iterdir())


def test_files_are_found_where_they_are_named(tmp_path):
    scenario, campaign = tmp_path / "case.toml", tmp_path / "room" / "campaign.toml"
    campaign.parent.mkdir()
    scenario.write_text('effects = ["a.py", "deep/b.py"]\n[rig]\nmass = 1\n', encoding="utf-8")
    campaign.write_text('[model]\neffects = ["c.py"]\n', encoding="utf-8")
    (tmp_path / "broken.toml").write_text("effects = [", encoding="utf-8")
    found = [tmp_path / "a.py", tmp_path / "deep" / "b.py"]
    assert files_named(["sweep", str(scenario), "--vary", "rig.mass=1,2"]) == found
    assert files_named(["gap", str(campaign.parent)]) == [campaign.parent / "c.py"]
    assert files_named(["gap", str(campaign)]) == [campaign.parent / "c.py"]
    assert files_named(["compare", str(campaign.parent), str(scenario)]) == found
    assert files_named(["gap", "x.toml", "-o", str(campaign.parent)]) == []
    assert [str(file) for file in files_named(["build", "--effects", "e.py"])] == ["e.py"]
    assert files_named(["effect", "new", "e.py"]) == []
    assert files_named(["run", str(tmp_path / "broken.toml"), "reference"]) == []


@pytest.fixture
def left(tmp_path):
    """A run that was cut off, and the effect that it has: code that tells when it is run."""
    code = tmp_path / "brush.py"
    code.write_text(f"open({str(tmp_path / 'run')!r}, 'w')\n", encoding="utf-8")
    folder = tmp_path / "results" / UNFINISHED
    folder.mkdir(parents=True)
    (folder / "scenario.toml").write_text(f'effects = ["{code}"]\n', encoding="utf-8")
    (folder / "run.json").write_text(json.dumps({"effects": digests([code])}), encoding="utf-8")
    yield folder.parent
    assert not (tmp_path / "run").exists()


def test_a_folder_of_results_alone_runs_no_code(left, capsys):
    for words in (["plot", str(left)], ["compare", str(left), str(left)], ["run", "-o", str(left)]):
        assert files_named(words) == []
    assert main(["run", "--resume", str(left)]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert f"--effects {left.parent / 'brush.py'}" in line and "if you trust them" in line


def test_a_run_goes_on_with_the_effects_that_it_was_begun_with(left, capsys):
    code, other = left.parent / "brush.py", left.parent / "other.py"
    other.write_text("1 / 0\n", encoding="utf-8")
    go_on = ["run", f"--resume={left}", "--effects"]
    assert files_named([*go_on, str(code)]) == [code]
    assert main([*go_on, str(code), str(other)]) == 2
    assert f"{other} is not one of its effects" in capsys.readouterr().err
    code.write_text("1 / 0\n", encoding="utf-8")
    assert main([*go_on, str(code)]) == 2
    assert f"{code} has changed since that began" in capsys.readouterr().err
    code.unlink()
    assert main([*go_on, str(code)]) == 2
    assert f"{code} has changed since that began" in capsys.readouterr().err


def test_effects_without_a_digest_are_not_run(left, capsys):
    for text in ("{}", "[", '{"effects": []}', '{"effects": {"/other.py": ""}}'):
        (left / UNFINISHED / "run.json").write_text(text, encoding="utf-8")
        assert main(["run", "--resume", str(left)]) == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert "begin anew" in line or "--effects /other.py" in line


def test_effects_are_named_beside_resume_only(capsys):
    assert main(["run", "reference", "--effects", "brush.py"]) == 2
    assert "--effects: is for --resume" in capsys.readouterr().err


def test_a_word_can_be_longer_than_a_file_s_name():
    """As the values of a sweep are; such a word is no file, and no error."""
    values = ",".join(f"0.{digit:03d}" for digit in range(100, 200))
    assert files_named(["sweep", "reference", "--vary", f"rig.mass={values}"]) == []
    assert files_named(["simulate", f"{values}.toml"]) == []


@pytest.mark.parametrize(
    ("command", "what"),
    [("simulate", "no such file"), ("gap", "is too long"), ("plan", "too long")],
)
def test_a_name_that_is_too_long_for_a_file(command, what, capsys):
    assert main([command, 300 * "a"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert what in line and "allowed is" in line


def test_effects_cannot_be_set(capsys):
    assert main(["simulate", "reference", "--set", 'effects=["brush.py"]']) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "--set effects=" in line and "STICKSLIP_EFFECTS" in line


def stickslip(*arguments, **variables):
    return subprocess.run(
        [sys.executable, "-m", "cosim", *map(str, arguments)],
        capture_output=True, text=True, env=os.environ | variables,
    )  # fmt: skip


def test_the_catalogue_goes_on_with_it(brush):
    done = stickslip("effects", brush, "--json")
    (entry,) = json.loads(done.stdout)
    assert entry["id"] == "brush" and entry["parameters"][0]["key"] == "brush.fall"


def test_what_is_wrong_with_a_file_is_bad_input(brush, capfd):
    """Also where this process has the model already, and another has to do the work."""
    brush.write_text(brush.read_text().replace("1.0 - fall", "np.cos(fall)"), encoding="utf-8")
    scenario = brush.with_name("case.toml")
    scenario.write_text('effects = ["brush.py"]\n[brush]\nfall = 0.3\n', encoding="utf-8")
    assert main(["simulate", str(scenario), "-o", str(brush.parent / "out")]) == 2
    (line,) = capfd.readouterr().err.splitlines()
    assert line.startswith(f"error: {brush}, line ") and "`np`" in line
    assert not (brush.parent / "out").exists()


def test_a_unit_that_no_unit_has(brush):
    brush.write_text(brush.read_text().replace('"m/s"', '"furlong"'), encoding="utf-8")
    done = stickslip("effects", "brush", STICKSLIP_EFFECTS=str(brush))
    assert done.returncode == 2
    assert "onset is in 'furlong'" in done.stderr and "m/s2" in done.stderr

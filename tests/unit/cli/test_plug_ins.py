"""Commands and custom effects: written, found in what is named, refused in one line."""

import json

import pytest
from command_line import refusal

from cosim.cli import main
from cosim.cli.runs.run import check_resumed, digests
from cosim.coupling.record.folder import UNFINISHED


@pytest.fixture
def brush(tmp_path):
    assert main(["effect", "new", str(tmp_path / "brush.py")]) == 0
    return tmp_path / "brush.py"


def test_a_new_file_does_not_replace_one(brush, capsys):
    brush.write_text("mine", encoding="utf-8")
    assert "brush.py" in refusal(capsys, "effect", "new", brush) and brush.read_text() == "mine"
    assert main(["effect", "new", str(brush), "--force"]) == 0
    assert "EFFECT = Effect(" in brush.read_text()


@pytest.mark.parametrize(
    "name", ["Brush.py", "brush.txt", "2.py", "class.py", "rig.py", "run_in.py"]
)
def test_a_name_that_no_effect_can_have(name, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert "allowed is" in refusal(capsys, "effect", "new", name)
    assert not list(tmp_path.iterdir())


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
    refusal(capsys, "plot", left)
    refusal(capsys, "compare", left, left)
    line = refusal(capsys, "run", "--resume", left)
    assert f"--effects {left.parent / 'brush.py'}" in line and "if you trust them" in line


def test_a_run_goes_on_with_the_effects_that_it_was_begun_with(left, capsys):
    code, other = left.parent / "brush.py", left.parent / "other.py"
    other.write_text("1 / 0\n", encoding="utf-8")
    go_on = ["run", f"--resume={left}", "--effects"]
    check_resumed(left, [str(code)])  # allows it
    assert f"{other} is not one of its effects" in refusal(capsys, *go_on, code, other)
    code.write_text("1 / 0\n", encoding="utf-8")
    assert f"{code} has changed since that began" in refusal(capsys, *go_on, code)
    code.unlink()
    assert f"{code} has changed since that began" in refusal(capsys, *go_on, code)


def test_effects_without_a_digest_are_not_run(left, capsys):
    for text in ("{}", "[", '{"effects": []}', '{"effects": {"/other.py": ""}}'):
        (left / UNFINISHED / "run.json").write_text(text, encoding="utf-8")
        line = refusal(capsys, "run", "--resume", left)
        assert "begin anew" in line or "--effects /other.py" in line


def test_effects_are_named_beside_resume_only(capsys):
    line = refusal(capsys, "run", "reference", "--effects", "brush.py")
    assert "--effects: is for --resume" in line


@pytest.mark.parametrize(
    ("command", "what"),
    [("simulate", "no such file"), ("gap", "is too long"), ("plan", "too long")],
)
def test_a_name_that_is_too_long_for_a_file(command, what, capsys):
    line = refusal(capsys, command, 300 * "a")
    assert what in line and "allowed is" in line


def test_effects_cannot_be_set(capsys):
    line = refusal(capsys, "simulate", "reference", "--set", 'effects=["brush.py"]')
    assert "--set effects=" in line and "STICKSLIP_EFFECTS" in line


def test_the_catalogue_goes_on_with_it(brush, capsys):
    assert main(["effects", str(brush), "--json"]) == 0
    (entry,) = json.loads(capsys.readouterr().out)
    assert entry["id"] == "brush" and entry["parameters"][0]["key"] == "brush.fall"


def test_what_is_wrong_with_a_file_is_bad_input(brush, capsys):
    brush.write_text(brush.read_text().replace("1.0 - fall", "np.cos(fall)"), encoding="utf-8")
    scenario = brush.with_name("case.toml")
    scenario.write_text('effects = ["brush.py"]\n[brush]\nfall = 0.3\n', encoding="utf-8")
    line = refusal(capsys, "simulate", scenario, "-o", brush.parent / "out")
    assert line.startswith(f"{scenario}: effects: {brush}, line ") and "`np`" in line
    assert not (brush.parent / "out").exists()

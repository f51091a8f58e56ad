"""Figures of a result, drawn when they are asked for."""

import json

import pytest
from command_line import refusal

from cosim.cli import main

SHORT = "[run]\nduration = 0.5\n"


@pytest.fixture
def result(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "short.toml").write_text(SHORT)
    assert main(["simulate", "short.toml", "-o", "out"]) == 0
    return tmp_path / "out"


def test_those_named_are_drawn_and_belong_to_the_result(result, capsys):
    capsys.readouterr()
    assert main(["plot", "out", "motion", "phase_portrait"]) == 0
    assert capsys.readouterr().out.split() == ["out/motion.png", "out/phase_portrait.png"]
    assert (result / "motion.png").read_bytes().startswith(b"\x89PNG")
    assert main(["plot", "out", "motion"]) == 0  # once more, over its own
    made = json.loads((result / "made_by.json").read_text())
    assert {"motion.png", "phase_portrait.png", "result.nc"} <= set(made["files"])
    assert made["status"] == "complete" and made["command"]
    assert main(["simulate", "short.toml", "-o", "out"]) == 0  # a new run takes them away
    assert not list(result.glob("*.png"))


def test_all_of_them_without_a_name(result):
    assert main(["plot", "out"]) == 0
    assert {"top_view.png", "motion.png", "heat.png"} <= {p.name for p in result.glob("*.png")}


def test_refusals(result, capsys):
    line = refusal(capsys, "plot", "out", "moton")
    assert "no figure of this run is named 'moton'; nearest: 'motion'" in line
    assert "holds no result.nc" in refusal(capsys, "plot", ".")
    (result / "heat.png").write_text("my own")
    assert "out/heat.png: is no result of an earlier run" in refusal(capsys, "plot", "out", "heat")
    assert (result / "heat.png").read_text() == "my own"
    assert main(["plot", "out", "heat", "--force"]) == 0

"""`stickslip gap`: files, JSON, refusals, interruptions."""

import json

import gap_answers as answers
import numpy as np
import pytest
from command_line import refusal
from gap_campaigns import write_campaign

from cosim.cli import main
from cosim.cli.measurements import gap as gap_command
from cosim.gap import find, read_campaign
from cosim.gap.result import Doubt
from cosim.gap.show import figures

DATA = {"gap.json", "model.toml", "made_by.json"}


@pytest.fixture
def found(gap, monkeypatch):
    """A search that has this answer; the path of its campaign."""
    asked = []
    monkeypatch.setattr(gap_command, "_find", lambda *given: asked.append(given) or gap)
    return str(gap.campaign.path), asked


def test_command_leaves_its_files(found, tmp_path, capsys):
    campaign, asked = found
    given = ["-o", str(tmp_path / "out"), "--json", str(tmp_path / "copy.json")]
    assert main(["gap", campaign, *given, "--seed", "7", "--jobs", "1"]) == 0
    assert asked[0][1:3] == (7, 1)
    for name in ("gap.json", "model.toml", "report.html", "ladder.png", "curve.png", "run.png"):
        assert (tmp_path / "out" / name).stat().st_size > 0
    assert (tmp_path / "copy.json").read_text() == (tmp_path / "out" / "gap.json").read_text()
    out = capsys.readouterr().out
    assert out.startswith("cold room, week 3: named\n  Kinetic friction falls")
    assert str(tmp_path / "out" / "model.toml") in out


def test_corrected_data_are_told_of(gap, tmp_path, capsys, monkeypatch):
    faulty = answers.with_a_fault(gap, scale=0.02)
    monkeypatch.setattr(gap_command, "_find", lambda *given: faulty)
    assert main(["gap", str(gap.campaign.path), "-o", str(tmp_path)]) == 0
    assert "corrected/campaign.toml" in capsys.readouterr().out
    assert "freed of measurement.scale" in (tmp_path / "report.html").read_text()


def test_a_doubt_that_nothing_can_answer_is_said_before_the_search(
    found, tmp_path, capsys, monkeypatch
):
    doubt = Doubt("units", "run01: mass in g?", ("run01",), True)
    monkeypatch.setattr("cosim.gap.checks.doubts_of", lambda campaign: (doubt,))
    told = []
    monkeypatch.setattr(gap_command, "_find", lambda *given: told.append(capsys.readouterr().err))
    assert main(["gap", found[0], "-o", str(tmp_path)]) == 1  # this search has no answer
    assert "run01: mass in g?; effects are not searched for" in told[0]


def test_json_on_standard_output_is_nothing_but_json(found, tmp_path, capsys):
    assert main(["gap", found[0], "-o", str(tmp_path), "--json", "-", "--no-page"]) == 0
    out, err = capsys.readouterr()
    assert json.loads(out)["verdict"] == "named"
    assert "velocity_weakening" in err and "report.html" not in err
    assert {file.name for file in tmp_path.iterdir()} == DATA


def test_the_folder_has_the_campaigns_name(found, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["gap", found[0], "--no-page"]) == 0
    assert (tmp_path / "results" / "cold-room-week-3-gap" / "gap.json").is_file()


def test_ctrl_c_while_drawing_keeps_the_answer(found, tmp_path, capsys, monkeypatch):
    def interrupted(*given):
        raise KeyboardInterrupt

    monkeypatch.setattr(figures, "draw_run", interrupted)
    assert main(["gap", found[0], "-o", str(tmp_path)]) == 1
    assert {file.name for file in tmp_path.iterdir()} == DATA | {"ladder.png", "curve.png"}
    assert "interrupted while drawing" in capsys.readouterr().err


def test_ctrl_c_before_there_is_an_answer(gap, tmp_path, capsys, monkeypatch):
    def interrupted(*given):
        raise KeyboardInterrupt

    monkeypatch.setattr(gap_command, "_find", interrupted)
    assert main(["gap", str(gap.campaign.path), "-o", str(tmp_path)]) == 1
    assert "interrupted before there was a result" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_the_bar_moves_with_every_step_of_a_model_and_ends_once():
    seen = []
    step = find._Steps(lambda done, total: seen.append(done / total))
    for _ in range(12):
        step()
    step.end()
    assert seen[0] < 0.05 and seen[-2] < 1.0 == seen[-1]
    assert all(np.diff(seen) > 0.0)


def test_runs_of_figures_alone_have_their_own_way(tmp_path, monkeypatch):
    asked = []
    monkeypatch.setattr(
        "cosim.studies.reproduction.summary.find_summary_gap",
        lambda campaign, **given: asked.append(campaign),
    )
    run = {"summary": {"frequency": [1.7, 0.05]}}
    campaign = read_campaign(write_campaign(tmp_path, [run]))
    with gap_command.Bar(disable=True) as bar:
        gap_command._find(campaign, 0, 1, bar)
    assert asked == [campaign]


@pytest.mark.parametrize(
    "arguments, said",
    [
        (["no/such.toml"], "no/such.toml: no such file"),
        (["study", "--jobs", "0"], "0 is not allowed, allowed is 1 or more"),
        (["study", "--seed", "-3"], "'-3' is not allowed"),
        (["study", "--json", "gap_command_is_a_folder"], "is a folder"),
    ],
)
def test_refusals_are_one_line(arguments, said, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "gap_command_is_a_folder").mkdir()
    assert said in refusal(capsys, "gap", *arguments)


def test_packaged_campaigns_are_found_by_name():
    assert "study" in gap_command.PACKAGED
    assert gap_command._source("study").is_file()

"""A law that the catalogue lacks, hidden in data by the independent generator, named by `gap`."""

import json
from pathlib import Path

from blind.campaign import draw_campaign
from blind.writing import write_campaign
from command_line import stickslip

EFFECT = Path(__file__).resolve().parents[2] / "examples" / "effects" / "flash_heating.py"
#: Rows of a run, with the header: six seconds are enough for a name.
SHORT = 601


def test_it_is_named_and_the_model_that_has_it_is_a_scenario(tmp_path):
    room, answers, out = tmp_path / "room", tmp_path / "answers.json", tmp_path / "out"
    hidden = draw_campaign(8, "unknown", ["flash_heating"], (15.0, 40.0))
    write_campaign(hidden, room, answers, "room")
    for file in room.glob("*.csv"):
        rows = file.read_text(encoding="utf-8").splitlines(keepends=True)[:SHORT]
        file.write_text("".join(rows), encoding="utf-8")
    (room / EFFECT.name).write_text(EFFECT.read_text(encoding="utf-8"), encoding="utf-8")
    with (room / "campaign.toml").open("a", encoding="utf-8") as campaign:
        campaign.write(f'\n[model]\neffects = ["{EFFECT.name}"]\n')
    done = stickslip(tmp_path, "gap", room, "-o", out, "--no-page")
    assert done.returncode == 0, done.stderr
    found = json.loads((out / "gap.json").read_text(encoding="utf-8"))
    assert (found["verdict"], found["effects"]) == ("named", ["flash_heating"])
    # a whole repair: near the noise in runs that no fit has seen
    assert found["gap"]["after"]["held_out"] < 1.5 < found["gap"]["before"]["held_out"]
    assert EFFECT.name in (out / "model.toml").read_text(encoding="utf-8")
    done = stickslip(tmp_path, "simulate", out / "model.toml", "-o", tmp_path / "motion")
    assert done.returncode == 0, done.stderr
    summary = json.loads((tmp_path / "motion" / "summary.json").read_text(encoding="utf-8"))
    assert summary["status"] == "complete"

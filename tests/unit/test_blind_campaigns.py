"""Hidden campaigns: files repeat, and answers do not leak."""

import json
import tomllib

import pytest
from blind.campaign import draw_campaign
from blind.effects import EFFECTS
from blind.out_of_catalogue import OUT_OF_CATALOGUE
from blind.writing import write_campaign

pytestmark = pytest.mark.slow  # numba compiles the simulator, and no answer hangs on it
ALL = EFFECTS | OUT_OF_CATALOGUE


def test_files_hold_no_answer_and_repeat_byte_for_byte(tmp_path):
    made = draw_campaign(11, "effects", ["speed_ripple"], tries=1)
    told = write_campaign(made, tmp_path / "a" / "c", tmp_path / "answers" / "c.json", "c")
    again = draw_campaign(11, "effects", ["speed_ripple"], tries=1)
    write_campaign(again, tmp_path / "b" / "c", tmp_path / "answers" / "again.json", "c")
    files = sorted(file.name for file in (tmp_path / "a" / "c").iterdir())
    assert files == ["campaign.toml", *(f"run{i:02d}.csv" for i in range(1, 7))]
    for name in files:
        text = (tmp_path / "a" / "c" / name).read_bytes()
        assert text == (tmp_path / "b" / "c" / name).read_bytes()
        assert not any(word.encode() in text for word in ALL)
    assert told["effects"] == ["speed_ripple"] and told["verdict"] == "named"
    assert json.loads((tmp_path / "answers" / "c.json").read_text())["seed"] == 11
    table = tomllib.loads((tmp_path / "a" / "c" / "campaign.toml").read_text())
    assert [run["hold_out"] for run in table["run"]].count(True) == 2


def test_an_answer_beside_the_data_is_refused(tmp_path):
    made = draw_campaign(3, "none")
    with pytest.raises(ValueError, match="must not lie"):
        write_campaign(made, tmp_path, tmp_path / "answer.json", "c")

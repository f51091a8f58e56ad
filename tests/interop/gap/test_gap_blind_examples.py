"""The command on campaigns with a hidden effect that another program made, from files to a name."""

import json
import shutil

import pytest
from command_line import stickslip

from cosim.gap.laws import SHAPES

pytestmark = pytest.mark.slow
#: Rows of a run, with the header, that are enough for a name: six seconds.
SHORT = 601


@pytest.fixture(scope="module", params=["e1", "e2"])
def asked(request, shared, tmp_path_factory):
    """Folder of the first seconds of an example's runs, with its answer in `out`; the true one."""
    example, folder = (
        shared("data/blind_examples") / request.param,
        tmp_path_factory.mktemp(request.param),
    )
    shutil.copyfile(example / "campaign.toml", folder / "campaign.toml")
    for file in example.glob("*.csv"):
        rows = file.read_text(encoding="utf-8").splitlines(keepends=True)[:SHORT]
        (folder / file.name).write_text("".join(rows), encoding="utf-8")
    done = stickslip(folder, "gap", folder, "-o", folder / "out", "--no-page")
    assert done.returncode == 0, done.stderr
    truth = json.loads((example.parent / "answers.json").read_text(encoding="utf-8"))
    return folder, truth[request.param]


def test_the_answer_is_the_right_one_and_the_gap_as_it_says(asked):
    """Closed by what was named, or never open; every effect along x is ranked, without a trace."""
    folder, truth = asked
    answer = json.loads((folder / "out" / "gap.json").read_text(encoding="utf-8"))
    assert answer["verdict"] == truth["verdict"]
    assert answer["effects"] == truth.get("effects", [])
    before, after = (answer["gap"][when]["held_out"] for when in ("before", "after"))
    assert after <= 1.5
    assert before >= 2.0 if truth["verdict"] == "named" else before == after
    ranked = {each["effect"] for each in answer["ranking"]}
    # one mass: there is nothing to see a dependence on load by
    assert ranked >= {*SHAPES, "surface_pattern", "speed_ripple"}


def test_the_extended_model_is_a_scenario(asked):
    folder, truth = asked
    text = (folder / "out" / "model.toml").read_text(encoding="utf-8")
    assert all(f"[{effect}]" in text for effect in truth.get("effects", []))
    done = stickslip(folder, "simulate", folder / "out" / "model.toml", "-o", folder / "motion")
    assert done.returncode == 0, done.stderr
    summary = json.loads((folder / "motion" / "summary.json").read_text(encoding="utf-8"))
    assert summary["status"] == "complete"


def test_the_same_input_gives_the_same_bytes(asked):
    """With one process and with two."""
    folder, _ = asked
    done = stickslip(folder, "gap", folder, "-o", folder / "again", "--no-page", "--jobs", 1)
    assert done.returncode == 0, done.stderr
    for name in ("gap.json", "model.toml"):
        assert (folder / "again" / name).read_bytes() == (folder / "out" / name).read_bytes()

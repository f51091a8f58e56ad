"""The command on campaigns with a hidden effect that another program made, from files to a name."""

import json
import os
import shutil
import subprocess
import sys
from functools import cache

import pytest

from cosim.gap.laws import SHAPES

#: Nothing hidden, and an effect.
NAMES = tuple(pytest.param(name, marks=pytest.mark.slow) for name in ("e1", "e2"))
#: Held-out gap, 1 for noise, that counts as a gap and that counts as closed.
OPEN, CLOSED = 2.0, 1.5
#: Rows of a run, with the header, that are enough for a name: six seconds.
SHORT = 601


def stickslip(*arguments):
    environment = os.environ | dict.fromkeys(("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
    return subprocess.run(
        [sys.executable, "-m", "cosim", *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=1200,
        env=environment,
    )


@pytest.fixture(scope="module")
def examples(shared):
    return shared("data/blind_examples")


@pytest.fixture(scope="module")
def answers(examples):
    return json.loads((examples / "answers.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def short(examples, tmp_path_factory):
    """Name of an example -> folder of the first seconds of its runs."""

    @cache
    def cut(name):
        folder = tmp_path_factory.mktemp(f"short_{name}")
        shutil.copyfile(examples / name / "campaign.toml", folder / "campaign.toml")
        for file in (examples / name).glob("*.csv"):
            rows = file.read_text(encoding="utf-8").splitlines(keepends=True)[:SHORT]
            (folder / file.name).write_text("".join(rows), encoding="utf-8")
        return folder

    return cut


@pytest.fixture(scope="module")
def found(short, tmp_path_factory):
    """Name of an example -> folder of its answer, computed once."""

    @cache
    def look(name):
        folder = tmp_path_factory.mktemp(name)
        done = stickslip("gap", short(name), "-o", folder, "--no-page")
        assert done.returncode == 0, done.stderr
        assert "Traceback" not in done.stderr
        return folder

    return look


def answer_in(folder):
    return json.loads((folder / "gap.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", NAMES)
def test_the_verdict_is_the_right_one(name, found, answers):
    answer = answer_in(found(name))
    assert answer["verdict"] == answers[name]["verdict"]
    assert answer["effects"] == answers[name].get("effects", [])


@pytest.mark.parametrize("name", NAMES)
def test_the_gap_is_as_the_verdict_says(name, found, answers):
    """Closed by what was named, or never open."""
    gap = answer_in(found(name))["gap"]
    before, after = gap["before"]["held_out"], gap["after"]["held_out"]
    verdict = answers[name]["verdict"]
    if verdict == "named":
        assert before >= OPEN and after <= CLOSED
    else:
        assert verdict == "none" and after == before <= CLOSED


@pytest.mark.parametrize("name", NAMES)
def test_every_effect_along_x_is_ranked(name, found):
    """Also those of which there is no trace, at next to nothing."""
    ranked = {each["effect"] for each in answer_in(found(name))["ranking"]}
    assert ranked >= set(SHAPES)  # one mass: there is nothing to see a dependence on load by
    assert {"surface_pattern", "speed_ripple"} <= ranked


@pytest.mark.slow
def test_the_extended_model_is_a_scenario(found, tmp_path):
    model = found("e2") / "model.toml"
    assert "[velocity_weakening]" in model.read_text(encoding="utf-8")
    done = stickslip("simulate", model, "-o", tmp_path / "motion")
    assert done.returncode == 0, done.stderr
    summary = json.loads((tmp_path / "motion" / "summary.json").read_text(encoding="utf-8"))
    assert summary["status"] == "complete"


@pytest.mark.slow
def test_the_same_input_gives_the_same_bytes(short, found, tmp_path):
    """With one process and with two."""
    done = stickslip("gap", short("e1"), "-o", tmp_path, "--no-page", "--jobs", 1)
    assert done.returncode == 0, done.stderr
    for name in ("gap.json", "model.toml"):
        assert (tmp_path / name).read_bytes() == (found("e1") / name).read_bytes()

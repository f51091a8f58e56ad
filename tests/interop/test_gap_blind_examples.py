"""The command on campaigns with a hidden effect that another program made, from files to a name."""

import json
import os
import shutil
import subprocess
import sys
from functools import cache

import pytest

#: The fifth, of which nobody knows a name, takes as long as the others together: it is asked in
#: tests/benchmarks/blind_examples.py.
NAMES = ("e1", "e2", "e3", "e4")
#: Held-out gap, 1 for noise, that counts as a gap and that counts as closed.
OPEN, CLOSED = 2.0, 1.5
#: Rows of a run, with the header, that are enough to compare two answers byte by byte.
SHORT = 401


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
def found(examples, tmp_path_factory):
    """Name of an example -> folder of its answer, computed once."""

    @cache
    def look(name):
        folder = tmp_path_factory.mktemp(name)
        done = stickslip("gap", examples / name, "-o", folder, "--no-page")
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


@pytest.mark.parametrize("name", ["e1", "e2"])
def test_every_effect_along_x_is_ranked(name, found):
    """Also those of which there is no trace, at next to nothing."""
    ranked = {each["effect"] for each in answer_in(found(name))["ranking"]}
    assert ranked == {
        "film_drag", "load_dependence", "run_in", "speed_ripple", "spring_hardening",
        "static_strengthening", "structural_damping", "surface_pattern", "thermal_weakening",
        "velocity_weakening",
    }  # fmt: skip


def test_the_extended_model_is_a_scenario(found, tmp_path):
    model = found("e2") / "model.toml"
    assert "[velocity_weakening]" in model.read_text(encoding="utf-8")
    done = stickslip("simulate", model, "-o", tmp_path / "motion")
    assert done.returncode == 0, done.stderr
    summary = json.loads((tmp_path / "motion" / "summary.json").read_text(encoding="utf-8"))
    assert summary["status"] == "complete"


@pytest.fixture(scope="module")
def short(examples, tmp_path_factory):
    """The first four seconds of every run of e1."""
    folder = tmp_path_factory.mktemp("short")
    shutil.copyfile(examples / "e1" / "campaign.toml", folder / "campaign.toml")
    for file in (examples / "e1").glob("*.csv"):
        rows = file.read_text(encoding="utf-8").splitlines(keepends=True)[:SHORT]
        (folder / file.name).write_text("".join(rows), encoding="utf-8")
    return folder


def test_the_same_input_gives_the_same_bytes(short, tmp_path):
    """With one process and with two: a shorter e1, so that it is no wait."""
    written = []
    for number, jobs in enumerate((1, 2)):
        folder = tmp_path / str(number)
        done = stickslip("gap", short, "-o", folder, "--no-page", "--jobs", jobs)
        assert done.returncode == 0, done.stderr
        written.append([(folder / name).read_bytes() for name in ("gap.json", "model.toml")])
    assert written[0] == written[1]

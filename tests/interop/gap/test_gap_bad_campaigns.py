"""What the command says of campaigns that are bad, or hold too little: a line, or a verdict."""

import json

import numpy as np
import pytest
from gap_campaigns import NOISE, motion, noisy, write_campaign

from cosim.cli import main


def run_of(seed=1, speed=0.06, duration=4.0, **more):
    """A run that sticks and slips, as a table of [[run]] with its columns."""
    done = motion(speed=speed, duration=duration, **more)
    return {"surface_speed": speed, "columns": {"t": done.time, "x": noisy(done["x"], seed)}}


def said(folder, capsys, runs, **tables):
    """Status and lines of `stickslip gap` on these runs, and its answer where there is one."""
    campaign = write_campaign(folder, runs, **tables)
    out = folder / "out"
    status = main(["gap", str(campaign), "-o", str(out), "--no-page", "--jobs", "1"])
    written = out / "gap.json"
    answer = json.loads(written.read_text(encoding="utf-8")) if written.exists() else None
    err = capsys.readouterr().err
    assert "Traceback" not in err and "Warning" not in err
    return status, err, answer


@pytest.mark.parametrize(
    ("run", "tables", "words"),
    [
        ({"columns": {"t": [0.0, 0.1], "x": [0.0, 1.0]}}, {}, ("column x: 2 samples", "allowed")),
        ({"mass": "heavy"}, {}, ("run 1: mass", '"heavy"', "allowed")),
        ({}, {"noise": {"x": 1e300}}, ("noise.x", "1e+300", "allowed")),
    ],
)
def test_what_cannot_be_read_is_refused_in_one_line(run, tables, words, tmp_path, capsys):
    """As the reader does, whose own tests have all the cases; nothing is left in the folder."""
    status, err, answer = said(tmp_path, capsys, [{**run_of(), **run}], **tables)
    assert (status, err.count("\n"), answer) == (2, 1, None)
    assert all(word in err for word in (str(tmp_path), *words)), err
    assert not (tmp_path / "out").exists() or not list((tmp_path / "out").iterdir())


def test_a_file_that_is_a_folder_is_refused(tmp_path, capsys):
    (tmp_path / "run01.csv").mkdir()
    status, err, _ = said(tmp_path, capsys, [{"file": "run01.csv"}])
    assert (status, err.count("\n")) == (2, 1) and "run01.csv" in err


def holed(run, rows):
    run["columns"]["x"][rows] = np.nan
    return run


#: Runs that hold too little to name anything, yet no fault, and what is said of them.
LITTLE = {
    "a single run": (lambda: [run_of()], "no run is held out"),
    "no slip": (lambda: [run_of(1, 0.001), run_of(2, 0.0015)], "no slip is seen"),
    "no stick": (lambda: [run_of(seed, speed, initial={"x": 0.03})
                          for seed, speed in ((1, 0.4), (2, 0.5))], "no stick is seen"),
    "duplicates": (lambda: [run_of(), run_of(), run_of(2)],
                   "run02 holds the same data as run01: left out"),
    "holes": (lambda: [holed(run_of(1), slice(50, 120)), holed(run_of(2), slice(None, None, 7))],
              ""),
}  # fmt: skip


@pytest.mark.parametrize("case", LITTLE)
def test_too_little_gets_a_verdict_with_its_reasons(case, tmp_path, capsys):
    """None of these holds an effect: no name may come out of nothing."""
    runs, words = LITTLE[case]
    status, err, answer = said(tmp_path, capsys, runs(), noise={"x": NOISE})
    assert status == 0 and words in err
    assert answer["verdict"] in ("none", "unknown") and answer["effects"] == []
    assert 0.8 < answer["gap"]["after"]["fit"] < 1.3
    assert (answer["gap"]["before"]["held_out"] is None) == (case == "a single run")

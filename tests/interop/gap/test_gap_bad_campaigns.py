"""What the command says of campaigns that are bad, or hold too little: a line, or a verdict."""

import json

import numpy as np
import pytest
from gap_campaigns import NOISE, motion, noisy, write_campaign

from cosim.cli import main

KNOWN_NOISE = {"x": NOISE}


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


# Too little to name anything, yet no fault: a verdict with its reasons.


def check_reasoned(status, answer):
    """None of these holds an effect: no name may come out of nothing."""
    assert status == 0
    assert answer["verdict"] in ("none", "unknown") and answer["effects"] == []
    assert 0.8 < answer["gap"]["after"]["fit"] < 1.3


def test_a_single_run_gets_a_verdict(tmp_path, capsys):
    status, err, answer = said(tmp_path, capsys, [run_of()], noise=KNOWN_NOISE)
    check_reasoned(status, answer)
    assert answer["gap"]["before"]["held_out"] is None  # nothing was
    assert "no run is held out" in err


def test_runs_without_any_slip_get_a_verdict(tmp_path, capsys):
    runs = [run_of(1, 0.001), run_of(2, 0.0015)]
    status, err, answer = said(tmp_path, capsys, runs, noise=KNOWN_NOISE)
    assert "no slip is seen" in err
    check_reasoned(status, answer)


def test_runs_without_any_stick_get_a_verdict(tmp_path, capsys):
    runs = [run_of(seed, speed, initial={"x": 0.03}) for seed, speed in ((1, 0.4), (2, 0.5))]
    status, err, answer = said(tmp_path, capsys, runs, noise=KNOWN_NOISE)
    check_reasoned(status, answer)
    assert "no stick is seen" in err


def test_duplicates_are_counted_once(tmp_path, capsys):
    same = run_of()
    status, err, answer = said(tmp_path, capsys, [same, same, run_of(2)], noise=KNOWN_NOISE)
    check_reasoned(status, answer)
    assert "run02 holds the same data as run01: left out" in err


def test_a_track_with_holes_gets_a_verdict(tmp_path, capsys):
    runs = [run_of(1), run_of(2)]
    runs[0]["columns"]["x"][50:120] = np.nan
    runs[1]["columns"]["x"][::7] = np.nan
    status, _, answer = said(tmp_path, capsys, runs, noise=KNOWN_NOISE)
    check_reasoned(status, answer)

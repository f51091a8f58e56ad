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


def test_what_cannot_be_read_is_refused_in_one_line(tmp_path, capsys):
    """As the reader does, whose own tests have all the cases; nothing is left in the folder."""
    status, err, answer = said(tmp_path, capsys, [{**run_of(), "mass": "heavy"}])
    assert (status, err.count("\n"), answer) == (2, 1, None)
    assert all(word in err for word in (str(tmp_path), "run 1: mass", '"heavy"', "allowed")), err
    assert not (tmp_path / "out").exists() or not list((tmp_path / "out").iterdir())
    (tmp_path / "folder.csv").mkdir()
    status, err, _ = said(tmp_path, capsys, [{"file": "folder.csv"}])
    assert (status, err.count("\n")) == (2, 1) and "folder.csv" in err


def with_holes():
    runs = [run_of(1), run_of(2)]
    runs[0]["columns"]["x"][50:120] = np.nan
    runs[1]["columns"]["x"][::7] = np.nan
    return runs


#: Too little to name anything, yet no fault: a verdict with its reasons.
LITTLE = {
    "a single run": (lambda: [run_of()], "no run is held out"),
    "no slip": (lambda: [run_of(1, 0.001), run_of(2, 0.0015)], "no slip is seen"),
    "no stick": (lambda: [run_of(seed, 0.3 + 0.1 * seed, initial={"x": 0.03}) for seed in (1, 2)],
        "no stick is seen"),
    "holes": (with_holes, ""),
}  # fmt: skip


@pytest.mark.parametrize("case", LITTLE)
def test_too_little_gets_a_verdict(case, tmp_path, capsys):
    """None of these holds an effect: no name may come out of nothing."""
    runs, remark = LITTLE[case]
    status, err, answer = said(tmp_path, capsys, runs(), noise={"x": NOISE})
    assert status == 0 and remark in err
    assert answer["verdict"] in ("none", "unknown") and answer["effects"] == []
    assert 0.8 < answer["gap"]["after"]["fit"] < 1.3
    assert case != "a single run" or answer["gap"]["before"]["held_out"] is None

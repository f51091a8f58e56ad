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


def without(name):
    return lambda columns: {key: v for key, v in columns.items() if key != name}


def times(name, factor):
    return lambda columns: {**columns, name: columns[name] * factor}


def swapped(columns):
    time = columns["t"].copy()
    time[[40, 41]] = time[[41, 40]]
    return {**columns, "t": time}


#: What is done to the columns of the second run, and words that the one line must hold: its key,
#: the value, what is allowed.
BAD_COLUMNS = {
    "no x": (without("x"), ("column x", "missing (there: t)", "allowed is t,x")),
    "no t": (without("t"), ("column t", "missing", "allowed")),
    "mm for m": (times("x", 1e3), ("column x", "are these millimetres?")),
    "ms for s": (times("t", 1e3), ("column t", "are these milliseconds?")),
    "thousandths of a second": (
        times("t", 1e-3),
        ("column t", "covers 0.004 s", "allowed is at least half", "divided by 1000"),
    ),
    "a hole of years": (
        lambda c: {**c, "t": c["t"] + 3e8 * (c["t"] > 2.0)},
        ("line 203", "t = 300000002.01 s", "3e+08 s after", "up to 100 times"),
    ),
    "days of a stiff rig": (
        lambda c: {**c, "t": np.linspace(0.0, 1e5, c["t"].size)},
        ("column t", "allowed is at most half"),
    ),
    "time not increasing": (swapped, ("line 43", "t = 0.4 s", "falls back", "allowed")),
    "3 samples": (
        lambda c: {k: v[:3] for k, v in c.items()},
        ("column x", "3 samples", "at least 20"),
    ),
    "all NaN": (times("x", np.nan), ("column x", "no samples", "at least 20")),
}


@pytest.mark.parametrize("case", BAD_COLUMNS)
def test_bad_columns_are_refused_in_one_line(case, tmp_path, capsys):
    change, words = BAD_COLUMNS[case]
    bad = run_of(2)
    bad["columns"] = change(bad["columns"])
    status, err, answer = said(tmp_path, capsys, [run_of(1), bad], noise=KNOWN_NOISE)
    assert (status, err.count("\n"), answer) == (2, 1, None)
    assert all(word in err for word in (str(tmp_path / "run02.csv"), *words)), err
    assert not (tmp_path / "out").exists() or not list((tmp_path / "out").iterdir())


BAD_TABLES = {
    "every run held out": ({"hold_out": True}, ("hold_out", "true in every run", "allowed is")),
    "a file that is not there": (
        {"file": "gone.csv", "columns": None},
        ("gone.csv", "no such file", "allowed is a CSV file"),
    ),
    "unknown key": ({"speed": 0.06}, ("run 1: speed: no such key", "known: file, mass")),
    "a word for a number": ({"mass": "heavy"}, ("run 1: mass", '"heavy"')),
    "a surface faster than any": (
        {"surface_speed": 1e9},
        ("run 1: surface_speed", "1000000000", "at most 1000 m/s"),
    ),
    "springs of a hammer": (
        {"stiffness": 1e9},
        ("run01.csv", "column t", "0.01 s between samples", "allowed is at most half"),
    ),
    "nothing to look at": ({"columns": None}, ("run 1", "allowed is")),
}


@pytest.mark.parametrize("case", BAD_TABLES)
def test_bad_runs_are_refused_in_one_line(case, tmp_path, capsys):
    change, words = BAD_TABLES[case]
    status, err, answer = said(tmp_path, capsys, [{**run_of(), **change}])
    assert (status, err.count("\n"), answer) == (2, 1, None)
    assert all(word in err for word in (str(tmp_path), *words)), err


@pytest.mark.parametrize("value", [1e-300, 1e300])
def test_a_noise_that_no_tracker_has_is_refused(value, tmp_path, capsys):
    status, err, _ = said(tmp_path, capsys, [run_of(1), run_of(2)], noise={"x": value})
    assert (status, err.count("\n")) == (2, 1)
    assert all(word in err for word in ("noise.x", f"{value:g}", "at least 1e-12")), err


NOBODY_KNOWS = {
    "errors.zero": {"errors": {"zero": 1e300}},
    "errors.stiffness": {"errors": {"stiffness": 1e-300}},
    "friction.mu_s": {"friction": {"mu_s": [0.3, 1e-300]}},
    "friction.mu_k": {"friction": {"mu_k": [1e300, 1e299]}},
    "rig.attachment_radius": {"rig": {"attachment_radius": 1e300}},
}


@pytest.mark.parametrize("key", NOBODY_KNOWS)
def test_numbers_that_nobody_knows_are_refused(key, tmp_path, capsys):
    status, err, _ = said(tmp_path, capsys, [run_of(1)], **NOBODY_KNOWS[key])
    assert (status, err.count("\n")) == (2, 1) and key in err and "allowed is" in err, err


def test_a_surface_that_stands_still_is_refused(tmp_path, capsys):
    status, err, _ = said(tmp_path, capsys, [{**run_of(), "surface_speed": 1e-300}])
    assert (status, err.count("\n")) == (2, 1) and "surface_speed: 1e-300" in err, err


def test_a_file_that_is_a_folder_is_refused(tmp_path, capsys):
    (tmp_path / "run01.csv").mkdir()
    status, err, _ = said(tmp_path, capsys, [{"file": "run01.csv"}])
    assert (status, err.count("\n")) == (2, 1) and "run01.csv" in err


@pytest.mark.parametrize("value", ["nan", "inf"])
def test_numbers_that_are_none_are_refused(value, tmp_path, capsys):
    status, err, _ = said(tmp_path, capsys, [{**run_of(), "mass": float(value)}])
    assert (status, err.count("\n")) == (2, 1) and "run 1: mass" in err and value in err


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


def test_a_single_run_without_any_slip_gets_a_verdict(tmp_path, capsys):
    status, err, answer = said(tmp_path, capsys, [run_of(1, 0.001)], noise=KNOWN_NOISE)
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


def test_a_single_run_and_its_copy_get_a_verdict(tmp_path, capsys):
    same = run_of()
    status, err, answer = said(
        tmp_path, capsys, [same, {**same, "hold_out": True}], noise=KNOWN_NOISE
    )
    check_reasoned(status, answer)
    assert "the same data" in err


def test_a_track_with_holes_gets_a_verdict(tmp_path, capsys):
    runs = [run_of(1), run_of(2)]
    runs[0]["columns"]["x"][50:120] = np.nan
    runs[1]["columns"]["x"][::7] = np.nan
    status, _, answer = said(tmp_path, capsys, runs, noise=KNOWN_NOISE)
    check_reasoned(status, answer)

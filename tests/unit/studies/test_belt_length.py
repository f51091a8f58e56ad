"""`stickslip belt-length`: cases, table, verdict, files, refusals."""

import json
from functools import partial

import numpy as np
import pandas as pd
import pytest
from command_line import executed, written
from refusals import one_line

from cosim.cli.arguments import COMMANDS
from cosim.cli.studies import belt_length as belt_length_command
from cosim.studies import belt_length
from cosim.studies.belt_length import CAMERA, Case, Options, Study, verdict, work_off
from cosim.studies.belt_length import drift as drifts
from cosim.studies.belt_length.drift import drift, run_drift
from cosim.studies.belt_length.lengths import LENGTHS, SPEEDS
from cosim.studies.belt_length.study import BOUNDS
from thermal.belt.air import moving_belt
from thermal.steady_sliding import SteadySliding

FAST = ("--samples", 0, "--map", 0, "--jobs", 1)
#: A contact that holds, and starts with the belt.
HELD = "[friction]\nmu_s = 200.0\n[surface]\nrun_up_time = 2.0"


call = partial(executed, belt_length_command)


@pytest.fixture
def coarse(monkeypatch):
    """Four times the study's steps, where the numbers are not looked at."""
    monkeypatch.setattr("cosim.studies.belt_length.case.COARSENESS", 8.0)


def test_the_studys_own_number_is_its_formula():
    """Table 3.5 of the study from the factors of its force: 2.2 % below what it prints."""
    case = Case(1.0, 0.82)
    assert case.force == pytest.approx(4.0349, rel=1e-4)
    assert drift(case).study == pytest.approx(0.0565 * 4.0349 / 4.1261, rel=2e-3)


def test_mended_single_pass_is_force_over_capacity_less_newton_cooling():
    case = Case(2.0, 0.5, h=10.0)
    length = case.single_pass().contact_length
    capacity = 840.0 * 0.0525
    cooled = np.exp(-2.0 * 10.0 * 0.075 / capacity * (2.0 - length) / 0.5)
    expected = case.force / capacity * cooled
    assert drift(case).single_pass == pytest.approx(expected, rel=1e-9)


def test_shortest_belt_meets_the_limit():
    case, limit = Case(1.0, 0.5), 0.2
    length = belt_length.shortest_belt(case, limit, run_drift)
    assert run_drift(case.with_length(length)) == pytest.approx(limit, rel=0.02)
    assert belt_length.shortest_belt(case, 0.05, drifts.steady_drift) > length
    assert belt_length.shortest_belt(case, 1e3, run_drift) == case.shortest == 1.05 * 0.08
    assert belt_length.shortest_belt(case, 1e-7, drifts.steady_drift) is None


def test_friction_falls_linearly_to_the_melting_point():
    case = Case(1.0, 0.82)
    found = drift(case)
    effect = drifts.friction_effect(case)
    assert effect.mu_change == pytest.approx(-effect.interface / 8.0)
    assert 0.85 * found.run < effect.drift < found.run, "less friction, less heat"
    assert drifts.linear_sensitivity(-16.0) == pytest.approx(1.0 / 16.0)
    assert effect.frequency > 0.5 and effect.frequency_change < 0.0
    unfeeling = drifts.friction_effect(case, 0.0)
    assert unfeeling.mu_change == 0.0 and unfeeling.frequency_change == 0.0
    assert unfeeling.drift == found.run


def test_drift_map_rises_with_speed_and_falls_with_length():
    found = belt_length.empty_map(4)
    belt_length.fill_map(found, Case(1.0, 0.82), 1)
    assert found.lengths[[0, -1]] == pytest.approx(LENGTHS)
    assert found.speeds[[0, -1]] == pytest.approx(SPEEDS)
    assert np.all(np.diff(found.drift, axis=0) <= 1e-6)
    assert np.all(np.diff(found.drift, axis=1) >= -1e-6)
    assert found.drift[0, 1] == pytest.approx(
        run_drift(Case(LENGTHS[0], float(found.speeds[1]))), rel=1e-12
    )


def test_still_air_takes_its_number_from_speed_and_length():
    slow, fast = belt_length.cases(
        Case(1.0, 0.5, h=3.0), length=(1.0,), speed=(0.15, 0.82), h=(None,)
    )
    assert 5.0 < slow.film < fast.film < 12.0
    assert fast.pause_film < moving_belt(0.0, 0.5, -8.0) < fast.film < moving_belt(0.82, 0.5, -8.0)
    assert fast.lasting.film > fast.film, "warmer for ever"
    cold = moving_belt(0.82, 7.6, -8.0, rise=0.0)
    assert Case(50.0, 0.82).film == pytest.approx(cold, rel=0.02), "laminar"
    assert Case(1.0, 0.5, h=15.0).film == Case(1.0, 0.5, h=15.0).pause_film == 15.0


@pytest.mark.parametrize(("length", "speed"), [(1.0, 0.15), (4.0, 0.82)])
def test_still_air_takes_its_number_from_the_rise_that_the_belt_has(length, speed):
    """Natural convection was that of a belt 1 K warm: 7.0 W/m2K on 1 m at 0.15 m/s, 6.4 on 4 m."""
    case = Case(length, speed)
    rise = case.follow(case.sliding())[1].belt_mean
    # half of the heat is assumed to go into the belt: 1 % in h
    assert case.film == pytest.approx(
        moving_belt(speed, 0.5 * length, case.ambient_degC, rise=rise), rel=0.01
    )


def test_files_and_words(coarse, tmp_path, capsys):
    words = ("--length", 1, 2, "--speed", 0.15, 0.82, "--h", 15, "--ramp", 0)
    assert call(*words, "-o", tmp_path, *FAST) == 0
    said = capsys.readouterr().out
    assert "NaN" not in said, "columns of an uncertainty that nobody asked for"
    for words in (
        "For a belt that meets the ice less than 0.07 K above the air, 1 m: suffices at 0.15"
        " m/s; does not suffice at 0.82 m/s.",
        "which --limit changes",
        "mu change: of the kinetic friction",
        "At 0.82 m/s 1 m of belt does not suffice",
        "the interface warms by",
        "within 0.07 K of the air again",
        "belt that never comes round",
    ):
        assert words in said
    numbers = json.loads((tmp_path / "belt_length.json").read_text())
    assert numbers["complete"] and len(numbers["cases"]) == 4
    assert numbers["verdict"]
    table = pd.read_csv(tmp_path / "belt_length.csv")
    assert list(table["length [m]"]) == [1.0, 2.0, 1.0, 2.0]
    assert table["drift [K]"][2] == pytest.approx(numbers["cases"][2]["drift"]["run"], rel=1e-12)
    assert len(pd.read_csv(tmp_path / "changes.csv")) == sum(
        len(case["changes"]) for case in numbers["cases"]
    )
    drawn = {path.name for path in tmp_path.glob("*.png")}
    assert drawn == {"drift_over_length.png", "interface_over_length.png"}


@pytest.mark.parametrize(("table", "options", "says"), [
    (None, ("--length", 0.05), "--length = 0.05 m is shorter than the contact"),
    (None, ("--h", "air", "--length", 0.05), "--length = 0.05 m is shorter than the contact"),
    (None, ("--thickness", 0.0), "--thickness = 0 m: must be a number above 0 and at most 0.1"),
    (None, ("--ambient", 1.0), "--ambient = 1.0: ice melts in air of 0 degC and more"),
    (None, ("--h", 0.0), "--h = 0: a belt that gives no heat to the air warms for ever"),
    (None, ("--h", float("nan")), "--h = nan W/m2K: must be a number at least 0"),
    (None, ("--run", 0.0), "--run = 0 s: must be above 0"),
    (None, ("--ramp", -1.0), "--ramp = -1 s: must be at least 0"),
    (None, ("slab",), 'slab: rig.surface = "slab": has no belt; allowed is "belt"'),
    (None, ("--pause", float("inf")), "--pause = inf s: must be at least 0"),
    (None, ("--runs", 0), "--runs = 0: must be 1 to 100"),
    (None, ("no_such_case",), "no_such_case: no such file"),
    (None, ("--limit", 0.0), "--limit = 0 K: must be above 0"),
    (None, ("--samples", 48), "--samples = 48: must be a power of two from 32, or 0"),
    (None, ("--samples", 16), "--samples = 16: must be a power of two from 32, or 0"),
    (None, ("--map", 1), "--map = 1: must be at least 2"),
    (None, ("--run", 1e12), "--run = 1e+12 s, --runs = 1 at --speed = 0.15 m/s"),
    (None, ("--sensitivity", -0.1), "--sensitivity = -0.1 1/K: must be a number at least 0"),
    (None, ("--jobs", 0), "--jobs = 0: must be at least 1"),
    ("[friction]\nmu_k = 0.0", (), "case.toml: friction.mu_k = 0: must be above 0"),
    ("[surface]\nspeed = 0.0", (), "case.toml: surface.speed = 0 m/s: must not be 0"),
    ("[belt]\nair_heat_transfer = 0.0", (), "case.toml: belt.air_heat_transfer = 0: a belt that"),
    ("[run]\nduration = 1000.0", (), "case.toml: --ramp = "),
    ("[springs]\nstiffness = 0.0", (), "case.toml: springs.stiffness = 0 N/m: over the"),
    (HELD, (), "the block is carried along and makes no heat; allowed"),
    ("[belt]\nthickness = 1e-9", (), "case.toml: belt.thickness = 1e-09 m: must be at least"),
    ("", ("--thickness", 1e-9), "--thickness = 1e-09 m: must be at least 1e-06 m"),
    ("", ("--conductivity", 1e-30), "--conductivity = 1e-30 W/mK: must be at least 0.002"),
])  # fmt: skip
def test_bad_input_is_refused_in_one_line(tmp_path, table, options, says):
    """Of a scenario with its file and key; nothing is written."""
    case = () if table is None else (written(tmp_path, f'defaults = "plain"\n{table}'),)
    line = one_line(ValueError, call, *case, *options, "-o", tmp_path / "out")
    assert says in line and not (tmp_path / "out").exists()


def test_ctrl_c_keeps_the_cases_that_are_done(coarse, tmp_path, monkeypatch, capsys):
    def stopped(study, wanted, jobs, progress):
        work_off(study, wanted[:1], 1, progress)
        study.complete = False
        raise KeyboardInterrupt

    monkeypatch.setattr(belt_length_command, "work_off", stopped)
    assert call("--length", 1, 2, "--speed", 0.5, "--ambient", -8, "-o", tmp_path, *FAST) == 1
    assert "1 of 2 cases are kept" in capsys.readouterr().err
    numbers = json.loads((tmp_path / "belt_length.json").read_text())
    assert not numbers["complete"] and len(numbers["cases"]) == 1
    assert len(pd.read_csv(tmp_path / "belt_length.csv")) == 1


def work_through(*wanted):
    study = Study(Options(CAMERA, samples=0))
    work_off(study, list(wanted), 1, lambda done: None)
    return study


def test_verdict_tells_of_melting(coarse):
    study = work_through(Case(1.0, 3.0, mass=20.0, ambient_degC=-1.0))
    assert study.rows[0].drift.steady_melts
    assert "In 1 of 1 cases the ice face comes to melt" in verdict(study)[-1]


def test_verdict_says_when_it_cannot_say(coarse):
    assert verdict(Study(Options(CAMERA))) == ["Nothing was computed, so nothing can be said."]
    assert "1 m was not among the lengths asked for" in verdict(work_through(Case(2.0, 0.5)))[0]


def test_the_studys_resolution_is_good_to_half_a_percent(monkeypatch):
    case = Case(1.0, 0.82)
    found = run_drift(case)
    monkeypatch.setattr("cosim.studies.belt_length.case.RESOLUTION", {})
    fine = SteadySliding(case.thermal(), case.speed, case.force)
    fine.ramp(10.0)
    assert found == pytest.approx(fine.run(20.0).entry, rel=5e-3)


def test_the_help_has_the_defaults_that_are_taken():
    """They stand in `commands.toml` as text, so that the help needs no heat model."""
    told = COMMANDS["belt-length"]["arguments"]
    study, protocol = belt_length_command.STUDY, belt_length.Protocol()
    rig = study.thermal()
    taken = {name: (getattr(study, field),) for name, (field, *_) in BOUNDS.items()}
    taken |= belt_length_command.STUDIED | {"ramp": (protocol.ramp,), "run": (protocol.run,)}
    taken |= {name: (getattr(rig.belt, name),) for name in ("conductivity", "thickness")}
    taken["conductance"] = (rig.contact.conductance,)
    for name, values in taken.items():
        shown = " ".join("air" if value is None else f"{value:g}" for value in values)
        assert told[f"--{name}"]["help"].endswith(f"(default: the scenario's, or {shown})")
    assert told["--limit --camera"]["default"] == CAMERA
    assert told["--samples"]["default"] == Options(CAMERA).samples

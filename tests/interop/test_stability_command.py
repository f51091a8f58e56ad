"""`stickslip stability`, and what `run` and `simulate` say of a motion that no rig keeps to."""

import json

import pytest
from command_line import stickslip, stickslip_here
from stickslip.steady_motion.starts import STARTS

#: As the model is before anything is added to it.
PLAIN = 'defaults = "plain"\n'
SLOW = "[surface]\nspeed = 0.2\nrun_up_time = 10.0\n[rig]\nspring_natural_length = 0.17\n"
SLOW += "[lateral_friction]\nratio = 1.0\n"


def test_it_writes_maps_a_page_and_numbers(tmp_path):
    done = stickslip(tmp_path, "stability", "study", "--grid", "3", "-q", "-o", "out", "--json")
    assert (done.returncode, done.stderr) == (0, "")
    numbers = json.loads(done.stdout)
    assert numbers == json.loads((tmp_path / "out" / "stability.json").read_text())
    assert numbers["stability"]["verdict"] == "unstable"
    assert numbers["stability"]["least_pretension"] == pytest.approx(8.32e-3, abs=2e-5)
    growth = numbers["pretension_map"]["growth"]
    assert growth[0][0] > 1.0 > growth[2][0]  # none, and a fifth of the length
    found = numbers["regime_map"]
    assert set(found["simulated"]) == set(found["closed_form"]) == {"rest", "riding", "ramp"}
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert page.count("<img") == 2 and "unstable" in page
    files = "made_by.json pretension_map.png regime_map.png report.html stability.json"
    assert " ".join(sorted(file.name for file in (tmp_path / "out").iterdir())) == files


def test_where_stick_slip_stops_is_one_command(tmp_path):
    done = stickslip_here(tmp_path, "stability", "--border", "speed", "-q", "-o", "out")
    assert (done.returncode, done.stderr) == (0, "")
    (line,) = [line for line in done.stdout.splitlines() if "sticks and slips from" in line]
    assert "sticks and slips from a speed ramp of 10 s up to 0.157 m/s;" in line
    assert "from rest up to 0.181 m/s; riding on the surface up to 0.262 m/s" in line
    numbers = json.loads((tmp_path / "out" / "stability.json").read_text())
    assert set(numbers["stick_slip_range"]["stick_slip"]) == {"rest", "riding", "ramp"}
    assert {border["key"] for border in numbers["nearest_borders"]} >= {"surface.speed"}
    assert numbers["regime_map"] is None
    assert "0.157 m/s" in (tmp_path / "out" / "report.html").read_text(encoding="utf-8")


def test_a_run_on_an_unstable_path_says_so(tmp_path):
    done = stickslip_here(tmp_path, "simulate", "study", "-o", "out")
    assert done.returncode == 0
    (line,) = [line for line in done.stdout.splitlines() if line.startswith("  unstable")]
    assert "tenfold in 3.78 s" in line and "stable from 8.32 mm" in line
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["stability"]["verdict"] == "unstable"
    assert summary["units"]["stability.least_pretension"] == "m"
    assert "is unstable" in (tmp_path / "out" / "report.html").read_text(encoding="utf-8")


def test_a_run_beside_which_another_regime_exists_says_so(tmp_path):
    (tmp_path / "fast.toml").write_text(PLAIN + SLOW)
    done = stickslip_here(tmp_path, "simulate", "fast.toml", "-o", "out")
    assert done.returncode == 0 and "  unstable" not in done.stdout
    (line,) = [line for line in done.stdout.splitlines() if line.startswith("  regimes")]
    assert "slides without ever sticking" in line and "riding on the surface" in line
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["other_regimes"] == ["riding"] and summary["same_regime"]["balanced"] == "own"
    assert set(summary["regimes"]) == set(STARTS)
    assert summary["regimes"]["riding"]["name"] == "stick-slip"


@pytest.mark.parametrize(
    "text",
    [
        "[structural_damping]\ncoefficient = 100.0\n",  # above the critical damping
        "[friction]\nmu_s = 0.2\nmu_k = 0.3\n",
        "[springs]\nstiffness = 0.0\nforce_curve_extension = [-0.2, 0.0, 0.2]\n"
        "force_curve_force = [-4.0, 0.0, 4.0]\n",
        '[rig]\ndegrees_of_freedom = ["x"]\n',
        "[surface]\nspeed = -0.1\n",
    ],
)
def test_odd_rigs_are_mapped_too(tmp_path, text):
    (tmp_path / "odd.toml").write_text(PLAIN + "[run]\nduration = 12.0\n" + text)
    done = stickslip_here(tmp_path, "stability", "odd.toml", "--grid", "2", "-q", "-o", "out")
    assert (done.returncode, done.stderr) == (0, "") or "exceeds friction.mu_s" in done.stderr
    assert json.loads((tmp_path / "out" / "stability.json").read_text())["regimes"]["own"]["name"]


def test_a_run_too_short_to_tell_says_nothing_of_its_motion(tmp_path):
    (tmp_path / "short.toml").write_text("[run]\nduration = 0.5\n")
    done = stickslip_here(tmp_path, "simulate", "short.toml", "-o", "out")
    assert done.returncode == 0 and "regimes" not in done.stdout and "unstable" not in done.stdout
    assert "stability" not in json.loads((tmp_path / "out" / "summary.json").read_text())


@pytest.mark.parametrize(("arguments", "line"), [
    (["stability", "--grid", "1"], "--grid = 1: must be at least 2, or 0 for none"),
    (["stability", "--border", "pretension", "--set", "rig.degrees_of_freedom=['x']"],
     "--border pretension: this rig has none; allowed is speed, ramp, damping, ratio"),
    (["stability", "still.toml"], "still: surface.speed = 0: needed is a surface that moves"),
    (["stability", "free.toml"], "free: springs.stiffness = 0: needed are springs"),
    (["stability", "smooth.toml"], "smooth: friction.mu_k = 0: needed is friction in slip"),
    (["stability", "ageing.toml"], "ageing: rate_and_state: its runs take too long"),
    (["stability", "short.toml"], "short: run.duration = 0.1 s: the motion ends early, or is"),
    (["simulate", "creep.toml"], "creep.toml: friction.stick_creep: 0.2 m/s is not below"),
])  # fmt: skip
def test_bad_input_is_one_line(tmp_path, arguments, line):
    (tmp_path / "still.toml").write_text("[surface]\nspeed = 0.0\n")
    (tmp_path / "free.toml").write_text("[springs]\nstiffness = 0.0\n")
    (tmp_path / "creep.toml").write_text("[friction]\nstick_creep = 0.2\n")
    (tmp_path / "smooth.toml").write_text("[friction]\nmu_k = 0.0\n")
    (tmp_path / "ageing.toml").write_text("[rate_and_state]\ndirect = 0.01\nevolution = 0.02\n")
    (tmp_path / "short.toml").write_text("[run]\nduration = 0.1\n")
    done = stickslip_here(tmp_path, *arguments)
    assert done.returncode == 2
    assert line in done.stderr and len(done.stderr.splitlines()) == 1

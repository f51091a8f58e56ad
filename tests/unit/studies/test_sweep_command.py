"""`stickslip sweep`: text to values, files, last lines, the test plan."""

import os
import signal
import subprocess
import sys
import time
from functools import partial

import numpy as np
import pytest
import xarray as xr
from command_line import executed

from cosim import read_scenario
from cosim.cli.studies import sweep as sweep_command
from cosim.studies.sweep import SweepError
from cosim.studies.sweep.axis import parse_vary
from cosim.studies.sweep.combination import model_version
from cosim.studies.sweep.grid import BELTS, plan_grid, repeats_grid
from cosim.studies.sweep.run import Store

call = partial(executed, sweep_command)


@pytest.fixture
def case(tmp_path):
    file = tmp_path / "short.toml"
    file.write_text('defaults = "plain"\n[run]\nduration = 1.0\noutput_interval = 0.05\n')
    return file


@pytest.mark.parametrize("text, values", [
    ("a.b= 1e-1 , .5,2,-0.1", [0.1, 0.5, 2, -0.1]),
    ("a.b=disc,'ring',0.1", ["disc", "ring", 0.1]),
    ('a.b=[x],["x", phi]', [("x",), ("x", "phi")]),
    ("a.b=[],[0,1]", [(), (0, 1)]),
    ("a.b=true,false,'true'", [True, False, "true"]),
    ("a.b=[{thickness=1e-3, density=700}],[]", [({"thickness": 1e-3, "density": 700},), ()]),
])  # fmt: skip
def test_text_to_values(text, values):
    """As TOML has them, and words without quotation marks."""
    assert parse_vary([text]) == {("a.b",): values}


@pytest.mark.parametrize("texts, line", [
    (["rig.mass"], "--vary rig.mass: not a key with values, allowed is key=v1,v2"),
    (["=1"], "--vary =1: not a key with values"),
    (["rig.mass="], "--vary rig.mass=: no values"),
    (["rig.mass=1,,2"], "an empty value is not a value"),
    (["a+b=1:2,3"], "--vary a.b=1:2,3: 3 is not 2 values for the linked keys"),
    (["a=[1,2"], "a bracket or a quotation mark is not closed"),
    (["rig.mass=1", "rig.mass=2"], "--vary rig.mass: varied twice"),
])  # fmt: skip
def test_text_that_is_refused(texts, line):
    with pytest.raises(SweepError, match=line):
        parse_vary(texts)


def test_files_and_last_lines(case, tmp_path, capsys):
    out = tmp_path / "out"
    varied = ("--vary", "rig.mass=0.5,0.7", "--vary", "friction.mu_s+friction.mu_k=0.28:0.2,9:9")
    assert call(case, *varied, "--jobs", 1, "-o", out) == 0
    printed = capsys.readouterr()
    assert printed.err == "" and "4 combinations in " in printed.out
    files = "chunks made_by.json report.html sweep.csv sweep.nc sweep.png"
    assert " ".join(sorted(file.name for file in out.iterdir())) == files
    with xr.open_dataset(out / "sweep.nc") as done:
        assert done.x_mean.dims == ("rig.mass", "friction.mu_s+friction.mu_k")
        assert done["rig.mass"].attrs["units"] == "kg"
        assert 'name = "short"' in done.attrs["scenario"]
        assert done.attrs["duration"] == 1.0


def test_a_key_that_is_varied_is_not_set_too(case, tmp_path):
    varied = ("--vary", "friction.mu_s+friction.mu_k=0.28:0.2", "-o", tmp_path / "out")
    line = "--set friction.mu_k=0.1: friction.mu_k is varied, allowed is a key that is not"
    with pytest.raises(SweepError, match=line):
        call(case, *varied, "--set", "friction.mu_k=0.1")


def test_a_sweep_without_any_result_fails(case, tmp_path, capsys):
    case.write_text("[friction]\nmu_s = 9.0\nmu_k = 9.0\n[run]\nduration = 9.0\n")
    assert call(case, "--vary", "rig.mass=0.5,0.7", "-o", tmp_path / "out") == 1
    printed = capsys.readouterr().out
    assert "0 of them complete" in printed and "failed     2, the first: the run ended" in printed
    assert (tmp_path / "out" / "sweep.png").stat().st_size > 0


#: The command, to which two signals are one wish however long a busy machine takes between them.
ONE_WISH = """
import sys
from cosim import interrupts
interrupts.SAME_WISH = 60.0
from cosim.cli import main
sys.exit(main())
"""


@pytest.mark.skipif(os.name == "nt", reason="signals reach a process group on POSIX only")
@pytest.mark.parametrize(
    "wanted, chunks", [pytest.param(signal.SIGINT, 3, marks=pytest.mark.slow), (signal.SIGTERM, 1)]
)
def test_a_signal_to_all_processes_loses_nothing(case, tmp_path, wanted, chunks):
    """As a terminal sends Ctrl-C: to this command and to its workers at once.

    The first chunk is there before the workers are: the signal meets them as they start.
    """
    masses, speeds = np.linspace(0.3, 2.0, 40), np.linspace(0.05, 0.8, 30)
    vary = (f"rig.mass={','.join(map(str, masses))}", f"surface.speed={','.join(map(str, speeds))}")
    command = [sys.executable, "-c", ONE_WISH, "sweep", case, "--jobs", "2"]
    command += ["--vary", vary[0], "--vary", vary[1], "--set", "run.duration=30"]
    with subprocess.Popen(
        [*command, "-o", tmp_path],
        start_new_session=True,
        # also where the tests run in the background, and ignore it
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    ) as process:
        while process.poll() is None and len(list(tmp_path.glob("chunks/*/*.json"))) < chunks:
            time.sleep(0.05)
        os.killpg(process.pid, wanted)
        os.killpg(process.pid, wanted)  # somebody impatient
        out, err = process.communicate(timeout=240)
    assert (process.returncode, out) == (1, "")
    *bar, said = err.splitlines()
    assert said.startswith("error: interrupted; what is finished is kept in ")
    assert all("run/s]" in line for line in bar)  # shown if that takes a minute
    kept = Store(tmp_path, model_version()).read()
    assert chunks <= len(kept) < masses.size * speeds.size
    assert not list(tmp_path.rglob("*.partial"))


def test_the_plan_has_1306_different_combinations():
    scenario = read_scenario("test_plan")
    plan, repeats = plan_grid(scenario), repeats_grid(scenario)
    assert plan.shape == (2, 9, 6, 6, 2) and repeats.shape == (10,)
    assert len({*plan.keys(), *repeats.keys()}) == 1306
    first, cold = plan.changes[0], plan.changes[len(plan) // 2]
    assert first["friction.mu_k"] == BELTS["K40"]
    assert cold["friction.mu_k"] == pytest.approx(1.16 * BELTS["K40"])
    assert cold["friction.mu_s"] / cold["friction.mu_k"] == pytest.approx(0.2815 / 0.2086)
    masses = plan.axes[2].coordinates["rig.mass"].values
    assert np.allclose(masses - 0.461, [0.0, 0.2, 0.4, 0.45, 0.65, 0.91])
    measured = plan_grid(scenario, belts={"K100": 0.2, "steel": 0.05}, per_kelvin=0.0)
    assert {changes["friction.mu_k"] for changes in measured.changes} == {0.2, 0.05}

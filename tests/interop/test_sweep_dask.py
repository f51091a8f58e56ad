"""Sweeps on a real Dask cluster: two worker processes, one of them killed in mid-sweep."""

import json
import os
import signal
import subprocess
import sys
from contextlib import ExitStack
from pathlib import Path

import numpy as np
import pytest
from command_line import stickslip_here
from stickslip import Parameters

from cosim.studies.sweep import SweepError, sweep

distributed = pytest.importorskip("distributed")

# the springs of a rig free in x only: no run is long
BASE = Parameters(rig={"degrees_of_freedom": ("x",)}, surface={"run_up_time": 1.0})
VARY = {"rig.mass": np.linspace(0.3, 2.0, 20), "surface.speed": np.linspace(0.05, 0.8, 12)}
CASE = {"duration": 12.0, "output_interval": 0.02}


@pytest.fixture(scope="module")
def cluster():
    """A scheduler and two workers without a nanny that would start them again."""
    with ExitStack() as stack:
        scheduler = stack.enter_context(
            distributed.LocalCluster(
                n_workers=0, dashboard_address=None, processes=False, protocol="tcp",
                host="127.0.0.1",
            )
        )  # fmt: skip
        options = "--no-nanny --nthreads 1 --no-dashboard".split()
        command = [sys.executable, "-m", "distributed.cli.dask_worker", *options]
        command.append(scheduler.scheduler_address)
        workers = [
            stack.enter_context(subprocess.Popen(command, stderr=subprocess.DEVNULL))
            for _ in range(2)
        ]
        for worker in workers:
            stack.callback(worker.kill)
        with distributed.Client(scheduler.scheduler_address, set_as_default=False) as client:
            client.wait_for_workers(2, timeout=30)
        yield scheduler.scheduler_address, workers


def test_a_killed_worker_loses_nothing(cluster, tmp_path):
    address, workers = cluster
    alive_at = []

    def kill_one(done, total):
        if not alive_at and 0.15 * total < done < total:
            alive_at.append(done)
            os.kill(workers[0].pid, signal.SIGKILL)

    shared = sweep(BASE, VARY, **CASE, dask=address, folder=tmp_path, progress=kill_one)
    assert alive_at and alive_at[0] < 240
    assert workers[0].wait(timeout=10) == -signal.SIGKILL
    assert workers[1].poll() is None
    assert (shared.status == 0).all()
    # what the cluster computed is what this process computes
    few = {key: values[::7] for key, values in VARY.items()}
    alone = sweep(BASE, few, **CASE, jobs=1)
    for name in ("x_mean", "frequency", "heat"):
        assert np.array_equal(shared[name].values[::7, ::7], alone[name].values, equal_nan=True)
    # and everything is on disk: no cluster is asked a second time
    again = sweep(BASE, VARY, **CASE, dask="tcp://127.0.0.1:1", folder=tmp_path)
    assert again.x_mean.equals(shared.x_mean)


def test_no_scheduler_is_said_in_one_line(monkeypatch):
    monkeypatch.setattr("cosim.studies.sweep.workers.CONNECT_SECONDS", 0.5)
    with pytest.raises(SweepError, match=r"^dask: no scheduler answers at tcp://127.0.0.1:1 \(.*"):
        sweep(BASE, {"rig.mass": [0.5, 0.6]}, duration=1.0, dask="tcp://127.0.0.1:1")


LAW = Path(__file__).resolve().parents[1] / "examples" / "effects" / "flash_heating.py"
SCENARIO = """
name = "flash"
effects = ["law.py"]
rig.degrees_of_freedom = ["x"]
surface.run_up_time = 0.5
flash_heating = { fall = 0.5, onset = 0.1 }
run = { duration = 2.0, output_interval = 0.02 }
"""


def test_workers_elsewhere_have_a_custom_effect(cluster, tmp_path):
    """Of its file, beside a scenario in a user's folder, they know nothing."""
    user = tmp_path / "user"
    user.mkdir()
    (user / "law.py").write_text(LAW.read_text())
    (user / "flash.toml").write_text(SCENARIO)
    # two scenarios, so that whole ones travel
    vary = ("--vary", "flash_heating.fall=0,0.4", "--vary", "rig.mass=0.5,0.7,0.9")
    words = ("sweep", user / "flash.toml", *vary, "--json", "-o")
    far = stickslip_here(tmp_path, *words, "far", "--dask", cluster[0])
    near = stickslip_here(tmp_path, *words, "near", "--jobs", "1")
    assert (far.returncode, near.returncode) == (0, 0), far.stderr + near.stderr
    rows = [json.loads(one.stdout)["runs"] for one in (far, near)]
    assert rows[0] == rows[1] and len(rows[0]) == 6
    # the law acts: with it, friction falls
    assert rows[0][0]["friction_coefficient"] > rows[0][3]["friction_coefficient"]

"""A sweep with a custom effect on Dask workers that know nothing of its file."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

distributed = pytest.importorskip("distributed")

FLASH = Path(__file__).resolve().parents[1] / "examples" / "effects" / "flash_heating.py"
SCENARIO = """
name = "flash"
effects = ["law.py"]
[rig]
degrees_of_freedom = ["x"]
[surface]
run_up_time = 0.5
[flash_heating]
fall = 0.5
onset = 0.1
[run]
duration = 2.0
output_interval = 0.02
"""
#: Two scenarios, so that whole ones travel; the rows are chunks of both workers.
VARY = ("--vary", "flash_heating.fall=0,0.4", "--vary", "rig.mass=0.5,0.7,0.9")


@pytest.fixture
def place(tmp_path, monkeypatch):
    """A user's folder with a scenario and the law beside it; no variable that names the law."""
    monkeypatch.delenv("STICKSLIP_EFFECTS", raising=False)
    user = tmp_path / "user"
    user.mkdir()
    (user / "law.py").write_text(FLASH.read_text())
    (user / "flash.toml").write_text(SCENARIO)
    return tmp_path


@pytest.fixture
def worker(place):
    """A scheduler, and a worker's process in another folder."""
    (place / "far").mkdir()
    with (
        distributed.LocalCluster(
            n_workers=0, dashboard_address=None, processes=False, protocol="tcp", host="127.0.0.1"
        ) as scheduler,
        distributed.Client(scheduler.scheduler_address, set_as_default=False) as client,
    ):
        words = ("--no-nanny", "--nthreads", "1", "--no-dashboard", scheduler.scheduler_address)
        command = [sys.executable, "-m", "distributed.cli.dask_worker", *words]
        with subprocess.Popen(command, cwd=place / "far", stderr=subprocess.DEVNULL) as process:
            try:
                client.wait_for_workers(1, timeout=30)
                yield scheduler.scheduler_address
            finally:
                process.kill()


def swept(place, out, *words):
    """`stickslip sweep` of the user's scenario, from a folder that is not its own."""
    command = [sys.executable, "-m", "cosim", "sweep", str(place / "user" / "flash.toml")]
    return subprocess.run(
        [*command, *VARY, "--json", "-o", str(place / out), *words],
        cwd=place, capture_output=True, text=True, check=False,
    )  # fmt: skip


def test_workers_elsewhere_have_the_law(place, worker):
    far, near = swept(place, "far-out", "--dask", worker), swept(place, "near", "--jobs", "1")
    assert (far.returncode, near.returncode) == (0, 0), far.stderr + near.stderr
    rows = [json.loads(one.stdout)["runs"] for one in (far, near)]
    assert rows[0] == rows[1] and len(rows[0]) == 6
    # the law acts: with it, friction falls
    assert rows[0][0]["friction_coefficient"] > rows[0][3]["friction_coefficient"]

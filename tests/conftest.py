"""What all tests share: a core for every worker, and where data lie that are not of the project."""

import os
from pathlib import Path

import pytest

# Every worker computes on its own core: the matrices here are too small to be shared out. BLAS
# would start a thread for each core of the machine in each worker of a parallel run, and they would
# wait for each other. Set before anything imports numpy, which reads it once.
for library in ("OPENBLAS", "MKL", "OMP"):
    os.environ.setdefault(f"{library}_NUM_THREADS", "1")

SHARED = Path(__file__).resolve().parents[2] / "shared"


@pytest.fixture(scope="session")
def shared():
    """Name -> path of a file or folder beside the checkout; the test is skipped where it is not.

    Measured data and the study's text are not part of the project.
    """

    def find(name):
        path = SHARED / name
        if not path.exists():
            pytest.skip(f"needs {path}, which is not there")
        return path

    return find


@pytest.fixture(scope="session")
def home(tmp_path_factory):
    """A folder in which examples leave what they make, once for all of them."""
    return tmp_path_factory.mktemp("home")


@pytest.fixture
def at_home(home, monkeypatch):
    """Work as a user does, in a folder of one's own: nothing is left in the checkout's."""
    monkeypatch.chdir(home)
    return home

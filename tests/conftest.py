"""What all tests share: a core for every worker, and where data lie that are not of the project."""

import os
import signal
import sys
from pathlib import Path

import pytest

# Every worker computes on its own core: the matrices here are too small to be shared out. BLAS
# would start a thread for each core of the machine in each worker of a parallel run, and they would
# wait for each other. Set before anything imports numpy, which reads it once.
for library in ("OPENBLAS", "MKL", "OMP"):
    os.environ.setdefault(f"{library}_NUM_THREADS", "1")

# What is compiled of the tests and of the package is kept where Python keeps it, also where the
# environment says that nothing is: half of what a worker does before its first test is compiling.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

# After that: pytest rewrites the assertions of hypothesis, in each process if it may not write.
from hypothesis import settings  # noqa: E402

# The same examples each time, and as long as a busy machine takes over them.
settings.register_profile("suite", deadline=None, derandomize=True)
settings.load_profile("suite")

# Before any FMU is loaded: an FMU that is the first to import pythonfmu imports its own copy of it,
# and that cannot build.
import pythonfmu  # noqa: E402, F401

SHARED = Path(__file__).resolve().parents[2] / "shared"


def pytest_configure(config):
    """Compile the model once, before there are workers.

    Commands say when they compile, and what tests look at is what they say otherwise.
    """
    if not hasattr(config, "workerinput"):
        from stickslip.catalogue import CATALOGUE

        _ = CATALOGUE.compiled


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
def once(tmp_path_factory):
    """Name of a unit -> its file, built once a session, by whichever worker needs it first."""

    def look_up(name):
        from stickslip.generation.platforms import this_platform

        from cosim.fmu.build import build_fmu

        base = tmp_path_factory.getbasetemp()
        # a worker's folder lies in that of all
        folder = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "units"
        if not (folder / name).exists():  # a unit appears whole
            build_fmu(folder, name, [this_platform()])
        return folder / name

    return look_up


def _unit(constant):
    """A fixture: the unit that a constant of `cosim.fmu.build` names."""

    @pytest.fixture(scope="session")
    def unit(once):
        from cosim.fmu import build

        return once(getattr(build, constant))

    return unit


# the block's for this machine, for FMI 2 and 3, and as pythonfmu makes it
fmu, fmu3, python_fmu = map(_unit, ("NATIVE", "FMI3", "PYTHON"))
# the heat's, reduced, for FMI 2 and 3, and whole
native, native3, whole = map(_unit, ("THERMAL", "THERMAL_FMI3", "THERMAL_PYTHON"))


@pytest.fixture(params=["native", "python"])
def unit(request):
    """One unit after the other, for what both do."""
    return request.getfixturevalue("fmu" if request.param == "native" else "python_fmu")


@pytest.fixture
def ctrl_c():
    """SIGINT raises KeyboardInterrupt here, also where the tests run in the background.

    A shell has its background jobs ignore the signal, and so does nohup.
    """
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture(scope="session")
def gap(tmp_path_factory):
    """An answer of the gap workflow: a named effect, found in three runs."""
    from gap_answers import answer

    return answer(tmp_path_factory.mktemp("campaign"))


@pytest.fixture
def full_disk():
    """A function that fails as writing to a full disk does, whatever it is called with."""

    def write(*_, **__):
        raise OSError(28, "No space left on device")

    return write


@pytest.fixture(scope="session")
def home(tmp_path_factory):
    """A folder in which examples leave what they make, once for all of them."""
    return tmp_path_factory.mktemp("home")


@pytest.fixture
def at_home(home, monkeypatch):
    """Work as a user does, in a folder of one's own: nothing is left in the checkout's."""
    monkeypatch.chdir(home)
    return home


@pytest.fixture
def elsewhere(tmp_path, monkeypatch):
    """Work in a folder of the test's own."""
    monkeypatch.chdir(tmp_path)


@pytest.fixture(scope="session")
def browser():
    """A browser for pages, one for all tests of a worker; skipped where there is none."""
    from browser import start

    found = start()
    yield found
    found.driver.quit()

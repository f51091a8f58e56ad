"""The FMU that the interop tests run, built once a session from what is here now."""

# Before any FMU is loaded: an FMU that is the first to import pythonfmu imports its own copy of it,
# and that cannot build.
import pytest
import pythonfmu  # noqa: F401

from cosim.fmu.build import build_fmu


@pytest.fixture(scope="session")
def fmu(tmp_path_factory):
    return build_fmu(tmp_path_factory.mktemp("fmu"))

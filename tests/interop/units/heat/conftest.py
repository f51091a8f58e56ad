"""The two units of the heat, native and whole, and an instance of each."""

import pytest
from heat_instance import instance

from cosim.fmu.build import THERMAL, THERMAL_PYTHON


@pytest.fixture(scope="session")
def native(once):
    return once(THERMAL)


@pytest.fixture(scope="session")
def whole(once):
    return once(THERMAL_PYTHON)


@pytest.fixture(params=["native", "whole"])
def unit(request):
    return request.getfixturevalue(request.param)


@pytest.fixture
def heat(unit, tmp_path):
    with instance(unit, tmp_path / "unit") as one:
        yield one

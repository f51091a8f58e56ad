"""The two units of the heat, native and whole, and an instance of each."""

import pytest
from heat_instance import instance
from stickslip.generation.platforms import this_platform

from cosim.fmu.build import build_fmu
from cosim.fmu.thermal import native_unit
from cosim.fmu.thermal.variables import NAME


@pytest.fixture(scope="session")
def native(tmp_path_factory):
    return build_fmu(tmp_path_factory.mktemp("heat"), native_unit.FMU, [this_platform()])


@pytest.fixture(scope="session")
def whole(tmp_path_factory):
    return build_fmu(tmp_path_factory.mktemp("heat_python"), f"{NAME}-python.fmu")


@pytest.fixture(params=["native", "whole"])
def unit(request):
    return request.getfixturevalue(request.param)


@pytest.fixture
def heat(unit, tmp_path):
    with instance(unit, tmp_path / "unit") as one:
        yield one

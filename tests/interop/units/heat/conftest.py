"""Both units of the heat, reduced and whole, one after the other, and an instance of each."""

import pytest
from heat_instance import instance


@pytest.fixture(params=["native", "whole"])
def unit(request):
    return request.getfixturevalue(request.param)


@pytest.fixture
def heat(unit, tmp_path):
    with instance(unit, tmp_path / "unit") as one:
        yield one

"""The native units as libraries, for the tests of this folder."""

import pytest
from c_unit import Unit


@pytest.fixture(scope="module")
def unit(fmu, tmp_path_factory):
    return Unit(fmu, tmp_path_factory.mktemp("unit"))


@pytest.fixture(scope="module")
def unit3(fmu3, tmp_path_factory):
    return Unit(fmu3, tmp_path_factory.mktemp("unit3"))

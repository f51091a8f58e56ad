"""The native units as libraries, for the tests of this folder."""

import pytest
from fmi3_unit import Unit as Unit3
from native_unit import Unit as Unit2


@pytest.fixture(scope="module")
def unit(fmu, tmp_path_factory):
    return Unit2(fmu, tmp_path_factory.mktemp("unit"))


@pytest.fixture(scope="module")
def unit3(fmu3, tmp_path_factory):
    return Unit3(fmu3, tmp_path_factory.mktemp("unit3"))

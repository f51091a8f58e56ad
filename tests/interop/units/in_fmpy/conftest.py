"""An instance of each unit, for the tests in this folder."""

import pytest
from fmpy_instance import instance


@pytest.fixture
def block(unit, tmp_path):
    with instance(unit, tmp_path / "first") as one:
        yield one


@pytest.fixture
def python_block(python_fmu, tmp_path):
    with instance(python_fmu, tmp_path / "first") as one:
        yield one

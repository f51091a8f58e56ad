"""A host of the plainest kind, for the tests of this folder."""

import pytest
from exchange_host import (
    hosted,
)


@pytest.fixture
def host(fmu, tmp_path):
    with hosted(fmu, tmp_path) as one:
        yield one

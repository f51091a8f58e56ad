"""A researcher with tracker data does the page "From your data to a missing effect"."""

import pytest


@pytest.mark.slow
def test_missing_effect(reader):
    reader.do("missing_effect")

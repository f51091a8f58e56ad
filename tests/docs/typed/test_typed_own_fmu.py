"""Somebody with models of their own does the page "Couple your own FMU"."""

import pytest


@pytest.mark.slow
def test_own_fmu(reader, browser):
    reader.do("own_fmu")
    reader.shows(browser, "pair/report.html", "mechanics", "thermal")

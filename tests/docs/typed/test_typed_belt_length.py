"""Whoever chooses a belt does the page "How long must my belt be?"."""

import pytest


@pytest.mark.slow
def test_belt_length(reader, browser):
    reader.do("belt_length")
    reader.shows(browser, "results/belt-length/report.html", "1 m", "0.05 K")

"""Somebody with a rig does the page "Your rig, coupled"."""

import pytest

#: What the report tells of: run, motion, heat, ledger.
NAMED = ("soft_springs", "stick-slip frequency", "warmest contact, over the air", "Energy")


@pytest.mark.slow
def test_rig_coupled(reader, browser):
    reader.do("rig_coupled")
    reader.shows(browser, "results/soft_springs/report.html", *NAMED)

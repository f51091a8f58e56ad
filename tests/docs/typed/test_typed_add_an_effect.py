"""Somebody with a law that the catalogue lacks does the page "Add an effect of your own"."""

import pytest


@pytest.mark.slow
def test_add_an_effect(reader, browser):
    reader.do("add_an_effect")
    assert (reader.folder / "found" / "model.toml").is_file()
    reader.shows(browser, "results/alone/report.html", "case", "64.00 %", "Energy")
    formula = "mu_k (1 - c (1 - 1 / (1 + (v / v_w)^8)^(1/8)))"
    reader.shows(browser, "results/flash_heating/effects.html", "flash_heating.onset", formula)

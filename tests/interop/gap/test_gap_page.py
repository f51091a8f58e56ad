"""The page of `stickslip gap` in a real browser: what is seen first, on paper, and at night."""

import base64
import re

import pytest
from browser import PHONE, WIDE

from cosim.gap.show import files

#: A4, inches.
PAPER = {"paperWidth": 8.27, "paperHeight": 11.69}
DARK = [{"name": "prefers-color-scheme", "value": "dark"}]


@pytest.fixture(scope="module")
def page(gap, tmp_path_factory):
    folder = tmp_path_factory.mktemp("page")
    files.write_page(gap, folder, folder / "report.html", lambda: None)
    return folder / "report.html"


def test_one_sentence_and_three_pictures_come_first(browser, page):
    browser.open(page)
    first = browser.js(
        "return [...document.querySelectorAll('h1, figure, h2, table, .warning')]"
        ".map((each) => each.tagName)"
    )
    assert first[:5] == ["H1", "FIGURE", "FIGURE", "FIGURE", "H2"]
    assert browser.overhang() <= 0


def test_it_fits_a_phone(browser, page):
    browser.open(page, PHONE)
    assert browser.overhang() <= 0


def test_at_most_four_pages_of_paper(browser, page):
    browser.open(page, WIDE)
    pdf = base64.b64decode(browser.command("Page.printToPDF", **PAPER)["data"])
    assert 1 <= len(re.findall(rb"/Type\s*/Page\b", pdf)) <= 4


def test_it_is_dark_where_that_is_asked_for(browser, page):
    browser.command("Emulation.setEmulatedMedia", features=DARK)
    try:
        browser.open(page)
        colours = browser.js(
            "const it = getComputedStyle(document.body); return [it.backgroundColor, it.color]"
        )
        ground, ink = ([int(part) for part in re.findall(r"\d+", one)[:3]] for one in colours)
        assert max(ground) < 60 and min(ink) > 180
        assert "invert" in browser.js(
            "return getComputedStyle(document.querySelector('figure img')).filter"
        )
    finally:
        browser.command("Emulation.setEmulatedMedia", features=[])

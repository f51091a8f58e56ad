"""The page of every command in Chromium: it draws what it has, fits every screen, keeps nobody out.

A command that writes a page belongs in `PAGES`; a check says so where one is missing. Most of the
time is what the commands compute, so all but the quickest are slow.
"""

import pytest
from browser import PHONE, WIDE
from command_line import stickslip

from cosim.cli.arguments import COMMANDS

SHORT = """
name = "short"
surface = { speed = 0.08, run_up_time = 0.5 }
run.duration = 3.0
belt.cell_length = 5e-3
"""
#: Command -> how it is asked for a page, what comes before, where the page is.
PAGES = {
    "effects": (["effects", "film_drag"], None, "effects.html"),
    "simulate": (["simulate", "short.toml"], None, "report.html"),
    "run": (["run", "short.toml"], None, "report.html"),
    "stability": (["stability", "reference", "--grid", "3"], None, "report.html"),
    "reproduce": (["reproduce", "C3"], None, "report.html"),
    "couple": (["couple", "units/StickSlipThermal.ssp", "--set", "run.stop=2"],
               ["build", "StickSlipThermal.ssp", "--platforms", "x86_64-linux", "-o", "units"],
               "report.html"),
    "friction-map": (["friction-map", "--speed", "0.02", "0.05", "0.1", "0.2", "--duration", "0.1"],
        None, "report.html"),
    "belt-length": (["belt-length", "short.toml", "--samples", "64", "--map", "4"], None,
        "report.html"),
    "sweep": (["sweep", "short.toml", "--vary", "rig.mass=0.6,0.7,0.8"], None, "report.html"),
    "compare": (["compare", "short.toml", "study"], None, "report.html"),
    "plan": (["plan", "planned"], ["plan", "--write-example", "planned"], "report.html"),
    "gap": (["gap", "measured"], ["gap", "--write-example", "measured"], "report.html"),
}  # fmt: skip
QUICK = ("effects",)
#: A sheet between its margins, CSS pixels: how wide, and how high a picture may be.
SHEET, HIGHEST = 703, 760
#: Those that write no page, and the explorer, whose page has a room of its own (interop/explorer).
WITHOUT = "build campaign completion docs effect explore keys new plot schema".split()


@pytest.mark.parametrize(
    "command",
    [
        pytest.param(command, marks=() if command in QUICK else pytest.mark.slow)
        for command in PAGES
    ],
)
def test_page_for_every_eye_and_screen(browser, tmp_path, command):
    (tmp_path / "short.toml").write_text(SHORT, encoding="utf-8")
    arguments, before, file = PAGES[command]
    if before:
        assert stickslip(tmp_path, *before).returncode == 0
    done = stickslip(tmp_path, *arguments, "-o", "out")
    assert done.returncode == 0, done.stderr
    page = tmp_path / "out" / file
    for width in (WIDE, PHONE):
        browser.open(page, width)
        assert browser.overhang() <= 0
        assert browser.barriers() == []
        assert browser.outside() == [] and browser.errors() == []
    runs_off, highest = paper(browser)
    assert runs_off == [] and highest <= HIGHEST
    alive = browser.all("figure.live")
    assert len(browser.all("figure.live.on .stage")) == len(alive)
    assert page.stat().st_size < 3_000_000
    assert all(picture.get_attribute("alt") for picture in browser.all("img"))


def paper(browser):
    """Heads of tables that are wider than a sheet, and the height of the highest picture, px."""
    browser.resize(SHEET)
    browser.command("Emulation.setEmulatedMedia", media="print")
    found = browser.js(
        "const width = document.documentElement.clientWidth; return ["
        "[...document.querySelectorAll('table')]"
        ".filter((each) => each.getBoundingClientRect().right > width + 1)"
        ".map((each) => each.rows[0].textContent), "
        "Math.max(0, ...[...document.querySelectorAll('img')].map((each) => each.height))]"
    )
    browser.command("Emulation.setEmulatedMedia", media="")
    return found


def test_no_command_is_forgotten():
    assert {command.split()[0] for command in COMMANDS} == {*PAGES, *WITHOUT}

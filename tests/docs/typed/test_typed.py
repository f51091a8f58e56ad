"""Readers do the pages of the tutorials, from an empty folder; somebody new installs first."""

import shutil

import pytest
import test_readme
from notebooks import PAGES

pytestmark = pytest.mark.slow
#: What a clean checkout does not hold.
MADE = (".git", ".venv*", ".npm", ".*_cache", "__pycache__", "results", "*.fmu", "*.ssp")
FORMULA = "mu_k (1 - c (1 - 1 / (1 + (v / v_w)^8)^(1/8)))"
TUTORIALS = sorted(file.stem for file in PAGES.glob("*.md") if file.stem != "index")
#: Tutorial -> files that are there in the end, and what the pages among them tell of.
LEFT = {
    "add_an_effect": {
        "found/model.toml": (),
        "results/alone/report.html": ("case", "64.0 %", "Energy"),
        "results/flash_heating/effects.html": ("flash_heating.onset", FORMULA),
    },
    "belt_length": {"results/belt-length/report.html": ("1 m", "0.05 K")},
    "in_your_tool": {"units/StickSlip3DOF.fmu": ()},
    "own_fmu": {"pair/report.html": ("mechanics", "thermal")},
    "rig_coupled": {
        "results/soft_springs/report.html": (
            *("soft_springs", "stick-slip frequency", "warmest interface, over the air", "Energy"),
        )
    },
}


@pytest.mark.parametrize("page", TUTORIALS)
def test_a_page_is_done(reader, request, page):
    reader.do(page)
    for file, words in LEFT.get(page, {}).items():
        assert (reader.folder / file).is_file()
        if words:
            reader.shows(request.getfixturevalue("browser"), file, *words)


def test_install(reader, browser):
    """The line that installs and runs, typed in a checkout."""
    ignored = shutil.ignore_patterns(*MADE)
    shutil.copytree(test_readme.ROOT, reader.folder, ignore=ignored, dirs_exist_ok=True)
    # what is found is to be what is installed there
    reader.environment["PYTHONPATH"] = ""
    status, said = reader.command(test_readme.SHELL[0])
    assert status == 0, "\n".join(said)
    assert any("results/reference/report.html" in line for line in said)
    reader.shows(browser, "results/reference/report.html", "reference")

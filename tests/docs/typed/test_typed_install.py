"""Somebody new types the line that installs and runs, in a checkout of their own."""

import shutil

import pytest
import test_readme

#: What a clean checkout does not hold.
MADE = (".git", ".venv*", ".npm", ".*_cache", "__pycache__", "results", "*.fmu", "*.ssp")


@pytest.mark.slow
def test_install(reader, browser):
    ignored = shutil.ignore_patterns(*MADE)
    shutil.copytree(test_readme.ROOT, reader.folder, ignore=ignored, dirs_exist_ok=True)
    # what is found is to be what is installed there
    reader.environment["PYTHONPATH"] = ""
    status, said = reader.shell.run(test_readme.SHELL[0])
    assert status == 0, "\n".join(said)
    assert any("results/reference/report.html" in line for line in said)
    reader.shows(browser, "results/reference/report.html", "reference")

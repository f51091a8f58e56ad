"""Benchmarks by name: what is printed runs, and tests import from the same rooms."""

import re
import runpy
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def runner():
    return runpy.run_path(str(ROOT / "tests" / "benchmarks" / "__main__.py"), run_name="runner")


def test_every_printed_command_runs_a_benchmark_that_there_is(runner):
    there = runner["benchmarks"]()
    places = [*ROOT.glob("*.md"), *ROOT.glob(".github/*.md")]
    places += [file for end in ("md", "py") for file in (ROOT / "tests").rglob(f"*.{end}")]
    printed = {
        name
        for file in places
        for name in re.findall(r"python tests/benchmarks (\w+)", file.read_text(encoding="utf-8"))
    }
    assert printed == set(there)  # each prints its own, at least


def test_tests_import_from_the_rooms_of_the_benchmarks(runner):
    told = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    places = told["tool"]["pytest"]["ini_options"]["pythonpath"]
    others = {place for place in places if place in ("tests", "tests/docs")}
    assert {str(ROOT / place) for place in {*places} - others} == {*runner["rooms"]()}


def test_a_name_that_is_none_is_answered_by_those_that_are(runner, monkeypatch):
    monkeypatch.setattr("sys.argv", ["benchmarks", "mechanic"])
    with pytest.raises(SystemExit, match="no benchmark mechanic; there are .*mechanics"):
        runner["main"]()

"""Scenarios, campaigns and systems that nobody would write, the same ones each time.

Of campaigns only the reading: finding takes seconds each. `STICKSLIP_FUZZ=50 pytest -m "" FILE`
draws fifty times as many, other ones each time.
"""

import os
import shutil
from unittest import mock

import pytest
from fuzzed import called, campaigns, fault_of, fresh, scenarios, toml, write_campaign
from fuzzed_systems import packages, settings_of, systems, write_package, write_system
from hypothesis import HealthCheck, given, settings

#: What a reading that finds no fault ends with here.
READ = "error: interrupted before there was a result\n"
MORE = int(os.environ.get("STICKSLIP_FUZZ", 1))


def drawn(count):
    """Settings of a test that draws so many cases, as a rule the same."""
    return settings(
        max_examples=count * MORE,
        derandomize=MORE == 1,
        database=None,
        deadline=None,
        suppress_health_check=list(HealthCheck),
    )


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    return tmp_path_factory.mktemp("fuzz")


def check(status, out, err, folder=None):
    fault = fault_of(status, out, err, folder)
    assert fault is None, f"{fault}: {err}"


@drawn(20)
@given(tables=scenarios())
def test_any_scenario_gets_a_sensible_answer(place, tables):
    if (text := toml(tables)) is None:
        return
    (place / "case.toml").write_text(text, encoding="utf-8", errors="replace")
    shutil.rmtree(place / "out", ignore_errors=True)
    answer = called("simulate", place / "case.toml", "-o", place / "out", figures=False)
    check(*answer, place / "out")


@drawn(60)
@given(case=campaigns())
def test_any_campaign_is_read_or_refused(place, case):
    if (path := write_campaign(place, *case)) is None:
        return
    with mock.patch("cosim.cli.measurements.gap._find", side_effect=KeyboardInterrupt):
        status, out, err = called("gap", path, "-o", place / "gap")
    assert status == 2 or err.endswith(READ), err
    check(status, out, err)


@drawn(30)
@given(case=campaigns(planned=True))
def test_any_plan_is_read_or_refused(place, case):
    if (path := write_campaign(place, *case)) is None:
        return
    with mock.patch("cosim.cli.measurements.plan.make_plan", side_effect=KeyboardInterrupt):
        status, out, err = called("plan", path, "-o", place / "plan")
    assert status == 2 or err.endswith(READ), err
    check(status, out, err)


@drawn(20)
@given(tables=systems())
def test_any_system_gets_a_sensible_answer(place, tables):
    folder = fresh(place / "system")
    folder.mkdir()
    if (path := write_system(folder, tables)) is None:
        return
    check(*called("couple", path, "-o", folder / "out", figures=False), folder / "out")


@drawn(20)
@given(case=packages())
def test_any_package_gets_a_sensible_answer(place, case):
    folder = fresh(place / "package")
    folder.mkdir()
    text, changes = case
    argv = ["couple", write_package(folder, text), *settings_of(changes), "-o", folder / "out"]
    check(*called(*argv, figures=False), folder / "out")

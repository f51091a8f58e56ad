"""Scenarios and campaigns that nobody would write, the same ones each time.

Of campaigns only the reading: finding takes seconds each. `STICKSLIP_FUZZ=50 pytest -m "" FILE`
draws fifty times as many, other ones each time.
"""

import os
import shutil
from unittest import mock

import pytest
from fuzzed import called, campaigns, fault_of, scenarios, toml, write_campaign
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

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


@pytest.mark.parametrize(
    ("command", "computes"), [("gap", "gap._find"), ("plan", "plan.make_plan")]
)
@drawn(45)
@given(data=st.data())
def test_any_campaign_is_read_or_refused(place, command, computes, data):
    case = data.draw(campaigns(planned=command == "plan"))
    if (path := write_campaign(place, *case)) is None:
        return
    with mock.patch(f"cosim.cli.measurements.{computes}", side_effect=KeyboardInterrupt):
        status, out, err = called(command, path, "-o", place / command)
    assert status == 2 or err.endswith(READ), err
    check(status, out, err)

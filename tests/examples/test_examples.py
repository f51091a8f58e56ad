"""Every example runs from top to bottom, and says what it should."""

import runpy
from math import exp, pi
from pathlib import Path

import pytest
from stickslip.reference.coulomb_oscillator import CoulombOscillator

HERE = Path(__file__).parent
EXAMPLES = sorted(file.stem for file in HERE.glob("*.py") if not file.stem.startswith("test_"))


@pytest.fixture
def ran(at_home):
    """Name of an example -> what its variables hold at the end."""
    return lambda name: runpy.run_path(str(HERE / f"{name}.py"))


def test_coupled_run(ran):
    got = ran("coupled_run")
    assert got["time"][-1] == pytest.approx(3.0)
    assert got["heat"] == pytest.approx(0.842, abs=0.002)
    assert got["rise"][-1] == pytest.approx(0.0366, abs=2e-4)
    assert abs(got["lost"]) < 1e-11


def test_fmu_in_fmpy(ran):
    got = ran("fmu_in_fmpy")
    assert got["units"]["x"] == "m"
    assert got["result"]["slip_count"][-1] == 18
    assert got["slip_share"] == pytest.approx(0.851, abs=0.002)
    assert abs(got["result"]["energy_residual"][-1]) < 1e-11


def test_read_result(ran):
    got = ran("read_result")
    assert got["x"].attrs["units"] == "m"
    weight = 0.67 * 9.81
    line = CoulombOscillator(0.67, 4 * 20.17, 0.15, 0.2815 * weight, 0.2086 * weight)
    assert got["swing"] == pytest.approx(2.0 * line.amplitude, rel=5e-3)


def test_belt_length(ran):
    """Twice as long a belt comes round half as warm for ever: the heat spreads over it."""
    got = ran("belt_length")
    assert got["after_a_run"][1.0] == pytest.approx(0.344, abs=0.001)
    assert got["for_ever"][1.0] == pytest.approx(2.0 * got["for_ever"][2.0], rel=0.05)


def test_with_an_effect(ran):
    got = ran("with_an_effect")
    assert got["stroke"]["plain"] == pytest.approx(0.01746, abs=5e-5)
    assert got["stroke"]["with velocity weakening"] > 1.2 * got["stroke"]["plain"]
    assert abs(got["ledger"]) < 1e-11


@pytest.mark.slow
def test_find_gap(ran):
    got = ran("find_gap")
    assert got["gap"].verdict == "named"
    assert list(got["gap"].effects) == ["velocity_weakening"]


def test_every_example_is_run_here():
    assert {name.removeprefix("test_") for name in globals() if name.startswith("test_")} == {
        *EXAMPLES,
        "every_example_is_run_here",
    }


def test_own_participant(ran):
    """The force is a macro step h old, half of one in the mean: exp(pi^2 h / T) a period."""
    got = ran("own_participant")
    assert got["result"].status == "complete"
    grown = exp(pi**2 * got["STEP"] / got["PERIOD"])
    assert got["end"] == pytest.approx(0.01 * grown, rel=2e-6)

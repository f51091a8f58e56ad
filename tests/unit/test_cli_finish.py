"""The end of a run: Ctrl-C that loses nothing, and the last lines."""

import signal
from pathlib import Path

import pytest

from cosim.cli.finish import closing_lines
from cosim.cli.interruption import interruptible
from cosim.cli.patience import patient_interrupts
from cosim.interrupts import REQUESTS, held_interrupts

MECHANICS = {
    "name": "case",
    "time_reached": 30.0,
    "wall_time": 2.34,
    "after_run_up": {"frequency": 2.3, "slip_share": 0.9},
    "ledger": {"mechanics": {"relative_residual": 1e-13}},
}
HEAT = {
    "temperatures": {"interface": {"end_degC": -7.9432, "end_rise": 0.0568}},
    "heat_shares": {"belt": 0.31, "ice": 0.48, "air": 0.21},
}
HEAT_LEDGERS = {
    "heat": {"received": 5.126, "relative_residual": 2e-14},
    "coupling": {"relative_difference": 0.0},
}


def test_a_coupled_run_ends_in_six_lines():
    ledgers = {"ledger": MECHANICS["ledger"] | HEAT_LEDGERS}
    lines = closing_lines(MECHANICS | HEAT | ledgers, Path("out"), 6.0)
    assert len(lines) == 6
    for said in (
        "30 s in 6.0 s",
        "2.300 break-aways",
        "0.900",
        "-7.9432 degC",
        "+0.0568 K",
        "5.126 J",
        "belt 0.310",
        "1.0e-13 of the work",
        "out/report.html",
    ):
        assert any(said in line for line in lines), said


def test_mechanics_alone_says_nothing_of_heat_and_a_short_run_has_no_frequency():
    short = MECHANICS | {"after_run_up": {"frequency": None, "slip_share": None}}
    lines = closing_lines(short, Path("out"), 6.0)
    assert len(lines) == 4 and "not known" in lines[1]


def test_ctrl_c_works_at_once_while_there_is_nothing_to_lose():
    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt), patient_interrupts():
        signal.raise_signal(signal.SIGINT)
    assert signal.getsignal(signal.SIGINT) is before


@pytest.mark.parametrize("wanted", REQUESTS)
def test_what_asks_to_end_does_as_ctrl_c_does(wanted):
    before = {number: signal.getsignal(number) for number in REQUESTS}
    with pytest.raises(KeyboardInterrupt), interruptible(ending=False):
        signal.raise_signal(wanted)
    with interruptible(ending=False), patient_interrupts() as patience:
        patience.hold()
        signal.raise_signal(wanted)
        assert patience.requested
    assert {number: signal.getsignal(number) for number in REQUESTS} == before


def test_a_key_held_down_interrupts_once():
    with interruptible(ending=False):
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)
        signal.raise_signal(signal.SIGINT)


def test_held_interrupts_come_at_the_end_of_the_block():
    reached = []
    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        with held_interrupts():
            signal.raise_signal(signal.SIGINT)
            reached.append("the end of the block")
        reached.append("what follows")
    assert reached == ["the end of the block"] and signal.getsignal(signal.SIGINT) is before


def test_ctrl_c_waits_until_the_results_are_saved():
    with patient_interrupts() as patience:
        patience.hold()
        signal.raise_signal(signal.SIGINT)
        signal.raise_signal(signal.SIGINT)
        with pytest.raises(KeyboardInterrupt):
            patience.release()
        with pytest.raises(KeyboardInterrupt):  # the figures can be had again
            signal.raise_signal(signal.SIGINT)

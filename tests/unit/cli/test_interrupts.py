"""Ctrl-C, and the signals that ask for the same, at a time that suits."""

import signal
import threading

import pytest

from cosim.interrupts import (
    REQUESTS,
    deferred_interrupt,
    held_interrupts,
    interruptible,
    patient_interrupts,
)

# also where the tests run in the background, and ignore it
pytestmark = pytest.mark.usefixtures("ctrl_c", "as_it_was")


def handlers():
    """Of all that asks for an end."""
    return {number: signal.getsignal(number) for number in REQUESTS}


@pytest.fixture
def as_it_was(ctrl_c):
    """Nothing of ours is left behind."""
    before = handlers()
    yield before
    assert handlers() == before


def test_ctrl_c_works_at_once_while_there_is_nothing_to_lose():
    with pytest.raises(KeyboardInterrupt), patient_interrupts():
        signal.raise_signal(signal.SIGINT)


@pytest.mark.parametrize("wanted", REQUESTS)
def test_what_asks_to_end_does_as_ctrl_c_does(wanted):
    with pytest.raises(KeyboardInterrupt), interruptible(ending=False):
        signal.raise_signal(wanted)
    with interruptible(ending=False), patient_interrupts() as patience:
        patience.hold()
        signal.raise_signal(wanted)
        assert patience.requested


def test_a_key_held_down_interrupts_once():
    with interruptible(ending=False):
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)
        signal.raise_signal(signal.SIGINT)


def test_held_interrupts_come_at_the_end_of_the_block():
    reached = []
    with pytest.raises(KeyboardInterrupt):
        with held_interrupts():
            signal.raise_signal(signal.SIGINT)
            reached.append("the end of the block")
        reached.append("what follows")
    assert reached == ["the end of the block"]


def test_ctrl_c_waits_until_the_results_are_saved():
    with patient_interrupts() as patience:
        patience.hold()
        signal.raise_signal(signal.SIGINT)
        signal.raise_signal(signal.SIGINT)
        with pytest.raises(KeyboardInterrupt):
            patience.release()
        with pytest.raises(KeyboardInterrupt):  # the figures can be had again
            signal.raise_signal(signal.SIGINT)


def test_the_first_ctrl_c_of_a_run_waits_and_the_second_does_not():
    with pytest.raises(KeyboardInterrupt), deferred_interrupt() as interrupt:
        assert not interrupt.requested
        signal.raise_signal(signal.SIGINT)
        assert interrupt.requested
        signal.raise_signal(signal.SIGINT)


def test_a_command_that_ends_its_process_hears_nothing_afterwards(as_it_was):
    try:
        with interruptible(ending=True):
            pass
        assert set(handlers().values()) == {signal.SIG_IGN}
    finally:
        for number, handler in as_it_was.items():
            signal.signal(number, handler)


@pytest.mark.parametrize(
    "guard",
    [held_interrupts, deferred_interrupt, patient_interrupts, lambda: interruptible(ending=True)],
)
def test_outside_the_main_thread_nothing_is_changed(guard):
    """Python refuses to install a handler there; a notebook's kernel or a server may call us so."""
    failed = []

    def work():
        try:
            with guard():
                pass
        except ValueError as error:
            failed.append(error)

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert not failed

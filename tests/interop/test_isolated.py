"""A participant in a process of its own: the same numbers, and what happens to it is one line."""

import os
import signal
import subprocess
import sys
import tempfile
import time

import pytest
from c_units import made

from cosim import coupling
from cosim.coupling import (
    CouplingError,
    FmuError,
    FmuParticipant,
    IsolatedError,
    IsolatedParticipant,
)

SEGFAULT, HANG, ABORT, EXIT, RESTORES_WRONGLY, PRINTS, LOGS, LOGS_ERROR = range(1, 9)
FATAL, CLOSES, FLOOD = 10, 11, 12


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    return made("faulty", tmp_path_factory.mktemp("unit"))


@pytest.fixture
def place(tmp_path, monkeypatch):
    """Where all temporary files are, to be empty at the end."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    yield tmp_path
    assert list(tmp_path.iterdir()) == []


def isolated(path, fault=0, at=0.25, time_limit=30.0, **settings):
    settings = {"parameters": {"fault": fault, "at": at}, "inputs": {"u": 1.0}} | settings
    return IsolatedParticipant(FmuParticipant, path, "unit", time_limit=time_limit, **settings)


def started(unit):
    unit.enter_initialisation(0.0, 1.0)
    unit.exit_initialisation()
    return unit


def is_gone(pid):
    """Not even a zombie is left."""
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return True
    return False


def test_it_does_what_it_does_here(path, place):
    here, there = FmuParticipant(path, "unit", inputs={"u": 1.0}), isolated(path)
    assert (there.name, there.ports) == (here.name, here.ports)
    assert there.capabilities == here.capabilities
    with here, there:
        for unit in (here, there):
            started(unit)
        pid = there.pid
        for n in range(4):
            for unit in (here, there):
                unit.write({"u": 0.1 * n, "k": n})
                assert unit.step(0.25 * n, 0.25) is None
            assert there.read() == here.read()
        for unit in (here, there):
            unit.write_waveforms(
                {"u": coupling.Waveform((1.0, 2.0), 0.5), "c": coupling.Waveform((1.0,), 0.5)}
            )
            assert unit.read()["b"] == 1  # no step yet
            unit.step(1.0, 0.5)
        assert there.read() == here.read()
        here.load_state(there.save_state())
        there.load_state(here.save_state())
    assert is_gone(pid) and there.pid is None


def test_states_stay_there(path, place):
    with started(isolated(path)) as unit:
        unit.step(0.0, 0.25)
        state, before = unit.get_state(), unit.read()
        for _ in range(3):
            unit.write({"u": 4.0})
            unit.step(0.25, 0.25)
            ahead = unit.read()
            unit.set_state(state)
            assert unit.read() == before and ahead["x"] == 1.25
        unit.free_state(state)
        for call in (unit.set_state, unit.free_state):
            with pytest.raises(IsolatedError, match="a state that is not its own, or not any more"):
                call(state)
        assert coupling.restores_exactly(unit, 0.25, 0.25)
    with started(isolated(path, RESTORES_WRONGLY)) as unit:
        assert not coupling.restores_exactly(unit, 0.0, 0.25)


@pytest.mark.parametrize("fault, message", [
    (SEGFAULT, r"its process was ended by SIGSEGV \(.*\) in the call of step"),
    (ABORT, r"its process was ended by SIGABRT \(.*\) in the call of step"),
    (EXIT, "its process ended with status 3 in the call of step"),
    (CLOSES, "its process closed the line to this one in the call of step"),
    (LOGS_ERROR, "too hot"),
    (FATAL, "broken for good"),
])  # fmt: skip
def test_a_crash_is_a_failed_step(path, place, capfd, fault, message):
    unit = isolated(path, fault)
    pid = unit.pid
    with coupling.CoupledSystem([unit], []) as system:
        result = coupling.run(system, coupling.GaussSeidel(("unit",)), stop=1.0, macro_step=0.125)
    assert result.status == "failed" and result.time.tolist() == [0.0, 0.125, 0.25]
    assert result["unit.x"].tolist() == [0.0, 0.125, 0.25]
    assert is_gone(pid) and unit.pid is None
    assert "\n" not in result.reason
    expected = f"^unit: failed in the step from t = 0.25 s: {message}"
    with pytest.raises(coupling.ParticipantError, match=expected):
        raise result.error
    assert capfd.readouterr() == ("", "")


def test_a_hang_ends_at_the_time_limit(path, place, capfd):
    with started(isolated(path, HANG, at=0.0, time_limit=0.5)) as unit:
        pid = unit.pid
        said = "did not answer to the call of step within 0.5 s, its time limit; its process was"
        with pytest.raises(IsolatedError, match=said):
            unit.step(0.0, 0.25)
        assert is_gone(pid)
        with pytest.raises(IsolatedError, match="its process has ended"):
            unit.read()
    assert capfd.readouterr() == ("", "")


def test_a_kill_from_outside_is_noticed(path, place):
    with started(isolated(path)) as unit:
        os.kill(unit.pid, signal.SIGKILL)
        with pytest.raises(IsolatedError, match=r"ended by SIGKILL \(Killed\) in the call of step"):
            unit.step(0.0, 0.25)
        started(unit)  # afresh, in a new process
        unit.step(0.0, 0.25)
        assert unit.read()["x"] == 0.25


def test_what_asks_us_to_end_does_not_end_it(path, place):
    with started(isolated(path)) as unit:
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            os.kill(unit.pid, number)
        unit.step(0.0, 0.25)
        assert unit.read()["x"] == 0.25


def test_an_interrupt_in_the_middle_of_a_call_leaves_nothing(path, place, ctrl_c):
    unit = started(isolated(path, HANG, at=0.0))
    pid = unit.pid
    before = signal.signal(signal.SIGALRM, signal.default_int_handler)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.2)
        with pytest.raises(KeyboardInterrupt):
            unit.step(0.0, 0.25)
    finally:
        signal.signal(signal.SIGALRM, before)
    assert is_gone(pid)
    unit.close()


def test_a_process_whose_unit_has_put_away_the_output_ends_at_once(tmp_path):
    program = """
import os, sys
from multiprocessing import Pipe
from cosim.processes import serve
ours, theirs = Pipe()
ours.close()
sys.stdout = None
serve(theirs.fileno(), os.getppid(), sys.argv[1])
"""
    command = [sys.executable, "-c", program, str(tmp_path / "scratch")]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60.0)
    assert (done.returncode, done.stderr) == (1, "")


def test_what_it_writes_and_logs_is_kept(path, place, capfd):
    with started(isolated(path, LOGS, at=0.0)) as unit:
        unit.step(0.0, 0.25)
        assert [str(m) for m in unit.messages] == ["unit: t = 0 s: warning [heat]: warm"]
    with started(isolated(path, ABORT, at=0.0)) as unit:
        with pytest.raises(IsolatedError):
            unit.step(0.0, 0.25)
        assert [m.text for m in unit.messages] == ["the unit's last words"]
    assert capfd.readouterr() == ("", "")


def test_a_flood_of_words_holds_nothing_up_and_is_bounded(path, place):
    with started(isolated(path, FLOOD, at=0.0)) as unit:
        unit.step(0.0, 0.25)
    assert len(unit.messages) == 1000 and unit.messages.dropped == 99_000
    assert list(unit.messages)[-1].text == "line 99999 of a flood"


# --- its beginning ---


def test_what_is_refused_there_is_refused_here(path, place):
    with pytest.raises(FmuError, match="no input of unit is named 'v'"):
        isolated(path, inputs={"v": 1.0})
    with pytest.raises(FmuError, match="no such file"):
        isolated("nothing.fmu")


def test_what_cannot_be_made_there_is_said(path, monkeypatch):
    with pytest.raises(CouplingError, match="cannot be handed to another process"):
        IsolatedParticipant(lambda: None)
    with pytest.raises(CouplingError, match="time_limit = 0 s: must be greater than 0"):
        isolated(path, time_limit=0.0)
    monkeypatch.setattr(made, "__module__", "__main__")
    with pytest.raises(CouplingError, match="made: is defined in the script that runs"):
        IsolatedParticipant(made)


# --- our own end ---

LEFT = """
import os, sys, time
from cosim.coupling import FmuParticipant, IsolatedParticipant

unit = IsolatedParticipant(
    FmuParticipant, sys.argv[1], parameters={"fault": int(sys.argv[2])}, time_limit=60.0
)
unit.enter_initialisation(0.0, 1.0)
unit.exit_initialisation()
print(unit.pid, flush=True)
if sys.argv[3] == "killed":
    unit.step(0.0, 0.25)
    time.sleep(60.0)
"""


def comes_true(condition, seconds=20.0):
    deadline = time.monotonic() + seconds
    while not condition() and time.monotonic() < deadline:
        time.sleep(0.05)
    return condition()


@pytest.mark.parametrize("fault", [0, HANG])
@pytest.mark.parametrize("how", ["left", "killed"])
def test_it_does_not_outlive_us(path, tmp_path, fault, how):
    """Whether this process ends without closing it, or is killed, waiting or in a call."""
    parent = subprocess.Popen(
        [sys.executable, "-c", LEFT, str(path), str(fault), how], stdout=subprocess.PIPE,
        stderr=subprocess.PIPE, text=True, env={**os.environ, "TMPDIR": str(tmp_path)},
    )  # fmt: skip
    pid = int(parent.stdout.readline())
    if how == "killed":
        time.sleep(0.3)
        parent.kill()
    parent.wait(30)
    assert comes_true(lambda: is_gone(pid))
    assert comes_true(lambda: list(tmp_path.iterdir()) == [])
    assert parent.stderr.read() == ""

"""The file of what is said in a run: what is in a line, what goes on, what the disk refuses."""

import errno
from datetime import datetime

import numpy as np
import pytest
from linear_participant import Linear

from cosim.coupling import CoupledSystem, Message, Messages
from cosim.coupling.record import MessageLog

WARM = Message("motor", 0.1, "warning", "heat", "warm")


def rows(path):
    """Of each line all but the wall time."""
    lines = path.read_text(encoding="utf-8").splitlines()
    return [line.split("\t")[1:] for line in lines if line and not line.startswith("#")]


def test_a_line_has_both_times_and_is_there_at_once(tmp_path):
    path = tmp_path / "messages.log"
    log = MessageLog(path)
    assert not path.exists()
    log.add(WARM)
    log.add(Message("motor", None, "ok", "two\nlines", "tab\tand \x1b[2Jescape"))
    head, first, second = path.read_text(encoding="utf-8").splitlines()  # nothing is closed yet
    assert head.startswith("# wall time (UTC)\tsimulated time (s)\t")
    wall, *told = first.split("\t")
    assert told == ["0.1", "motor", "warning", "heat", "warm"]
    assert datetime.fromisoformat(wall).tzinfo is not None
    assert second.split("\t")[1:] == ["", "motor", "ok", "two lines", "tab and  [2Jescape"]


def test_what_an_earlier_run_left_goes_and_what_a_cut_off_one_left_stays(tmp_path):
    path = tmp_path / "messages.log"
    with MessageLog(path) as log:
        log.add(WARM)
    with path.open("a") as file:
        file.write("a line that a kill has cut")
    with MessageLog(path, resumed=True) as log:
        log.add(Message("motor", 0.2, "error", "", "hot"))
        assert log.told() == f"2 messages (1 warning, 1 error) in {path}"
    assert [row[1:3] for row in rows(path) if row] == [["motor", "warning"], ["motor", "error"]]
    assert "\n# the run was cut off" in path.read_text(encoding="utf-8")
    MessageLog(path).close()
    assert not path.exists()


def test_only_warnings_and_errors_are_worth_a_word(tmp_path):
    with MessageLog(tmp_path / "messages.log") as log:
        log.add(Message("motor", 0.1, "ok", "", "fine"))
        log.add(Message("motor", 0.1, "output", "", "a line"))
        assert log.told() == ""
        for _ in range(2):
            log.add(WARM)
        assert log.told().startswith("4 messages (2 warnings) in ")


def test_a_flood_does_not_fill_the_disk(tmp_path):
    path = tmp_path / "messages.log"
    with MessageLog(path, most_bytes=1000) as log:
        for _ in range(1000):
            log.add(WARM)
    assert path.stat().st_size <= 1000
    assert log.told().endswith(f"in {path}, the last {1000 - len(rows(path))} left out")


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EACCES])
def test_what_the_disk_refuses_is_said_and_raises_nothing(tmp_path, monkeypatch, number):
    def refuse(*_):
        raise OSError(number, "the disk says no")

    shown = []
    monkeypatch.setattr("cosim.coupling.record.log.FileIO", refuse)
    with MessageLog(tmp_path / "messages.log", shown=shown.append) as log:
        log.add(WARM)
    assert log.told().endswith(", not all: the disk says no")
    assert shown == ["motor: t = 0.1 s: warning [heat]: warm"]


def speaker(name):
    unit = Linear(name, [[-1.0]], np.zeros((1, 0)), [[1.0]], ins={}, outs={"x": "m"}, x=[1.0])
    unit.messages = Messages(name)
    return unit


def test_a_system_hands_over_what_was_said_before_and_what_is_to_come():
    first, silent = speaker("first"), speaker("silent")
    del silent.messages
    first.messages.add("ok", "", "early")
    system, heard = CoupledSystem([first, silent], []), []
    system.listen(heard.append)
    first.messages.add("ok", "", "late")
    system.messages.add("warning", "steps", "a remark")
    assert [(m.source, m.text) for m in heard] == [
        ("first", "early"),
        ("first", "late"),
        ("(master)", "a remark"),
    ]

"""Processes end in good order, however many calls wait and however long those under way take."""

import os
import subprocess
import sys
from importlib.util import find_spec

import pytest
from process_ids import is_soon, lives

from cosim.processes import apart, as_finished, processes

# two calls under way, six that wait
INTERRUPTED = """
import time
from cosim.processes import pool

if __name__ == "__main__":
    try:
        with pool(2) as submit:
            for _ in range(8):
                submit(time.sleep, 60.0)
            time.sleep(2.0)
            raise KeyboardInterrupt
    except KeyboardInterrupt:
        print("interrupted", flush=True)
"""


def interrupted(folder, program):
    """A program that says at last that it was interrupted, and no more; in time."""
    script = folder / "program.py"
    script.write_text(program, encoding="utf-8")
    command = [sys.executable, str(script)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=50, check=True)
    assert done.stdout.strip() == "interrupted" and "Traceback" not in done.stderr


def test_an_interrupt_ends_calls_that_do_not_look_up(tmp_path):
    interrupted(tmp_path, INTERRUPTED)


def square(number):
    return number**2


def test_results_come_in_order_or_as_they_are_finished():
    numbers = [(n,) for n in range(5)]
    for jobs in (1, 2):
        with processes(jobs) as mapped:
            assert list(mapped(square, numbers)) == [0, 1, 4, 9, 16]
        assert sorted(as_finished(jobs, square, numbers)) == [0, 1, 4, 9, 16]


def test_apart_returns_and_raises_what_the_call_does():
    assert apart(divmod, 7, 2) == (3, 1)
    with pytest.raises(ZeroDivisionError):
        apart(divmod, 7, 0)


def test_apart_says_that_its_process_died():
    with pytest.raises(RuntimeError, match="without an answer"):
        apart(os._exit, 3)


ENDLESS = """
import os, signal, threading, time
from cosim.processes import apart

threading.Timer(3.0, os.kill, (os.getpid(), signal.SIGINT)).start()
signal.signal(signal.SIGINT, signal.default_int_handler)
try:
    apart(time.sleep, 600.0)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


def test_an_interrupt_ends_a_call_apart(tmp_path):
    """Of whose end nobody knows; the limit is that of the test, far below the ten minutes."""
    interrupted(tmp_path, ENDLESS)


KILLED = """
from cosim.processes import processes
from long_work import work

with processes(2) as mapped:
    list(mapped(work, [(PLACE,)] * 2))
"""
LONG_WORK = """
import os, time

def work(place):
    open(os.path.join(place, str(os.getpid())), "w").close()
    time.sleep(600.0)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="looks in /proc")
def test_workers_end_with_a_parent_that_was_killed(tmp_path):
    """They would wait for it, for ever; and long before they would in good order."""
    place, script = tmp_path / "there", tmp_path / "killed.py"
    place.mkdir()
    script.write_text(KILLED.replace("PLACE", repr(str(place))), encoding="utf-8")
    (tmp_path / "long_work.py").write_text(LONG_WORK, encoding="utf-8")
    with subprocess.Popen([sys.executable, str(script)]) as parent:
        is_soon(lambda: len(list(place.iterdir())) == 2)
        parent.kill()
    workers = [int(file.name) for file in place.iterdir()]
    is_soon(lambda: not any(map(lives, workers)), 5.0)


def test_apart_looks_for_nothing_in_a_unit_that_was_left_on_the_path(tmp_path, monkeypatch):
    """An instance that was never set up leaves its resources there, with a pythonfmu in them."""
    package = tmp_path / "resources" / "left_by_a_unit"
    package.mkdir(parents=True)
    (package / "__init__.py").touch()
    monkeypatch.syspath_prepend(package.parent)
    assert find_spec(package.name) is not None
    assert apart(find_spec, package.name) is None

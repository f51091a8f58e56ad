"""Processes of others: whether one lives, and waiting for what they do."""

import time
from contextlib import suppress
from pathlib import Path


def lives(number):
    """Whether a process is there, and no zombie that nobody has asked for."""
    with suppress(OSError):
        return Path(f"/proc/{number}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    return False


def is_soon(true, seconds=40.0):
    """Fails unless it comes true in time."""
    until = time.monotonic() + seconds
    while not true():
        assert time.monotonic() < until
        time.sleep(0.02)

"""What a sweep raises."""

from __future__ import annotations


class SweepError(ValueError):
    """A sweep that cannot be started; one line: key, what is wrong, what is allowed."""


class SweepStopped(RuntimeError):
    """A sweep that could not be finished; one line, with what is kept and how to go on."""


class WorkersLost(RuntimeError):
    """Worker processes ended in mid-work; what they had not returned is to be done again."""

"""Some combinations that a worker does in one go."""

from __future__ import annotations

import platform
import threading
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from pydantic import ValidationError
from stickslip import Parameters
from stickslip.compiled import compiled_kernel

from cosim.interrupts import held_interrupts

from .combination import ERROR, Row, Run, compute, model_version, with_changes, without_values
from .errors import SweepStopped

_LOADING = threading.Lock()


class Work(NamedTuple):
    """What all combinations of a sweep have in common."""

    base: Parameters
    run: Run
    version: str


class Task(NamedTuple):
    """One combination: its content key and how it differs from the base."""

    key: str
    changes: Mapping[str, Any]


def compute_chunk(
    work: Work, tasks: Sequence[Task], stopped: Callable[[], bool] = lambda: False
) -> list[Row]:
    """Run in a worker: the outcome of every task, of those before ``stopped`` where it says so.

    Raises SweepStopped where the worker has another version of the model.
    """
    if stopped():
        return []
    if model_version() != work.version:
        raise SweepStopped(
            f"the worker on {platform.node()} has another version of the model than this process; "
            "install the same one there, or start again if it was just changed"
        )
    with _LOADING, held_interrupts():  # threads of one worker must not load the kernel twice
        compiled_kernel()
    with warnings.catch_warnings():
        # what there is to warn of was said when the combinations were checked
        warnings.simplefilter("ignore", UserWarning)
        return list(_outcomes(work, tasks, stopped))


def _outcomes(work: Work, tasks: Sequence[Task], stopped: Callable[[], bool]) -> Iterator[Row]:
    def look(time: float) -> None:
        if stopped():
            raise _Stop

    try:
        for task in tasks:
            yield _outcome(work, task, look)
    except _Stop:
        return


class _Stop(BaseException):
    """Leaves a run in its middle; not one of the errors that are recorded."""


def _outcome(work: Work, task: Task, look: Callable[[float], None]) -> Row:
    try:
        parameters = with_changes(work.base, task.changes)
    except ValidationError as error:  # checked before: only a worker's other pydantic refuses
        return without_values(task.key, ERROR, " ".join(str(error).split()))
    return compute(task.key, parameters, work.run, look)

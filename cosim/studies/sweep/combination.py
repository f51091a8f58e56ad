"""One combination: parameters, content key, outcome; and the chunk of them that a worker does."""

from __future__ import annotations

import ast
import hashlib
import inspect
import json
import platform
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from importlib import resources
from typing import Any, NamedTuple

from pydantic import ValidationError
from stickslip import Parameters, Trajectory, simulate
from stickslip.generation.source import kernel_source

from cosim.scenario import Scenario, ScenarioError

from . import features as feature_module
from .coupled import HEAT_FEATURES, changed, coupled_features, heat_version
from .errors import SweepStopped
from .features import FEATURES, features

COMPLETE, FAILED, ERROR = 0, 1, 2
STATUS_MEANINGS = "complete failed error"
KEY_DIGITS = 32


class Run(NamedTuple):
    """How every combination is run: duration and time between two rows, s; coupled to the heat.

    Where the combinations are whole scenarios, each has a duration and an interval of its own.
    """

    duration: float
    output_interval: float
    coupled: bool = False

    def of(self, parameters: Parameters) -> Run:
        """Of one combination."""
        if not isinstance(parameters, Scenario):
            return self
        run = parameters.run
        return self._replace(duration=run.duration, output_interval=run.output_interval)

    @property
    def features(self) -> dict[str, tuple[str, str]]:
        """Name -> unit and long name of what is told of each run."""
        return FEATURES | HEAT_FEATURES if self.coupled else FEATURES


class Row(NamedTuple):
    """The outcome of one combination; values in the order of `FEATURES`."""

    key: str
    status: int
    reason: str
    values: tuple[float, ...]


@cache
def model_version() -> str:
    """Hash of everything that turns parameters into features; comments do not count."""
    package = resources.files("stickslip")
    files = sorted(file.name for file in package.iterdir() if file.name.endswith(".py"))
    texts = [(package / name).read_text(encoding="utf-8") for name in files]
    texts += [kernel_source(), inspect.getsource(feature_module)]
    plain = "\n".join(ast.unparse(ast.parse(text)) for text in texts)
    return hashlib.sha256(plain.encode()).hexdigest()[:KEY_DIGITS]


def content_key(parameters: Parameters, run: Run) -> str:
    """Hash of all that the outcome depends on: two equal combinations have one key."""
    duration, output_interval, coupled = run.of(parameters)
    whole = isinstance(parameters, Scenario)
    # a name is none of what a run depends on
    tables = parameters.model_dump(mode="json", exclude={"name"} if whole else None)
    content: list[Any] = [model_version(), duration, output_interval, tables]
    if coupled:
        content.append(heat_version())
    text = json.dumps(content, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:KEY_DIGITS]


def with_changes(base: Parameters, changes: Mapping[str, Any]) -> Parameters:
    """``base`` with `block.key` -> value; raises pydantic's ValidationError, of a whole scenario
    ScenarioError."""
    if isinstance(base, Scenario):
        return changed(base, changes)
    tables = base.model_dump()
    for key, value in changes.items():
        block, _, entry = key.partition(".")
        tables[block][entry] = value
    return Parameters.model_validate(tables, strict=True)


def compute(
    key: str, parameters: Parameters, run: Run, progress: Callable[[float], None] | None = None
) -> Row:
    """Simulate one combination. What goes wrong is in the row: it never ends a sweep.

    FAILED: the model gave up, and would again. ERROR: the program raised, worth another try.
    progress: called with the time reached; it ends the run by what is no Exception.
    """
    try:
        if isinstance(parameters, Scenario):
            return _of_scenario(key, parameters, run, progress)
        trajectory = simulate(parameters, run.duration, run.output_interval, progress=progress)
        if not trajectory.complete:
            return without_values(key, FAILED, trajectory.reason)
        return Row(key, COMPLETE, "", _values(trajectory))
    except Exception as error:  # noqa: BLE001 - named in the row, for whoever reads the sweep
        text = " ".join(str(error).split())
        return without_values(key, ERROR, f"{type(error).__name__}: {text}")


def _of_scenario(
    key: str, scenario: Scenario, run: Run, progress: Callable[[float], None] | None
) -> Row:
    if run.coupled:
        numbers, reason = coupled_features(scenario, progress)
    else:
        own = run.of(scenario)
        trajectory = simulate(
            scenario.mechanics,
            own.duration,
            own.output_interval,
            interface_temperature=scenario.ambient.temperature_degC,
            progress=progress,
        )
        reason = trajectory.reason
        numbers = {} if reason else features(trajectory)
    if reason:
        return without_values(key, FAILED, reason)
    return Row(key, COMPLETE, "", tuple(numbers[name] for name in run.features))


def without_values(key: str, status: int, reason: str) -> Row:
    """The row of a combination that has no features."""
    return Row(key, status, reason, ())


def _values(trajectory: Trajectory) -> tuple[float, ...]:
    numbers = features(trajectory)
    return tuple(numbers[name] for name in FEATURES)


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
    with warnings.catch_warnings():
        # what there is to warn of was said when the combinations were checked
        warnings.simplefilter("ignore", UserWarning)
        return list(_outcomes(work, tasks, stopped))


def _outcomes(work: Work, tasks: Sequence[Task], stopped: Callable[[], bool]) -> Iterator[Row]:
    def stop_if_told(time: float) -> None:
        if stopped():
            raise _Stop

    try:
        for task in tasks:
            yield _outcome(work, task, stop_if_told)
    except _Stop:
        return


class _Stop(BaseException):
    """Leaves a run in its middle; not one of the errors that are recorded."""


def _outcome(work: Work, task: Task, stop_if_told: Callable[[float], None]) -> Row:
    try:
        parameters = with_changes(work.base, task.changes)
    except (
        ValidationError,
        ScenarioError,
    ) as error:  # checked before: only a worker's other pydantic refuses
        return without_values(task.key, ERROR, " ".join(str(error).split()))
    return compute(task.key, parameters, work.run, stop_if_told)

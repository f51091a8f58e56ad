"""One combination: parameters, content key, outcome; and the chunk of them that a worker does."""

from __future__ import annotations

import ast
import hashlib
import inspect
import json
import platform
import warnings
from collections.abc import Mapping, Sequence
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any, NamedTuple

from stickslip import Parameters, simulate
from stickslip.catalogue import CATALOGUE, Catalogue

from cosim.processes import stop_if_told
from cosim.scenario import Scenario

from . import features as feature_module
from .coupled import changed, coupled_features
from .errors import SweepStopped
from .features import ALL, FEATURES, Feature, features

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
    def features(self) -> dict[str, Feature]:
        """Name -> what is told of each run."""
        return ALL if self.coupled else FEATURES


class Row(NamedTuple):
    """The outcome of one combination; values in the order of its run's features, or none.

    FAILED: the model gave up, and would again. ERROR: the program raised, worth another try.
    """

    key: str
    status: int
    reason: str
    values: tuple[float, ...] = ()


class Work(NamedTuple):
    """What all combinations of a sweep have in common."""

    base: Parameters
    run: Run
    version: str


class Task(NamedTuple):
    """One combination: its content key and how it differs from the base."""

    key: str
    changes: Mapping[str, Any]


@cache
def model_version(catalogue: Catalogue = CATALOGUE) -> str:
    """Hash of everything that turns parameters into features; comments do not count."""
    package = resources.files("stickslip")
    files = sorted(file.name for file in package.iterdir() if file.name.endswith(".py"))
    texts = [(package / name).read_text(encoding="utf-8") for name in files]
    # rows are kept without the names of their numbers
    texts += [catalogue.text, inspect.getsource(feature_module), repr(list(ALL))]
    plain = "\n".join(ast.unparse(ast.parse(text)) for text in texts)
    return hashlib.sha256(plain.encode()).hexdigest()[:KEY_DIGITS]


@cache
def heat_version() -> str:
    """Hash of everything that a coupled run's numbers hang on beside the mechanics."""
    folders = [Path(str(resources.files(package))) for package in ("thermal", "cosim.coupling")]
    files = [file for folder in folders for file in folder.rglob("*.py")]
    texts = sorted(file.read_text(encoding="utf-8") for file in files)
    return hashlib.sha256("".join(texts).encode()).hexdigest()


def content_key(parameters: Parameters, run: Run) -> str:
    """Hash of all that the outcome depends on: two equal combinations have one key."""
    duration, output_interval, coupled = run.of(parameters)
    whole = isinstance(parameters, Scenario)
    # a name is none of what a run depends on
    tables = parameters.model_dump(mode="json", exclude={"name"} if whole else None)
    content: list[Any] = [model_version(parameters.catalogue), duration, output_interval, tables]
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
    return type(base).model_validate(tables, strict=True)


def compute_chunk(work: Work, tasks: Sequence[Task]) -> list[Row]:
    """Run in a worker: the outcome of every task.

    Raises SweepStopped where the worker has another version of the model.
    """
    if model_version(work.base.catalogue) != work.version:
        raise SweepStopped(
            f"the worker on {platform.node()} has another version of the model than this process; "
            "install the same one there, or start again if it was just changed"
        )
    with warnings.catch_warnings():
        # what there is to warn of was said when the combinations were checked
        warnings.simplefilter("ignore", UserWarning)
        return [compute(work, task) for task in tasks]


def compute(work: Work, task: Task) -> Row:
    """Simulate one combination. What goes wrong is in the row: it never ends a sweep."""
    try:
        numbers, reason = _simulated(with_changes(work.base, task.changes), work.run)
    except Exception as error:  # noqa: BLE001 - named in the row, for whoever reads the sweep
        return Row(task.key, ERROR, f"{type(error).__name__}: {' '.join(str(error).split())}")
    if reason:
        return Row(task.key, FAILED, reason)
    return Row(task.key, COMPLETE, "", tuple(numbers[name] for name in work.run.features))


def _simulated(parameters: Parameters, run: Run) -> tuple[dict[str, float], str]:
    """Features by name; or why there are none."""
    duration, output_interval, coupled = run.of(parameters)
    if not isinstance(parameters, Scenario):
        trajectory = simulate(parameters, duration, output_interval, progress=stop_if_told)
    elif coupled:
        return coupled_features(parameters, stop_if_told)
    else:
        trajectory = simulate(
            parameters.mechanics,
            duration,
            output_interval,
            interface_temperature=parameters.ambient.temperature_degC,
            progress=stop_if_told,
        )
    return ({}, trajectory.reason) if trajectory.reason else (features(trajectory), "")

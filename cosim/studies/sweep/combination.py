"""One combination: parameters, content key, outcome; and the chunk of them that a worker does."""

from __future__ import annotations

import ast
import hashlib
import inspect
import json
import math
import platform
import warnings
from collections.abc import Mapping, Sequence
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any, NamedTuple

from stickslip import Parameters, simulate
from stickslip.catalogue import CATALOGUE, Catalogue

from cosim.report import contents, heat_numbers, run_summary
from cosim.report.dataset import run_columns, trajectory_columns
from cosim.scenario import Scenario, ScenarioError
from cosim.scenario.toml_file import changed_tables

from . import features as feature_module
from .axis import list_entry
from .features import ALL, FEATURES, Feature, features


class SweepStopped(RuntimeError):
    """A sweep that could not be finished; one line, with what is kept and how to go on."""


#: In place of a key: a whole scenario.
SCENARIO = "scenario"
COMPLETE, FAILED, ERROR = 0, 1, 2
STATUS_MEANINGS = "complete failed error"
KEY_DIGITS = 32


class Run(NamedTuple):
    """How every combination is run: duration, time between two rows, most that it may take, s.

    coupled: to the heat. Where the combinations are whole scenarios, each has times of its own.
    """

    duration: float = 30.0
    output_interval: float = 0.01
    patience: float = math.inf
    coupled: bool = False

    def of(self, parameters: Parameters) -> Run:
        """Of one combination."""
        if not isinstance(parameters, Scenario):
            return self
        own = parameters.run
        return Run(own.duration, own.output_interval, own.patience, self.coupled)

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


#: One combination: its content key, and how it differs from the base.
Task = tuple[str, Mapping[str, Any]]


class Work(NamedTuple):
    """What all combinations of a sweep have in common."""

    base: Parameters
    run: Run
    version: str


@cache
def model_version(catalogue: Catalogue = CATALOGUE) -> str:
    """Hash of everything that turns parameters into features; comments do not count."""
    package = resources.files("stickslip")
    files = sorted(file.name for file in package.iterdir() if file.name.endswith(".py"))
    texts = [(package / name).read_text(encoding="utf-8") for name in files]
    own = (feature_module, run_summary, contents, heat_numbers)
    # rows are kept without the names of their numbers
    texts += [catalogue.text, *map(inspect.getsource, own), repr(list(ALL))]
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
    # a name is none of what a run depends on
    tables = parameters.model_dump(mode="json", exclude={"name"})
    times = run.of(parameters)[:2]
    content: list[Any] = [model_version(parameters.catalogue), *times, tables]
    if run.coupled:
        content.append(heat_version())
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()[:KEY_DIGITS]


def with_changes(base: Parameters, changes: Mapping[str, Any]) -> Parameters:
    """``base`` with `block.key` -> value; of a scenario `block.key[2].entry` is one of the second
    table of a list, and `SCENARIO` -> another takes the base's place.

    Raises pydantic's ValidationError, of a whole scenario ScenarioError in one line.
    """
    if not isinstance(base, Scenario):
        tables = changed_tables(base.model_dump(), changes)
        return type(base).model_validate(tables, strict=True)
    given: Scenario = changes.get(SCENARIO, base)
    tables = given.to_tables()
    for key, value in changes.items():
        if key != SCENARIO:
            tables = changed_tables(tables, _of_list(tables, key, value))
    return type(given).from_tables(tables)


def _of_list(tables: Mapping[str, Any], key: str, value: Any) -> dict[str, Any]:
    """The key and value, of one table of a list the list's."""
    if (place := list_entry(key)) is None:
        return {key: value}
    name, number, entry = place
    block, _, of_list = name.partition(".")
    entries = [dict(one) for one in tables.get(block, {}).get(of_list, ())]
    if not 1 <= number <= len(entries):
        raise ScenarioError(f"{key}: the scenario has {len(entries)} of {name}, counted from 1")
    entries[number - 1][entry] = value
    return {name: tuple(entries)}


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
        return [compute(work, *task) for task in tasks]


def compute(work: Work, key: str, changes: Mapping[str, Any]) -> Row:
    """Simulate one combination. What goes wrong is in the row: it never ends a sweep."""
    try:
        numbers, reason = _simulated(with_changes(work.base, changes), work.run)
    except Exception as error:  # noqa: BLE001 - named in the row, for whoever reads the sweep
        return Row(key, ERROR, f"{type(error).__name__}: {' '.join(str(error).split())}")
    if reason:
        return Row(key, FAILED, reason)
    return Row(key, COMPLETE, "", tuple(numbers[name] for name in work.run.features))


def _simulated(parameters: Parameters, run: Run) -> tuple[dict[str, float], str]:
    """Features by name; or why there are none."""
    temperature, mechanics = None, parameters
    if isinstance(parameters, Scenario):
        if run.coupled:
            from cosim.coupling.case import run_scenario

            result = run_scenario(parameters).result
            if result.status != "complete":
                return {}, result.reason
            return features(run_columns(result, parameters, "")), ""
        temperature, mechanics = parameters.ambient.temperature_degC, parameters.mechanics
    times = run.of(parameters)[:2]
    trajectory = simulate(mechanics, *times, interface_temperature=temperature)
    if trajectory.reason:
        return {}, trajectory.reason
    return features(trajectory_columns(trajectory, mechanics, "")), ""

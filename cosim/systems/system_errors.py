"""What is wrong with a system's file, in one line."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any, TypeVar

from pydantic import BaseModel

from cosim.coupling import CouplingError, FmuError
from cosim.scenario.validation import ScenarioError, checked

Model = TypeVar("Model", bound=BaseModel)
#: Tables of a system's file of which keys can be set from outside.
TABLES = ("coupling", "run")


class SystemFault(ValueError):
    """A system cannot be read or makes no sense; one line: file, key, what, what is allowed."""


def table_of(model: type[Model], entries: Any, place: str) -> Model:
    """A table of a file, checked; SystemFault names its keys with their place."""
    if not isinstance(entries, Mapping):
        raise SystemFault(f"{place}: not a table, allowed is a table [{place}]")
    try:
        return checked(model, entries)
    except ScenarioError as fault:
        line = str(fault)
        raise SystemFault(line if line.startswith(place) else f"{place}.{line}") from None


def changed(tables: dict[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """The tables of a file with other values; changes: `table.key` -> value."""
    for key, value in changes.items():
        table, _, entry = key.partition(".")
        place = tables.setdefault(table, {})
        if table not in TABLES or not isinstance(place, dict):
            raise SystemFault(f"{key}: cannot be set here, allowed are keys of coupling and run")
        place[entry] = value
    return tables


@contextmanager
def naming(source: str, key: str = "") -> Iterator[None]:
    """Let a fault of a system say file and key, where it does not yet."""
    try:
        yield
    except (SystemFault, ScenarioError, CouplingError, FmuError) as fault:
        said = str(fault)
        kind = SystemFault if isinstance(fault, ScenarioError) else type(fault)
        if said.startswith(source):
            raise kind(said) from None
        raise kind(f"{source}: {key}: {said}" if key else f"{source}: {said}") from None

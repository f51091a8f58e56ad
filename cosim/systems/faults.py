"""What is wrong with a system's file, in one line."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeVar

from pydantic import BaseModel

from cosim.scenario.faults import ScenarioError, checked

Model = TypeVar("Model", bound=BaseModel)


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

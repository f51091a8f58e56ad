"""Every key of a scenario in words: what it is, its unit, its default, what is allowed."""

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from pydantic.fields import FieldInfo

from cosim.scenario.defaults import IN_PROPORTION, stated
from cosim.scenario.scenario import scenario_type
from cosim.scenario.validation import allowed, entries_of, known_keys, spaced, table_of, unit_of


class Key(NamedTuple):
    """A key of a scenario.

    default: of a file that leaves the key out; None where it must be given. plain: the same with
    `defaults = "plain"`, and in Python.
    """

    key: str
    default: Any
    plain: Any
    unit: str
    allowed: str
    description: str

    @property
    def words(self) -> str:
        """`key = value unit`; of one that must be given, what it is called."""
        if self.default is None:
            return f"{self.key} (must be given)"
        return f"{self.key} = {shown(self.default)}{spaced(self.unit)}"


#: What a key's default is where it is no value: said in its place.
FOLLOWS = {"name": "the file's name", "defaults": "rig"}


def all_keys() -> list[Key]:
    """The keys of a scenario, in the order of its tables."""
    return [
        key
        for name, field in known_keys(scenario_type()).items()
        if table_of(field.annotation) is None
        for key in _with_entries(name, field)
    ]


def _with_entries(name: str, field: FieldInfo) -> Iterator[Key]:
    """A key, and behind it those of each table where it is a list of tables."""
    yield _key(name, field, stated().get(name, FOLLOWS.get(name, field.default)))
    if (table := entries_of(field.annotation)) is not None:
        for entry, inner in table.model_fields.items():
            yield _key(f"{name}[].{entry}", inner, inner.default)


def _key(name: str, field: FieldInfo, default: Any) -> Key:
    needed = field.is_required()
    said = field.description or ""
    if name in IN_PROPORTION:
        other, usual = IN_PROPORTION[name]
        said += f"; left out, {stated()[name] / usual:.3g} of {other}"
    return Key(
        key=name,
        default=None if needed else default,
        plain=None if needed else field.default,
        unit=unit_of(field),
        allowed=allowed(name, field),
        description=said,
    )


def found(word: str, keys: list[Key]) -> list[Key]:
    """Those that have a word in their key, or else those that have it in their description.

    >>> [key.key for key in found("springs.s", all_keys())]
    ['springs.stiffness']
    """
    word = word.lower()
    named = [key for key in keys if word in key.key.lower()]
    return named or [key for key in keys if word in key.description.lower()]


def taken_line(taken: Mapping[str, Any]) -> str:
    """What a file left to the defaults, in one line; "" for nothing."""
    if not taken:
        return ""
    units = known_keys(scenario_type())
    told = [f"{key} = {shown(value)}{spaced(unit_of(units[key]))}" for key, value in taken.items()]
    return f'left to the defaults: {", ".join(told)} (defaults = "plain" takes none of them)'


def shown(value: Any) -> str:
    """A value as a file has it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(map(shown, value))}]"
    return f"{value:g}" if isinstance(value, float) else str(value)

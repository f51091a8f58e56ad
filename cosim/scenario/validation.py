"""The check of what a file holds, and what is wrong with it in one line a user can act on.

Scenarios, campaigns and the keys of a sweep go through here.
"""

import re
from collections.abc import Iterable, Mapping
from typing import Any, Literal, TypeVar, get_args, get_origin

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo
from stickslip.packaged import packaged_tables
from stickslip.quantity import details
from stickslip.units import QUANTITY, in_unit

from cosim.names import nearest_key

LONGEST_VALUE = 60
#: What is wrong and what is allowed, in words.
WORDS = packaged_tables(__package__, "validation.toml")


Model = TypeVar("Model", bound=BaseModel)
#: An entry of pydantic's report.
Fault = Mapping[str, Any]


class ScenarioError(ValueError):
    """A scenario cannot be read or makes no sense; one line: file, key, what, what is allowed."""


def checked(model: type[Model], tables: Mapping[str, Any]) -> Model:
    """A model from the tables of a TOML file; ScenarioError in one line."""
    try:
        return model.model_validate(_in_si(_tuples(tables), model), strict=True)
    except ValidationError as report:
        raise ScenarioError(describe_faults(report, model)) from None


def _tuples(value: Any) -> Any:
    """TOML's lists as the tuples that the models hold."""
    if isinstance(value, Mapping):
        return {key: _tuples(entry) for key, entry in value.items()}
    return tuple(_tuples(entry) for entry in value) if isinstance(value, list) else value


def _in_si(tables: Any, model: type[BaseModel]) -> Any:
    """The tables with "870 g" as the number that the key takes; what is no such text stays."""
    if not isinstance(tables, Mapping):
        return tables
    made = dict(tables)
    for key, field in model.model_fields.items():
        value, table = made.get(key), table_of(field.annotation) or entries_of(field.annotation)
        if isinstance(value, str) and (number := in_unit(value, unit_of(field))) is not None:
            made[key] = number
        elif table is not None and isinstance(value, tuple):
            made[key] = tuple(_in_si(each, table) for each in value)
        elif table is not None:
            made |= {key: _in_si(value, table)} if key in made else {}
    return made


def entries_of(kind: Any) -> type[BaseModel] | None:
    """What a list of tables is made of."""
    return table_of(get_args(kind)[0]) if get_origin(kind) is tuple else None


def known_keys(model: type[BaseModel]) -> dict[str, FieldInfo]:
    """`key` and `table.key` -> field, of a model made of tables."""
    keys = {}
    for name, field in model.model_fields.items():
        keys[name] = field
        if (table := table_of(field.annotation)) is not None:
            keys |= {f"{name}.{key}": entry for key, entry in table.model_fields.items()}
    return keys


def describe_faults(report: ValidationError, model: type[BaseModel]) -> str:
    """The first fault of pydantic's report, and how many keys have others, in one line."""
    keys = known_keys(model)
    faults: dict[str, list[Fault]] = {}
    for fault in report.errors():
        # deeper places are entries of a list or branches of a union, of one key
        loc = fault["loc"]
        place = loc[:2] if _is_of_a_table(loc, keys) else loc[:1]
        faults.setdefault(".".join(map(str, place)), []).append(fault)
    # a key that is missing may be there, and spelled wrong
    key, first = min(faults.items(), key=lambda each: each[1][0]["type"] == "missing")
    line = _describe(key, first, keys)
    others = len(faults) - 1
    return line + (f" (and {others} more fault{'s' * (others > 1)})" if others else "")


def _is_of_a_table(loc: tuple[Any, ...], keys: Mapping[str, FieldInfo]) -> bool:
    """Whether the second part of a place is a key, not an entry of a list or of free names."""
    field = keys.get(str(loc[0])) if loc else None
    free = field is not None and get_origin(field.annotation) is dict
    return len(loc) > 1 and not isinstance(loc[1], int) and not free


def _describe(key: str, faults: list[Fault], keys: dict[str, FieldInfo]) -> str:
    fault = faults[0]
    if (within := _inner_table(fault["loc"], keys)) is not None:
        place, table, rest = within
        inner = _describe(str(rest[0]), [{**fault, "loc": rest}], known_keys(table))
        return f"{place}.{inner}"
    if fault["type"] == "missing" and fault["loc"][-1] == key:
        about = f" ({keys[key].description})" if keys[key].description else ""
        return f"{key}: missing, needed is {allowed(key, keys[key])}{about}"
    if fault["type"] == "value_error":
        return _of_several_keys(key, str(fault["ctx"]["error"]), keys)
    if fault["type"] == "extra_forbidden":
        return f"{key}: no such key, {_known_instead(key, keys)}"
    wrong = (
        WORDS["wrong"].get(fault["type"], "not possible") if len(faults) == 1 else "not possible"
    )
    if wrong == "not a number" and QUANTITY.fullmatch(str(fault["input"])):
        wrong = not_in(unit_of(keys[key]))
    return f"{key}: {wrong} ({_shown(fault['input'])}), allowed is {allowed(key, keys[key])}"


def _inner_table(
    loc: tuple[Any, ...], keys: dict[str, FieldInfo]
) -> tuple[str, type[BaseModel], tuple[Any, ...]] | None:
    """Place and kind of the table of a list, or by a free name, that a fault is in; the rest."""
    for depth in (1, 2):
        key = ".".join(map(str, loc[:depth]))
        kind = keys[key].annotation if key in keys and len(loc) > depth + 1 else None
        if (table := entries_of(kind)) is not None:
            return f"{key}[{loc[depth] + 1}]", table, loc[depth + 1 :]
        if get_origin(kind) is dict and (table := table_of(get_args(kind)[1])) is not None:
            return f"{key}.{loc[depth]}", table, loc[depth + 1 :]
    return None


def _of_several_keys(table: str, message: str, keys: dict[str, FieldInfo]) -> str:
    """`key = value ...` from a check of several values, as `table.key: value ...`."""
    message = " ".join(message.split())
    match = re.match(r"(?P<key>[\w.]+) (?:= )?(?P<rest>.*)", message)
    if match:
        for key in (f"{table}.{match['key']}", match["key"]):
            if key in keys:
                return f"{key}: {match['rest']}"
    return f"{table}: {message}" if table else message


def _known_instead(key: str, keys: dict[str, FieldInfo]) -> str:
    """The key that was meant, or all that its table has."""
    if key == "contact.radius":
        return "the contact's radius is rig.contact_radius"
    if near := nearest_key(key, keys):
        return f"nearest known: {near}"
    siblings = [known for known in keys if known.rpartition(".")[0] == key.rpartition(".")[0]]
    return f"known: {', '.join(known.rpartition('.')[2] for known in siblings)}"


def unit_of(field: FieldInfo) -> str:
    """The unit that a field was declared with; "1" for a plain number, and for none."""
    return str(details(field).get("unit", "1"))


def not_in(unit: str) -> str:
    """What is wrong with a number that is given in another unit, or in one at all."""
    others = WORDS["read"].get(unit)
    such_as = f", such as {others}" if others else ""
    return "has no unit" if unit == "1" else f"not in a unit of{spaced(unit)}{such_as}"


def spaced(unit: str) -> str:
    """A unit behind a number, as one writes it; "" for none."""
    return "" if unit == "1" else " " + unit.replace(".", " ")


def allowed(key: str, field: FieldInfo) -> str:
    """What a key may hold, in words."""
    if (table := table_of(field.annotation)) is not None:
        return f"a table [{key}] with {', '.join(table.model_fields)}"
    return _allowed_type(field.annotation, field.metadata, spaced(unit_of(field)))


def _allowed_type(kind: Any, metadata: Iterable[Any], unit: str) -> str:
    if kind is float or kind is int:
        bounds = [
            words.format(getattr(bound, name))
            for bound in metadata
            for name, words in WORDS["bounds"].items()
            if getattr(bound, name, None) is not None
        ]
        number = "a number" if kind is float else "a whole number"
        return f"{number} {' and '.join(bounds)}".rstrip() + unit
    if kind is bool:
        return "true or false"
    if kind is Any:
        return "a value"
    if kind is str and not any(getattr(bound, "pattern", None) for bound in metadata):
        return "a text"
    if kind is str:
        return 'a text of 1 to 100 characters without /\\:*?"<>|, a dot or a space not first'
    if get_origin(kind) is Literal:
        return " or ".join(f'"{choice}"' for choice in get_args(kind))
    if get_origin(kind) is tuple:
        return _allowed_list(get_args(kind), unit)
    if get_origin(kind) is dict and table_of(get_args(kind)[1]) is not None:
        return "a table of tables"
    if get_origin(kind) is dict:
        return f"a table of names, each with {_allowed_type(get_args(kind)[1], (), unit)}"
    parts = get_args(kind)
    if hasattr(kind, "__metadata__"):
        return _allowed_type(parts[0], _flat_metadata(kind), unit)
    return " or ".join(_allowed_type(part, (), unit) for part in parts)


def _allowed_list(entries: tuple[Any, ...], unit: str) -> str:
    if (table := table_of(entries[0])) is not None:
        return f"a list of tables with {', '.join(table.model_fields)}"
    if entries[-1] is Ellipsis:
        return f"a list of {_allowed_type(entries[0], (), unit)}"
    if entries[0] is str:
        return f"a list of {len(entries)} texts"
    return f"a list of {len(entries)}, each {_allowed_type(entries[0], (), unit)}"


def _flat_metadata(kind: Any) -> list[Any]:
    """Bounds of an Annotated type, also those that sit inside a Field."""
    return [
        bound
        for entry in kind.__metadata__
        for bound in getattr(entry, "metadata", None) or [entry]
    ]


def table_of(kind: Any) -> type[BaseModel] | None:
    """The model, where a type is a table of keys."""
    return kind if isinstance(kind, type) and issubclass(kind, BaseModel) else None


def _shown(value: Any) -> str:
    """A value as the file has it, shortened."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        text = f'"{value}"'.replace("\n", "\\n")
    elif isinstance(value, tuple):
        text = f"[{', '.join(_shown(entry) for entry in value)}]"
    elif isinstance(value, dict):
        text = f"a table with {', '.join(map(str, value)) or 'nothing'}"
    elif isinstance(value, int) and value.bit_length() > 1000:
        text = "an integer of over 300 digits"
    else:
        text = str(value)
    return text if len(text) <= LONGEST_VALUE else text[: LONGEST_VALUE - 3] + "..."

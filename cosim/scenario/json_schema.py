"""What a file may hold as a JSON Schema, by which editors check it, complete it and explain it.

Draft 7, in the part of it that editors of TOML know (taplo, and with it Even Better TOML). A schema
says what one key may be; what several say together is checked when the file is read.
"""

import math
from collections.abc import Mapping
from typing import Any

from pydantic import BaseModel

from cosim.scenario.defaults import RIG, stated
from cosim.scenario.scenario import scenario_type

DRAFT = "http://json-schema.org/draft-07/schema#"
#: Line of a TOML file, its first, by which editors find its schema.
DIRECTIVE = "#:schema ./{file}"
#: Name of the schema of scenarios as a file beside them.
SCENARIO_FILE = "scenario.schema.json"
#: Of a number that is written with its unit.
WITH_UNIT = r"^\s*[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?\s*[A-Za-zµ°]"
#: What pydantic says beyond what an editor shows: names made of keys, and our own remarks.
_OWN_WORDS = ("title", "unit", "typical", "tried")


def scenario_schema() -> dict[str, Any]:
    """The schema of a scenario file, with the defaults of a file."""
    schema = schema_of(scenario_type(), "a scenario of stickslip")
    for key, value in stated().items():
        table, _, entry = key.partition(".")
        owner = _resolved(schema, schema["properties"][table])
        owner["properties"][entry]["default"] = value
    schema["properties"]["defaults"]["default"] = RIG
    del schema["properties"]["name"]["default"]  # the file's
    return schema


def schema_of(model: type[BaseModel], title: str) -> dict[str, Any]:
    """The schema of a model that is made of tables."""
    schema: dict[str, Any] = _plainer(model.model_json_schema())
    return {"$schema": DRAFT, "title": title, **schema}


def _resolved(schema: Mapping[str, Any], entry: dict[str, Any]) -> dict[str, Any]:
    """A table itself, where it is only referred to."""
    name = str(entry.get("$ref", "")).rpartition("/")[2]
    return schema["$defs"][name] if name else entry


def _plainer(node: Any) -> Any:
    """A schema, or what is in it, in words that draft 7 has; units are told with what a key is."""
    if isinstance(node, list):
        return [_plainer(entry) for entry in node]
    if not isinstance(node, dict):
        return node
    if "$ref" in node:
        return {"$ref": node["$ref"]}
    told: dict[str, Any] = {
        key: _entries(value) if key in ("properties", "$defs") else _plainer(value)
        for key, value in node.items()
        if key not in _OWN_WORDS and key != "default"
    }
    if _is_finite(default := node.get("default")):
        told["default"] = default
    unit = node.get("unit", "1")
    if unit != "1" and "description" in told:
        told["description"] += f" [{unit}]"
        if told.get("type") == "number":  # or with a unit, as "870 g"
            told |= {"type": ["number", "string"], "pattern": WITH_UNIT}
    kinds = told.pop("prefixItems", [])
    if kinds:
        told["items"] = kinds[0] if all(kind == kinds[0] for kind in kinds) else kinds
    return told


def _entries(named: Mapping[str, Any]) -> dict[str, Any]:
    """Of names that users gave, each what it stands for; "title" may be one of them."""
    return {name: _plainer(entry) for name, entry in named.items()}


def _is_finite(value: Any) -> bool:
    """Whether there is a default that JSON can say."""
    if isinstance(value, (list, tuple)):
        return all(_is_finite(entry) for entry in value)
    return value is not None and not (isinstance(value, float) and not math.isfinite(value))

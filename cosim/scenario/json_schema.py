"""What a file may hold as a JSON Schema, by which editors check it, complete it and explain it.

And a new scenario file that names it: a commented one to begin from, or a copy of another.
"""

import json
import math
import re
from collections.abc import Mapping
from importlib import resources
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from cosim.files import OutputRefused, writable, write_text
from cosim.scenario.defaults import RIG, stated
from cosim.scenario.scenario import SUFFIX, scenario_of, scenario_type, source_text
from cosim.scenario.toml_file import parsed

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


def write_new(name: str, source: str | None = None, *, force: bool = False) -> Path:
    """Write NAME.toml, and beside it the schema that editors find by its first line; the file.

    name: of the scenario, with the folder that it is to be in. source: a file or a packaged
    scenario, of which the new one is a copy; None: the commented one of `new.toml`. ScenarioError
    where that or the name cannot be; OutputRefused for what is there already, unless ``force``.
    """
    file = Path(f"{name.removesuffix(SUFFIX)}{SUFFIX}")
    text = _text(file, source)
    scenario_of(parsed(text, file), file)
    schema = file.parent / SCENARIO_FILE
    if file.exists() and not force:
        raise OutputRefused(
            f"{file}: is there, allowed is another NAME, or --force to overwrite it"
        )
    if schema.exists() and not force and not _is_schema(schema):
        raise OutputRefused(
            f"{schema}: is there and no schema of this tool, allowed is another folder, or "
            "--force to overwrite it"
        )
    writable(file.parent, (file.name, schema.name))
    write_text(schema_text(), schema)
    write_text(text, file)
    return file


def schema_text() -> str:
    """The schema of a scenario, as a file has it."""
    return json.dumps(scenario_schema(), indent=1, allow_nan=False) + "\n"


def _text(file: Path, source: str | None) -> str:
    """The content of the new file."""
    name = file.name.removesuffix(SUFFIX)
    if source is None:
        text = (resources.files("cosim.scenario") / "new.toml").read_text(encoding="utf-8")
        text = text.replace("@FILE@", str(file)).replace("@NAME@", name)
    else:
        text = re.sub(r"\A#:schema .*\n", "", source_text(source))
        head, table, rest = re.split(r"(?m)(^\[|\Z)", text, maxsplit=1)
        text = re.sub(r"(?m)^name *=.*$", lambda _: f'name = "{name}"', head) + table + rest
    return f"{DIRECTIVE.format(file=SCENARIO_FILE)}\n{text}"


def _is_schema(file: Path) -> bool:
    try:
        content = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return False
    return isinstance(content, dict) and content.get("title") == scenario_schema()["title"]

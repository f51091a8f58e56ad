"""A new scenario file: a commented one to begin from, or a copy of another under its own name."""

import json
import re
from importlib import resources
from pathlib import Path

from cosim.files import OutputRefused, writable, write_text
from cosim.scenario.json_schema import DIRECTIVE, SCENARIO_FILE, scenario_schema
from cosim.scenario.scenario import SUFFIX, scenario_of, source_text
from cosim.scenario.toml_file import parsed


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

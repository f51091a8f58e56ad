"""Every TOML block of the documentation, by the schemas that editors have."""

import json
import re
import tomllib
from pathlib import Path

import jsonschema
import pytest

from cosim.cli import main
from cosim.cli.arguments import COMMANDS

ROOT = Path(__file__).resolve().parents[2]
SITE = ROOT / "tests" / "docs" / "site"
PAGES = [ROOT / "README.md", *sorted(SITE.rglob("*.md"))]
#: Printed, and written by a cell.
BLOCKS = re.compile(r"(?:^```toml|^%%writefile [^\n]*\.toml)\n(.*?)^```", re.M | re.S)
FOUND = [
    pytest.param(text, id=f"{page.relative_to(ROOT)}-{number}")
    for page in PAGES
    for number, text in enumerate(BLOCKS.findall(page.read_text(encoding="utf-8")))
    if not text.startswith("[project")  # of a distribution's own pyproject.toml
]


@pytest.fixture(scope="module")
def schemas():
    """Kind -> what checks a file of it."""
    found = {}
    with pytest.MonkeyPatch.context() as patch:
        for kind in COMMANDS["schema"]["arguments"]["kind"]["choices"]:
            said: list[str] = []
            patch.setattr("builtins.print", lambda text, said=said, **_: said.append(text))
            assert main(["schema", kind]) == 0
            found[kind] = jsonschema.Draft7Validator(json.loads("".join(said)))
    whole = {key: value for key, value in found["campaign"].schema.items() if key != "required"}
    found["part of a campaign"] = jsonschema.Draft7Validator(whole)
    return found


def kind_of(tables):
    """Of which file a block is, by the tables that only such a file has."""
    if "units" in tables:
        return "system"
    if "errors" in tables and "run" not in tables:
        return "part of a campaign"
    if "run" in tables and isinstance(tables["run"], list):
        return "campaign" if all("file" in r or "summary" in r for r in tables["run"]) else "plan"
    return "scenario"


@pytest.mark.parametrize("text", FOUND)
def test_a_block_is_as_its_schema_has_it(schemas, text):
    tables = tomllib.loads(text)
    if "effects" in tables:  # of one's own: an editor's schema does not know their tables
        known = schemas["scenario"].schema["properties"]
        tables = {key: value for key, value in tables.items() if key in known}
    faults = [
        f"{'.'.join(map(str, error.absolute_path))}: {error.message}"
        for error in schemas[kind_of(tables)].iter_errors(tables)
    ]
    assert not faults


def test_there_are_blocks_and_a_wrong_one_is_refused(schemas):
    assert len(FOUND) >= 6
    for wrong in ("[rig]\nmas = 1", "[surface]\nspeed = 'fast'", "[coupling]\nscheme = 'x'"):
        assert not schemas["scenario"].is_valid(tomllib.loads(wrong))

"""`stickslip schema`: what a TOML file may hold, as JSON Schema."""

import json
from argparse import Namespace
from pathlib import Path
from typing import Any

from pydantic import Field, create_model

from cosim.cli import DONE
from cosim.files import writable, write_text
from cosim.manifest import require_json
from cosim.scenario.json_schema import scenario_schema, schema_of


def execute(arguments: Namespace) -> int:
    """Print or write the schema; 0."""
    file = None if arguments.output is None else Path(arguments.output)
    if file is not None:
        writable(file.parent, (file.name,))
        require_json(file, ("$schema", "title"), arguments.force)
    text = json.dumps(_schema(arguments.kind), indent=1, allow_nan=False) + "\n"
    if file is None:
        print(text, end="")
    else:
        write_text(text, file)
    return DONE


def _schema(kind: str) -> dict[str, Any]:
    if kind == "scenario":
        return scenario_schema()
    if kind == "system":
        from cosim.systems.toml_file import System

        return schema_of(System, "a system of stickslip")
    return _campaign_schema(kind)


def _campaign_schema(kind: str) -> dict[str, Any]:
    """A campaign that was made, or of a plan, whose runs need no file."""
    from cosim.gap.data.campaign_file import CampaignTable, MeasuredRunTable, RunTable

    run: Any = RunTable if kind == "plan" else MeasuredRunTable
    runs: Any = (tuple[run, ...], Field(min_length=1, description="a table [[run]] for each run"))
    whole = create_model("Campaign", __base__=CampaignTable, run=runs)
    schema = schema_of(whole, f"a {kind} of stickslip")
    schema["$defs"][run.__name__]["required"] = ["mass", "stiffness", "surface_speed"]
    return schema

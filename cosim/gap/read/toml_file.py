"""campaign.toml as checked tables."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel

from cosim.gap.errors import CampaignError
from cosim.gap.read.tables import CampaignTable, RunTable
from cosim.names import nearest
from cosim.scenario.faults import ScenarioError, checked

FILE_NAME = "campaign.toml"
Table = TypeVar("Table", bound=BaseModel)


def read_tables(path: Path) -> tuple[CampaignTable, list[RunTable]]:
    """The campaign's table and those of its runs; CampaignError in one line."""
    tables = _parse(path)
    runs = tables.pop("run", None)
    if not isinstance(runs, list) or not all(isinstance(run, dict) for run in runs):
        near = nearest("run", [key for key in tables if key not in CampaignTable.model_fields])
        hint = f" (nearest: {near})" if runs is None and near else ""
        raise CampaignError(f"{path}: run: no runs{hint}, allowed is a table [[run]] for each run")
    if not runs:
        raise CampaignError(f"{path}: run: no runs, allowed is a table [[run]] for each run")
    if "name" not in tables:
        tables["name"] = path.resolve().parent.name or "unnamed"
    campaign = _checked(CampaignTable, tables, str(path))
    return campaign, [
        _checked(RunTable, run, f"{path}: run {number}") for number, run in enumerate(runs, 1)
    ]


def _parse(path: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except FileNotFoundError:
        raise CampaignError(
            f"{path}: no such file, allowed is a campaign.toml or a folder with one"
        ) from None
    except OSError as error:
        raise CampaignError(f"{path}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError as error:
        raise CampaignError(
            f"{path}: byte {error.start + 1} is not UTF-8, allowed is a TOML file in UTF-8"
        ) from None
    except (ValueError, RecursionError) as error:  # TOMLDecodeError is a ValueError
        raise CampaignError(f"{path}: not TOML: {' '.join(str(error).split())}") from None


def _checked(model: type[Table], tables: Mapping[str, Any], where: str) -> Table:
    try:
        return checked(model, tables)
    except ScenarioError as fault:
        raise CampaignError(f"{where}: {fault}") from None

"""The catalogue as one self-contained HTML page."""

from __future__ import annotations

from importlib import resources
from typing import Any

from jinja2 import Environment, StrictUndefined

from cosim.report.drawing import Picture
from cosim.report.inline import inline

from .catalogue import allowed


def page(entries: list[dict[str, Any]], pictures: dict[str, Picture]) -> str:
    """HTML of the entries of `described`, each with its picture inside."""
    environment = Environment(
        autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters |= {"inline": inline, "allowed": allowed}
    source = resources.files(__package__).joinpath("effects.html.j2").read_text(encoding="utf-8")
    return environment.from_string(source).render(entries=entries, pictures=pictures)

"""The study as one self-contained HTML page."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import resources
from typing import Any

from jinja2 import Environment, StrictUndefined

from cosim.report.drawing import Picture
from cosim.report.inline import inline


def page(numbers: dict[str, Any], sentences: Sequence[str], pictures: Sequence[Picture]) -> str:
    """HTML of the numbers of `result.as_json`, what they say, and the maps."""
    environment = Environment(
        autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters["inline"] = inline
    source = resources.files(__package__).joinpath("stability.html.j2").read_text(encoding="utf-8")
    return environment.from_string(source).render(
        numbers=numbers, sentences=sentences, pictures=pictures
    )

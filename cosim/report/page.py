"""Pages: one self-contained HTML file, its pictures inside, its look that of all the others.

A page is a Jinja template that extends `page.html.j2` and fills its blocks title, style and
content. Beside its own values it has ``figure(picture)`` and the filter ``number``.
"""

from __future__ import annotations

import base64
import math
from dataclasses import dataclass, field
from functools import cache
from typing import Any

from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

#: Pixels of an inch: on a page, and of the pictures.
CSS_DPI, DPI = 96, 150


@dataclass(frozen=True)
class Picture:
    """A PNG with its caption."""

    name: str
    caption: str
    png: bytes = field(repr=False)


def render(template: str, package: str, **values: Any) -> str:
    """HTML of a template that lies in a package, or in `cosim.report`, with the values it names.

    Raises jinja2.UndefinedError where one of them is missing.
    """
    return _environment(package).get_template(template).render(**values)


@cache
def _environment(package: str) -> Environment:
    environment = Environment(
        loader=ChoiceLoader([PackageLoader("cosim.report"), PackageLoader(package, ".")]),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["number"] = number
    environment.globals["figure"] = figure
    return environment


def figure(picture: Picture, alt: str = "") -> Markup:
    """A picture and its caption, as wide as its inches say."""
    return Markup(
        '<figure><img width="{}" src="data:image/png;base64,{}" alt="{}">\n'
        "<figcaption>{}</figcaption></figure>\n"
    ).format(
        _width(picture.png),
        base64.b64encode(picture.png).decode("ascii"),
        alt or picture.caption,
        picture.caption,
    )


#: Of its own largest value, and of its nominal one, what is rounding in a channel.
OF_LARGEST, OF_NOMINAL = 1e-15, 1e-16


def number(
    value: float | str | None, digits: int = 4, *, largest: float = 0.0, nominal: float = 0.0
) -> str:
    """So many significant digits, plain text as it is, a dash for none.

    largest, nominal: sizes of the channel that it is of, in its unit; rounding beside them is 0.
    """
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return "–"
    if isinstance(value, str):
        return value
    if abs(value) <= max(OF_LARGEST * abs(largest), OF_NOMINAL * abs(nominal)):
        return "0"
    return f"{value:.{digits}g}".replace("-", "−")


def _width(png: bytes) -> int:
    """Width of a picture on the page, CSS pixels: type as large as its inches say."""
    pixels = int.from_bytes(png[16:20], "big")  # of the header, after signature and chunk name
    return round(pixels * CSS_DPI / DPI)

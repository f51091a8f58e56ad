"""Pages: one self-contained HTML file, its pictures inside, its look that of all the others.

A page is a Jinja template that extends `page.html.j2` and fills its blocks title, style and
content. Beside its own values it has ``figure(picture)``, ``boxes(tiles)`` and the filters
``number``, ``unit`` and ``g``.

A picture with ``live`` is drawn by the scripts in `templates/`, to hover over, to zoom or to play;
others are PNGs. The scripts are in the page, plain and readable, and so is uPlot (MIT licence, in
`templates/uplot`), which draws the curves: a page asks for nothing outside. A table
scrolls by itself, so that a page never does sideways; one of more than two columns is a list where
the window is narrow, its words behind their heads.
"""

import base64
import math
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache, cached_property
from importlib import import_module, resources
from pathlib import Path
from typing import Any, ClassVar

from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined, select_autoescape

from cosim.files import writable, write_bytes, write_text
from cosim.result import Result

#: Pixels of an inch: on a page, and of the pictures.
CSS_DPI, DPI = 96, 150


@dataclass(frozen=True)
class Picture:
    """A figure with its caption.

    drawing: makes its PNG, when that is asked for. alt: what a reader hears who does not see it
    (left out, the caption). live: what the page draws in place of the PNG, see `cosim.report.live`.
    """

    name: str
    caption: str
    drawing: Callable[[], bytes] = field(repr=False)
    alt: str = ""
    live: Mapping[str, Any] | None = field(default=None, repr=False)

    @cached_property
    def png(self) -> bytes:
        """The file's content."""
        return self.drawing()

    @property
    def width(self) -> int:
        """On the page, CSS pixels: type as large as its inches say."""
        pixels = int.from_bytes(self.png[16:20], "big")  # behind signature and chunk name
        return round(pixels * CSS_DPI / DPI)


UPLOT, ITS_LICENCE = "uplot/uPlot.iife.min.js", "uplot/LICENSE"
#: The only address in a page with it: where uPlot is from. A page names none.
ITS_HOME = "https://github.com/leeoniya/"
#: What draws each kind of live picture, in this order; of `templates/`.
SCRIPTS = {
    "over_time": (UPLOT, "live.js", "plot.js", "over_time.js"),
    "phase_plane": (UPLOT, "live.js", "plot.js", "phase_plane.js"),
    "top_view": ("live.js", "rig.js", "player.js", "top_view.js"),
}
#: On every page, and behind the scripts of live pictures.
EVERYWHERE = "page.js"
TEMPLATES = resources.files("cosim.report") / "templates"


def render(template: str, package: str, **values: Any) -> str:
    """HTML of a template that lies in a package, or in `cosim.report`, with the values it names.

    Raises jinja2.UndefinedError where one of them is missing.
    """
    kinds: set[str] = set()
    environment = _environment(package)
    parts: Any = environment.get_template("parts.html.j2").module

    def drawn(picture: Picture, alt: str = "") -> Any:
        if picture.live is not None:
            kinds.add(picture.live["kind"])
        return parts.figure(picture, alt or picture.alt or picture.caption)

    told = {"figure": drawn, "boxes": parts.boxes, "scripts": lambda: _scripts(kinds)}
    return environment.get_template(template).render(**values, **told)


def write_page(text: str, pictures: Iterable[Picture], folder: Path) -> None:
    """Pictures as files beside the page that has them, then the page."""
    for picture in pictures:
        write_bytes(picture.png, folder / f"{picture.name}.png")
    write_text(text, folder / "report.html")


class PageResult(Result):
    """A result with figures, which a module shows: loaded when asked for, as it draws.

    The module has `headline`, `tiles`, `page` (HTML and pictures of a result and a command line)
    and `write_numbers` (whatever else the command leaves, into a folder).
    """

    __slots__ = ()
    #: Name of the module.
    SHOWN_BY: ClassVar[str]

    def save(self, folder: str | Path, command: str = "") -> Path:
        """As `Result.save`; command: the line that the page says it is made by."""
        folder, shown_by = writable(Path(folder)), import_module(self.SHOWN_BY)
        shown_by.write_numbers(self, folder)
        html, pictures = shown_by.page(self, command)
        write_page(html, pictures, folder)
        return folder

    def _page(self) -> str:
        return str(import_module(self.SHOWN_BY).page(self)[0])

    def _answer(self) -> tuple[str, list[tuple[str, str]]]:
        shown_by = import_module(self.SHOWN_BY)
        return shown_by.headline(self), shown_by.tiles(self)


def texts(template: str, package: str, known: Mapping[str, Any]) -> Any:
    """The macros of a text template that lies in a package, as functions of what they are told.

    known: names that the template uses, such as those of a module.
    """
    return _environment(package).get_template(template, globals=dict(known)).module


def sentences(text: str) -> list[str]:
    """The paragraphs of a text, which blank lines part, each as one line."""
    parts = re.split(r"\n *\n", text)
    return [re.sub(r"[ \n]+", " ", part).strip() for part in parts if part.strip()]


def tiles_of(text: str) -> list[tuple[str, str]]:
    """Names and values of figures, of a text whose paragraphs are "name | value"."""
    parts = [line.partition("|") for line in sentences(text)]
    return [(name.strip(), value.strip()) for name, _, value in parts]


def _scripts(kinds: set[str]) -> list[str]:
    """The files of scripts that these kinds of live pictures need, each once."""
    files = (file for kind in SCRIPTS if kind in kinds for file in SCRIPTS[kind])
    return list(dict.fromkeys([*files, EVERYWHERE]))


@cache
def asset(file: str) -> str:
    """Text of a script or a style sheet in `templates/`."""
    text = (TEMPLATES / file).read_text(encoding="utf-8")
    if file == UPLOT:
        return f"/*\n{asset(ITS_LICENCE)}*/\n{text.replace(ITS_HOME, '')}"
    return text


@cache
def _environment(package: str) -> Environment:
    environment = Environment(
        loader=ChoiceLoader([PackageLoader("cosim.report"), PackageLoader(package, ".")]),
        autoescape=select_autoescape(["html.j2"]),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    own = {"number": number, "unit": unit_text, "g": "{:g}".format}
    environment.filters |= own | {"base64": lambda data: base64.b64encode(data).decode("ascii")}
    environment.globals["asset"] = asset
    # of the filter `tojson`, whose text is safe inside a script element, in which no entity is read
    how = {"allow_nan": False, "ensure_ascii": False, "separators": (",", ":")}
    environment.policies["json.dumps_kwargs"] = how
    return environment


def unit_text(unit: str) -> str:
    """A unit of FMI as it is read: powers raised, a root as such, a product with a space.

    >>> unit_text("W.s0.5/(m2.K)"), unit_text("kg.m2"), unit_text("degC")
    ('W √s/(m² K)', 'kg m²', '°C')
    """
    unit = re.sub(r"([A-Za-z]+)0\.5", r"√\1", unit)
    unit = re.sub(r"(?<=[A-Za-z])\d", lambda power: "⁰¹²³⁴⁵⁶⁷⁸⁹"[int(power[0])], unit)
    return {"degC": "°C", "deg": "°"}.get(unit, unit.replace(".", " "))


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
    # no power of ten where thousands are as short
    return f"{float(f'{value:.{digits}g}'):.{max(digits, 6)}g}".replace("-", "−")

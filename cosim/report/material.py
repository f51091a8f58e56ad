"""The block's material in what is read: texts and figures are written for ice."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ICE = "ice"
_WORD = r"\b(?:(?P<article>[Aa])n )?(?P<first>[Ii])ce\b(?!\.\w)"
#: What a page has that is no text: scripts, what is quoted as it is, pictures.
_KEPT = r"(?P<kept><(?P<tag>script|style|pre|code)\b.*?</(?P=tag)>|\"data:[^\"]*\")"
#: Longer texts in a live picture are packed numbers.
_LONGEST = 200


def of_material(text: str, material: str) -> str:
    """A text with the block's material where it says ice.

    >>> of_material("An ice block. Ice and belt, the ice_face", "steel")
    'A steel block. Steel and belt, the ice_face'
    """
    return _replaced(_WORD, text, material)


def page_of_material(html: str, material: str) -> str:
    """The same of a page, but for what in it is no text."""
    return _replaced(f"{_KEPT}|{_WORD}", html, material)


def figure_of_material(figure: Figure, material: str) -> Figure:
    """A figure, in whose texts the material is put."""
    from matplotlib.text import Text  # only for who draws

    if material != ICE:
        for text in figure.findobj(Text):
            text.set_text(of_material(text.get_text(), material))
    return figure


def live_of_material(node: Any, material: str) -> Any:
    """The same of what makes a picture alive: a tree of plain values."""
    if isinstance(node, Mapping):
        return {key: live_of_material(value, material) for key, value in node.items()}
    if isinstance(node, (list, tuple)):
        return [live_of_material(entry, material) for entry in node]
    is_text = isinstance(node, str) and len(node) < _LONGEST
    return of_material(node, material) if is_text else node


def _replaced(pattern: str, text: str, material: str) -> str:
    def instead(found: re.Match[str]) -> str:
        if found.groupdict().get("kept"):
            return found["kept"]
        name = material
        if found["article"]:
            an = "n" if material[0].lower() in "aeiou" else ""
            return f"{found['article']}{an} {name}"
        return name[0].upper() + name[1:] if found["first"] == "I" else name

    return text if material == ICE else re.sub(pattern, instead, text, flags=re.DOTALL)

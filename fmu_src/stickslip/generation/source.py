"""The kernel as the text of one module, from the core's files and the effects' declarations.

That one text is what becomes C, and what travels inside the FMU.
"""

import re
from collections.abc import Sequence
from functools import cache
from importlib import resources

from ..effects import EFFECTS
from ..effects.effect import Effect
from ..kernel import MODULES, terms
from ..kernel.tables import constants, value_names
from ..words import SAID, WHY_NOT
from .places import ARRAY
from .terms import terms_source

#: How the core spells an array of floats, and what it has for being several files. By patterns: to
#: parse and write it anew would take a command a tenth of a second.
_ANNOTATION = re.compile(r": Floats\b")
_FOR_FILES_ONLY = re.compile(r"(?m)^from (?:\.[\w.]*|__future__) import (?:\([^)]*\)|[^(\n]*)\n+")

#: Beside the kernel's text: files of the package as they are, but for where the kernel's names come
#: from.
AS_THEY_ARE = ("draws", "packing", "contradictions")
_OF_NAMES = "Names of the parameters in the order of the kernel's array ``v``."
_OF_WORDS = "What is said of contradictions, and of a motion that cannot go on, by their numbers."
_KERNEL = re.compile(r"(?m)^from (\.|stickslip\.)kernel\.[\w.]+ import")
_MODULE = re.compile(
    r"(?m)^from (\.|stickslip)\.?kernel(?:\.\w+)* import (?:\w+ as )?(layout|codes)$"
)


@cache
def kernel_source(effects: tuple[Effect, ...] = EFFECTS) -> str:
    """The core's files in order, without their mutual imports, between layout and terms."""
    # those of the catalogue stand as functions in this process already
    made_of = terms.TEXT if effects is EFFECTS else terms_source(effects)
    made = {"layout": layout_source(effects), "terms": made_of}
    return "\n".join(
        f"# {name}\n{made[name] if name in made else _core(name)}\n" for name in MODULES
    )


def travelling(effects: tuple[Effect, ...] = EFFECTS) -> dict[str, str]:
    """Module -> text of all that travels inside a unit of the block: the kernel, and how named
    parameters and random numbers enter it. In the order in which each imports those before it."""
    names = f"NAMES = {value_names(effects)}\n"
    told = f"SAID = {SAID}\nWHY_NOT = {WHY_NOT}\n"
    texts = {
        "kernel": kernel_source(effects),
        "names": f'"""{_OF_NAMES}"""\n\n{names}',
        "words": f'"""{_OF_WORDS}"""\n\n{told}',
    }
    for name in AS_THEY_ARE:
        texts[name] = (resources.files("stickslip") / f"{name}.py").read_text("utf-8")
    return {name: one_kernel(text) for name, text in texts.items()}


def one_kernel(text: str) -> str:
    """A file of the package where the kernel is one module."""
    text = _MODULE.sub(r"from \1 import kernel as \2", text)
    return _KERNEL.sub(r"from \1kernel import", text)


def layout_source(effects: Sequence[Effect] = EFFECTS) -> str:
    """Where each number stands, as assignments."""
    return "\n".join(f"{name} = {value!r}" for name, value in constants(effects).items()) + "\n"


def _core(name: str) -> str:
    file = f"{name.replace('.', '/')}.py"
    text = (resources.files("stickslip.kernel") / file).read_text("utf-8")
    return _ANNOTATION.sub(f": {ARRAY}", _FOR_FILES_ONLY.sub("", text))

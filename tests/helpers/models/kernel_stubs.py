"""Stubs of the kernel's made modules: a name that the layout lacks is an error of the type checker.

    python tests/helpers/models/kernel_stubs.py

writes them anew, after an effect has joined the house or a number the layout.
"""

import ast
from pathlib import Path

from stickslip.effects import EFFECTS
from stickslip.kernel import tables, terms

HEAD = "# made by tests/helpers/models/kernel_stubs.py\n"


def stubs() -> dict[str, str]:
    """File of `stickslip.kernel` -> text."""
    return {"layout.pyi": HEAD + _numbers(), "terms.pyi": HEAD + _functions()}


def _numbers() -> str:
    kinds = {tuple: "tuple[float, ...]", float: "float", int: "int"}
    lines = [f"{name}: {kinds[type(value)]}" for name, value in tables.constants().items()]
    return "\n".join(["from . import Floats as Floats", "", *lines, ""])


def _functions() -> str:
    """Those that the core calls; what is of one effect's file is called by them alone."""
    lines = ["from . import Floats", "", "TEXT: str", ""]
    own = tuple(f"{effect.id}_" for effect in EFFECTS)
    for node in ast.parse(terms.TEXT).body:
        if isinstance(node, ast.FunctionDef) and not node.name.startswith(own):
            taken = ast.unparse(node.args).replace("'float[:]'", "Floats")
            given = ast.unparse(node.returns) if node.returns else "None"
            lines.append(f"def {node.name}({taken}) -> {given}: ...")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    for file, text in stubs().items():
        (Path(terms.__file__).with_name(file)).write_text(text, encoding="utf-8")

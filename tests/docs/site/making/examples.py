"""The gallery: every example with what it printed and drew when tests/docs/gallery.py ran it."""

import ast
import os
from pathlib import Path

from .markdown import heading

EXAMPLES = Path(os.environ["STICKSLIP_CHECKOUT"]) / "tests" / "examples"
GALLERY = Path(os.environ["STICKSLIP_GALLERY"])


def text() -> str:
    """A section for each."""
    return "".join(_section(file) for file in sorted(EXAMPLES.glob("*.py")))


def _section(file: Path) -> str:
    source = file.read_text(encoding="utf-8")
    title, _, rest = (ast.get_docstring(ast.parse(source)) or "").partition("\n")
    code = source.split('"""', 2)[2].strip()
    parts = [heading(2, title.rstrip("."), f"example-{file.stem}"), f"{rest.strip()}\n\n"]
    parts.append(f"`tests/examples/{file.name}`\n\n```python\n{code}\n```\n\n")
    said, drawn = GALLERY / f"{file.stem}.txt", GALLERY / f"{file.stem}.png"
    if said.exists():
        parts.append(f"It prints\n\n```text\n{said.read_text(encoding='utf-8').rstrip()}\n```\n\n")
    if drawn.exists():
        parts.append(f"![what it draws: {title.rstrip('.')}](/gallery/{drawn.name})\n\n")
    return "".join(parts)

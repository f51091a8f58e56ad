"""Tables and headings of Markdown."""

from collections.abc import Iterable, Sequence


def table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A table; what would end a cell is escaped."""
    lines = [list(head), ["---"] * len(head), *([cell(value) for value in row] for row in rows)]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n\n"


def cell(value: object) -> str:
    """A value as the text of a cell; what is marked as code keeps its signs."""
    parts = " ".join(str(value).split()).split("`")
    parts[::2] = [part.replace("<", "&lt;").replace("*", "\\*") for part in parts[::2]]
    return "`".join(parts).replace("|", "\\|")


def code(value: object) -> str:
    """As it is typed; nothing for nothing."""
    text = str(value)
    return f"`{text}`" if text else ""


def heading(level: int, text: str, label: str = "") -> str:
    """A heading, with a label to refer to."""
    mark = f"({label})=\n" if label else ""
    return f"{mark}{'#' * level} {text}\n\n"

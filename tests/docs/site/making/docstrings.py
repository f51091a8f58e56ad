"""Docstrings as they are written: a sentence, and below it text that is laid out by hand.

They are plain text, not reStructuredText: nothing in them is markup.
"""

import re


def as_written(app, what, name, obj, options, lines):
    """The first paragraph as text, the rest as a block of its own."""
    while lines and not lines[-1].strip():
        lines.pop()
    end = next((number for number, line in enumerate(lines) if not line.strip()), len(lines))
    first, rest = lines[:end], lines[end + 1 :]
    lines[:] = [plain(line) for line in first]
    if rest:
        lines += ["", ".. code-block:: text", "", *(f"   {line}" for line in rest), ""]


def plain(line: str) -> str:
    """A line whose signs mean nothing; what stands in backticks is code."""
    parts = re.split(r"`+", line)
    if len(parts) % 2 == 0:  # a span that goes over the line's end
        return re.sub(r"([*_|`\\])", r"\\\1", line)
    parts[::2] = [re.sub(r"([*_|\\])", r"\\\1", part) for part in parts[::2]]
    # between two that are nothing, so that letters may follow at once
    parts[1::2] = [rf"\ ``{part.strip()}``\ " for part in parts[1::2]]
    return "".join(parts)


def setup(app):
    """Sphinx: whenever autodoc has read a docstring."""
    app.connect("autodoc-process-docstring", as_written)
    return {"parallel_read_safe": True, "parallel_write_safe": True}

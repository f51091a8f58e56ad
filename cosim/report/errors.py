"""What goes wrong when results are written."""

from __future__ import annotations


class OutputError(ValueError):
    """A result file cannot be written; one line with the file and the reason."""

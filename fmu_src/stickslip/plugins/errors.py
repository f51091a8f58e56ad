"""What is wrong with an effect from outside."""

from __future__ import annotations


class PluginError(ValueError):
    """A file is no plug-in effect, or its name is taken; one line: file, line, what is allowed."""

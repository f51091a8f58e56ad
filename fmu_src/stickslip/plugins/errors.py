"""What is wrong with an effect from outside."""


class PluginError(ValueError):
    """A file is no plug-in effect, or its name is taken; one line: file, line, what is allowed."""

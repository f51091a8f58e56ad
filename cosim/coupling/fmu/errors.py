"""What goes wrong with a unit."""


class FmuError(ValueError):
    """A file is not an FMU that can be used here, or a value given to it is refused."""


class FmuCallError(RuntimeError):
    """An FMI function did not succeed, or the FMU logged an error. Says what it logged."""


def one_line(error: BaseException) -> str:
    """What an exception says, in one line; its kind where it says nothing."""
    return " ".join(str(error).split()) or type(error).__name__

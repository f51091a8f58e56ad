"""What a command says beside its results: notes, and with `-v` more of what it does.

Results go to stdout, everything else to stderr. `-q` leaves results, warnings and errors.
"""

import logging
import sys
from collections.abc import Iterator
from contextlib import contextmanager

#: Loggers of the product: what computes says there what a user should know (WARNING: a note), what
#: whoever watches a terminal waits for (above INFO: a note there), and what it does (INFO).
LOGGERS = ("stickslip", "thermal", "cosim")

_quiet = False


def is_quiet() -> bool:
    """Whether nothing but results, warnings and errors is wanted."""
    return _quiet


def note(text: str) -> None:
    """A line that helps and changes nothing; not with `-q`."""
    if not _quiet:
        _write(f"note: {text}")


def _write(text: str) -> None:
    from tqdm import tqdm  # a bar that is there goes on below the line

    tqdm.write(text, file=sys.stderr)


class _Notes(logging.Handler):
    """Records as notes; those below WARNING are asked for with `-v`, and come as they are."""

    def emit(self, record: logging.LogRecord) -> None:
        if record.levelno > logging.INFO:
            note(record.getMessage())
        else:
            _write(record.getMessage())


@contextmanager
def saying(quiet: bool, verbose: bool) -> Iterator[None]:
    """How much is said meanwhile."""
    global _quiet
    before, _quiet = _quiet, quiet
    watched = sys.stderr is not None and sys.stderr.isatty()
    usual = logging.INFO + 1 if watched else logging.WARNING
    handler = _Notes(logging.INFO if verbose else usual)
    loggers = [logging.getLogger(name) for name in LOGGERS]
    levels = [logger.level for logger in loggers]
    for logger in loggers:
        logger.addHandler(handler)
        logger.setLevel(handler.level)
    try:
        yield
    finally:
        _quiet = before
        for logger, level in zip(loggers, levels, strict=True):
            logger.removeHandler(handler)
            logger.setLevel(level)

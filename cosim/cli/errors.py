"""Errors and warnings as a user sees them: one line each."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager


class BadInput(ValueError):
    """What was given cannot be used; one line: file, key, what is wrong, what is allowed."""


@contextmanager
def refusing(*kinds: type[Exception], prefix: str = "") -> Iterator[None]:
    """Turn errors of these kinds into BadInput."""
    try:
        yield
    except kinds as error:
        raise BadInput(f"{prefix}{' '.join(str(error).split())}") from error


@contextmanager
def warnings_in_one_line() -> Iterator[None]:
    """Show each of our warnings once, as `warning: ...` on stderr; leave the libraries' out."""
    shown = set()

    def show(message, category, filename, lineno, file=None, line=None):
        text = " ".join(str(message).split())
        if category is UserWarning and text not in shown:
            shown.add(text)
            print(f"warning: {text}", file=sys.stderr)

    with warnings.catch_warnings():
        warnings.simplefilter("always", UserWarning)
        warnings.showwarning = show
        yield

"""The progress bar of a run."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from tqdm import tqdm


@contextmanager
def progress_over(duration: float) -> Iterator[Callable[[float], None]]:
    """A bar over simulated time (s) on stderr, none when that is no terminal.

    Gives a function to be called with the time reached.
    """
    layout = "{percentage:3.0f}%|{bar}| {n:.2f}/{total:g} s [{elapsed}<{remaining}]"
    with tqdm(total=duration, disable=None, bar_format=layout, leave=False) as bar:
        yield lambda time: bar.update(time - bar.n)

"""Progress on a terminal: the run, then the files that are written."""

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


@contextmanager
def progress_over_files() -> Iterator[Callable[[str], None]]:
    """A line that counts and names the files written; none when stderr is no terminal."""
    with tqdm(disable=None, bar_format="{n} files written, {desc} the last", leave=False) as bar:

        def written(name: str) -> None:
            bar.set_description_str(name, refresh=False)
            bar.update()

        yield written

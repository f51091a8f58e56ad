"""Effects' files on their way to another machine, and work that waits there for them.

A worker of a cluster starts in a folder of its own and without this process's environment: it gets
the text of every file, and has the effects before anything that is made of them is unpacked.
"""

from __future__ import annotations

import os
import pickle
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

from ..scratch import scratch_folder
from .active_plugins import files, is_read, known_as, use
from .errors import PluginError


class Sent(NamedTuple):
    """A file as it is here: its name with the folder, and its text."""

    name: str
    text: str


def to_send() -> tuple[Sent, ...]:
    """All files that this process has effects from."""
    return tuple(Sent(str(file), file.read_text(encoding="utf-8-sig")) for file in files())


def packed(function: Callable[..., Any], *arguments: Any) -> bytes:
    """A call for `unpacked_call`."""
    return pickle.dumps((function, arguments))


def unpacked_call(sent: Sequence[Sent], call: bytes) -> Any:
    """What a packed call gives in a process that has the effects of these files, and no others.

    Raises PluginError where the process has others already: it can have one set in its life.
    """
    receive(sent)
    function, arguments = pickle.loads(call)
    return function(*arguments)


def receive(sent: Sequence[Sent]) -> None:
    """Have the effects of files that another process sent; PluginError where it is too late."""
    here = [file.read_text(encoding="utf-8-sig") for file in files()]
    if here != [one.text for one in sent]:
        if here or is_read():
            names = ", ".join(Path(one.name).name for one in sent) or "no file"
            raise PluginError(
                f"{names}: this worker (process {os.getpid()}) has read its effects already, and"
                f" not these but those of {', '.join(map(str, files())) or 'no file'}; allowed is"
                " a worker that was started afresh"
            )
        folder = Path(_folder().name)
        for one in sent:
            (folder / Path(one.name).name).write_text(one.text, encoding="utf-8")
        use(*(folder / Path(one.name).name for one in sent))
    for one, file in zip(sent, files(), strict=True):
        known_as(one.name, file)


@cache
def _folder() -> TemporaryDirectory[str]:
    """A folder for effects' files, as long as this process."""
    return scratch_folder("effects")

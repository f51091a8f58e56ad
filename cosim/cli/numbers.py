"""`--json`: the numbers of a command, printed in place of its lines, or written to a file."""

from argparse import Namespace
from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

from cosim.cli.argument_types import STDOUT
from cosim.files import writable, write_text
from cosim.manifest import require_json


@dataclass(frozen=True)
class Numbers:
    """Where the numbers go: printed, to a file, or nowhere."""

    prints: bool
    file: Path | None

    def give(self, text: str) -> bool:
        """Print or write JSON as asked; whether it was printed, and stdout is taken."""
        text = text.rstrip("\n") + "\n"
        if self.file is not None:
            write_text(text, self.file)
        if self.prints:
            print(text, end="", flush=True)
        return self.prints


def numbers_asked(arguments: Namespace, keys: Collection[str]) -> Numbers:
    """What `--json` says; asked before anything is computed.

    keys: by which an earlier result of the command is known. OutputRefused for a file that cannot
    be written, or is there and no such result.
    """
    given = arguments.json
    if given in (None, STDOUT):
        return Numbers(given == STDOUT, None)
    file = Path(given)
    writable(file.parent, (file.name,))
    require_json(file, keys, arguments.force)
    return Numbers(False, file)

"""What several commands are given: a scenario, with what `--set` changes, and `--json`.

`--json` has the numbers of a command printed in place of its lines, or written to a file.
"""

from argparse import Namespace
from collections.abc import Collection, Iterable
from dataclasses import dataclass
from pathlib import Path

from cosim.cli.argument_types import STDOUT
from cosim.cli.console import note
from cosim.files import writable, write_text
from cosim.manifest import require_json
from cosim.scenario import Scenario, ScenarioError, read_scenario
from cosim.scenario.changes import changes_of
from cosim.scenario.keys import taken_line


def given_scenario(source: str, settings: Iterable[str] = ()) -> Scenario:
    """Read a scenario with `key=value` settings put in; ScenarioError in one line for none."""
    changes = changes_of(settings)
    if "effects" in changes:  # code is read before the settings are, and from a file's own folder
        raise ScenarioError(
            f"--set effects={changes['effects']}: custom effects cannot be set; allowed is "
            'effects = ["brush.py"] at the top of the scenario, or STICKSLIP_EFFECTS=brush.py in '
            "the environment"
        )
    return read_scenario(source, changes)


def note_taken(scenario: Scenario) -> None:
    """Say what a file left to the defaults, once all that was given is known to be good."""
    if line := taken_line(scenario.taken):
        note(line)


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

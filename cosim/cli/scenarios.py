"""The scenario that a command is given: a file or a packaged one, with what `--set` changes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from cosim.cli.saying import note

if TYPE_CHECKING:
    from cosim.scenario import Scenario


def given_scenario(source: str, settings: Iterable[str] = ()) -> Scenario:
    """Read a scenario with `key=value` settings put in; ScenarioError in one line for none."""
    from cosim.scenario import read_scenario
    from cosim.scenario.changes import changes_of

    return read_scenario(source, changes_of(settings))


def note_taken(scenario: Scenario) -> None:
    """Say what a file left to the defaults, once all that was given is known to be good."""
    from cosim.scenario.keys import taken_line

    if line := taken_line(scenario.taken):
        note(line)

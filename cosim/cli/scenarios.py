"""The scenario that a command is given: a file or a packaged one, with what `--set` changes."""

from collections.abc import Iterable

from cosim.cli.console import note
from cosim.scenario import Scenario, ScenarioError, read_scenario
from cosim.scenario.keys import taken_line
from cosim.scenario.scenario import scenario_of
from cosim.scenario.toml_file import changes_of


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
    line = taken_line(scenario.taken)
    if line and scenario == scenario_of({"name": scenario.name}, ""):
        line = f"{scenario.name} sets nothing beside the defaults; {line}"
    if line:
        note(line)

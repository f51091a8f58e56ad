"""What a command reads and where it writes, checked before anything is computed."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from cosim.cli.errors import refusing
from cosim.files import OutputRefused, writable
from cosim.scenario import Scenario, read_scenario
from cosim.scenario.faults import ScenarioError

RESULTS = "results"
RESULT_FILES = ("result.nc", "result.csv", "summary.json", "report.html")


def scenario_to_run(source: str, *, coupled: bool) -> Scenario:
    """The scenario, refused here when it is none or does not fit a coupled run."""
    with refusing(ScenarioError):
        scenario = read_scenario(source)
    if coupled:
        with refusing(ScenarioError, prefix=f"{source}: "):
            _ = scenario.record_every  # raises when rows would fall between macro steps
    return scenario


def results_folder(given: str | None, scenario: Scenario) -> Path:
    """The folder of the results, made and found writable."""
    folder = Path(given) if given is not None else Path(RESULTS) / scenario.name
    return writable_folder(folder, RESULT_FILES)


def writable_folder(folder: Path, files: Iterable[str]) -> Path:
    """Make a folder; BadInput when nothing can be written to it, or a name in it is taken."""
    with refusing(OutputRefused):
        return writable(folder, files)

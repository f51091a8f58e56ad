"""A run on the command line: its scenario, its progress, its files, its last lines."""

import json
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from stickslip.steady_motion import Interface, assess
from stickslip.steady_motion.assessment import MOST_STEPS

from cosim.cli import FAILED
from cosim.cli.arguments import RESULTS
from cosim.cli.bar import Bar
from cosim.cli.console import note
from cosim.cli.runs.run_io import LAST_OF_DATA, Ending, log_files, own_folder
from cosim.cli.scenarios import given_scenario
from cosim.coupling.record import LOG
from cosim.interrupts import Patience
from cosim.manifest import other_command
from cosim.report import Views, write_results
from cosim.report.bounds import is_believed
from cosim.report.columns import Data
from cosim.report.contents import attach_assessment, material_of
from cosim.report.coupling import doubts
from cosim.report.run_text import bounds_sentences, closing_lines
from cosim.scenario import Scenario, ScenarioError, check_work
from cosim.scenario.durations import in_words
from cosim.scenario.work import WORTH_SAYING, doubted

RESULT_FILES = ("result.nc", "result.csv", "summary.json", "report.html", LOG)
#: By which keys the JSON of a run is known.
KEYS = ("name", "case", "status", "scenario")


def scenario_to_run(source: str | None, settings: Iterable[str] = (), *, coupled: bool) -> Scenario:
    """The scenario, without a source the reference case, with `key=value` settings put in.

    ScenarioError when it is none or does not fit a coupled run, or would not end.
    """
    source = source or "reference"
    scenario = given_scenario(source, settings)
    try:
        if coupled:
            _ = scenario.record_every  # raises when rows would fall between macro steps
        seconds = check_work(scenario, coupled=coupled)
    except ScenarioError as fault:
        raise ScenarioError(f"{source}: {fault}") from None
    if doubt := doubted(scenario.mechanics):
        print(f"warning: {doubt}", file=sys.stderr)
    if seconds > WORTH_SAYING:
        note(f"this run takes some {in_words(seconds)}")
    return scenario


def results_folder(
    given: str | None, scenario: Scenario, command: str, force: bool = False
) -> Path:
    """The folder of the results, made, found writable and without others' files; OutputRefused.

    Nobody loses the results of another command, but where a folder is given.
    """
    folder = Path(given) if given is not None else Path(RESULTS) / scenario.name
    if replaced := other_command(folder):
        if given is None:
            folder = folder.with_name(f"{folder.name}-{command}")
        else:
            note(f"{folder}: what this writes replaces the results of `{replaced}`")
    return own_folder(folder, RESULT_FILES, force)


def assess_motion(dataset: Data, scenario: Scenario, patience: Patience) -> None:
    """Let a complete run's dataset carry the assessment of its motion.

    Friction that feels the interface has it as the run left it, temperature and water. A Ctrl-C
    that came in the meantime ends the work: what was computed goes to disk without it.
    """
    if dataset.attrs["status"] != "complete":
        return
    interface = Interface(scenario.ambient.temperature_degC)
    if "interface_temperature" in dataset:
        interface = Interface(
            float(dataset["interface_temperature"].values[-1]),
            float(dataset["film_thickness"].values[-1]),
        )

    def check() -> None:
        if patience.requested:
            raise _StoppedError

    try:
        found = assess(
            scenario.mechanics, scenario.run.duration, interface, most_steps=MOST_STEPS, look=check
        )
    except _StoppedError:
        return
    attach_assessment(dataset, found)


class _StoppedError(Exception):
    """A Ctrl-C has ended the assessment."""


def finish(
    dataset: Data, ending: Ending, files: Mapping[str, str] | None = None, views: Views = ()
) -> int:
    """Write all results and say what came out; 0 when the run is complete, else 1.

    files: further ones to list on the page. views: of belt and ice, for an animation.
    """
    listed = dict(files or {}) | log_files(ending.log)
    further: Any = {"files": listed, "views": views, "command": ending.command, **ending.shown}

    def write(released: Callable[[str], None]) -> Mapping[str, Any]:
        with Bar(bar_format="{n} files written, {desc} the last") as bar:

            def written(name: str) -> None:
                bar.set_description_str(name, refresh=False)
                bar.update()
                released(name)

            write_results(dataset, ending.folder, progress=written, **further)
        numbers: Mapping[str, Any] = json.loads((ending.folder / LAST_OF_DATA).read_text("utf-8"))
        return numbers

    def lines_of(numbers: Mapping[str, Any]) -> Iterator[str]:
        coupling = numbers.get("coupling", {})
        for doubt in (*bounds_sentences(numbers), *doubts(coupling)):
            yield f"warning: {doubt}"
        for remark in coupling.get("remarks", ()):
            yield f"note: {remark}"

    numbers, status, tells = ending.told(write, lines_of)
    if tells:
        material = material_of(dataset)
        print("\n".join(closing_lines(numbers, ending.folder, ending.wall_time, material)))
    return status if status == FAILED or is_believed(numbers) else FAILED

"""`stickslip belt-length`: its arguments, what it runs, what it leaves behind."""

import sys
import time
from argparse import Namespace
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from cosim.cli import DONE, FAILED, BadInput
from cosim.cli.bar import Bar
from cosim.cli.console import note
from cosim.cli.numbers import Numbers, numbers_asked
from cosim.cli.scenarios import given_scenario, note_taken
from cosim.manifest import made_by, own_folder, results_in
from cosim.report.files import json_text
from cosim.report.page import write_page
from cosim.scenario import Scenario
from cosim.studies.belt_length import figures as figures  # which draws: loaded once and for all
from cosim.studies.belt_length import show, unknowns
from cosim.studies.belt_length.case import Case, Protocol, StudyError
from cosim.studies.belt_length.lengths import empty_map, fill_map
from cosim.studies.belt_length.result import Options, Study
from cosim.studies.belt_length.study import (
    BOUNDS,
    answer_all,
    cases,
    check_case,
    check_options,
    steps,
    work_off,
)

#: The study's rig: speeds and lengths are varied, the rest is a case's default.
STUDY = Case(1.0, 0.82)

#: Choice -> the study's values; of the others it has the default case's.
STUDIED = {"length": (1.0, 2.0, 3.0, 4.0), "speed": (0.15, 0.5, 0.82)}


def execute(arguments: Namespace) -> int:
    """Compute, write, print; 0, or 1 when stopped: what there was by then is written."""
    began = time.perf_counter()
    scenario, wanted, options = _asked(arguments)
    numbers = numbers_asked(arguments, ("limit", "cases", "verdict"))
    own_files = (show.RESULT, show.TABLE, show.PAGE, show.CHANGES, show.DOUBT)
    folder = own_folder(arguments.output, own_files, arguments.force)
    if scenario is not None:
        _note(scenario)
    study, status = Study(options, scenario="" if scenario is None else scenario.to_toml()), DONE
    own = None if scenario is None else wanted[0]
    study.grid = empty_map(arguments.map, own) if arguments.map else None
    try:
        with Bar(total=steps(study, wanted, own is not None), unit="run") as bar:
            if own is not None:
                answer_all(study, wanted, arguments.jobs, bar.update)
            work_off(study, wanted, arguments.jobs, bar.update)
            if study.grid is not None:
                fill_map(study.grid, wanted[0], arguments.jobs, bar.update)
    except KeyboardInterrupt:
        print(
            f"error: interrupted; {len(study.rows)} of {len(wanted)} cases are kept in {folder}",
            file=sys.stderr,
        )
        status = FAILED
    made = made_by(scenario=study.scenario or None)
    with results_in(folder, made, force=arguments.force) as results:
        results.complete = status == DONE
        show.write_numbers(study, folder)
        if results.complete:
            with Bar(total=1, unit="page"):
                write_page(*show.page(study, made["command"]), folder)
    _print(study, numbers, folder, time.perf_counter() - began)
    return status


def _asked(arguments: Namespace) -> tuple[Scenario | None, list[Case], Options]:
    """Scenario, cases and options, all of them checked before anything is computed."""
    check_options(arguments)
    scenario, base, source = None, STUDY, arguments.scenario
    if source is not None:
        scenario = given_scenario(source, arguments.changes)
        with _of_file(source):
            base = unknowns.scenario_case(scenario)
    elif arguments.changes:
        raise BadInput("--set: changes keys of a scenario, so a SCENARIO is needed with it")
    base = unknowns.with_ranges(replace(base, protocol=_protocol(base, arguments)), arguments.doubt)
    given = scenario is not None
    if arguments.map is None:
        arguments.map = 12 if given else 30
    choices = {}
    for name, (field, *_) in BOUNDS.items():
        asked = getattr(arguments, name)
        own = (getattr(base, field),) if given or name not in STUDIED else STUDIED[name]
        # of a value that is given twice one case
        choices[field] = own if asked is None else tuple(dict.fromkeys(asked))
    wanted = cases(base, **choices)
    for case in wanted:
        check_case(case, arguments)
        with _of_file(source):
            if scenario is not None:
                unknowns.check_slides(scenario, case)
    options = Options(arguments.limit, arguments.sensitivity, arguments.samples)
    return scenario, wanted, options


@contextmanager
def _of_file(source: str) -> Iterator[None]:
    """Let faults of a scenario begin with its file."""
    try:
        yield
    except StudyError as error:
        raise StudyError(f"{source}: {error}") from None


def _note(scenario: Scenario) -> None:
    """What was taken, and what is computed otherwise."""
    note_taken(scenario)
    for remark in unknowns.remarks(scenario):
        note(remark)
    if keys := unknowns.ignored_keys(scenario):
        note(
            f"{', '.join(keys)}: ignored, belt-length has a resolution of its own;"
            " `stickslip run` heeds them"
        )


def _protocol(base: Case, arguments: Namespace) -> Protocol:
    """The base's, with what the options say."""
    said = {
        name: getattr(arguments, name)
        for name in ("ramp", "run", "pause")
        if getattr(arguments, name) is not None
    }
    return replace(base.protocol, runs=arguments.runs, lifted=arguments.lifted, **said)


def _print(study: Study, asked: Numbers, folder: Path, wall_time: float) -> None:
    if asked.give(json_text(study.summary())):
        return
    print(show.printed(study), end="")
    cases = f"{len(study.rows)} case{'s' * (len(study.rows) != 1)}"
    print(f"{cases} in {wall_time:.1f} s; {folder / show.PAGE}, {folder / show.RESULT}")

"""`stickslip couple`: any system of units, from an SSP or a TOML file."""

from __future__ import annotations

import os
import shlex
import sys
import time
from argparse import ArgumentParser, Namespace
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from cosim.cli import DONE, FAILED, BadInput, Failed, is_bad_input
from cosim.cli.arguments import add_force, add_json, add_output, add_set, add_shown, shown
from cosim.cli.numbers import Numbers, numbers_asked
from cosim.interrupts import Patience, patient_interrupts

if TYPE_CHECKING:
    from cosim.coupling.record import MessageLog, RunFolder
    from cosim.report.files import Shown
    from cosim.systems import SystemRun
    from cosim.systems.specification import SystemSpecification

EXAMPLE = "stickslip couple StickSlipThermal.ssp --set coupling.macro_step=0.01 -o results/pair"
RESULTS = "results"
#: By which keys the JSON of a system is known.
KEYS = ("name", "status", "coupling")


def add_arguments(parser: ArgumentParser) -> None:
    """The arguments of the command."""
    parser.add_argument(
        "system",
        metavar="SYSTEM",
        nargs="?",
        help="an SSP file (1.0 or 2.0), or a TOML file of units, connections, scheme and steps",
    )
    add_set(parser, "run.stop=10 (of [coupling] and [run], or UNIT.VARIABLE=VALUE)")
    parser.add_argument(
        "--resume",
        metavar="DIR",
        help="go on with the run of SYSTEM in DIR that was cut off, from its newest checkpoint"
        " (run.checkpoint_seconds says how often there is one). Units are code: those of SYSTEM are"
        " run, and none that DIR alone names",
    )
    add_json(parser)
    add_shown(parser)
    add_output(parser, "folder of the results; made when missing (default: results/NAME)")
    add_force(parser, ", and begin anew where an unfinished run could be resumed")


def prepare() -> None:
    """Import what the command computes with."""
    import cosim.cli.runs.run_io
    import cosim.systems.show  # noqa: F401


class Job(NamedTuple):
    """What is to be run, and where; source: its file, as it was begun with."""

    specification: SystemSpecification
    source: str
    results: Path
    folder: RunFolder
    shown: Shown
    command: str
    force: bool

    @property
    def resume(self) -> str:
        """What goes on with it once it is cut off."""
        return _resume(self.source, self.results)


def _resume(system: str, results: Path) -> str:
    return shlex.join(["stickslip", "couple", system, "--resume", str(results)])


def execute(arguments: Namespace) -> int:
    """Run, write, report; the exit status."""
    from cosim.cli.runs import run_io
    from cosim.cli.runs.run_io import hearing, is_removed, log_files, message_log
    from cosim.manifest import made_by, results_in

    began = time.perf_counter()
    numbers = numbers_asked(arguments, KEYS)
    job = _begun(arguments) if arguments.resume is None else _found(arguments)
    logging = message_log(job.folder, arguments.verbose)
    going_on = run_io.going_on(job.folder, job.resume)
    with going_on, job.specification, patient_interrupts() as patience, logging as log:
        with units_speak_aside():
            done = _run(
                job, patience, heard=hearing(log, arguments.verbose), debug=arguments.verbose
            )
        patience.hold()
        if is_removed(job.results, done.result.time.tolist()):
            return FAILED
        goes_on = done.result.status != "complete" and job.folder.checkpoint.is_file()
        made = made_by(job.command, system=job.source)
        with results_in(job.results, made, force=job.force) as results:
            for name in log_files(log):
                results.add(job.results / name)
            status = _finish(job, done, began, patience, numbers, goes_on, log)
            results.complete = status == DONE
    # only now: had the results not come to the disk, there would still be what they are made of
    job.folder.release() if goes_on else job.folder.finished()
    return status


def _begun(arguments: Namespace) -> Job:
    """A run from its start."""
    from cosim.cli.runs.run_io import own_folder
    from cosim.coupling.record import RunFolder
    from cosim.scenario.changes import changes_of
    from cosim.systems import read_system
    from cosim.systems.run import check_system
    from cosim.systems.show import FILES

    if arguments.system is None:
        raise BadInput("SYSTEM: missing, needed is an SSP or a TOML file")
    changes = changes_of(arguments.changes, "run.stop=10")
    specification = read_system(arguments.system, changes)
    results = Path(arguments.output or Path(RESULTS) / _folder_name(specification.name))
    command = shlex.join(["stickslip", *sys.argv[1:]])
    asked: dict[str, Any] = {
        "system": str(Path(arguments.system).resolve()),
        "changes": changes,
        "command": command,
        "shown": shown(arguments),
        "resume": _resume(arguments.system, results),
    }
    with closed_if_refused(specification):
        check_system(specification)  # before what an earlier run left in the folder is gone
        own_folder(results, FILES, arguments.force)
        folder = RunFolder.begun(results, asked, {}, force=arguments.force)
    return Job(
        *(specification, asked["system"], results, folder),
        *(shown(arguments), command, arguments.force),
    )


def _found(arguments: Namespace) -> Job:
    """A run that was cut off, as it was begun."""
    from cosim.cli.runs.run_io import refuse_beside_resume
    from cosim.coupling.record import RunFolder
    from cosim.report.files import PAGE_ALONE
    from cosim.systems import read_system

    given = {
        "-o": arguments.output,
        "--set": arguments.changes,
        "--figures": arguments.figures,
        "--no-page": arguments.no_page,
        "--force": arguments.force,
    }
    refuse_beside_resume(given)
    folder = RunFolder.found(Path(arguments.resume))
    asked = folder.asked
    system, changes = asked.get("system"), asked.get("changes", {})
    if not isinstance(system, str) or not isinstance(changes, dict):
        raise BadInput(f"{arguments.resume}: not created by `stickslip couple`; see {folder.path}")
    if arguments.system is None:
        raise BadInput(
            "SYSTEM: missing; units are code and run only where they are named: "
            f"{_resume(system, folder.results)}"
        )
    specification = read_system(arguments.system, changes)
    command = f"{asked.get('command', '')} (interrupted and resumed)"
    return Job(
        *(specification, arguments.system, folder.results, folder),
        *(asked.get("shown", PAGE_ALONE), command),
        force=False,
    )


@contextmanager
def units_speak_aside() -> Iterator[None]:
    """What units write to the terminal goes to stderr: stdout is for what is asked for."""
    sys.stdout.flush()
    try:
        ours = os.dup(1)
    except OSError:  # there is no stdout
        yield
        return
    try:
        os.dup2(2, 1)
        yield
    finally:
        sys.stdout.flush()
        os.dup2(ours, 1)
        os.close(ours)


@contextmanager
def closed_if_refused(specification: SystemSpecification) -> Iterator[None]:
    """Where nothing comes of a system, what was unpacked of it goes."""
    try:
        yield
    except BaseException:
        specification.close()
        raise


def _folder_name(name: str) -> str:
    """A system's name as every file system takes it for a folder."""
    kept = "".join(letter if letter.isalnum() or letter in "-_ ." else "_" for letter in name)
    return kept.strip(" .")[:100] or "system"


def _run(job: Job, patience: Patience, **said: Any) -> SystemRun:
    """Run with a bar; one that does not come to its first step leaves nothing to go on from."""
    try:
        return _with_bar(job, patience, **said)
    except BaseException:
        if not job.folder.checkpoint.is_file():
            job.folder.finished()
        raise


def _with_bar(job: Job, patience: Patience, **said: Any) -> SystemRun:
    """Run; a unit's contents are only unpacked, and refused, when it starts."""
    from cosim.cli.runs import run_io
    from cosim.coupling import ParticipantError
    from cosim.systems import run_system

    start, stop = job.specification.run.start, job.specification.run.stop
    with run_io.progress_over(stop - start) as show:

        def progress(reached: float) -> None:
            patience.hold()
            show(reached - start)

        try:
            return run_system(job.specification, progress, job.folder, **said)
        except ParticipantError as error:
            if is_bad_input(error.__cause__):
                cause = " ".join(str(error.__cause__).split())
                named = cause if ".fmu" in cause else f"{error.participant}: {cause}"
                raise BadInput(named) from error
            raise Failed(" ".join(str(error).split())) from error


def _finish(
    job: Job,
    done: SystemRun,
    began: float,
    patience: Patience,
    asked: Numbers,
    goes_on: bool,
    log: MessageLog,
) -> int:
    """Write all and say what came out; 0 when the run is complete, else 1."""
    from cosim.cli.runs.run_io import log_files, say_how_it_ended
    from cosim.report.coupling import doubts
    from cosim.report.files import json_text
    from cosim.systems.show import write_system
    from cosim.systems.show.summary import closing_lines, in_few_lines

    def written(name: str) -> None:
        if name == "summary.json":
            patience.release()

    folder = job.results
    further = f", and this goes on from there: {job.resume}" if goes_on else ""
    try:
        numbers: dict[str, Any] = write_system(
            done,
            folder,
            command=job.command,
            files=log_files(log),
            progress=written,
            shown=job.shown,
        )
    except KeyboardInterrupt:
        print(
            f"error: interrupted while drawing; the data are in {folder}{further}", file=sys.stderr
        )
        return FAILED
    printed = asked.give(json_text(numbers))
    for said in doubts(numbers["coupling"]):
        print(f"warning: {said}", file=sys.stderr)
    if say_how_it_ended(numbers, folder, job.resume if goes_on else "", log) == FAILED:
        return FAILED
    for said in in_few_lines(numbers["warnings"]):
        print(f"warning: {said}", file=sys.stderr)
    if not printed:
        print("\n".join(closing_lines(numbers, folder, time.perf_counter() - began)))
    return DONE

"""`stickslip couple`: any system of units, from an SSP or a TOML file."""

from __future__ import annotations

import os
import shlex
import sys
import time
from argparse import Namespace
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cosim.cli import DONE, FAILED, BadInput
from cosim.cli.arguments import RESULTS, shown
from cosim.cli.numbers import Numbers, numbers_asked

if TYPE_CHECKING:
    from cosim.cli.runs.run_io import Job
    from cosim.coupling.record import MessageLog
    from cosim.interrupts import Patience
    from cosim.manifest import ResultFolder
    from cosim.systems import SystemRun
    from cosim.systems.specification import SystemSpecification

#: By which keys the JSON of a system is known.
KEYS = ("name", "status", "coupling")


def _resume(system: str, results: Path) -> str:
    return shlex.join(["stickslip", "couple", system, "--resume", str(results)])


def execute(arguments: Namespace) -> int:
    """Run, write, report; the exit status."""
    from cosim.cli.runs import run_io
    from cosim.systems import run_system

    began = time.perf_counter()
    numbers = numbers_asked(arguments, KEYS)
    specification, job = _begun(arguments) if arguments.resume is None else _found(arguments)
    start, stop = specification.run.start, specification.run.stop

    def run(patience: Patience, **said: Any) -> SystemRun:
        with (
            units_speak_aside(),
            run_io.progress_over(stop - start) as show,
            run_io.refusing_units(True),
        ):

            def progress(reached: float) -> None:
                patience.hold()
                show(reached - start)

            return run_system(specification, progress, job.folder, **said)

    def write(
        done: SystemRun, results: ResultFolder, patience: Patience, resume: str, log: MessageLog
    ) -> int:
        return _finish(job, done, began, patience, numbers, resume, log)

    with specification:
        return run_io.carried_out(job, arguments.verbose, run, write)


def _begun(arguments: Namespace) -> tuple[SystemSpecification, Job]:
    """A run from its start."""
    from cosim.cli.runs.run_io import Job, own_folder
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
    resume = _resume(arguments.system, results)
    asked: dict[str, Any] = {
        "system": str(Path(arguments.system).resolve()),
        "changes": changes,
        "command": command,
        "shown": shown(arguments),
        "resume": resume,
    }
    with closed_if_refused(specification):
        check_system(specification)  # before what an earlier run left in the folder is gone
        own_folder(results, FILES, arguments.force)
        folder = RunFolder.begun(results, asked, {}, force=arguments.force)
    of = {"system": asked["system"]}
    resume = _resume(asked["system"], results)
    return specification, Job(
        results, folder, shown(arguments), command, arguments.force, resume, of
    )


def _found(arguments: Namespace) -> tuple[SystemSpecification, Job]:
    """A run that was cut off, as it was begun."""
    from cosim.cli.runs.run_io import Job, refuse_beside_resume
    from cosim.coupling.record import RunFolder
    from cosim.report.files import PAGE_ALONE
    from cosim.systems import read_system

    refuse_beside_resume(arguments, "-o", "--set", "--figures", "--no-page", "--force")
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
    drawn, resume = asked.get("shown", PAGE_ALONE), _resume(arguments.system, folder.results)
    of = {"system": arguments.system}
    return specification, Job(folder.results, folder, drawn, command, False, resume, of)


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


def _finish(
    job: Job,
    done: SystemRun,
    began: float,
    patience: Patience,
    asked: Numbers,
    resume: str,
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
    further = f", and this goes on from there: {resume}" if resume else ""
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
    if say_how_it_ended(numbers, folder, resume, log) == FAILED:
        return FAILED
    for said in in_few_lines(numbers["warnings"]):
        print(f"warning: {said}", file=sys.stderr)
    if not printed:
        print("\n".join(closing_lines(numbers, folder, time.perf_counter() - began)))
    return DONE

"""`stickslip couple`: any system of units, from an SSP or a TOML file."""

import os
import shlex
import sys
import time
from argparse import Namespace
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from cosim.cli import DONE, BadInput
from cosim.cli.arguments import RESULTS
from cosim.cli.numbers import numbers_asked
from cosim.cli.runs import run_io
from cosim.cli.runs.run_io import Ending, Job
from cosim.coupling.record import RunFolder
from cosim.interrupts import Patience
from cosim.manifest import ResultFolder
from cosim.report.coupling import doubts
from cosim.scenario.toml_file import changes_of
from cosim.systems import SystemRun, read_system, run_system
from cosim.systems.run import check_system
from cosim.systems.show import FILES, write_system
from cosim.systems.show.page import closing_lines, in_few_lines
from cosim.systems.specification import SystemSpecification

#: By which keys the JSON of a system is known.
KEYS = ("name", "status", "coupling")


def execute(arguments: Namespace) -> int:
    """Run, write, report; the exit status."""
    began = time.perf_counter()
    numbers_wanted = numbers_asked(arguments, KEYS)
    specification, job = _begun(arguments) if arguments.resume is None else _found(arguments)
    start, stop = specification.run.start, specification.run.stop

    def run(patience: Patience, **said: Any) -> SystemRun:
        with (
            units_speak_aside(),
            run_io.progress_over(stop - start, patience, start) as show,
            run_io.refusing_units(True),
        ):
            return run_system(specification, show, job.folder, **said)

    def write(done: SystemRun, results: ResultFolder, ending: Ending) -> int:
        def files(written: Callable[[str], None]) -> Mapping[str, Any]:
            listed = run_io.log_files(ending.log)
            how: Any = {"command": job.command, "files": listed, "shown": job.shown}
            return write_system(done, job.results, progress=written, **how)

        def lines(numbers: Mapping[str, Any]) -> list[str]:
            return [f"warning: {doubt}" for doubt in doubts(numbers["coupling"])]

        numbers, status, tells = ending.told(files, lines)
        for said in in_few_lines(numbers["warnings"]) if status == DONE else ():
            print(f"warning: {said}", file=sys.stderr)
        if tells:
            print("\n".join(closing_lines(numbers, job.results, ending.wall_time)))
        return status

    with specification:
        return job.carried_out(began, numbers_wanted, arguments.verbose, run, write)


def _begun(arguments: Namespace) -> tuple[SystemSpecification, Job]:
    """A run from its start."""
    if arguments.system is None:
        raise BadInput("SYSTEM: missing, needed is an SSP or a TOML file")
    changes = changes_of(arguments.changes, "run.stop=10")
    specification = read_system(arguments.system, changes)
    results = Path(arguments.output or Path(RESULTS) / _folder_name(specification.name))
    of = {"system": str(Path(arguments.system).resolve())}
    with specification.closed_if_refused():
        check_system(specification)  # before what an earlier run left in the folder is gone
        run_io.own_folder(results, FILES, arguments.force)
        wanted, resume = of | {"changes": changes}, _resume(of["system"], results)
        return specification, Job.begun(results, arguments, wanted, {}, resume, of)


def _found(arguments: Namespace) -> tuple[SystemSpecification, Job]:
    """A run that was cut off, as it was begun."""
    run_io.refuse_beside_resume(arguments, "-o", "--set", "--figures", "--no-page", "--force")
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
    resume, of = _resume(arguments.system, folder.results), {"system": arguments.system}
    return specification, Job.found(folder, asked, resume, of)


def _resume(system: str, results: Path) -> str:
    return shlex.join(["stickslip", "couple", system, "--resume", str(results)])


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


def _folder_name(name: str) -> str:
    """A system's name as every file system takes it for a folder."""
    kept = "".join(letter if letter.isalnum() or letter in "-_ ." else "_" for letter in name)
    return kept.strip(" .")[:100] or "system"

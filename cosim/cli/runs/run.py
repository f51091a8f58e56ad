"""`stickslip run`: the coupled case, begun or resumed."""

from __future__ import annotations

import shlex
import sys
import time
from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from cosim.cli import DONE, FAILED, BadInput, Failed, is_bad_input
from cosim.cli.arguments import add_run_arguments, shown

if TYPE_CHECKING:
    from cosim.coupling.case import CoupledRun
    from cosim.coupling.record import RunFolder
    from cosim.report.files import Shown
    from cosim.scenario import Scenario

EXAMPLE = "stickslip run my_case.toml -o results/first"
SCENARIO = "scenario.toml"


def add_arguments(parser: ArgumentParser) -> None:
    """The arguments of the command."""
    add_run_arguments(parser)
    parser.add_argument(
        "--fmu",
        metavar="FILE",
        help="the mechanical FMU (default: that in build of a checkout, or else in the user's cache"
        " folder, built when missing or stale)",
    )
    parser.add_argument(
        "--animation",
        action="store_true",
        help="also write temperature.gif: belt and ice, a frame every run.snapshot_interval",
    )
    parser.add_argument(
        "--fields",
        action="store_true",
        help="also write fields/temperature.pvd: belt and ice for ParaView, every"
        " run.snapshot_interval",
    )
    parser.add_argument(
        "--resume",
        metavar="DIR",
        help="go on with the run in DIR that was cut off, from its newest checkpoint"
        " (run.checkpoint_seconds says how often there is one); as it was begun, so nothing else"
        " but --effects, -q, -v and --json is given. The FMU that it was begun with is run: resume"
        " a folder of somebody else's only if you trust them",
    )
    parser.add_argument(
        "--effects",
        nargs="+",
        default=[],
        metavar="FILE.py",
        help="with --resume: the custom effects that the run has. Code is run only of files"
        " that are named here, and whose SHA-256 is still that of when the run began",
    )


def prepare() -> None:
    """Import what the command computes with."""
    import cosim.cli.runs.running
    import cosim.coupling.case  # noqa: F401


class Job(NamedTuple):
    """What is to be run, and where."""

    scenario: Scenario
    results: Path
    folder: RunFolder
    fmu: str | None
    views: bool
    fields: bool
    shown: Shown
    command: str
    force: bool


def execute(arguments: Namespace) -> int:
    """Run, write, report; the exit status."""
    from cosim.cli.numbers import numbers_asked
    from cosim.cli.runs import run_io, running
    from cosim.cli.scenarios import note_taken
    from cosim.files import writable
    from cosim.interrupts import patient_interrupts
    from cosim.manifest import made_by, results_in
    from cosim.report.dataset import run_columns

    began = time.perf_counter()
    numbers = numbers_asked(arguments, running.KEYS)
    job = _begun(arguments) if arguments.resume is None else _found(arguments)
    # said with the first step, when units, too, are known to be good; of old when it goes on
    unsaid = [] if arguments.resume else [job.scenario]
    fields = writable(job.results / run_io.FIELDS) if job.fields else None
    _ = job.scenario.catalogue.compiled  # before the bar begins to count
    logging = run_io.message_log(job.folder, arguments.verbose)
    going_on = run_io.going_on(job.folder, _resume(job.results, job.scenario))
    with going_on, patient_interrupts() as patience, logging as log:
        with run_io.progress_over(job.scenario.run.duration) as show:

            def progress(reached: float) -> None:
                patience.hold()
                while unsaid:
                    note_taken(unsaid.pop())
                show(reached)

            said = {"heard": run_io.hearing(log, arguments.verbose), "debug": arguments.verbose}
            done = _run(job, fields=fields, progress=progress, **said)
        patience.hold()
        if run_io.is_removed(job.results, done.result.time.tolist()):
            return FAILED
        dataset = run_columns(
            done.result, job.scenario, job.scenario.to_toml(), snapshots=done.snapshots
        )
        running.assess_motion(dataset, job.scenario, patience)
        goes_on = done.result.status != run_io.COMPLETE and job.folder.checkpoint.is_file()
        made = made_by(job.command, scenario=job.scenario.to_toml())
        with results_in(job.results, made, force=job.force) as results:
            taken = run_io.field_files(job.results) if done.snapshots.file else []
            for name in (*run_io.log_files(log), *taken):
                results.add(job.results / name)
            status = running.finish(
                dataset,
                job.results,
                began,
                patience,
                _field_files(done, job.results),
                views=done.snapshots.views,
                command=job.command,
                resume=_resume(job.results, job.scenario) if goes_on else "",
                log=log,
                asked=numbers,
                **job.shown,
            )
            results.complete = status == DONE
    # only now: had the results not come to the disk, there would still be what they are made of
    job.folder.release() if goes_on else job.folder.finished()
    return status


def _begun(arguments: Namespace) -> Job:
    """A run from its start."""
    from cosim.cli.plug_ins import digests
    from cosim.cli.runs import run_io, running
    from cosim.coupling.record import RunFolder
    from cosim.fmu.build import own_fmu
    from cosim.manifest import require_own

    if arguments.effects:
        raise BadInput(
            '--effects: is for --resume; allowed is effects = ["brush.py"] at the top of the '
            "scenario"
        )
    scenario = running.scenario_to_run(arguments.scenario, arguments.changes, coupled=True)
    # before anything is written: it may lack a compiler
    unit = arguments.fmu or own_fmu(scenario.catalogue)
    results = running.results_folder(arguments.output, scenario, arguments.force)
    require_own(results, [run_io.COLLECTION], arguments.force)
    command = shlex.join(["stickslip", *sys.argv[1:]])
    fmu = None if arguments.fmu is None else str(Path(arguments.fmu).resolve())
    asked = {
        "resume": _resume(results, scenario),
        "command": command,
        "fmu": fmu,
        "views": arguments.animation,
        "fields": arguments.fields,
        "shown": shown(arguments),
        "taken": dict(scenario.taken),
        "effects": digests(scenario.catalogue.files),
    }
    folder = RunFolder.begun(results, asked, {SCENARIO: scenario.to_toml()}, force=arguments.force)
    return Job(
        *(scenario, results, folder, str(unit), arguments.animation, arguments.fields),
        *(shown(arguments), command, arguments.force),
    )


def _found(arguments: Namespace) -> Job:
    """A run that was cut off, as it was begun."""
    from cosim.cli.plug_ins import check_resumed
    from cosim.cli.runs import run_io, running
    from cosim.coupling.record import RunFolder
    from cosim.report.files import PAGE_ALONE

    given = {
        "a scenario": arguments.scenario,
        "-o": arguments.output,
        "--set": arguments.changes,
        "--fmu": arguments.fmu,
        "--animation": arguments.animation,
        "--fields": arguments.fields,
        "--figures": arguments.figures,
        "--no-page": arguments.no_page,
        "--force": arguments.force,
    }
    run_io.refuse_beside_resume(given)
    results = Path(arguments.resume)
    check_resumed(results, arguments.effects)
    folder = RunFolder.found(results)
    asked = folder.asked
    if not (folder.path / SCENARIO).is_file():
        raise BadInput(
            f"{results}: not created by `stickslip run`; {folder.path / 'README.txt'} says what"
            " resumes it"
        )
    scenario = running.scenario_to_run(str(folder.path / SCENARIO), coupled=True)
    scenario = scenario.with_taken(asked.get("taken", {}))
    return Job(
        *(scenario, results, folder, asked.get("fmu")),
        *(bool(asked.get("views")), bool(asked.get("fields"))),
        shown=asked.get("shown", PAGE_ALONE),
        command=f"{asked.get('command', '')} (interrupted and resumed)",
        force=False,
    )


def _resume(results: Path, scenario: Scenario) -> str:
    files = scenario.catalogue.files
    effects = ["--effects", *map(str, files)] if files else []
    return shlex.join(["stickslip", "run", "--resume", str(results), *effects])


def _field_files(done: CoupledRun, folder: Path) -> dict[str, str]:
    """The temperature fields as the page lists them."""
    from cosim.cli.runs import running

    if done.snapshots.file is None:
        return {}
    true = done.snapshots.file
    listed = {
        true.relative_to(folder).as_posix(): "temperature fields of belt and ice for ParaView, to "
        "scale: colour by rise_K"
    }
    for thicker in running.stretched_fields(folder):
        times = thicker.stem.rpartition("_")[2].removesuffix("x")
        name = thicker.relative_to(folder).as_posix()
        listed[name] = f"the same with the belt drawn {times} times as thick as it is"
    return listed


def _run(job: Job, **further: Any) -> CoupledRun:
    """The coupled run; one that does not come to its first step leaves nothing to go on from."""
    try:
        return _coupled(job.scenario, fmu=job.fmu, folder=job.folder, views=job.views, **further)
    except BaseException:
        if not job.folder.checkpoint.is_file():
            job.folder.finished()
        raise


def _coupled(scenario: Scenario, **arguments: Any) -> CoupledRun:
    """`run_scenario`; an FMU's contents are only unpacked, and refused, when it starts."""
    from cosim.coupling import ParticipantError
    from cosim.coupling.case import run_scenario

    try:
        return run_scenario(scenario, **arguments)
    except ParticipantError as error:
        if is_bad_input(error.__cause__):
            raise BadInput(" ".join(str(error.__cause__).split())) from error
        raise Failed(" ".join(str(error).split())) from error

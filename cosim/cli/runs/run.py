"""`stickslip run`: the coupled case, begun or resumed.

A folder of results may be anybody's: of custom effects only code is run that the command line
itself names, and that is as it was when the run began.
"""

import hashlib
import json
import shlex
import time
from argparse import Namespace
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from stickslip.catalogue import default_catalogue
from stickslip.effects import PluginError
from stickslip.text_file import MOST_TOML, read_text, tables_in

from cosim.cli import BadInput
from cosim.cli.numbers import numbers_asked
from cosim.cli.runs import run_io, running
from cosim.cli.runs.run_io import Ending, Job
from cosim.cli.scenarios import note_taken
from cosim.coupling.case import CoupledRun, run_scenario
from cosim.coupling.record import RunFolder
from cosim.files import writable
from cosim.fmu.build import own_fmu
from cosim.interrupts import Patience
from cosim.manifest import ResultFolder, require_own
from cosim.report.dataset import run_columns
from cosim.scenario import Scenario


def digests(files: Sequence[Path]) -> dict[str, str]:
    """Absolute name of each file -> SHA-256 of what is in it; "" of what cannot be read."""
    return {str(file): _digest(file) for file in files}


def _digest(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest() if file.is_file() else ""


def check_resumed(results: Path, named: Sequence[str]) -> None:
    """PluginError unless all effects' files of a run that was cut off are named, and as they were.

    Before its scenario is read, which executes the files that it names.
    """
    known = _known(results / "unfinished" / "run.json")
    now = digests([*default_catalogue().files, *(Path(name).resolve() for name in named)])
    for file, digest in now.items():
        if not digest or known.get(file) != digest:
            what = "has changed since that began" if file in known else "is not one of its effects"
            raise PluginError(
                f"{results}: goes on with a run as it was begun, and {file} {what}; allowed "
                f"are {', '.join(known) or 'no effects of your own'}, or to begin anew"
            )
    lacking = [file for file in known if file not in now]
    if lacking:
        raise PluginError(
            f"{results}: its run has custom effects, whose code is run only where you name "
            f"it; allowed is, if you trust them, --effects {' '.join(known)}"
        )
    scenario = results / "unfinished" / "scenario.toml"
    tables = tables_in(read_text(scenario, MOST_TOML)) if scenario.is_file() else {}
    asked = tables.get("effects", [])
    if unknown := [file for file in asked if str(file) not in known]:
        raise PluginError(
            f"{results}: names {unknown[0]}, but not the SHA-256 that it had when the run began, so"
            " its code is not run; allowed is to begin anew"
        )


def _known(manifest: Path) -> dict[str, str]:
    """Effects' file -> its SHA-256, as a run began; none of what is no such list."""
    try:
        effects = json.loads(manifest.read_text(encoding="utf-8"))["effects"]
        return {str(file): str(digest) for file, digest in effects.items()}
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return {}


SCENARIO = "scenario.toml"
#: Options of a run that is begun; one that goes on has them as it was begun.
ONLY_ANEW = ("--fmu", "--animation", "--fields", "--figures", "--no-page", "--force")


def execute(arguments: Namespace) -> int:
    """Run, write, report; the exit status."""
    began = time.perf_counter()
    numbers = numbers_asked(arguments, running.KEYS)
    scenario, wanted, job = _begun(arguments) if arguments.resume is None else _found(arguments)
    # said with the first step, when units, too, are known to be good; of old when it goes on
    unsaid = [] if arguments.resume else [scenario]
    how: dict[str, Any] = {
        "fmu": wanted.get("fmu"),
        "views": bool(wanted.get("views")),
        "fields": writable(job.results / run_io.FIELDS) if wanted.get("fields") else None,
        "folder": job.folder,
    }
    _ = scenario.catalogue.compiled  # before the bar begins to count

    def run(patience: Patience, **said: Any) -> CoupledRun:
        duration = scenario.run.duration
        with run_io.progress_over(duration, patience) as show, run_io.refusing_units(False):

            def progress(reached: float) -> None:
                show(reached)
                while unsaid:
                    note_taken(unsaid.pop())

            return run_scenario(scenario, progress=progress, **how, **said)

    def write(done: CoupledRun, results: ResultFolder, ending: Ending) -> int:
        pictures = done.snapshots
        dataset = run_columns(done.result, scenario, scenario.to_toml(), snapshots=pictures)
        running.assess_motion(dataset, scenario, ending.patience)
        fields = run_io.field_files(job.results) if pictures.file else []
        for name in fields:
            results.add(job.results / name)
        return running.finish(dataset, ending, _collections(fields), pictures.views)

    return job.carried_out(began, numbers, arguments.verbose, run, write)


def _begun(arguments: Namespace) -> tuple[Scenario, Mapping[str, Any], Job]:
    """A run from its start."""
    if arguments.effects:
        raise BadInput(
            '--effects: is for --resume; allowed is effects = ["brush.py"] at the top of the '
            "scenario"
        )
    scenario = running.scenario_to_run(arguments.scenario, arguments.changes, coupled=True)
    # before anything is written: it may lack a compiler
    unit = str(arguments.fmu or own_fmu(scenario.catalogue))
    results = running.results_folder(arguments.output, scenario, "run", arguments.force)
    require_own(results, [run_io.COLLECTION], arguments.force)
    wanted = {
        "fmu": None if arguments.fmu is None else str(Path(arguments.fmu).resolve()),
        "views": arguments.animation,
        "fields": arguments.fields,
        "taken": dict(scenario.taken),
        "effects": digests(scenario.catalogue.files),
    }
    resume, text = _resume(results, scenario), scenario.to_toml()
    files, of = {SCENARIO: text}, {"scenario": text}
    job = Job.begun(results, arguments, wanted, files, resume, of)
    return scenario, wanted | {"fmu": unit}, job


def _found(arguments: Namespace) -> tuple[Scenario, Mapping[str, Any], Job]:
    """A run that was cut off, as it was begun."""
    run_io.refuse_beside_resume(arguments, "a scenario", "-o", "--set", *ONLY_ANEW)
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
    of = {"scenario": scenario.to_toml()}
    return scenario, asked, Job.found(folder, asked, _resume(results, scenario), of)


def _resume(results: Path, scenario: Scenario) -> str:
    files = scenario.catalogue.files
    effects = ["--effects", *map(str, files)] if files else []
    return shlex.join(["stickslip", "run", "--resume", str(results), *effects])


def _collections(fields: Iterable[str]) -> dict[str, str]:
    """Of the files of the temperature fields those to be opened, as the page lists them."""
    listed = {}
    for name in fields:
        file = Path(name)
        times = file.stem.partition("_belt_")[2].removesuffix("x")
        if file.suffix == ".pvd" and times:
            listed[name] = f"the same with the belt drawn {times} times as thick as it is"
        elif file.suffix == ".pvd":
            what = "temperature fields of belt and ice for ParaView, to scale: colour by rise_K"
            listed[name] = what
    return listed

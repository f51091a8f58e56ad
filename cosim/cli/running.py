"""A run on the command line: its scenario, its progress, its files, its last lines."""

from __future__ import annotations

import shlex
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import xarray as xr
from stickslip import Parameters, simulate
from stickslip.compiled import is_cached
from stickslip.steady_motion import Interface, assess
from stickslip.steady_motion.assessment import PATIENCE, deadline
from stickslip.steady_motion.regimes import CREEPING, OWN
from stickslip.steady_motion.stability import UNSTABLE
from tqdm import tqdm

from cosim.cli import DONE, FAILED, BadInput
from cosim.coupling.record import LOG, MessageLog, RunFolder
from cosim.files import writable
from cosim.interrupts import Patience
from cosim.manifest import claim, require_own
from cosim.report import Views, summary, write_results
from cosim.report.bounds import bounds_sentences
from cosim.report.contents import attach_assessment, ramp_sentence, regime_sentence, unstable_line
from cosim.report.quantities import ROUNDING
from cosim.scenario import Scenario, ScenarioError, check_work, read_scenario
from cosim.scenario.work import WORTH_SAYING, in_words

RESULTS = "results"
FIELDS = "fields"
COLLECTION = f"{FIELDS}/temperature.pvd"
RESULT_FILES = ("result.nc", "result.csv", "summary.json", "report.html", LOG)
COMPLETE = "complete"
#: Written after all other data and before the figures.
LAST_OF_DATA = "summary.json"


def scenario_to_run(source: str | None, *, coupled: bool) -> Scenario:
    """The scenario, without a source the reference case.

    ScenarioError when it is none or does not fit a coupled run, or would not end.
    """
    source = source or "reference"
    scenario = read_scenario(source)
    try:
        if coupled:
            _ = scenario.record_every  # raises when rows would fall between macro steps
        seconds = check_work(scenario, coupled=coupled)
    except ScenarioError as fault:
        raise ScenarioError(f"{source}: {fault}") from None
    if seconds > WORTH_SAYING:
        print(f"note: this run takes some {in_words(seconds)}", file=sys.stderr)
    return scenario


def results_folder(given: str | None, scenario: Scenario, force: bool = False) -> Path:
    """The folder of the results, made, found writable and without others' files; OutputRefused."""
    folder = Path(given) if given is not None else Path(RESULTS) / scenario.name
    return own_folder(folder, RESULT_FILES, force)


def own_folder(folder: Path, files: Iterable[str], force: bool) -> Path:
    """A folder that is made, found writable, and has no file of these that is somebody else's.

    What lies beside a run that was cut off is that run's: it had no time to list it.
    """
    writable(folder, files)
    if RunFolder(folder).is_left:
        claim(folder, (*files, *field_files(folder)))
    require_own(folder, files, force)
    return folder


def field_files(folder: Path) -> list[str]:
    """The collection of the temperature fields, and what it names; none where there is none."""
    file = folder / COLLECTION
    try:
        named = [entry.get("file", "") for entry in ElementTree.parse(file).iter("DataSet")]
    except (OSError, ElementTree.ParseError):
        return []
    return [f"{FIELDS}/{name}" for name in (file.name, *named)]


def refuse_beside_resume(given: Mapping[str, object]) -> None:
    """BadInput for an argument, by what it is called, that was given beside --resume."""
    for what, value in given.items():
        if value:
            raise BadInput(
                f"--resume: goes on with a run as it was begun, so {what} cannot be given"
            )


def message_log(folder: RunFolder, verbose: bool) -> MessageLog:
    """The log of a run beside its results, behind what the run had said before it was cut off.

    verbose: shown on stderr, too.
    """
    resumed = folder.checkpoint.is_file()
    return MessageLog(folder.results / LOG, resumed, _show_line if verbose else None)


def _show_line(line: str) -> None:
    """On stderr, above the bar where there is one."""
    tqdm.write(line, file=sys.stderr)


def log_files(log: MessageLog) -> dict[str, str]:
    """The log as the page lists it; it is there where something was said."""
    return {LOG: "what units and master said, a line each"} if log.path.is_file() else {}


def say_how_it_ended(
    numbers: Mapping[str, Any], folder: Path, resume: str, log: MessageLog | None
) -> int:
    """What became of the run, unless that is all well: one line on stderr; the exit status.

    numbers: of its summary. resume: what goes on with it, "" where nothing does. log: of what was
    said, which is told of where there are warnings or errors.
    """
    said = "" if log is None else log.told()
    if numbers["status"] == COMPLETE:
        if said:
            print(f"note: {said}", file=sys.stderr)
        return DONE
    goes_on = f", and this goes on from there: {resume}" if resume else ""
    where = f"{folder}, {said}" if said else str(folder)
    print(f"error: {numbers['reason']}; what was computed is in {where}{goes_on}", file=sys.stderr)
    return FAILED


def compile_model() -> None:
    """Have the compiled mechanics ready; says so where that takes a while."""
    if sys.stderr.isatty() and not is_cached():
        print(
            "compiling the mechanical model for this machine; once, up to half a minute",
            file=sys.stderr,
        )
    simulate(Parameters(), 1e-3, 1e-3)


def assess_motion(dataset: xr.Dataset, scenario: Scenario, patience: Patience) -> None:
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
    in_time = deadline(PATIENCE)

    def check() -> None:
        if patience.requested:
            raise TimeoutError
        in_time()

    attach_assessment(
        dataset, assess(scenario.mechanics, scenario.run.duration, interface, look=check)
    )


@contextmanager
def progress_over(duration: float) -> Iterator[Callable[[float], object]]:
    """A bar over simulated time (s) on stderr, none when that is no terminal.

    Gives a function to be called with the time reached.
    """
    layout = "{percentage:3.0f}%|{bar}| {n:.2f}/{total:g} s [{elapsed}<{remaining}]"
    with tqdm(total=duration, disable=None, bar_format=layout, leave=False) as bar:
        yield lambda time: bar.update(time - bar.n)


@contextmanager
def progress_over_files() -> Iterator[Callable[[str], None]]:
    """A line that counts and names the files written; none when stderr is no terminal."""
    with tqdm(disable=None, bar_format="{n} files written, {desc} the last", leave=False) as bar:

        def written(name: str) -> None:
            bar.set_description_str(name, refresh=False)
            bar.update()

        yield written


def finish(
    dataset: xr.Dataset,
    folder: Path,
    began: float,
    patience: Patience,
    files: Mapping[str, str] | None = None,
    views: Views = (),
    command: str | None = None,
    resume: str = "",
    log: MessageLog | None = None,
) -> int:
    """Write all results and say what came out; 0 when the run is complete, else 1.

    began: of the command, on time.perf_counter, s. patience: released when the data are on
    disk; a Ctrl-C then ends the drawing. files: further ones to list on the page. views:
    of belt and ice, for an animation. command: as the run was asked for; None: this one.
    resume: what goes on with a run that is not complete. log: of what was said in it.
    """
    command = shlex.join(["stickslip", *sys.argv[1:]]) if command is None else command
    try:
        files = dict(files or {}) | (log_files(log) if log else {})
        _write(dataset, folder, patience, files=files, views=views, command=command)
    except KeyboardInterrupt:
        print(f"error: interrupted while drawing; the data are in {folder}", file=sys.stderr)
        return FAILED
    numbers = summary(dataset)
    for said in bounds_sentences(numbers):
        print(f"warning: {said}", file=sys.stderr)
    if say_how_it_ended(numbers, folder, resume, log) == FAILED:
        return FAILED
    print("\n".join(closing_lines(numbers, folder, time.perf_counter() - began)))
    return DONE


def _write(dataset: xr.Dataset, folder: Path, patience: Patience, **further: Any) -> None:
    with progress_over_files() as show:

        def written(name: str) -> None:
            show(name)
            if name == LAST_OF_DATA:
                patience.release()

        write_results(dataset, folder, progress=written, **further)


def closing_lines(numbers: Mapping[str, Any], folder: Path, wall_time: float) -> list[str]:
    """Three to seven lines for whoever waited."""
    late, ledgers = numbers["after_run_up"], numbers["ledger"]
    lines = [
        f"{numbers['name']}: {numbers['time_reached']:g} s in {wall_time:.1f} s of wall time, "
        f"{numbers['wall_time']:.2g} s of them in the models",
        f"  stick-slip   {_motion_line(late)}",
    ]
    if "temperatures" in numbers:
        interface, shares = numbers["temperatures"]["interface"], numbers["heat_shares"]
        lines += [
            f"  interface    {interface['end_degC']:z.4f} degC at the end, "
            f"{interface['end_rise']:+z.4f} K over the air",
            f"  heat         {_heat(ledgers['heat']['received'])} J, in "
            + ", ".join(
                f"{sink} {_number(shares[sink], 'z.3f')}"
                for sink in ("belt", "ice", "air", "melting")
                if sink != "melting" or shares.get(sink)
            ),
        ]
    if "melting" in numbers:
        lines.append(f"  melting      {_melting_line(numbers['melting'])}")
    lines += _assessed_lines(numbers)
    lines.append(f"  ledgers      {_ledger_line(ledgers)}")
    lines.append(f"  results      {folder / 'report.html'} and beside it")
    return lines


def _assessed_lines(numbers: Mapping[str, Any]) -> list[str]:
    """A line where no rig could make this motion, and one where another exists beside it."""
    if "stability" not in numbers:
        return []
    lines = []
    if numbers["stability"]["verdict"] == UNSTABLE:
        lines.append(f"  unstable     {unstable_line(numbers)}")
    elif ramp := ramp_sentence(numbers):
        lines.append(f"  unstable     {ramp}")
    if numbers["other_regimes"] or numbers["regimes"][OWN]["name"] == CREEPING:
        lines.append(f"  regimes      {regime_sentence(numbers)}")
    return lines


def _motion_line(late: Mapping[str, Any]) -> str:
    if late["frequency"] is None:
        return "not known: the run ends before the surface has its speed"
    return (
        f"{late['frequency']:.3f} break-aways per second at constant speed, "
        f"slip share {_number(late['slip_share'], '.3f')}"
    )


def _melting_line(melting: Mapping[str, Any]) -> str:
    film = melting["film_thickness"]
    return (
        f"from {melting['onset']:.4g} s, {1e3 * melting['melted_mass']:.3g} g in all; film "
        f"{_number(film and 1e6 * film, '.3g')} um at the end, friction coefficient "
        f"{_number(melting['friction_before'], '.3f')} before, "
        f"{_number(melting['friction_end'], '.3f')} at the end"
    )


def _ledger_line(ledgers: Mapping[str, Any]) -> str:
    """What each ledger is off by, as a part of what it is about."""
    parts = [f"mechanics {_number(ledgers['mechanics']['relative_residual'], '.1e')} of the work"]
    if "heat" in ledgers:
        parts += [
            f"heat {_number(ledgers['heat']['relative_residual'], '.1e')}",
            f"coupling {_number(ledgers['coupling']['relative_difference'], '.1e')} of the heat",
        ]
    return ", ".join(parts)


def _heat(joules: float) -> str:
    """Joules, none of them where there is but rounding."""
    return f"{0.0 if abs(joules) < ROUNDING['J'] else joules:z.4g}"


def _number(value: float | None, form: str) -> str:
    """A run too short for a number has None."""
    return "none" if value is None else format(value, form)

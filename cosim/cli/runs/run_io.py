"""What every run on the command line shares, whatever is run: its folder, log, bar and end.

Without the models and their results: `stickslip couple` starts without them.
"""

import sys
import time
from argparse import Namespace
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple, Self, TypeVar
from xml.etree import ElementTree

from cosim.cli import DONE, FAILED, BadInput, Failed, is_bad_input
from cosim.cli.bar import Bar
from cosim.cli.console import note
from cosim.cli.numbers import Numbers
from cosim.coupling import ParticipantError
from cosim.coupling.messages import SMALLEST, UNCONVERGED, Message
from cosim.coupling.record import LOG, MessageLog, RunFolder
from cosim.coupling.system import MASTER
from cosim.files import OutputError, writable
from cosim.interrupts import Patience, patient_interrupts
from cosim.manifest import ResultFolder, claim, command_line, made_by, require_own, results_in
from cosim.report.files import PAGE_ALONE, Shown, json_text

Done = TypeVar("Done")
FIELDS = "fields"
COLLECTION = f"{FIELDS}/temperature.pvd"
COMPLETE = "complete"
#: Written after all other data and before the figures.
LAST_OF_DATA = "summary.json"


def shown(arguments: Namespace) -> Shown:
    """What is drawn of a run, as the command line says it."""
    return {"figures": arguments.figures, "page": not arguments.no_page}


@dataclass(frozen=True)
class Ending:
    """What becomes of a run on the command line.

    folder: of the results. began: of the command, on time.perf_counter, s. patience: released when
    the data are on disk; a Ctrl-C then ends the drawing. asked: where the numbers go as JSON.
    shown: what is drawn. command: as the run was asked for. resume: what goes on with it, "" where
    nothing does. log: of what was said, which is told of where there are warnings or errors.
    """

    folder: Path
    began: float
    patience: Patience
    asked: Numbers
    shown: Shown
    command: str
    resume: str = ""
    log: MessageLog | None = None

    @property
    def wall_time(self) -> float:
        """Since the command began, s."""
        return time.perf_counter() - self.began

    def told(
        self,
        write: Callable[[Callable[[str], None]], Mapping[str, Any]],
        lines: Callable[[Mapping[str, Any]], Iterable[str]],
    ) -> tuple[Mapping[str, Any], int, bool]:
        """Write all and say what became of the run, unless that is all well: one line on stderr.

        write: is given what is to be called with the name of each file once it is written, and
        returns the numbers of the summary; lines: for stderr, of these. Returns the numbers, the
        exit status, and whether the numbers are still to be told in lines.
        """

        def written(name: str) -> None:
            if name == LAST_OF_DATA:
                self.patience.release()

        goes_on = f", and this goes on from there: {self.resume}" if self.resume else ""
        try:
            numbers = write(written)
        except KeyboardInterrupt:
            said = f"interrupted while drawing; the data are in {self.folder}{goes_on}"
            print(f"error: {said}", file=sys.stderr)
            return {}, FAILED, False
        printed = self.asked.give(json_text(numbers))
        for line in lines(numbers):
            print(line, file=sys.stderr)
        said = "" if self.log is None else self.log.told()
        if numbers["status"] == COMPLETE:
            if said:
                note(said)
            return numbers, DONE, not printed
        where = f"{self.folder}, {said}" if said else str(self.folder)
        reason = f"{numbers['reason']}; what was computed is in {where}{goes_on}"
        print(f"error: {reason}", file=sys.stderr)
        return numbers, FAILED, False


class Job(NamedTuple):
    """Where a coupled run goes, and what it is of: scenario or system, for the list of its files.

    resume: what goes on with it once it is cut off.
    """

    folder: RunFolder
    shown: Shown
    command: str
    force: bool
    resume: str
    of: Mapping[str, str]

    @property
    def results(self) -> Path:
        """Folder of the results."""
        return self.folder.results

    @classmethod
    def begun(
        cls,
        results: Path,
        arguments: Namespace,
        wanted: Mapping[str, Any],
        files: Mapping[str, str],
        resume: str,
        of: Mapping[str, str],
    ) -> Self:
        """Of a run from its start; wanted, files: what else is kept to go on with it."""
        command, drawn = command_line(), shown(arguments)
        asked = {"resume": resume, "command": command, "shown": drawn, **wanted}
        folder = RunFolder.begun(results, asked, files, force=arguments.force)
        return cls(folder, drawn, command, arguments.force, resume, of)

    @classmethod
    def found(
        cls, folder: RunFolder, asked: Mapping[str, Any], resume: str, of: Mapping[str, str]
    ) -> Self:
        """Of a run that was cut off, as it was begun."""
        command = f"{asked.get('command', '')} (interrupted and resumed)"
        return cls(folder, asked.get("shown", PAGE_ALONE), command, False, resume, of)

    def carried_out(
        self,
        began: float,
        asked: Numbers,
        verbose: bool,
        run: Callable[..., Done],
        write: Callable[[Done, ResultFolder, Ending], int],
    ) -> int:
        """Run, then write what came out; the exit status.

        began, asked: of the `Ending` that write is given. run: is given the patience, and `heard`
        and `debug` as `cosim.coupling` has them; one that does not come to its first step leaves
        nothing to go on from.
        """
        folder = self.folder
        # behind what the run had said before it was cut off
        resumed, show = folder.checkpoint.is_file(), _show_line if verbose else None
        logging = MessageLog(self.results / LOG, resumed, show)
        with going_on(folder, self.resume), patient_interrupts() as patience, logging as log:
            try:
                done: Any = run(patience, heard=hearing(log, verbose), debug=verbose)
            except BaseException:
                if not folder.checkpoint.is_file():
                    folder.finished()
                    for place in (self.results / FIELDS, self.results):
                        with suppress(OSError):  # there is something in it
                            place.rmdir()
                raise
            patience.hold()
            if is_removed(self.results, done.result.time.tolist()):
                return FAILED
            goes_on = done.result.status != COMPLETE and folder.checkpoint.is_file()
            resume, made = self.resume if goes_on else "", made_by(self.command, **self.of)
            drawn = (patience, asked, self.shown, self.command, resume, log)
            with results_in(self.results, made, force=self.force) as results:
                for name in log_files(log):
                    results.add(self.results / name)
                status = write(done, results, Ending(self.results, began, *drawn))
                results.complete = status == DONE
        # only now: had the results not come to the disk, there would still be what they are made of
        folder.release() if goes_on else folder.finished()
        return status


@contextmanager
def refusing_units(named: bool) -> Iterator[None]:
    """What a unit refuses before the first step, in one line; named: also whose fault it is.

    A unit's contents are only unpacked, and refused, when it starts.
    """
    try:
        yield
    except ParticipantError as error:
        if is_bad_input(error.__cause__):
            cause = " ".join(str(error.__cause__).split())
            told = f"{error.participant}: {cause}" if named and ".fmu" not in cause else cause
            raise BadInput(told) from error
        raise Failed(" ".join(str(error).split())) from error


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
    """The collections of the temperature fields, and what they name; none where there are none."""
    found: list[str] = []
    for file in sorted((folder / FIELDS).glob(f"{Path(COLLECTION).stem}*.pvd")):
        try:
            named = [entry.get("file", "") for entry in ElementTree.parse(file).iter("DataSet")]
        except (OSError, ElementTree.ParseError):
            continue
        found += [f"{FIELDS}/{name}" for name in (file.name, *named)]
    return found


#: What is called otherwise in the arguments than on the command line.
_CALLED = {"a scenario": "scenario", "-o": "output", "--set": "changes"}


def refuse_beside_resume(arguments: Namespace, *called: str) -> None:
    """BadInput for an argument, by what it is called, that was given beside --resume."""
    for what in called:
        if getattr(arguments, _CALLED.get(what, what.strip("-").replace("-", "_"))):
            raise BadInput(
                f"--resume: goes on with a run as it was begun, so {what} cannot be given"
            )


def _show_line(line: str) -> None:
    """On stderr, above the bar where there is one."""
    Bar.write(line, file=sys.stderr)


def hearing(log: MessageLog, verbose: bool) -> Callable[[Message], None]:
    """What a run tells its messages to: the log, and at once the terminal where it cannot wait.

    That steps grind at their smallest size, or stand unconverged, is said where it begins; what
    follows of the kind is in the log alone. verbose: the log shows all of it.
    """
    heard: set[str] = set()

    def hear(message: Message) -> None:
        log.add(message)
        at_once = message.source == MASTER and message.category in (SMALLEST, UNCONVERGED)
        if at_once and message.category not in heard and not verbose:
            heard.add(message.category)
            when = "" if message.time is None else f"at t = {message.time:.6g} s "
            _show_line(f"warning: {when}{message.text}; more of it is in {log.path}")

    return hear


def log_files(log: MessageLog | None) -> dict[str, str]:
    """The log as the page lists it; it is there where something was said."""
    there = log is not None and log.path.is_file()
    return {LOG: "what units and master said, a line each"} if there else {}


@contextmanager
def going_on(folder: RunFolder, resume: str) -> Iterator[None]:
    """What could not be written, as on a full disk, is said with what goes on from a checkpoint."""
    try:
        yield
    except OutputError as error:
        if not folder.checkpoint.is_file():
            raise
        raise OutputError(f"{error}; this goes on from the newest checkpoint: {resume}") from error


def is_removed(folder: Path, time: Iterable[float]) -> bool:
    """Whether the folder of the results is gone, which is then said in one line, with what is lost.

    time: recorded times of the run, s.
    """
    if folder.is_dir():
        return False
    reached = max(time, default=0.0)
    print(
        f"error: {folder}: was removed while the run went; it has ended at t = {reached:.6g} s, and"
        " all rows until then, checkpoints and messages are lost: begin anew",
        file=sys.stderr,
    )
    return True


@contextmanager
def progress_over(
    duration: float, patience: Patience | None = None, start: float = 0.0
) -> Iterator[Callable[[float], None]]:
    """A bar over simulated time (s) on stderr, none when that is no terminal.

    Gives a function to be called with the time reached, of a run from `start`; from then on there
    is something to lose. What remains is by the mean speed since the first step: models are made
    ready before it, which takes as long as a thousand steps.
    """
    layout = "{percentage:3.0f}%|{bar}| {n:.2f}/{total:g} s [{elapsed}<{remaining}]"
    # miniters: a stretch that goes fast is not to keep the bar still in a slow one
    with Bar(total=duration, bar_format=layout, smoothing=0, miniters=0) as bar:
        begun = False

        def show(reached: float) -> None:
            nonlocal begun
            if patience is not None:
                patience.hold()
            if not (begun or bar.disable):
                begun = True
                bar.initial = bar.n = bar.last_print_n = reached - start
                bar.start_t = bar.last_print_t = time.time()  # tqdm's clock
            bar.update(reached - start - bar.n)

        yield show

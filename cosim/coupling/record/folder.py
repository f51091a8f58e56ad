"""What a run keeps in its folder of results until it is complete, and goes on from.

`unfinished/` holds the rows so far, the newest checkpoint and what the run was asked for; that it
is there says that the run is not complete.
"""

import json
import shutil
from collections.abc import Mapping
from contextlib import suppress
from io import TextIOWrapper
from pathlib import Path
from typing import Any, Self

from cosim.coupling.record.checkpoint import CheckpointError
from cosim.files import OutputError, OutputRefused, writable, write_text

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None  # type: ignore[assignment]

UNFINISHED = "unfinished"
RECORD, COLUMNS, CHECKPOINT = "record.npy", "record.json", "checkpoint.zip"
_ASKED, _LOCK, _READ_ME = "run.json", "lock", "README.txt"
EXPLANATION = Path(__file__).with_name("unfinished.txt")


class RunFolder:
    """The folder of an unfinished run, held by one process at a time.

    folder: of the results, there and writable. Made by `begun` or `found`.
    """

    def __init__(self, results: Path):
        self.results = results
        self.path: Path = results / UNFINISHED
        self.record: Path = self.path / RECORD
        self.columns: Path = self.path / COLUMNS
        self.checkpoint: Path = self.path / CHECKPOINT
        self._lock: TextIOWrapper | None = None

    @classmethod
    def begun(
        cls, results: Path, asked: Mapping[str, Any], files: Mapping[str, str], force: bool = False
    ) -> Self:
        """Begin anew; what an earlier run left is gone.

        force: also where that run could be resumed; else that is refused.

        asked: what the run was asked for (`resume`: the command that goes on with it). files: name
        -> text of what else it needs. Raises OutputRefused where another process is at work here
        or a run can be resumed, OutputError where the disk refuses.
        """
        folder = cls(results)
        try:
            folder.path.mkdir(exist_ok=True)
            folder._hold()
            if not force:
                folder._refuse_to_lose()
            folder._clear()
        except OSError as error:
            raise OutputError(f"{folder.path}: cannot be written: {error.strerror}") from error
        own = {
            _ASKED: json.dumps(dict(asked), indent=1) + "\n",
            _READ_ME: EXPLANATION.read_text("utf-8").format(resume=asked.get("resume", "")),
        }
        for name, text in (own | dict(files)).items():
            write_text(text, folder.path / name)
        return folder

    @classmethod
    def found(cls, results: Path) -> Self:
        """The folder of a run that was cut off and has a checkpoint.

        Raises CheckpointError, in one line, where there is none, OutputRefused where another
        process is at work here, or nothing can be written.
        """
        folder = cls(results)
        if not results.is_dir():
            raise CheckpointError(
                f"{results}: no such folder, allowed is that of an unfinished run"
            )
        if not folder.path.is_dir():
            raise CheckpointError(
                f"{results}: holds no unfinished run: it is complete or was never begun"
            )
        folder._hold()
        if not folder.checkpoint.is_file():
            folder.release()
            raise CheckpointError(
                f"{results}: its run has no checkpoint yet, or what it couples cannot be saved: "
                "begin anew"
            )
        writable(results)
        for entry in folder._partial():
            entry.unlink(missing_ok=True)
        return folder

    @property
    def asked(self) -> dict[str, Any]:
        """What the run was asked for; CheckpointError when that cannot be read."""
        path = self.path / _ASKED
        try:
            content = json.loads(path.read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            raise CheckpointError(f"{path}: cannot be read: {error}") from error
        if not isinstance(content, dict):
            raise CheckpointError(f"{path}: is damaged")
        return content

    def finished(self) -> None:
        """The run is complete and its results are written: nothing of this is needed any more."""
        self.release()
        shutil.rmtree(self.path, ignore_errors=True)

    def release(self) -> None:
        """Another process may go on from here."""
        if self._lock is not None:
            self._lock.close()
            self._lock = None

    def _hold(self) -> None:
        """Keep other processes out; the system lets go of it when this one is killed."""
        if fcntl is None:
            return
        self._lock = (self.path / _LOCK).open("w")
        try:
            # of this process alone: what it starts does not hold on to it
            fcntl.lockf(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            self.release()
            raise OutputRefused(
                f"{self.results}: another process is at work on a run in here, allowed is to wait "
                "for it, or another folder: name one with -o"
            ) from error

    @property
    def is_left(self) -> bool:
        """Whether a run was begun here that did not come to its end."""
        return (self.path / _ASKED).is_file()

    def _refuse_to_lose(self) -> None:
        """OutputRefused where an earlier run could be resumed."""
        if not self.checkpoint.is_file():
            return
        resume = f"--resume {self.results}"
        with suppress(CheckpointError):
            resume = str(self.asked.get("resume", "")) or resume
        self.release()
        raise OutputRefused(
            f"{self.results}: holds an unfinished run, allowed is to go on with it: {resume}; "
            "another folder with -o; or --force to begin anew"
        )

    def _clear(self) -> None:
        """Remove what an earlier run left, and nothing that is not of a run."""
        names = {entry.name for entry in {*self.path.iterdir()} - self._partial()}
        if names - {_LOCK} and _ASKED not in names:
            raise OutputRefused(
                f"{self.path}: holds files that are not of a run, allowed is a folder without them"
            )
        for entry in self.path.iterdir():
            if entry.is_dir() and not entry.is_symlink():
                shutil.rmtree(entry)
            elif entry.name != _LOCK:
                entry.unlink()

    def _partial(self) -> set[Path]:
        """What a kill in the middle of writing left."""
        return {*self.path.glob(".*.partial")}

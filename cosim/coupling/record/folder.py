"""What a run keeps in its folder of results until it is complete, and goes on from.

`unfinished/` holds the rows so far, the newest checkpoint and what the run was asked for; that it
is there says that the run is not complete.

A checkpoint is a file with everything that a run needs to go on, in another process, bit for bit. A
zip: `manifest.json`, in which numbers stand with all their digits, and one member with the bytes of
each participant. Its comment, the last 64 bytes, is the SHA-256 of all that is before them.
"""

import hashlib
import io
import json
import shutil
import zipfile
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from io import TextIOWrapper
from itertools import zip_longest
from os.path import commonprefix
from pathlib import Path
from typing import Any, Self

from cosim.files import OutputError, OutputRefused, writable, write_bytes, write_text

#: Of the file's layout; a file of another one is refused.
FORMAT = 3
_MANIFEST = "manifest.json"
_DIGEST = 64
#: How many differences of two set-ups a message names.
_NAMED = 3
#: Characters of a text that a message shows.
_SHOWN = 80


class CheckpointError(ValueError):
    """A checkpoint is none, is damaged, or belongs to another case; one line."""


@dataclass(frozen=True)
class Checkpoint:
    """A run at an accepted communication point.

    time: s. setup: what the run is made of, as `differences` compares it: key -> text or number.
    master: what the master needs to go on, of what JSON holds: texts, numbers, lists, tables.
    states: participant, or whatever else goes on, -> its bytes. record: where the rows on disk have
    come to, as `master`.
    """

    time: float
    setup: Mapping[str, Any] = field(default_factory=dict)
    master: Mapping[str, Any] = field(default_factory=dict)
    states: Mapping[str, bytes] = field(default_factory=dict)
    record: Mapping[str, Any] = field(default_factory=dict)


def save_checkpoint(path: Path, checkpoint: Checkpoint) -> Path:
    """Put a checkpoint in place of an earlier one; at any moment one of the two is there, whole.

    Raises OutputError, in one line, where the disk refuses.
    """
    content, told = io.BytesIO(), vars(checkpoint) | {"states": list(checkpoint.states)}
    # json writes a float by `repr`, which reads back as the same bits; an array is one of numpy
    manifest = json.dumps(
        {"format": FORMAT} | told, indent=1, ensure_ascii=False, default=lambda a: a.tolist()
    )
    with zipfile.ZipFile(content, "w") as archive:
        archive.writestr(_MANIFEST, manifest)
        for number, state in enumerate(checkpoint.states.values()):
            archive.writestr(_member(number), state)
        archive.comment = b"0" * _DIGEST
    data = content.getvalue()[:-_DIGEST]
    return write_bytes(data + _digest(data), path)


def _member(number: int) -> str:
    """A participant's name may be one that no file can have."""
    return f"states/{number:04d}"


def _digest(data: bytes) -> bytes:
    return hashlib.sha256(data).hexdigest().encode()


def load_checkpoint(path: Path) -> Checkpoint:
    """What `save_checkpoint` wrote; CheckpointError in one line when it is not that any more."""
    try:
        data = path.read_bytes()
    except OSError as error:
        raise CheckpointError(f"{path}: cannot be read: {error.strerror or error}") from error
    if len(data) <= _DIGEST or _digest(data[:-_DIGEST]) != data[-_DIGEST:]:
        raise CheckpointError(
            f"{path}: is damaged or no checkpoint: its contents do not have the checksum at its end"
        )
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        manifest = json.loads(archive.read(_MANIFEST))
        if manifest["format"] != FORMAT:
            raise CheckpointError(
                f"{path}: is a checkpoint of format {manifest['format']}, this version goes on from"
                f" format {FORMAT}: use the version that made it"
            )
        states = {
            name: archive.read(_member(number)) for number, name in enumerate(manifest["states"])
        }
    del manifest["format"]
    return Checkpoint(**(manifest | {"states": states}))


def differences(before: Mapping[str, Any], now: Mapping[str, Any]) -> list[str]:
    """What differs between two set-ups, as `key: was this, is that`; [] where nothing does.

    >>> differences({"mass": 0.67, "speed": 0.1}, {"mass": 0.7, "speed": 0.1})
    ['mass: was 0.67, is 0.7']
    """
    absent = object()
    found = []
    for key in dict.fromkeys((*before, *now)):
        values = [side.get(key, absent) for side in (before, now)]
        was, new = (_as_json(value, absent) for value in values)
        if was == new:
            continue
        if all(isinstance(value, str) for value in values):
            line, was, new = _first_difference(*values)
            key += f", line {line}" if any("\n" in value for value in values) else ""
        found.append(f"{key}: was {was}, is {new}")
    return found


def _first_difference(was: str, new: str) -> tuple[int, str, str]:
    """Of two texts, which may be whole files: number and text of the first line that differs."""
    pairs = zip_longest(was.splitlines(keepends=True), new.splitlines(keepends=True))
    number, sides = next((n, pair) for n, pair in enumerate(pairs, 1) if pair[0] != pair[1])
    same = len(commonprefix([side or "" for side in sides]))
    # a file can be one long line: what is shown begins shortly before the difference
    first = max(0, same - _SHOWN // 2)
    shown = ["not there" if side is None else _clipped(side, first) for side in sides]
    return number, shown[0], shown[1]


def _clipped(text: str, first: int) -> str:
    part = json.dumps(text[first : first + _SHOWN], ensure_ascii=False)
    return ("..." if first else "") + part + ("..." if len(text) > first + _SHOWN else "")


def _as_json(value: Any, absent: object) -> str:
    return "not there" if value is absent else json.dumps(value, sort_keys=True, ensure_ascii=False)


def require_same_setup(path: Path, checkpoint: Checkpoint, setup: Mapping[str, Any]) -> None:
    """Refuse to go on with another case; CheckpointError that names what differs."""
    found = differences(checkpoint.setup, setup)
    if found:
        more = f", and {len(found) - _NAMED} more" if len(found) > _NAMED else ""
        raise CheckpointError(
            f"{path}: is of another case: {', '.join(found[:_NAMED])}{more}; allowed is to go on "
            "with what the run was begun with"
        )


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

"""Files and folders of results: tried before anything is computed, whole when they are there."""

import os
import platform
import tempfile
import zlib
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

#: A machine, in a file's name: process numbers are of one.
_HOST = f"{zlib.crc32(platform.node().encode()):08x}"


class OutputRefused(ValueError):
    """A file or folder that cannot be written, found before anything is computed; one line."""


class OutputError(ValueError):
    """A result that was computed cannot be written; one line with the file and the reason."""


#: Who is told of every file before it takes its name.
_watchers: list[Callable[[Path], object]] = []


@contextmanager
def watched(told: Callable[[Path], object]) -> Iterator[None]:
    """Call ``told`` with the path of every file that this process writes, before it is there."""
    _watchers.append(told)
    try:
        yield
    finally:
        _watchers.remove(told)


def writable(folder: Path, files: Iterable[str] = ()) -> Path:
    """Make a folder; OutputRefused when nothing can be written to it, or a name in it is taken.

    Partial files of processes that were killed go.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass  # the only sure test: permissions do not bind everybody, a disk may be read-only
    except OSError as error:
        raise OutputRefused(
            f"{folder}: cannot be written to ({error.strerror}), allowed is a folder that can"
        ) from error
    not_taken(folder, files)
    clear_partial(folder)
    return folder


def clear_partial(folder: Path) -> None:
    """Remove the partial files of processes that were killed."""
    for file in folder.glob(".*.partial"):
        host, _, number = file.name.split(".")[-2].partition("-")
        if host == _HOST and number.isdecimal() and not _lives(int(number)):
            file.unlink(missing_ok=True)


def _lives(process: int) -> bool:
    """Whether there is a process of that number; it may be another one since."""
    if os.name == "nt":  # os.kill would end it
        return True
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except (PermissionError, OverflowError):
        pass  # somebody else's; or the number of another kind of machine, of which nothing is known
    return True


def not_taken(folder: Path, files: Iterable[str]) -> None:
    """OutputRefused when a name that a file is to have is a folder's."""
    for name in files:
        if (folder / name).is_dir():
            raise OutputRefused(f"{folder / name}: is a folder, allowed is a file or nothing")


def write_atomically(path: Path, write: Callable[[Path], object]) -> Path:
    """Let ``write`` fill a partial file beside ``path``, bring it to the disk, put it in place.

    An earlier file of that name stays as it was until then. Raises OutputError where the disk
    refuses, and what ``write`` raises; no partial file is left.
    """
    partial = path.with_name(f".{path.name}.{_HOST}-{os.getpid()}.partial")
    try:
        partial.touch()  # says in plain words why a folder refuses; HDF5 does not
        write(partial)
        with partial.open("rb+") as file:
            os.fsync(file.fileno())  # else a power cut may leave the name without the contents
        for told in tuple(_watchers):
            told(path)
        os.replace(partial, path)
    except OSError as error:
        raise OutputError(f"{path}: cannot be written: {error.strerror or error}") from error
    finally:
        if path.parent.is_dir():
            partial.unlink(missing_ok=True)
    return path


def write_text(text: str, path: Path) -> Path:
    """A text file in UTF-8."""
    return write_atomically(path, lambda partial: partial.write_text(text, encoding="utf-8"))


def write_bytes(content: bytes, path: Path) -> Path:
    """A binary file."""
    return write_atomically(path, lambda partial: partial.write_bytes(content))


def write_unless_owned(texts: Mapping[str, str], folder: Path, force: bool = False) -> None:
    """Text files into a folder that is made, all or none; nothing that somebody changed is lost.

    texts: name -> text. OutputRefused when a file of such a name is there with other content,
    unless ``force``; one of the same content is as good as written.
    """
    writable(folder, texts)
    other = [folder / name for name, text in texts.items() if _differs(folder / name, text)]
    if other and not force:
        raise OutputRefused(
            f"{other[0]}: is there with other content, allowed is another folder, or --force to "
            "overwrite it"
        )
    for name, text in texts.items():
        write_text(text, folder / name)


def _differs(path: Path, text: str) -> bool:
    """Whether a file is there that holds anything else; a pipe, which may never end, does."""
    if not path.is_file():
        return path.exists()
    try:
        return path.read_bytes().decode("utf-8").splitlines() != text.splitlines()
    except (OSError, UnicodeDecodeError):
        return True

"""Whose the files of a result folder are: those of one run, listed there, and everybody else's."""

import json
import logging
import shlex
import sys
from collections.abc import Collection, Iterable, Iterator, Mapping
from contextlib import contextmanager
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path, PurePosixPath
from typing import Any
from warnings import warn

from cosim.files import OutputRefused, clear_partial, watched, writable, write_text

LOG = logging.getLogger(__name__)
#: What made the results beside it, and which files they are.
MANIFEST = "made_by.json"
COMPLETE, INCOMPLETE = "complete", "incomplete"


class ResultFolder:
    """Files of one run as they are written; those of an earlier one that are left go at the end.

    complete: whether the run came to its end, for whoever reads the manifest; where it did not, who
    writes says so, or raises.
    """

    def __init__(self, folder: Path, made_by: Mapping[str, Any], force: bool):
        self.folder, self.complete = folder, True
        self._made_by, self._force = dict(made_by), force
        self._earlier, self._written = files_of_earlier(folder), set[str]()

    def add(self, path: Path) -> None:
        """A file of this run, written by whatever way."""
        name = self._name(path)
        if name not in ("", MANIFEST) and name not in self._written:
            self._written.add(name)
            LOG.info("writing %s", path)
            self._say(INCOMPLETE, self._earlier | self._written)

    def about_to_write(self, path: Path) -> None:
        """Add a file that takes its name now; what somebody else has there is kept beside it."""
        name = self._name(path)
        known = name in ("", MANIFEST, *self._written, *self._earlier)
        if not known and not self._force and path.is_file():
            _keep(path)
        self.add(path)

    def close(self) -> None:
        """Remove what is left of the earlier run, once there is something of this one."""
        if not self._written:
            return
        for name in self._earlier - self._written:
            _remove(self.folder, name)
        there = {name for name in self._written if (self.folder / name).is_file()}
        self._say(COMPLETE if self.complete else INCOMPLETE, there)

    def _name(self, path: Path) -> str:
        """Relative to the folder; "" where it is not inside."""
        try:
            place = path.parent.resolve() / path.name  # of a link, where the link is
            return place.relative_to(self.folder.resolve()).as_posix()
        except ValueError:
            return ""

    def _say(self, status: str, files: Iterable[str]) -> None:
        _write(self.folder, self._made_by | {"status": status, "files": sorted(files)})


def command_line() -> str:
    """That of this process."""
    return shlex.join(["stickslip", *sys.argv[1:]])


def made_by(command: str | None = None, **what: Any) -> dict[str, Any]:
    """Command line, version of the package and time (UTC), and what else made a result.

    command: None for that of this process. what: key -> value for JSON, as the scenario.
    """
    return {
        "command": command_line() if command is None else command,
        "stickslip": version("stickslip"),
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
        **what,
    }


@contextmanager
def results_in(
    folder: Path, made: Mapping[str, Any], files: Iterable[str] = (), force: bool = False
) -> Iterator[ResultFolder]:
    """The results that are written meanwhile are those of one run, and named in `MANIFEST`.

    made: of `made_by`. files: as for `require_own`, which is asked first. A file of another name
    that is somebody else's is moved aside with a warning, as nobody computes again for that;
    ``force`` overwrites it.
    """
    require_own(folder, files, force)
    clear_partial(folder)  # of a run that was killed, where the command has not tried the folder
    results = ResultFolder(folder, made, force)
    try:
        with watched(results.about_to_write):
            yield results
    except BaseException:
        results.complete = False
        raise
    finally:
        results.close()


def other_command(folder: Path) -> str:
    """The command line of an earlier result in a folder, if it is of another command; else ""."""
    line = str(manifest_of(folder).get("command", ""))
    return line if line.split()[1:2] != sys.argv[1:2] else ""


def require_own(folder: Path, files: Iterable[str], force: bool = False) -> None:
    """OutputRefused when one of these files is there and no run of ours has listed it."""
    if force:
        return
    ours = files_of_earlier(folder)
    for name in files:
        if name not in ours and (folder / name).is_file():
            raise OutputRefused(
                f"{folder / name}: is no result of an earlier run by {folder / MANIFEST}, allowed "
                "is another folder with -o, or --force to overwrite it"
            )


def own_folder(folder: str | Path, files: Iterable[str], force: bool = False) -> Path:
    """A folder that is made, found writable, and has no file of these that is somebody else's."""
    require_own(writable(Path(folder), files), files, force)
    return Path(folder)


def require_json(path: Path, keys: Collection[str], force: bool = False) -> None:
    """OutputRefused for a file that is no earlier JSON of ours: an object with `keys`, or some."""
    if force or not path.exists():
        return
    try:
        # of a device there is no end, and nothing that could be lost
        content = json.loads(path.read_text(encoding="utf-8")) if path.is_file() else None
    except (OSError, ValueError):
        content = None
    found = content if isinstance(content, list) and content else [content]
    if not all(isinstance(entry, dict) and set(keys) <= set(entry) for entry in found):
        raise OutputRefused(
            f"{path}: is there and no result of this command, allowed is another name, or --force "
            "to overwrite it"
        )


def claim(folder: Path, files: Iterable[str]) -> None:
    """List files that an earlier run of ours left without having had the time for it."""
    ours = files_of_earlier(folder)
    there = {name for name in files if (folder / name).is_file()}
    if there - ours:
        _write(folder, {"status": INCOMPLETE, "files": sorted(ours | there)})


def list_further(folder: Path, files: Iterable[str]) -> None:
    """List files that were added to a complete result, which is otherwise as it was."""
    content = manifest_of(folder) or made_by()
    _write(folder, content | {"files": sorted({*content.get("files", ()), *files})})


def files_of_earlier(folder: Path) -> set[str]:
    """What the last run here has listed, as names inside the folder; none where there was none."""
    listed = manifest_of(folder).get("files", ())
    names = listed if isinstance(listed, list) else ()
    return {name for name in names if isinstance(name, str) and _is_inside(name)}


def manifest_of(folder: Path) -> dict[str, Any]:
    """What the manifest in a folder says; nothing where there is none, or it is damaged."""
    try:
        content = json.loads((folder / MANIFEST).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return content if isinstance(content, dict) else {}


def _write(folder: Path, content: Mapping[str, Any]) -> None:
    write_text(json.dumps(content, indent=1, ensure_ascii=False) + "\n", folder / MANIFEST)


def _is_inside(name: str) -> bool:
    """Whether a name stays in its folder: a list may have been written by anybody."""
    path = PurePosixPath(name)
    return bool(path.parts) and not path.is_absolute() and ".." not in path.parts


def _keep(path: Path) -> None:
    """Move a file aside, under a name that is free."""
    number = 1
    while (aside := path.with_name(f"{path.name}.kept{number}")).exists():
        number += 1
    path.rename(aside)
    warn(f"{path}: was no result of ours; it is kept as {aside.name}", UserWarning, stacklevel=2)


def _remove(folder: Path, name: str) -> None:
    """A file, and the folders that are empty without it."""
    path = folder / name
    try:
        path.unlink(missing_ok=True)
        for parent in path.relative_to(folder).parents[:-1]:
            (folder / parent).rmdir()
    except OSError:
        pass  # a folder that holds something else, or is gone, stays as it is

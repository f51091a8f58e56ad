"""Files that somebody names: what kind and how large they are is asked before they are read."""

import errno
import os
import re
import stat
import tomllib
from pathlib import Path
from typing import Any

#: Bytes of a TOML file, which take some seconds, and of tables in tables or lists in lists.
MOST_TOML, DEEPEST = 4 * 2**20, 64
_PART = r"""(?:[\w-]++|"[^"\n]*+"|'[^'\n]*+')"""
#: A key with dots: for each of them tomllib goes through all before it.
_DOTTED = re.compile(rf"{_PART}(?:[ \t]*+\.[ \t]*+{_PART})*+")


def read_text(file: str | os.PathLike[str], most: int) -> str:
    """The text of a file in UTF-8 of up to ``most`` bytes; OSError, UnicodeDecodeError for none.

    A pipe is read where a shell has opened it for the command (`/dev/stdin`, `<(...)`); one on
    disk, which nobody may ever write to, and a device, which may never end, are refused.
    """
    path = Path(file)
    status = path.stat()
    piped = stat.S_ISFIFO(status.st_mode) and path.is_relative_to("/dev")
    if not (stat.S_ISREG(status.st_mode) or piped):
        kind = errno.EISDIR if stat.S_ISDIR(status.st_mode) else errno.EINVAL
        raise OSError(kind, "is a folder" if kind == errno.EISDIR else "is not a file", str(file))
    if status.st_size > most:
        raise _too_large(file, status.st_size, most)
    with path.open("rb") as opened:
        content = opened.read(most + 1)
    if len(content) > most:
        raise _too_large(file, len(content), most)
    # as a file that is opened for its text, and without the mark that editors on Windows put
    return content.decode("utf-8-sig").replace("\r\n", "\n").replace("\r", "\n")


def _too_large(file: object, size: int, most: int) -> OSError:
    said = f"has {size / 2**20:.3g} MiB, allowed are {most / 2**20:g} MiB"
    return OSError(errno.EFBIG, said, str(file))


def tables_in(text: str) -> dict[str, Any]:
    """The tables of a TOML text; ValueError, of tomllib and others, where it cannot be used."""
    if any(found[0].count(".") > DEEPEST for found in _DOTTED.finditer(text)):
        raise ValueError(_TOO_DEEP)
    try:
        tables = tomllib.loads(text)
    except RecursionError:
        raise ValueError(_TOO_DEEP) from None
    if _is_deeper(tables, DEEPEST):
        raise ValueError(_TOO_DEEP)
    return tables


_TOO_DEEP = f"nested too deeply, allowed are {DEEPEST} levels"


def _is_deeper(value: Any, levels: int) -> bool:
    if not isinstance(value, dict | list):
        return False
    inner = value.values() if isinstance(value, dict) else value
    return levels < 0 or any(_is_deeper(each, levels - 1) for each in inner)

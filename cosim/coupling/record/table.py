"""A table on disk that grows row by row and can be read by others at any moment.

The file is an array as numpy saves it, (rows, columns): a header of fixed length, then the rows.
A row is written behind the end first, and only then counted in the header, in place; so whoever
opens the file with `numpy.load(path, mmap_mode="r")`, while it grows or after a kill, finds whole
rows. Names and units of the columns stand in a JSON file beside it: the header of an array with
named fields outgrows, at some 250 names, what numpy.load reads without being told to.
"""

import errno
import os
import struct
import tempfile
import time
import weakref
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from io import FileIO
from pathlib import Path

import numpy as np

from cosim.files import OutputError

#: Digits of the row count. They lie in two machine words, and the upper one does not change before
#: 1e8 rows: a reader never sees half of a new count.
DIGITS = 16
_HEADER = 128
_COUNT_AT = 64
#: How often to see whether the file is still there, s of wall time.
LOOK_EVERY = 1.0


class GrowingTable:
    """A table of floats in a file, of which nothing is kept in memory.

    columns: how many; path: of the file, which replaces an earlier one; None: a file without a
    name that is gone when it is closed. single: four bytes a number instead of eight. rows: go on
    after so many in the file that an earlier process has left, in place of a new one.
    Raises OutputError, in one line, where the disk refuses, or the file is not that table or has
    fewer rows; what was there stays readable.
    """

    def __init__(
        self,
        columns: int,
        path: Path | None = None,
        single: bool = False,
        rows: int | None = None,
    ):
        self.columns, self.path = columns, path
        self._kind = np.dtype("<f4" if single else "<f8")
        self._pack = struct.Struct(f"<{columns}{self._kind.char}").pack
        self._size = columns * self._kind.itemsize
        self._rows = rows or 0
        self._looked = time.monotonic()
        with self._refusing():
            self._file = _opened(path, anew=rows is None)
        self._number = self._file.fileno()
        weakref.finalize(self, self._file.close)
        head = _header(self._kind.str, columns)
        if rows is not None:
            self._go_on(head)
        else:
            self._write(head, 0)

    def _go_on(self, head: bytes) -> None:
        found, size = self._file.read(_HEADER), _HEADER + self._rows * self._size
        enough = os.fstat(self._number).st_size >= size
        if _without_count(found) != _without_count(head) or not enough:
            self.close()
            raise OutputError(
                f"{self.path}: is not the table of {self.columns} columns and at least "
                f"{self._rows} rows that was begun here"
            )
        # shorter before anything is written: at no time is there a row that was not computed
        self._count()
        with self._refusing():
            self._file.truncate(size)

    def append(self, values: Sequence[float] | np.ndarray) -> None:
        """Write a row of (columns,) values.

        The row is with the operating system when this returns: it outlives the process.
        """
        self._write(self._packed(values), _HEADER + self._rows * self._size)
        self._rows += 1
        self._count()
        if time.monotonic() - self._looked > LOOK_EVERY:
            self._look()

    def _packed(self, values: Sequence[float] | np.ndarray) -> bytes:
        if isinstance(values, np.ndarray):
            return np.ascontiguousarray(values.reshape(self.columns), self._kind).tobytes()
        return self._pack(*values)

    def _count(self) -> None:
        self._write(b"%*d" % (DIGITS, self._rows), _COUNT_AT)

    def _write(self, data: bytes, at: int) -> None:
        try:
            written = _write_at(self._number, data, at)
            while written < len(data):  # a disk that fills up takes a part, then says so
                written += _write_at(self._number, data[written:], at + written)
        except OSError as error:
            raise self._refused(error) from error

    def sync(self) -> None:
        """Bring all rows to the disk: they outlive the machine."""
        self._look()
        with self._refusing():
            os.fsync(self._number)

    def _look(self) -> None:
        """A file that was removed takes rows for ever, and nobody will find them."""
        self._looked = time.monotonic()
        if self.path is not None and not self.path.exists():
            raise self._refused(OSError(errno.ENOENT, "it was removed while it was written"))

    def rows(self) -> np.ndarray:
        """All rows (n, columns), read-only, as the file has them: read when they are looked at."""
        if not self._rows:
            return np.empty((0, self.columns), self._kind)
        shape = (self._rows, self.columns)
        return np.asarray(np.memmap(self._file, self._kind, "r", _HEADER, shape))

    def __len__(self) -> int:
        return self._rows

    def close(self) -> None:
        """Let go of the file; arrays that `rows` gave stay good. May be called twice."""
        self._file.close()

    @contextmanager
    def _refusing(self) -> Iterator[None]:
        """Turns an OSError into an OutputError that names the table's file."""
        try:
            yield
        except OSError as error:
            raise self._refused(error) from error

    def _refused(self, error: OSError) -> OutputError:
        what = self.path or "a temporary file"
        return OutputError(f"{what}: cannot be written: {error.strerror or error}")


def _header(kind: str, columns: int) -> bytes:
    """What numpy puts in front of an array (0, columns), the row count at a place of its own."""
    front = f"{{'descr': '{kind}', 'fortran_order': False, 'shape': (".encode()
    prefix = b"\x93NUMPY\x01\x00" + struct.pack("<H", _HEADER - 10)
    text = (prefix + front).ljust(_COUNT_AT) + b"%*d, %d), }" % (DIGITS, 0, columns)
    return text.ljust(_HEADER - 1) + b"\n"


def _without_count(head: bytes) -> bytes:
    return head[:_COUNT_AT] + head[_COUNT_AT + DIGITS :]


def _opened(path: Path | None, anew: bool) -> FileIO:
    if path is None:
        # numpy maps it, and wants a file that is one itself
        file: FileIO = tempfile.TemporaryFile(buffering=0)  # noqa: SIM115  closed with the table
        return file
    if anew:
        path.unlink(missing_ok=True)  # who has the earlier one open keeps it
    return path.open("x+b" if anew else "r+b", buffering=0)


def _seek_and_write(file: int, data: bytes, at: int) -> int:
    os.lseek(file, at, os.SEEK_SET)
    return os.write(file, data)


#: What writes at a place of a file; Windows has no single call for it.
_write_at = getattr(os, "pwrite", _seek_and_write)

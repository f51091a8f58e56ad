"""The table on disk: read by plain numpy at any moment, whatever becomes of the writer."""

import sys

import numpy as np
import pytest
from command_line import python
from refusals import one_line

from cosim.coupling.record import GrowingTable
from cosim.coupling.record import table as table_module
from cosim.files import OutputError


def loaded(path):
    return np.load(path, mmap_mode="r")


def test_every_number_comes_back_as_it_was(tmp_path):
    odd = [np.nan, np.inf, -np.inf, -0.0, 5e-324, 1.7976931348623157e308, 0.1]
    table = GrowingTable(len(odd), tmp_path / "t.npy")
    table.append(odd)
    assert loaded(table.path).tobytes() == np.array([odd]).tobytes()


def test_without_a_path_there_is_no_file_and_the_rows_are_there(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    table = GrowingTable(2)
    assert table.rows().shape == (0, 2)
    table.append([1.0, 2.0])
    rows = table.rows()
    assert list(tmp_path.iterdir()) == []
    table.close()
    assert rows.tolist() == [[1.0, 2.0]], "what was given stays good"
    assert not rows.flags.writeable


def test_goes_on_at_a_place_that_it_has_passed(tmp_path):
    whole, cut = (GrowingTable(2, tmp_path / name) for name in ("whole.npy", "cut.npy"))
    for n in range(20):
        whole.append([n, 0.1 * n])
    for n in range(17):
        cut.append([n, 0.1 * n])
    cut.close()
    cut = GrowingTable(2, tmp_path / "cut.npy", rows=11)
    assert loaded(cut.path)[:, 0].tolist() == [*range(11)], "later rows are gone"
    for n in range(11, 20):
        cut.append([n, 0.1 * n])
    assert cut.path.read_bytes() == whole.path.read_bytes()
    assert len(cut) == len(whole)


@pytest.mark.parametrize("spoil", [
    lambda path: path.write_bytes(b"no table"),
    lambda path: path.write_bytes(path.read_bytes()[:-9]),
    lambda path: np.save(path, np.zeros((9, 3))),
    lambda path: path.unlink(),
], ids=["other file", "too short", "other columns", "gone"])  # fmt: skip
def test_another_file_is_refused(tmp_path, spoil):
    table = GrowingTable(2, tmp_path / "t.npy")
    for n in range(3):
        table.append([n, n])
    table.close()
    spoil(table.path)
    line = one_line(OutputError, lambda: GrowingTable(2, table.path, rows=3))
    assert "t.npy: " in line


def test_an_earlier_table_is_replaced_and_stays_with_who_reads_it(tmp_path):
    table = GrowingTable(1, tmp_path / "t.npy")
    table.append([1.0])
    before = loaded(table.path)
    table.close()
    again = GrowingTable(2, table.path)
    again.append([5.0, 6.0])
    assert before.tolist() == [[1.0]] and loaded(again.path).tolist() == [[5.0, 6.0]]


def test_whole_rows_whenever_it_is_killed(tmp_path, monkeypatch):
    """0, 1, 2, ...; each row of one value: after each piece that is written, and of half a row."""
    path, write, counts = tmp_path / "t.npy", table_module._write_at, []
    table = GrowingTable(1000, path)
    table.append(np.zeros(1000))

    def in_halves(number, data, at):
        done = write(number, data[: len(data) // 2] if len(data) > 1000 else data, at)
        rows = loaded(path)
        assert (rows == rows[:, :1]).all(), "a torn row"
        counts.append(len(rows))
        return done

    monkeypatch.setattr(table_module, "_write_at", in_halves)
    for n in range(1, 4):
        table.append(np.full(1000, float(n)))
    assert counts[0] == 1 and counts[-1] == 4
    np.testing.assert_array_equal(loaded(path)[:, 0], range(4))


FULL = """
import resource, signal, sys
from pathlib import Path
import numpy as np
from cosim.coupling.record import GrowingTable
from cosim.files import OutputError
table = GrowingTable(100, Path(sys.argv[1]))
resource.setrlimit(resource.RLIMIT_FSIZE, (10_000, 10_000))
try:
    for n in range(100):
        table.append(np.full(100, n))
except OutputError as error:
    print(error)
print(len(table), table.rows()[-1, 0])
"""


@pytest.mark.skipif(sys.platform == "win32", reason="needs a limit of the operating system")
def test_no_room_is_said_and_what_is_there_stays_readable(tmp_path):
    path = tmp_path / "t.npy"
    said, rows = python(FULL, path).splitlines()
    assert said == f"{path}: cannot be written: File too large"
    assert rows == "12 11.0"  # 128 bytes and 12 rows of 800 fit into 10000
    assert loaded(path).shape == (12, 100) and loaded(path)[-1, 0] == 11.0

"""Checkpoints: exact, whole or refused; the folder of a run that is not complete."""

import numpy as np
import pytest

from cosim.coupling.record import RunFolder
from cosim.coupling.record.folder import (
    Checkpoint,
    CheckpointError,
    load_checkpoint,
    save_checkpoint,
)
from cosim.files import OutputError, OutputRefused

EXAMPLE = Checkpoint(
    time=0.1 + 0.2,
    setup={"rig.mass": 0.67, "unit": "{1234}", "order": ["a", "b"]},
    master={"outputs": {"a": {"x": 1 / 3, "n": 3, "on": True}}, "past": [[0.1, None], []]},
    states={"a": bytes(range(256)) * 5, "b/../ü": b"", "c": b"c"},
    record={"rows": 6, "newest": [5e-324, -0.0, 1.7976931348623157e308]},
)


@pytest.fixture
def saved(tmp_path):
    return save_checkpoint(tmp_path / "checkpoint.zip", EXAMPLE)


def test_comes_back_as_it_was(saved):
    found = load_checkpoint(saved)
    assert found == EXAMPLE
    assert (
        np.array(found.record["newest"]).tobytes() == np.array(EXAMPLE.record["newest"]).tobytes()
    )
    assert type(found.master["outputs"]["a"]["n"]) is int
    assert type(found.master["outputs"]["a"]["on"]) is bool


def test_arrays_and_numbers_of_numpy_are_taken(tmp_path):
    master = {"matrix": np.arange(4.0).reshape(2, 2) / 3, "count": np.int64(3)}
    found = load_checkpoint(save_checkpoint(tmp_path / "c.zip", Checkpoint(0.0, master=master)))
    assert found.master["matrix"] == (np.arange(4.0).reshape(2, 2) / 3).tolist()
    assert found.master["count"] == 3


def test_any_damage_is_seen(saved):
    whole, random = saved.read_bytes(), np.random.default_rng(3)
    damaged = [whole[:size] for size in (0, 1, 63, 64, 65, len(whole) // 2, len(whole) - 1)]
    for _ in range(300):
        damaged.append(bytearray(whole))
        damaged[-1][random.integers(len(whole))] ^= 1 << int(random.integers(8))
    for content in damaged:
        saved.write_bytes(content)
        with pytest.raises(CheckpointError, match=r"checkpoint\.zip: is damaged"):
            load_checkpoint(saved)
    saved.write_bytes(whole)
    assert load_checkpoint(saved) == EXAMPLE


def test_another_format_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr("cosim.coupling.record.folder.FORMAT", 99)
    path = save_checkpoint(tmp_path / "c.zip", EXAMPLE)
    monkeypatch.undo()
    with pytest.raises(CheckpointError, match="format 99, this version goes on from format 3"):
        load_checkpoint(path)


def test_an_earlier_one_stays_until_the_next_is_whole(saved, monkeypatch, full_disk):
    monkeypatch.setattr("os.fsync", full_disk)
    with pytest.raises(OutputError, match="No space left on device"):
        save_checkpoint(saved, Checkpoint(9.0))
    assert load_checkpoint(saved) == EXAMPLE
    assert [entry.name for entry in saved.parent.iterdir()] == ["checkpoint.zip"]


ASKED = {"command": "run", "resume": "stickslip run --resume results"}


def test_a_folder_says_that_its_run_is_not_complete(tmp_path):
    folder = RunFolder.begun(tmp_path, ASKED, {"scenario.toml": "name = 'ü'\n"})
    said = (tmp_path / "unfinished" / "README.txt").read_text()
    assert "not complete" in said and "stickslip run --resume results" in said
    assert folder.asked == ASKED
    assert (folder.path / "scenario.toml").read_text(encoding="utf-8") == "name = 'ü'\n"
    folder.finished()
    assert list(tmp_path.iterdir()) == []


def test_what_was_cut_off_is_found_again(tmp_path):
    folder = RunFolder.begun(tmp_path, ASKED, {})
    save_checkpoint(folder.checkpoint, EXAMPLE)
    (folder.path / ".checkpoint.zip.1234.partial").write_text("cut off in the middle")
    folder.release()
    again = RunFolder.found(tmp_path)
    assert again.asked == ASKED and load_checkpoint(again.checkpoint) == EXAMPLE
    assert not list(again.path.glob(".*"))


def test_what_there_is_not_to_go_on_from_is_one_line(tmp_path):
    with pytest.raises(CheckpointError, match="no such folder"):
        RunFolder.found(tmp_path / "none")
    with pytest.raises(CheckpointError, match="holds no unfinished run: it is complete"):
        RunFolder.found(tmp_path)
    RunFolder.begun(tmp_path, ASKED, {}).release()
    with pytest.raises(CheckpointError, match="no checkpoint yet"):
        RunFolder.found(tmp_path)
    (tmp_path / "unfinished" / "run.json").write_text("{")
    with pytest.raises(CheckpointError, match=r"run\.json: cannot be read"):
        _ = RunFolder(tmp_path).asked


def test_a_new_run_clears_what_an_earlier_one_left_and_nothing_else(tmp_path):
    folder = RunFolder.begun(tmp_path, ASKED, {})
    save_checkpoint(folder.checkpoint, EXAMPLE)
    folder.release()
    with pytest.raises(OutputRefused, match=r"allowed is to go on with it: .*; or --force"):
        RunFolder.begun(tmp_path, ASKED, {})
    assert folder.checkpoint.exists()
    folder = RunFolder.begun(tmp_path, ASKED, {}, force=True)
    assert not folder.checkpoint.exists()
    folder.finished()
    own = tmp_path / "unfinished" / "thesis.docx"
    own.parent.mkdir()
    own.write_text("my own")
    with pytest.raises(OutputRefused, match="holds files that are not of a run"):
        RunFolder.begun(tmp_path, ASKED, {})
    assert own.read_text() == "my own"

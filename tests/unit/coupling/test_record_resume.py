"""A run that is cut off and resumed is the run that was not, to the last bit."""

import json
import os
import pickle
import shutil
import signal
from dataclasses import asdict

import numpy as np
import pytest
from linear_participant import Linear

from cosim.coupling import Connection, CoupledSystem, GaussSeidel, Jacobi, Tolerance, run
from cosim.coupling.record import Keep, RunFolder
from cosim.coupling.record.folder import CheckpointError, load_checkpoint
from cosim.coupling.schemes import Aitken, Iterated, QuasiNewton
from cosim.coupling.step_control.adaptive import AdaptiveStep, Defect, Doubling
from cosim.files import OutputError

ASKED = {"resume": "stickslip run --resume DIR"}
ORDER = ("left", "right", "spring")


class Saved(Linear):
    def save_state(self):
        return pickle.dumps(self.get_state())

    def load_state(self, saved):
        self.set_state(pickle.loads(saved))


class Spring(Linear):
    """Turns two pendulums towards each other."""

    save_state, load_state = Saved.save_state, Saved.load_state


def pendulums():
    """Two of them and the spring; fresh, as another process would have them."""
    swings = {"ins": {"torque": "N.m"}, "outs": {"angle": "rad", "rate": "rad/s"}}
    pair = [
        Saved(name, [[0.0, 1.0], [-1.0, -0.1]], [[0.0], [1.0]], np.eye(2), **swings, x=[angle, 0.0])
        for name, angle in (("left", 1.0), ("right", -0.3))
    ]
    none, pull = np.zeros((1, 2)), [[-2.0, 2.0], [2.0, -2.0]]
    ports = {"ins": {"left": "rad", "right": "rad"}, "outs": {"on_left": "N.m", "on_right": "N.m"}}
    spring = Spring("spring", [[0.0]], none, none.T, pull, **ports, x=[0.0])
    links = [
        *(Connection(f"{name}.angle", f"spring.{name}") for name in ("left", "right")),
        *(Connection(f"spring.on_{name}", f"{name}.torque") for name in ("left", "right")),
    ]
    return CoupledSystem([*pair, spring], links)


@pytest.fixture(autouse=True)
def no_waiting_for_the_disk(monkeypatch):
    """What it is for, a power cut, is not what is tried here; a busy disk takes long over it."""
    monkeypatch.setattr("os.fsync", lambda file: None)


class CutOff(BaseException):
    """As much as a kill is within one process: nobody is told."""


def cut_off_after(steps):
    done = iter(range(steps))

    def progress(_):
        if next(done, None) is None:
            raise CutOff

    return progress


def adaptive(estimate):
    return AdaptiveStep(estimate(Tolerance(1e-4)), first=0.01, smallest=2e-3, largest=0.5)


def iterated(acceleration):
    return Iterated(ORDER, acceleration=acceleration)


#: What is remembered from step to step: nothing, points, differences, sizes.
HOW = {
    "held": lambda: {"scheme": GaussSeidel(ORDER), "macro_step": 0.03},
    "linear": lambda: {"scheme": Jacobi(ORDER, "linear"), "macro_step": 0.03},
    "quadratic": lambda: {"scheme": GaussSeidel(ORDER, "quadratic"), "macro_step": 0.03},
    "Aitken": lambda: {"scheme": iterated(Aitken()), "macro_step": 0.1},
    "quasi-Newton": lambda: {"scheme": iterated(QuasiNewton()), "macro_step": 0.1},
    "doubling": lambda: {"scheme": GaussSeidel(ORDER, "linear"), "control": adaptive(Doubling)},
    "defect": lambda: {"scheme": iterated(QuasiNewton(0.5)), "control": adaptive(Defect)},
}
#: Known events fall on steps of the grid and between them.
SPAN = {"stop": 4.0, "events": (0.65, 1.25, 3.0), "record_every": 3}


def go(how, keep=None, progress=None, **further):
    return run(pendulums(), **(HOW[how]() | SPAN | further), keep=keep, progress=progress)


def kept(folder, **further):
    return Keep(folder, **({"seconds": 0.0, "steps": 7} | further))


def same(found, expected):
    assert found.status == expected.status == "complete"
    np.testing.assert_array_equal(found.time, expected.time)
    assert list(found.values) == list(expected.values)
    for name, values in expected.values.items():
        np.testing.assert_array_equal(found[name], values)
    assert found.steps == expected.steps
    assert counts(found.statistics) == counts(expected.statistics)


def counts(statistics):
    """All but the seconds."""
    found = asdict(statistics)
    for effort in found["participants"].values():
        del effort["seconds"]
    return found


@pytest.mark.parametrize("how", HOW)
def test_goes_on_as_if_it_had_never_been_cut_off(tmp_path, how):
    whole = go(how)
    folder = RunFolder.begun(tmp_path, ASKED, {})
    random = np.random.default_rng(11)
    for _ in range(3):  # cut off again and again, each time further on
        with pytest.raises(CutOff):
            go(how, kept(folder), cut_off_after(int(random.integers(8, 12))))
        folder.release()
        folder = RunFolder.found(tmp_path)
    same(go(how, kept(folder)), whole)
    np.testing.assert_array_equal(np.load(folder.record)[:, 0], whole.time)


def test_goes_on_from_any_step(tmp_path):
    """Whatever row or event comes next; behind the last one nothing does."""
    whole = go("quadratic", stop=0.75)
    for steps in range(whole.steps):
        folder = RunFolder.begun(tmp_path, ASKED, {}, force=True)
        with pytest.raises(CutOff):
            go("quadratic", kept(folder, steps=1), cut_off_after(steps), stop=0.75)
        folder.release()
        same(go("quadratic", kept(RunFolder.found(tmp_path)), stop=0.75), whole)


def test_every_row_is_on_disk_at_once(tmp_path):
    folder = RunFolder.begun(tmp_path, ASKED, {})
    rows = []

    def look(reached):
        table = np.load(folder.record, mmap_mode="r")
        rows.append(table[-1, 0])
        assert rows[-1] == reached

    result = go("held", Keep(folder), look, record_every=1, events=())
    np.testing.assert_array_equal(rows, result.time[1:])
    content = json.loads(folder.columns.read_text(encoding="utf-8"))
    columns = {column["name"]: column["unit"] for column in content["columns"]}
    assert list(columns) == ["time", *result.values]
    assert columns["spring.on_left"] == "N.m"
    np.testing.assert_array_equal(np.load(folder.record)[:, 1:].T, list(result.values.values()))


def test_ctrl_c_leaves_a_checkpoint_of_the_last_step(tmp_path):
    folder = RunFolder.begun(tmp_path, ASKED, {})

    def interrupt(reached):
        if reached > 2.0:
            os.kill(os.getpid(), signal.SIGINT)

    cut = go("linear", Keep(folder), interrupt)
    assert cut.status == "interrupted"
    assert load_checkpoint(folder.checkpoint).time == cut.time[-1] > 2.0
    same(go("linear", Keep(folder)), go("linear"))


def test_wall_time_decides_too(tmp_path):
    folder = RunFolder.begun(tmp_path, ASKED, {})
    times = []

    def look(_):
        if folder.checkpoint.exists():
            times.append(load_checkpoint(folder.checkpoint).time)

    go("held", kept(folder, steps=0, seconds=1e-9), look)
    assert len(times) == len(set(times)) > 100, "after each step"
    folder = RunFolder.begun(tmp_path, ASKED, {}, force=True)
    go("held", Keep(folder, seconds=3600.0))
    go("held", Keep(RunFolder.begun(tmp_path, ASKED, {}), seconds=0.0, steps=0))
    assert not folder.checkpoint.exists()


def begun_and_cut_off(tmp_path, **further):
    folder = RunFolder.begun(tmp_path, ASKED, {})
    with pytest.raises(CutOff):
        go("linear", kept(folder, **further), cut_off_after(20))
    return folder


@pytest.mark.parametrize(("changes", "said"), [
    ({"stop": 5.0}, "goals: was"),
    ({"record_every": 2}, "record_every: was 3, is 2"),
    ({"events": ()}, "goals: was"),
    ({"scheme": Jacobi(ORDER)}, "scheme: was"),
    ({"macro_step": 0.02}, "control: was"),
], ids=str)  # fmt: skip
def test_another_run_is_refused(tmp_path, changes, said):
    folder = begun_and_cut_off(tmp_path)
    with pytest.raises(CheckpointError, match=said):
        go("linear", kept(folder), **changes)


def test_a_state_that_a_participant_refuses_is_one_line(tmp_path, monkeypatch):
    folder = begun_and_cut_off(tmp_path)

    def refuse(self, saved):
        raise ValueError("of another mesh")

    monkeypatch.setattr(Spring, "load_state", refuse)
    with pytest.raises(CheckpointError, match="spring does not go on from it: of another mesh"):
        go("linear", kept(folder))


def test_who_cannot_be_saved_is_named_and_the_run_goes_on(tmp_path, monkeypatch):
    monkeypatch.delattr(Spring, "save_state")
    folder = RunFolder.begun(tmp_path, ASKED, {})
    with pytest.warns(UserWarning, match="no checkpoints: spring cannot be saved"):
        result = go("held", kept(folder))
    assert result.status == "complete" and not folder.checkpoint.exists()
    np.testing.assert_array_equal(np.load(folder.record)[:, 0], result.time)


def test_a_checkpoint_that_the_disk_refuses_is_said_and_the_run_goes_on(tmp_path, monkeypatch):
    def refuse(*_):
        raise OutputError("checkpoint.zip: cannot be written: No space left on device")

    monkeypatch.setattr("cosim.coupling.record.keeper.save_checkpoint", refuse)
    with pytest.warns(UserWarning, match="no checkpoint: .*No space left on device; the run goes"):
        result = go("held", kept(RunFolder.begun(tmp_path, ASKED, {})))
    same(result, go("held"))


def test_a_folder_that_is_removed_ends_the_run_with_all_that_it_had(tmp_path):
    folder = RunFolder.begun(tmp_path, ASKED, {})

    def remove(reached):
        if reached > 2.0:
            shutil.rmtree(folder.path, ignore_errors=True)

    result = go("held", kept(folder), remove)
    assert result.status == "failed" and "removed while it was written" in result.reason
    assert result.time[-1] > 2.0
    whole = go("held")
    kept_rows = len(result.time) - 1  # the last may be one that is thinned out later
    np.testing.assert_array_equal(result.time[:kept_rows], whole.time[:kept_rows])

"""Sweeps: the product of the varied keys, what is kept, what is run again, what is refused."""

import json
import signal
import subprocess
from collections import Counter

import numpy as np
import pytest
import xarray as xr
from stickslip import Friction, Parameters, Rig, Surface, simulate
from stickslip.catalogue import CATALOGUE

from cosim.report import trajectory_columns
from cosim.studies.sweep import SweepError, SweepStopped, features, product_grid, sweep
from cosim.studies.sweep import combination as combination_module
from cosim.studies.sweep import run as run_module
from cosim.studies.sweep import workers as workers_module

BASE = Parameters(rig=Rig(degrees_of_freedom=("x",)), surface=Surface(run_up_time=0.5))
SHORT = {"duration": 2.0, "output_interval": 0.02, "jobs": 1}
VARY = {"rig.mass": [0.5, 0.7, 0.9], "surface.speed": [0.1, 0.2]}


@pytest.fixture
def computed(monkeypatch):
    """Counts the rows that are computed."""
    counts = Counter()
    compute = combination_module.compute

    def counting(work, key, changes):
        counts[key] += 1
        return compute(work, key, changes)

    monkeypatch.setattr(combination_module, "compute", counting)
    return counts


def test_the_varied_keys_are_the_dimensions():
    done = sweep(BASE, VARY, **SHORT)
    assert dict(done.sizes) == {"rig.mass": 3, "surface.speed": 2}
    assert done["rig.mass"].attrs == {"units": "kg", "long_name": "mass of the block"}
    assert done.attrs["status"] == "complete"
    for name in done.variables:
        assert done[name].attrs["units"] and done[name].attrs["long_name"]
    one = combination_module.with_changes(BASE, {"rig.mass": 0.9, "surface.speed": 0.1})
    alone = features(trajectory_columns(simulate(one, 2.0, 0.02), one, ""))
    here = done.sel({"rig.mass": 0.9, "surface.speed": 0.1})
    for name, value in alone.items():
        assert here[name].item() == pytest.approx(value, abs=0.0, rel=0.0, nan_ok=True)


def test_linked_keys_share_a_dimension():
    pairs = [(0.28, 0.21), (0.1, 0.05)]
    done = sweep(BASE, {("friction.mu_s", "friction.mu_k"): pairs}, **SHORT)
    name = "friction.mu_s+friction.mu_k"
    assert done["x_mean"].dims == (name,)
    assert done["friction.mu_k"].dims == (name,)
    assert list(done["friction.mu_k"].values) == [0.21, 0.05]
    assert list(done[name].values) == ["0.28:0.21", "0.1:0.05"]
    assert done["x_mean"].values[0] > done["x_mean"].values[1]


def test_words_and_lists_are_varied_too(tmp_path):
    vary = {"rig.inertia": ["disc", 1e-3], "rig.degrees_of_freedom": [("x",), ["x", "phi"]]}
    done = sweep(BASE, vary, **SHORT)
    assert list(done["rig.inertia"].values) == ["disc", "0.001"]
    assert list(done["rig.degrees_of_freedom"].values) == ["x", "x phi"]
    done.to_netcdf(tmp_path / "a.nc", engine="h5netcdf")
    assert xr.open_dataset(tmp_path / "a.nc").x_mean.equals(done.x_mean)


def test_processes_give_the_same_numbers(monkeypatch):
    monkeypatch.setattr(workers_module, "NOT_WORTH_PROCESSES", 0)
    alone = sweep(BASE, VARY, **SHORT)
    shared = sweep(BASE, VARY, **SHORT | {"jobs": 2})
    assert alone.drop_attrs().identical(shared.drop_attrs())


def test_what_changed_is_computed_and_nothing_else(tmp_path, computed, monkeypatch):
    first = sweep(BASE, VARY, **SHORT, folder=tmp_path)
    again = sweep(BASE, VARY, **SHORT, folder=tmp_path)
    assert first.drop_attrs().identical(again.drop_attrs())
    assert set(computed.values()) == {1} and len(computed) == 6
    more = {"rig.mass": [0.5, 0.7, 0.9, 1.1], "surface.speed": [0.1, 0.2]}
    sweep(BASE, more, **SHORT, folder=tmp_path)
    assert len(computed) == 8
    other = BASE.model_copy(update={"friction": Friction(mu_s=0.3)})
    sweep(other, VARY, **SHORT, folder=tmp_path)
    assert len(computed) == 14
    sweep(BASE, VARY, **SHORT | {"duration": 3.0}, folder=tmp_path)
    assert len(computed) == 20
    for module in (combination_module, run_module):
        monkeypatch.setattr(module, "model_version", lambda catalogue: "0" * 32)
    sweep(BASE, VARY, **SHORT, folder=tmp_path)
    assert len(computed) == 26, "another version of the model"


@pytest.mark.parametrize("counts", [True, False])
def test_an_edited_term_is_another_version_and_a_comment_is_not(monkeypatch, counts):
    """Also one that enters when parameters are packed, before the motion begins."""
    version = combination_module.model_version.__wrapped__
    before, term = version(), "(normal_force / reference_force) ** (-exponent)"
    source = CATALOGUE.text
    assert term in source
    edited = source.replace(term, f"2.0 * {term}") if counts else f"{source}# words"
    monkeypatch.setitem(vars(CATALOGUE), "text", edited)
    assert (version() != before) is counts


def test_a_worker_with_another_model_is_refused(monkeypatch):
    monkeypatch.setattr(combination_module, "model_version", lambda catalogue: "0" * 32)
    with pytest.raises(SweepStopped, match="has another version of the model"):
        sweep(BASE, VARY, **SHORT)


def test_a_sweep_stopped_in_the_middle_goes_on(tmp_path, computed, monkeypatch):
    monkeypatch.setattr(workers_module, "CHUNK_TIME", 0.0)

    def stop(done, total):
        if done == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sweep(BASE, VARY, **SHORT, folder=tmp_path, progress=stop)
    assert len(computed) == 3
    seen = []
    done = sweep(BASE, VARY, **SHORT, folder=tmp_path, progress=lambda *now: seen.append(now))
    assert set(computed.values()) == {1} and len(computed) == 6
    assert seen[0] == (3, 6) and seen[-1] == (6, 6)
    assert (done.status == 0).all()


def test_a_damaged_chunk_is_run_again(tmp_path, computed):
    sweep(BASE, VARY, **SHORT, folder=tmp_path)
    damaged = sorted(tmp_path.glob("chunks/*/*.json"))[0]
    lost = len(json.loads(damaged.read_text()))
    damaged.write_text(damaged.read_text()[:40])
    with pytest.warns(UserWarning, match="damaged .* are run again"):
        done = sweep(BASE, VARY, **SHORT, folder=tmp_path)
    assert sum(computed.values()) == 6 + lost
    assert (done.status == 0).all()


def test_a_killed_process_of_the_pool_is_replaced(tmp_path, monkeypatch):
    monkeypatch.setattr(workers_module, "NOT_WORTH_PROCESSES", 0)
    monkeypatch.setattr(workers_module, "CHUNK_TIME", 0.05)
    started, start = [], subprocess.Popen

    def noted(*call, **more):
        started.append(start(*call, **more))
        return started[-1]

    def kill(done, total):
        if done > 10:
            started[0].kill()

    monkeypatch.setattr(subprocess, "Popen", noted)
    vary = {"rig.mass": np.linspace(0.3, 2.0, 60)}
    done = sweep(BASE, vary, duration=10.0, jobs=2, folder=tmp_path, progress=kill)
    assert started[0].returncode == -signal.SIGKILL and (done.status == 0).all()


def test_failures_are_recorded_and_end_nothing(tmp_path, computed):
    """Friction that carries the block into the anchor of a spring, beside one that does not."""
    vary = {("friction.mu_s", "friction.mu_k"): [(0.28, 0.21), (9.0, 9.0)]}
    done = sweep(BASE, vary, **SHORT | {"duration": 6.0}, folder=tmp_path)
    assert list(done.status.values) == [0, 1]
    assert "the run ended at t = " in done.reason.values[1] and done.reason.values[0] == ""
    assert np.isnan(done.x_mean.values[1]) and done.attrs["status"].startswith("1 of 2")
    sweep(BASE, vary, **SHORT | {"duration": 6.0}, folder=tmp_path)
    assert set(computed.values()) == {1}, "the model would give up again"


def test_errors_of_the_program_are_recorded_and_tried_again(tmp_path, monkeypatch):
    def broken(parameters, *run, **options):
        if parameters.rig.mass == 0.7:
            raise MemoryError("no room")
        return simulate(parameters, *run, **options)

    monkeypatch.setattr(combination_module, "simulate", broken)
    done = sweep(BASE, VARY, **SHORT, folder=tmp_path)
    assert list(done.status.sel({"rig.mass": 0.7}).values) == [2, 2]
    assert (done.status == 2).sum() == 2
    assert set(done.reason.sel({"rig.mass": 0.7}).values) == {"MemoryError: no room"}
    monkeypatch.setattr(combination_module, "simulate", simulate)
    assert (sweep(BASE, VARY, **SHORT, folder=tmp_path).status == 0).all()


@pytest.mark.parametrize("vary, line", [
    ({}, "nothing is varied"),
    ({"rig.mas": [1.0]}, "rig.mas: no such key of a scenario, nearest: rig.mass"),
    ({"ambient.temperature_degC": [1.0]}, "is no key of the mechanics, allowed with a "),
    ({"rig.mass": []}, "rig.mass: no values, allowed is at least one"),
    ({"rig.mass": 1.0}, r"rig.mass: not a list \(1.0\)"),
    ({"rig.mass": [1.0, 1]}, "rig.mass: 1 is there twice"),
    ({"rig.mass": [1.0, "heavy"]}, r'rig.mass: not a number \("heavy"\), allowed is a number'),
    ({"rig.mass": [1.0, -2.0]}, r"rig.mass: out of range \(-2.0\), allowed .* greater than 0"),
    ({"rig.mass": [1.0], ("rig.mass", "surface.speed"): [(2.0, 1.0)]}, "rig.mass: varied"),
    ({("rig.mass", "rig.mass"): [(1.0, 1.0)]}, "links a key with itself"),
    ({("rig.mass", "surface.speed"): [(1.0,)]}, "not one value for each linked key"),
    ({"rig.surface": ["slab"], "rig.slab_radius": [0.5, 0.01]}, "rig.slab_radius: 0.01 m puts"),
    ({"rig.mass": np.arange(1, 2001), "surface.speed": np.arange(2000)}, "^4000000 combi"),
])  # fmt: skip
def test_bad_input_is_refused_in_one_line_before_anything_runs(tmp_path, computed, vary, line):
    with pytest.raises(SweepError, match=line) as refusal:
        sweep(BASE, vary, **SHORT, folder=tmp_path / "none")
    assert "\n" not in str(refusal.value)
    assert not computed and not (tmp_path / "none").exists()


@pytest.mark.parametrize("case", [{"duration": 0.0}, {"output_interval": np.nan}, {"jobs": 0}])
def test_a_run_that_cannot_be_is_refused(case):
    with pytest.raises(SweepError, match=f"^{next(iter(case))}: out of range"):
        sweep(BASE, VARY, **SHORT | case)


def test_equal_combinations_run_once(computed):
    """A slab's radius does not matter on a belt, but the parameters differ: two runs."""
    grid = product_grid(BASE, {"rig.mass": [0.5, 0.6]})
    run = combination_module.Run(1.0, 0.1)
    twice = run_module.run_grid(type(grid)(grid.base, grid.axes, run, lambda settings: {}), jobs=1)
    assert sum(computed.values()) == 1
    assert twice.x_mean.values[0] == twice.x_mean.values[1]

"""A run as dataset and files: units everywhere, and every number comes back as it was."""

import errno
import json
import os
from dataclasses import replace
from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from stickslip import Trajectory, simulate
from stickslip.ports import OUTPUTS

from cosim.coupling import Connection, CoupledResult, EnergyFlow, Ledger
from cosim.coupling.exchange import Effort, Statistics
from cosim.report import OutputError, run_columns, trajectory_columns, write_data
from cosim.report.contents import mechanics_of, thermal_of
from cosim.report.dataset import THERMAL
from cosim.report.files import write_netcdf
from cosim.scenario import Scenario
from thermal import BeltIceModel


@cache
def scenario(surface: str = "belt") -> Scenario:
    """Five seconds with a short speed ramp: a dozen stick-slip cycles on a coarse belt."""
    tables = dict(
        name="short", rig={"surface": surface}, lateral_friction={"ratio": 1.0},
        surface={"speed": 0.08, "run_up_time": 1.0}, run={"duration": 6.0},
        belt={"cell_length": 5e-3},
    )  # fmt: skip
    return Scenario.from_tables(tables)


@cache
def trajectory(surface: str = "belt") -> Trajectory:
    run = scenario(surface).run
    return simulate(scenario(surface).mechanics, run.duration, run.output_interval)


@cache
def coupled(surface: str = "belt") -> tuple[CoupledResult, SimpleNamespace]:
    """What a master returns for that run, heat to belt and ice, and pictures of the belt."""
    run, model = trajectory(surface), BeltIceModel(scenario(surface).thermal)
    way = run["surface_travel"] - run["x"]
    rows, pictures = [model.outputs()], [(0.0, model.belt_profile()[1], model.contact_position)]
    for i in range(1, run.time.size):
        step = run.time[i] - run.time[i - 1]
        model.step(step, run["heat"][i] - run["heat"][i - 1], way[i] - way[i - 1])
        rows.append(model.outputs())
        if i % 50 == 0:
            pictures.append((run.time[i], model.belt_profile()[1], model.contact_position))
    mechanical = {port.name: (port.unit or "1", run[port.name]) for port in OUTPUTS}
    thermal = {n: (u, np.array([row[n] for row in rows])) for n, (u, _) in THERMAL.items()}
    ports = {f"mechanics.{name}": port for name, port in mechanical.items()}
    # the master records inputs too; this one is what the step was made with, one step behind
    stale = np.roll(thermal["interface_temperature"][1], 1)
    ports["mechanics.interface_temperature"] = ("degC", stale)
    ports |= {f"thermal.{name}": port for name, port in thermal.items()}
    ports["thermal.x"] = ("m", np.roll(run["x"], 1))
    connection = Connection("mechanics.heat", "thermal.heat", taken="heat_received")
    ledger = Ledger(
        (EnergyFlow(connection, run["heat"], thermal["heat_received"][1]),),
        {"thermal.heat_residual": thermal["heat_residual"][1]},
    )
    units, values = ({n: port[i] for n, port in ports.items()} for i in (0, 1))
    steps = run.time.size - 1
    ended = ("complete", "", None, 1.5, 2, steps, statistics(steps))
    pictured = dict(
        zip(("time", "temperature", "contact"), zip(*pictures, strict=True), strict=True)
    )
    pictured |= {"position": model.belt_profile()[0], "contact_length": model.footprint.length}
    return CoupledResult(run.time, values, units, ledger, *ended), SimpleNamespace(**pictured)


def statistics(steps: int) -> Statistics:
    """As of steps that were iterated twice each and, one of them, a third time."""
    efforts = {"mechanics": Effort(steps, 0.25 * steps), "thermal": Effort(steps, 0.5 * steps)}
    made = Statistics(efforts, iterations=2 * steps + 3, most_iterations=3, rejected=1)
    made.unconverged.append(0.5)
    return made


def coupled_dataset(surface: str = "belt") -> xr.Dataset:
    result, pictures = coupled(surface)
    case = scenario(surface)
    return run_columns(result, case, case.to_toml(), snapshots=pictures).to_xarray()


def mechanics_dataset(surface: str = "belt") -> xr.Dataset:
    case = scenario(surface)
    return trajectory_columns(trajectory(surface), case, case.to_toml(), wall_time=0.25).to_xarray()


BOTH = pytest.mark.parametrize("make", [coupled_dataset, mechanics_dataset])


@BOTH
def test_every_variable_has_unit_and_description(make):
    dataset = make()
    for name, variable in dataset.variables.items():
        assert variable.attrs["units"], name
        assert variable.attrs["long_name"], name
    assert dataset["phi"].attrs["units"] == "rad"


def test_coupled_run_holds_what_the_contract_names():
    dataset = coupled_dataset()
    assert {port.name for port in OUTPUTS} | set(THERMAL) <= set(dataset.data_vars)
    assert dataset["belt_temperature"].dims == ("snapshot_time", "belt_position")
    assert dataset.attrs["status"] == "complete"
    assert dataset.attrs["scenario"] == scenario().to_toml()


def test_outputs_are_taken_and_not_the_inputs_of_the_same_name():
    result, _ = coupled()
    dataset = coupled_dataset()
    np.testing.assert_array_equal(
        dataset["interface_temperature"], result["thermal.interface_temperature"]
    )
    np.testing.assert_array_equal(dataset["x"], result["mechanics.x"])


@pytest.mark.parametrize("surface", ["belt", "slab"])
def test_parameters_come_back_from_the_dataset(surface):
    case = scenario(surface)
    dataset = coupled_dataset(surface)
    assert mechanics_of(dataset).flat() == case.mechanics.flat()
    assert thermal_of(dataset).model_dump() == case.thermal.model_dump()
    stored = json.loads(dataset.attrs["parameters"])
    assert stored["springs"]["stiffness"]["unit"] == "N/m"


def test_mechanics_alone_does_not_list_the_tables_of_the_heat():
    stored = json.loads(mechanics_dataset().attrs["parameters"])
    assert "run" in stored and "rig" in stored
    assert not {"belt", "ice", "coupling"} & set(stored)


@BOTH
def test_netcdf_round_trip_is_exact(make, tmp_path):
    dataset = make()
    write_data(dataset, tmp_path)
    with xr.open_dataset(tmp_path / "result.nc", engine="h5netcdf") as back:
        xr.testing.assert_identical(back.load(), dataset)


@pytest.mark.parametrize(("reason", "status"), [
    ("", "complete"),
    ("stopped: KeyboardInterrupt", "interrupted"),
    ("the integrator gave up at t = 1 s", "failed"),
])  # fmt: skip
def test_status_of_a_trajectory(reason, status):
    dataset = trajectory_columns(replace(trajectory(), reason=reason), scenario(), "").to_xarray()
    assert dataset.attrs["status"] == status
    assert bool(dataset.attrs["reason"]) == (status != "complete")


def test_failed_write_leaves_the_earlier_file_and_no_scraps(tmp_path, monkeypatch, full_disk):
    dataset = mechanics_dataset()
    write_data(dataset, tmp_path)
    before = (tmp_path / "result.csv").read_bytes()

    monkeypatch.setattr("cosim.report.columns.csv.writer", full_disk)
    with pytest.raises(OutputError, match="No space left"):
        write_data(dataset, tmp_path)
    assert (tmp_path / "result.csv").read_bytes() == before
    assert {path.name for path in tmp_path.iterdir()} == {"result.nc", "result.csv"}


@pytest.mark.skipif(not hasattr(os, "posix_fallocate"), reason="no way to ask for room there")
def test_no_room_for_a_dataset_is_said_before_hdf5_meets_it(tmp_path, monkeypatch):
    """HDF5 on a disk that fills up writes dozens of tracebacks and takes the process with it."""
    asked = []

    def refuse(file, start, size):
        asked.append(size)
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("os.posix_fallocate", refuse)
    dataset = xr.Dataset({"x": ("time", np.zeros(100_000))})
    with pytest.raises(OutputError, match=r"result\.nc: cannot be .*: No space left"):
        write_netcdf(dataset, tmp_path / "result.nc")
    assert asked[0] > 800_000 and list(tmp_path.iterdir()) == []

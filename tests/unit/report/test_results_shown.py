"""Results in a notebook: a line that says what they are, datasets with units, figures."""

import json

import numpy as np
import pytest
import xarray as xr
from lag_unit import RAMP, lag_unit
from stickslip import Parameters

from cosim import read_scenario, read_system, run_scenario, run_system, simulate_scenario
from cosim.report.dataset import MECHANICAL

SHORT = {"run.duration": 1.0, "belt.length": 0.5}


@pytest.fixture(scope="module")
def coupled():
    return run_scenario(read_scenario("reference").changed(SHORT))


@pytest.fixture(scope="module")
def simulated():
    return simulate_scenario(read_scenario("reference").changed({"run.duration": 4.0}))


def test_they_say_what_they_are_in_one_line(coupled, simulated, gap):
    assert repr(coupled) == "<CoupledRun of reference, complete: 1 s in 100 steps>"
    assert repr(coupled.result).startswith("<CoupledResult, complete: 1 s in 100 macro steps, 101 ")
    assert repr(simulated).startswith("<SimulatedRun of reference: <Trajectory of 4 s, 401 rows: ")
    assert repr(gap).startswith("<Gap of cold room, week 3: named velocity_weakening; fit ")
    assert all(len(repr(one)) < 120 for one in (coupled, coupled.result, simulated, gap))


def test_a_trajectory_as_a_dataset_has_all_of_it(simulated):
    run = simulated.trajectory
    data = run.to_xarray()
    for name, (unit, words) in MECHANICAL.items():
        np.testing.assert_array_equal(data[name], run[name])
        assert (data[name].attrs["units"], data[name].attrs["long_name"]) == (unit, words)
    np.testing.assert_array_equal(data["event_time"], run.events[:, 0])
    np.testing.assert_array_equal(data["event_mode"], run.events[:, 1])
    assert data.sizes["time"] == run.time.size
    assert Parameters.model_validate_json(data.attrs["parameters"]) == run.parameters


def test_an_answer_as_a_dataset_has_runs_models_and_numbers(gap, tmp_path):
    data = gap.to_xarray()
    assert data.sizes["sample"] == sum(run.motion.time.size for run in gap.campaign.runs)
    for place, run in enumerate(gap.campaign.runs):
        rows = data.isel(sample=data["number"].values == place)
        fitted = gap.extended.run(run.name)
        np.testing.assert_array_equal(rows["x"], run.motion.x)
        left = rows["x_left_extended"]
        assert np.isnan(left[: fitted.begin]).all()  # what had been before, nobody knows
        there = np.isfinite(left)
        np.testing.assert_array_equal(left[there], fitted.residuals)
        cut = np.isnan(rows["x_extended"])  # where the model sets out anew, or is not compared
        assert 0 <= cut.sum() - fitted.window[-1] <= np.sum(~there[fitted.begin :])
        np.testing.assert_array_equal(rows["x_extended"][~cut], fitted.track[~cut, 0])
        assert float(data["gap_extended"][place]) == fitted.gap
    assert data["x"].attrs["units"] == "m" and data["x_left_plain"].attrs["units"] == "1"
    assert json.loads(data.attrs["gap"])["verdict"] == "named" == data.attrs["verdict"]
    data.to_netcdf(tmp_path / "gap.nc", engine="h5netcdf")
    with xr.open_dataset(tmp_path / "gap.nc") as read:
        assert read.sizes == data.sizes


@pytest.fixture(scope="module")
def system(tmp_path_factory):
    folder = tmp_path_factory.mktemp("system")
    lag_unit(folder / "lag.fmu")
    (folder / "system.toml").write_text(RAMP.format(more=""), encoding="utf-8")
    with read_system(folder / "system.toml") as specification:
        return run_system(specification)


def test_a_system_s_run_shows_itself(system):
    data = system.to_xarray()
    np.testing.assert_array_equal(data["lag.y"], system.result["lag.y"])
    assert data["lag.u"].attrs["fed_by"] == "ramp.y" and data.sizes["step_time"] == 10
    for name in ("signals", "system", "steps"):
        assert system.plot(name)._repr_png_().startswith(b"\x89PNG")
    with pytest.raises(ValueError, match="no figure of this run is named 'energy'"):
        system.plot("energy")

"""Columns as files: what xarray and pandas write of the same, without them."""

import subprocess
import sys

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from cosim.report.columns import Column, Columns, write_columns, write_columns_as_csv
from cosim.report.files import write_netcdf, write_table

COLUMNS = Columns(
    {"a.x": Column(("time",), np.array([1.0, np.nan, 1e-300]), {"units": "m", "si_factor": 1.5}),
     "=a": Column(("time",), np.array([1, 2, 3]), {"units": "1"}),
     "size": Column(("step_time",), np.array([0.1, 0.2]), {"units": "s"})},
    {"time": Column(("time",), np.array([0.0, 0.1, 1.0 / 3.0]), {"units": "s"}),
     "step_time": Column(("step_time",), np.array([0.1, 0.3]))},
    {"title": "made", "reason": "", "unconverged_steps": 2, "wall_time": 0.25},
)  # fmt: skip


def test_netcdf_is_what_xarray_reads_as_the_same(tmp_path):
    dataset = COLUMNS.to_xarray()
    ours, theirs = write_columns(COLUMNS, tmp_path / "a.nc"), tmp_path / "b.nc"
    write_netcdf(dataset, theirs)
    for path in (ours, theirs):
        with xr.open_dataset(path, engine="h5netcdf") as read:
            assert read.load().identical(dataset)
            assert np.isnan(read["a.x"].encoding["_FillValue"])


def test_csv_is_that_of_pandas(tmp_path):
    dataset = COLUMNS.to_xarray()
    table = dataset[[name for name in dataset if dataset[name].dims == ("time",)]].to_dataframe()
    ours = write_columns_as_csv(COLUMNS, "time", tmp_path / "a.csv")
    assert ours.read_bytes() == write_table(table, tmp_path / "b.csv").read_bytes()
    assert list(pd.read_csv(ours)) == ["time", "a.x", "'=a"]


def test_without_rows_there_are_files_all_the_same(tmp_path):
    none = {name: Column(("time",), np.empty(0)) for name in ("time", "x")}
    columns = Columns({"x": none["x"]}, {"time": none["time"]}, {})
    with xr.open_dataset(write_columns(columns, tmp_path / "a.nc"), engine="h5netcdf") as read:
        assert read.sizes["time"] == 0 and "x" in read
    assert write_columns_as_csv(columns, "time", tmp_path / "a.csv").read_text() == "time,x\n"


@pytest.mark.parametrize(
    ("of_the_command", "of_its_files"),
    [("couple", "cosim.systems.show.figures"), ("simulate", "cosim.report.figures")],
)
def test_a_run_is_written_without_xarray(of_the_command, of_its_files):
    """And without pandas and scipy: together they take longer than a small run."""
    code = f"import sys; import {of_its_files}; from cosim.cli.arguments import command_module"
    code += f"; command_module({of_the_command!r})"
    code += "; print([name for name in ('xarray', 'pandas', 'scipy') if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


def test_rows_are_those_that_xarray_takes():
    dataset = COLUMNS.to_xarray()
    for name, rows in (("sel", slice(0.1, None)), ("sel", slice(0.05, 0.2)), ("isel", slice(1))):
        ours, theirs = getattr(COLUMNS, name)(time=rows), getattr(dataset, name)(time=rows)
        assert ours.to_xarray().identical(theirs)
    assert float(COLUMNS.isel(time=2)["time"]) == 1.0 / 3.0
    assert COLUMNS["a.x"].max() == 1.0 and COLUMNS[["=a"]].sizes == {"time": 3}
    assert Columns.of(dataset).to_xarray().identical(dataset)

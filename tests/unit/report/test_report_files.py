"""Tables for a spreadsheet: what is text there stays text, what is a number stays one."""

import pandas as pd
import xarray as xr

from cosim.report.files import write_table


def test_no_name_is_taken_for_a_formula(tmp_path):
    table = pd.DataFrame(
        {"=cmd|'/c calc'!A0.x": [-1.5, 2e-300], "name": ["@SUM(A1)", "-0.5"], "+k": ["a", None]}
    )
    lines = write_table(table, tmp_path / "a.csv", index=False).read_text().splitlines()
    assert lines == ["'=cmd|'/c calc'!A0.x,name,'+k", "-1.5,'@SUM(A1),a", "2e-300,-0.5,"]


def test_a_result_is_restored_exactly(tmp_path):
    dataset = xr.Dataset(
        {"=a.x": ("time", [-0.1, 1 / 3]), "mode": ("time", [True, False])}, {"time": [0.0, 1.0]}
    )
    found = pd.read_csv(write_table(dataset.to_dataframe(), tmp_path / "a.csv"))
    assert list(found) == ["time", "'=a.x", "mode"]
    assert found["'=a.x"].tolist() == [-0.1, 1 / 3] and found["mode"].tolist() == [True, False]

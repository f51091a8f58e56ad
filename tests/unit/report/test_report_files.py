"""Tables for a spreadsheet: what is text there stays text, what is a number stays one."""

import pandas as pd

from cosim.report.files import write_table


def test_no_name_is_taken_for_a_formula(tmp_path):
    table = pd.DataFrame(
        {"=cmd|'/c calc'!A0.x": [-1.5, 2e-300], "name": ["@SUM(A1)", "-0.5"], "+k": ["a", None]}
    )
    lines = write_table(table, tmp_path / "a.csv", index=False).read_text().splitlines()
    assert lines == ["'=cmd|'/c calc'!A0.x,name,'+k", "-1.5,'@SUM(A1),a", "2e-300,-0.5,"]

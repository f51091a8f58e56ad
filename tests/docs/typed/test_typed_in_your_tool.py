"""An engineer does the page "Use the unit in your tool"."""

import pytest


@pytest.mark.slow
def test_in_your_tool(reader):
    reader.do("in_your_tool")
    assert (reader.folder / "units" / "StickSlip3DOF.fmu").is_file()

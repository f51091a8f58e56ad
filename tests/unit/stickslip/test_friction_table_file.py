"""A CSV file of friction that would be misread is refused, with its line."""

from pathlib import Path

import pytest
from refusals import one_line
from stickslip.friction.table_file import read_table

#: Two speeds at two temperatures.
GRID = "v,mu,T_degC\n0,0.4,-20\n0,0.3,-10\n0.05,0.38,-20\n0.05,0.24,-10\n"


@pytest.mark.parametrize(("text", "what"), [
    ("v,mu,mu\n0.1,0.2,0.9\n0.2,0.3,0.9\n", "column mu is there twice"),
    ("v,mu\n0,1,0,2\n0,2,0,3\n", "line 2 has more fields than the header"),
    ("v;mu\n0,1;0,2\n0,2;0,3\n", "no column v (there are v;mu); allowed is a header row v,mu"),
    ("v,T_K,mu\n0.1,263,0.2\n0.2,268,0.3\n", "column T_K is not read"),
    ("v,mu\n0.2,0.3\n0.1,0.2\n", "line 3: v = 0.1 after 0.2"),
    ("v,mu\n0.1,0.2\n0.2,-0.3\n", "line 3, mu = -0.3: allowed is 0 to 100"),
    ("v,mu\n-0.1,0.2\n0.2,0.3\n", "line 2, v = -0.1: allowed is 0 to 1000 m/s"),
    (GRID.replace("0.05,0.24,-10\n", ""),
     "no mu at v = 0.05, T_degC = -10; needed is one for each of 2"),
    (GRID.replace("0.24,-10", "0.24,-20"), "line 5: v = 0.05 at T_degC = -20 is there already"),
    (GRID.replace("0.24,-10", "0.24,cold"), 'line 5, T_degC = "cold": not a finite number'),
    (GRID.replace("_degC", "_C"), "T_C is not read (there are v, mu, T_C); allowed is T_degC"),
    (GRID.replace("0.24,-10", "0.24,-300"), "T_degC = -300: allowed is -273.15 to 100 degC"),
])  # fmt: skip
def test_a_file_that_would_be_misread_is_refused_with_its_line(text, what, tmp_path):
    (tmp_path / "mu.csv").write_text(text, encoding="utf-8")
    assert what in one_line(ValueError, read_table, tmp_path / "mu.csv")


@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="no such device here")
def test_a_device_is_no_table():
    with pytest.raises(ValueError, match="is not a file"):
        read_table(Path("/dev/zero"))

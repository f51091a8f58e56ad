"""The end of a run: its last lines."""

from pathlib import Path

from cosim.cli.running import closing_lines

MECHANICS = {
    "name": "case",
    "time_reached": 30.0,
    "wall_time": 2.34,
    "after_run_up": {"frequency": 2.3, "slip_share": 0.9},
    "ledger": {"mechanics": {"relative_residual": 1e-13}},
}
HEAT = {
    "temperatures": {"interface": {"end_degC": -7.9432, "end_rise": 0.0568}},
    "heat_shares": {"belt": 0.31, "ice": 0.48, "air": 0.21},
}
HEAT_LEDGERS = {
    "heat": {"received": 5.126, "relative_residual": 2e-14},
    "coupling": {"relative_difference": 0.0},
}


def test_a_coupled_run_ends_in_six_lines():
    ledgers = {"ledger": MECHANICS["ledger"] | HEAT_LEDGERS}
    lines = closing_lines(MECHANICS | HEAT | ledgers, Path("out"), 6.0)
    assert len(lines) == 6
    for said in (
        "30 s in 6.0 s",
        "2.300 break-aways",
        "0.900",
        "-7.9432 degC",
        "+0.0568 K",
        "5.126 J",
        "belt 0.310",
        "1.0e-13 of the work",
        "out/report.html",
    ):
        assert any(said in line for line in lines), said


def test_mechanics_alone_says_nothing_of_heat_and_a_short_run_has_no_frequency():
    short = MECHANICS | {"after_run_up": {"frequency": None, "slip_share": None}}
    lines = closing_lines(short, Path("out"), 6.0)
    assert len(lines) == 4 and "not known" in lines[1]

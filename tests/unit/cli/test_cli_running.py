"""The end of a run: its last lines."""

from pathlib import Path

import pytest

from cosim.cli import main
from cosim.report.run_text import closing_lines

MECHANICS = {
    "name": "case", "time_reached": 30.0, "wall_time": 2.34,
    "after_run_up": {"frequency": 2.3, "slip_share": 0.9, "duration": 20.0},
    "ledger": {"mechanics": {"relative_residual": 1e-13}},
}  # fmt: skip
HEAT = {
    "temperatures": {"interface": {"end_degC": -7.9432, "end_rise": 0.0568}},
    "heat_shares": {"belt": 0.31, "ice": 0.48, "air": 0.21},
}
HEAT_LEDGERS = {
    "heat": {"received": 5.126, "relative_residual": 2e-14},
    "coupling": {"relative_difference": 0.0},
}


COUPLED = MECHANICS | HEAT | {"ledger": MECHANICS["ledger"] | HEAT_LEDGERS}


def lines_of(numbers, folder=Path("out")):
    return closing_lines(numbers, folder, 6.0)


def test_a_coupled_run_ends_in_six_lines(tmp_path):
    assert lines_of(COUPLED, tmp_path)[-1].endswith(tmp_path.name), "no page that there is not"
    (tmp_path / "report.html").touch()
    lines = lines_of(COUPLED, tmp_path)
    assert len(lines) == 6
    for said in (
        "30 s in 6.0 s",
        "2.3 Hz",
        "slip share 0.9",
        "-7.943 degC",
        "+0.057 K",
        "5.13 J",
        "of which belt 31.0 %, ice 48.0 %, air 21.0 %",
        "1.0e-13 of the work",
        f"{tmp_path / 'report.html'}",
    ):
        assert any(said in line for line in lines), said


@pytest.mark.parametrize(("ends", "said"), [
    ({"interface_degC": -5.6789, "interface_rise": 2.3211, "reached": 5432.1} | {"within": 0.05},
     "-5.7 degC if this went on for ever, +2.3 K over the air; within 5400 s of"),
    ({"reason": "none: the face of the block comes to melt"}, "none: the face of the block"),
])  # fmt: skip
def test_it_is_told_how_warm_the_contact_gets_in_the_end(ends, said):
    lines = lines_of(COUPLED | {"in_the_end": ends})
    (line,) = [line for line in lines if line.startswith("  in the end")]
    assert said in line


@pytest.mark.parametrize(("rate", "share", "said"), [
    (None, None, "not known"),
    (0.0, 1.0, "no break-away at constant speed"),
    (None, 0.3, "one break-away at constant"),
])  # fmt: skip
def test_without_a_period_there_is_no_frequency(rate, share, said):
    """Of mechanics alone, which says nothing of heat."""
    late = {"frequency": rate, "slip_share": share, "duration": 20.0 if share else 0.0}
    lines = lines_of(MECHANICS | {"after_run_up": late})
    assert len(lines) == 4 and said in lines[1] and "Hz" not in lines[1]
    assert share is None or f"slip share {share:.3g}" in lines[1]


def test_rounding_is_not_told_of_as_heat_and_nought_has_no_sign():
    heat = {"heat": HEAT_LEDGERS["heat"] | {"received": -1.95e-21}}
    rise = {"temperatures": {"interface": {"end_degC": -8.0, "end_rise": -1e-14}}}
    said = "\n".join(lines_of(COUPLED | rise | {"ledger": COUPLED["ledger"] | heat}))
    assert "heat         0 J" in said and ", 0 K over the air" in said and "e-21" not in said


def test_a_block_beyond_its_belt_is_said_in_one_line(tmp_path, capsys):
    changes = ("--set", "initial.y=0.03", "--set", "run.duration=1")
    assert main(["simulate", "study", *changes, "-o", str(tmp_path / "out")]) == 0
    said = [line for line in capsys.readouterr().err.splitlines() if "edge" in line]
    assert len(said) == 1 and said[0].startswith("warning: ") and "t = 0 s, y = 30 mm" in said[0]

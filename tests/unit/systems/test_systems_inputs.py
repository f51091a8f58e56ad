"""What a system is given beside its units: values on the command line, inputs over time; and what
no unit here is given, by its name."""

import numpy as np
import pytest
from c_units import made
from command_line import refusal
from lag_unit import lag_unit

from cosim.cli import main
from cosim.coupling import Curve
from cosim.systems import SystemFault, read_system, run_system
from cosim.systems.run import check_system

#: y' = u, held over each step.
ONE = """
[units.one]
file = "lag.fmu"
{more}
[coupling]
macro_step = 0.1
[run]
stop = 1.0
"""


@pytest.fixture
def one(tmp_path):
    lag_unit(tmp_path / "lag.fmu")

    def write(more="", table=None):
        if table is not None:
            (tmp_path / "drive.csv").write_text(table, encoding="utf-8")
        (tmp_path / "one.toml").write_text(ONE.format(more=more), encoding="utf-8")
        return tmp_path / "one.toml"

    return write


def ended(path, **changes):
    """y at the end."""
    with read_system(path, changes) as system:
        return run_system(system).result["one.y"][-1]


# --- values on the command line ---


def test_a_variable_of_a_unit_is_set_by_name(one, tmp_path, capsys):
    path = one("inputs = { u = 1.0 }")
    assert ended(path) == pytest.approx(1.0, rel=1e-12)
    assert ended(path, **{"one.part.gain": 3.0, "one.u": 2.0}) == pytest.approx(6.0, rel=1e-12)
    arguments = ["--set", "one.part.gain=3", "--json", "-o", str(tmp_path / "out")]
    assert main(["couple", str(path), *arguments]) == 0
    assert '"part.gain": 3' in capsys.readouterr().out


@pytest.mark.parametrize(("setting", "said"), [
    ("two.u=1", "two.u: no unit is named 'two'"),
    ("one.part.gian=1", "no variable of one is named 'part.gian'; nearest: 'part.gain'"),
    ("one.u=[1, 2]", "one.u: not possible ([1, 2]), allowed is a number, true, false"),
    ("one.u=nan", "one.u = nan: must be a finite number"),
    ("one=1", "one: no unit"),
    ("run.stop", "allowed is KEY=VALUE"),
    ("run.stop=soon", 'run.stop: not a number ("soon")'),
    ("units.one.file=x", "no unit is named 'units'"),
    ("run.stopp=1", "run.stopp: no such key, nearest known: run.stop"),
])  # fmt: skip
def test_what_cannot_be_set_is_refused_in_a_line(one, setting, said, tmp_path, capsys):
    line = refusal(capsys, "couple", one(), "--set", setting, "-o", tmp_path / "out")
    assert said in line


# --- inputs over time ---


def test_a_curve_is_linear_jumps_and_has_an_exact_mean():
    curve = Curve(np.array([0.0, 1.0, 1.0, 3.0]), np.array([0.0, 2.0, 5.0, 1.0]))
    assert [curve.at(t) for t in (-1.0, 0.5, 1.0, 2.0, 9.0)] == [0.0, 1.0, 5.0, 3.0, 1.0]
    assert [curve.before(t) for t in (0.5, 1.0, 3.0, 9.0)] == [1.0, 2.0, 1.0, 1.0]
    points = np.random.default_rng(1).uniform(-1.0, 4.0, (50, 2))
    fine = (np.arange(200_000) + 0.5) / 200_000
    for begin, end in np.sort(points, axis=1):
        values = np.array([curve.at(t) for t in begin + (end - begin) * fine[::400]])
        assert curve.mean(begin, end) == pytest.approx(values.mean(), abs=2e-2)
    assert [curve.mean(*span) for span in ((0.0, 1.0), (1.0, 3.0), (3.0, 4.0))] == [1.0, 3.0, 1.0]
    whole = curve.mean(-1.0, 4.0) * 5.0
    assert whole == pytest.approx(0.0 + 1.0 + 6.0 + 1.0, rel=1e-14)


TABLE = "time,u\n0,0\n0.25,1\n0.25,3\n1,0\n"


def test_an_input_over_time_comes_from_a_table(one):
    """y is the area under the table's curve, whatever the step: the jump is inside of one."""
    path = one('input_file = "drive.csv"', TABLE)
    for step in (0.1, 0.05, 1.0):
        assert ended(path, **{"coupling.macro_step": step}) == pytest.approx(1.25, rel=1e-12)
    substeps = one('input_file = "drive.csv"\nsubsteps = 4', TABLE)
    assert ended(substeps) == pytest.approx(1.25, rel=1e-12)


@pytest.mark.parametrize(("more", "table", "said"), [
    ("", "t,u\n0,1\n", "line 1: its columns are t, u; allowed are time and then inputs"),
    ("", "time,u,u\n0,1,1\n", "inputs, each once"),
    ("", "time,v\n0,1\n", "no input of one is named 'v'"),
    ("", "time,u\n0,1\n1,x\n", "line 3: u = 'x', allowed is a finite number"),
    ("", "time,u\n0,1\n1,inf\n", "line 3: u = 'inf', allowed is a finite number"),
    ("", "time,u\n0,1\n1\n", "line 3: has 1 cells, the header has 2"),
    ("", "time,u\n1,1\n\n0,1\n", "line 4: the time goes back to 0 s"),
    ("", "time,u\n", "has no rows"),
    ("", "\0\xff", "drive.csv: "),
    ("\ninputs = { u = 1.0 }", "time,u\n0,1\n", "one.u: is set, and a column of"),
])  # fmt: skip
def test_a_table_that_cannot_be_is_refused_in_a_line(one, more, table, said, tmp_path, capsys):
    path = one('input_file = "drive.csv"' + more, table)
    line = refusal(capsys, "couple", path, "-o", tmp_path / "out")
    assert said in line and "drive.csv" in line


def test_an_input_is_fed_by_one_of_both(one, tmp_path):
    path = one('input_file = "drive.csv"', "time,u\n0,1\n")
    links = '[[connections]]\nfrom = "one.y"\nto = "one.u"\n'
    path.write_text(links + path.read_text())
    with read_system(path) as system, pytest.raises(SystemFault, match="one.u is a column of"):
        check_system(system)


# --- what is not coupled here ---

FIRST = "<ModelVariables>"
BINARY = '<Binary name="blob" valueReference="90" causality="input"><Start value="00"/></Binary>'
SIZED = (
    '<UInt64 name="count" valueReference="91" causality="structuralParameter" variability="fixed"'
    ' start="2"/><Float64 name="a" valueReference="92" causality="parameter" variability="fixed"'
    ' start="1 2"><Dimension valueReference="91"/></Float64>'
)
INTERFACE = (
    '<CoSimulation modelIdentifier="events" canHandleVariableCommunicationStepSize="true"\n'
    '    canGetAndSetFMUState="true" canSerializeFMUState="true" hasEventMode="true"\n'
    '    mightReturnEarlyFromDoStep="true"/>'
)
OTHER = '<{} modelIdentifier="events"/>'


@pytest.mark.parametrize(("changes", "lines", "said"), [
    ({FIRST: FIRST + BINARY}, "inputs = { blob = 0 }", "unit.blob is a Binary, which is not"),
    ({FIRST: FIRST + SIZED}, "parameters = { count = 3 }", "unit.count is a structural par"),
    ({INTERFACE: OTHER.format("ScheduledExecution")}, "", "is for scheduled execution only"),
    ({INTERFACE: OTHER.format("ModelExchange")}, "", "export it as one, with the solver"),
    ({FIRST: FIRST + BINARY + SIZED}, "", None),
], ids=["binary", "structural", "scheduled", "exchange", "left alone"])  # fmt: skip
def test_what_is_not_coupled_here_is_refused_by_its_name(tmp_path, changes, lines, said, capsys):
    """Variables of these kinds that nobody sets do no harm."""
    made("events", tmp_path, **changes)
    text = f'[units.unit]\nfile = "events.fmu"\n{lines}\n[coupling]\nmacro_step = 0.1\n'
    (tmp_path / "system.toml").write_text(text + "[run]\nstop = 0.2\n")
    code = main(["couple", str(tmp_path / "system.toml"), "-q", "-o", str(tmp_path / "out")])
    error = capsys.readouterr().err.splitlines()
    if said is None:
        assert (code, error) == (0, [])
    else:
        assert code == 2 and len(error) == 1 and said in error[0]

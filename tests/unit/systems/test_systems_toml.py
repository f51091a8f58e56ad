"""A system as a TOML file: what it comes to when it is run, and what is refused in which words."""

import json
import re

import numpy as np
import pytest
import xarray as xr
from command_line import refusal
from lag_unit import lag_unit

from cosim.cli import main
from cosim.coupling import CouplingError, FmuError
from cosim.coupling.record import RunFolder
from cosim.systems import SystemFault, read_system, run_system

CHAIN = """
name = "a chain"
[units.first]
file = "first.fmu"
[units.first.parameters]
part.gain = 2.0
"part.rate" = 0.5
[units.first.inputs]
u = 3.0
[units.second]
file = "second.fmu"
[[connections]]
from = "first.y"
to = "second.u"
{extra}
[coupling]
macro_step = 0.01
[run]
stop = 1.0
"""


@pytest.fixture
def chain(tmp_path):
    """A file of two units in a row, the first's output in m, the second's input in mm."""
    lag_unit(tmp_path / "first.fmu", y_unit="m")
    lag_unit(tmp_path / "second.fmu", u_unit="mm")
    path = tmp_path / "chain.toml"

    def write(extra="", **replaced):
        text = CHAIN.format(extra=extra)
        for old, new in replaced.values():
            text = text.replace(old, new)
        path.write_text(text)
        return path

    return write


def result_of(path, **changes):
    with read_system(path, changes) as specification:
        return run_system(specification)


def test_a_chain_is_what_its_equations_say(chain):
    """y1' = 2 * 3 - y1 / 2 is solved exactly by the unit; the second sums its end values."""
    done = result_of(chain())
    time, values = done.result.time, done.result.values
    first = 12.0 * (1.0 - np.exp(-0.5 * time))
    np.testing.assert_allclose(values["first.y"], first, rtol=1e-12, atol=1e-14)
    np.testing.assert_allclose(values["second.u"][1:], 1000.0 * first[1:], rtol=1e-12)
    summed = np.concatenate([[0.0], np.cumsum(0.01 * 1000.0 * first[1:])])
    np.testing.assert_allclose(values["second.y"], summed, rtol=1e-12)
    assert done.result.units["second.u"] == "mm"


@pytest.mark.parametrize(
    "said, factor, offset",
    [("factor = 2.0\noffset = 5.0", 2000.0, 5.0), ("convert = false", 1.0, 0.0)],
)
def test_a_connection_scales_and_shifts_after_the_conversion(chain, said, factor, offset):
    values = result_of(chain(said)).result.values
    expected = offset + factor * values["first.y"][1:]
    np.testing.assert_allclose(values["second.u"][1:], expected, rtol=1e-13)


def test_a_value_may_have_its_unit_where_the_variable_has_one(chain):
    folder = chain().parent
    lag_unit(folder / "first.fmu", u_unit="mm", y_unit="m")
    written, plain = (
        result_of(chain(value=("u = 3.0", f"u = {value}"))).result.values
        for value in ('"0.3 cm"', "3.0")
    )
    np.testing.assert_array_equal(written["first.y"], plain["first.y"])


@pytest.mark.parametrize("value, unit, line", [
    ('"3 kg"', "mm", r'not in a unit of mm \("3 kg"\), allowed is a number in mm'),
    ('"3 m"', "", r'has no unit \("3 m"\), allowed is a number'),
    ('"much"', "mm", r'not a number \("much"\), allowed is a number in mm'),
])  # fmt: skip
def test_a_value_in_another_unit_is_refused_in_a_line(chain, value, unit, line, tmp_path, capsys):
    path = chain(value=("u = 3.0", f"u = {value}"))
    lag_unit(path.parent / "first.fmu", u_unit=unit, y_unit="m")
    said = refusal(capsys, "couple", path, "-o", tmp_path / "out")
    assert re.fullmatch(rf".*chain\.toml: first\.u: {line}", said), said
    assert not (tmp_path / "out").exists()


def test_what_is_not_said_is_told(chain):
    lag_unit(chain().parent / "second.fmu")
    done = result_of(chain(step=("macro_step = 0.01", "")))
    assert done.assembly.macro_step == 0.01
    assert done.assembly.remarks == (
        "first.y -> second.u: units not checked: the input states none, m is taken",
        "coupling.macro_step is not given: 0.01 s, as a unit advises",
    )


@pytest.mark.parametrize("key, value, line", [
    ("coupling.waveform", "quadratic", 'coupling.waveform is not used with scheme = "gauss'),
    ("coupling.safety", 0.5, 'coupling.safety is not used with step_control = "fixed"'),
    ("coupling.power_bonds", [["a.b", "c.d"]], "coupling.power_bonds is not used with step"),
])  # fmt: skip
def test_what_has_no_meaning_is_told(chain, key, value, line):
    (remark,) = result_of(chain(), **{key: value}).assembly.remarks
    assert remark.startswith(line)


def test_rows_of_a_step_control_are_its_steps_and_that_is_told(chain):
    changes = {"run.output_interval": 0.1, "coupling.step_control": "doubling"}
    done = result_of(chain(), **changes)
    assert done.result.time.size == done.result.steps + 1
    assert "run.output_interval is not used with step_control" in done.assembly.remarks[0]


@pytest.mark.parametrize("old, new, message", [
    ('file = "first.fmu"', "", r"units.first.file: missing, needed is a text \(the FMU"),
    ("[units.first]", "[unit.first]", r"unit: no such key, nearest known: units"),
    ('"part.rate"', '"part.rat"', r"no variable of first is named 'part.rat'; nearest: 'par"),
    ("u = 3.0", "u = [3.0]", r"units.first.inputs.u: not possible .* a finite number, true"),
    ("u = 3.0", "u = nan", r"units.first.inputs.u: not possible \(nan\)"),
    ("u = 3.0", f"u = 1{400 * '0'}", r"units.first.inputs.u: not possible \(10+\)"),
    ('from = "first.y"', 'from = "frist.y"', r"connections\[1\].from: no unit is named 'fri"),
    ('from = "first.y"', 'from = "first.z"', r"no port of first is named 'z'"),
    ('from = "first.y"', 'from = "first"', r'not a port \("first"\), allowed is a text as u'),
    ('from = "first.y"', 'form = "first.y"', r"connections\[1\].from: missing"),
    ('from = "first.y"', "from = 3", r"connections\[1\].from: not a text \(3\)"),
    ('to = "second.u"', 'to = "second.y"', r"second.y is an output; a connection ends at"),
    ('to = "second.u"', 'to = "second.u"\nfactor = 0.0', r"factor: 0 would carry nothing"),
    ("macro_step = 0.01", "macro_step = 0", r"coupling.macro_step: out of range \(0\)"),
    ("macro_step = 0.01", "macro_step = 1e-12", r"into more than 1000000000 steps, allowed is"),
    ("macro_step = 0.01\n[run]\nstop = 1.0", "[run]\nstop = 1e9", r"s \(as a unit advises\)"),
    ("macro_step = 0.01", "macrostep = 1", r"coupling.macrostep: no such key, nearest known"),
    ("macro_step = 0.01", "order = [1]", r"coupling.order: not a text \(1\)"),
    ("macro_step = 0.01", 'order = ["first"]', r"the order leaves out second"),
    ("macro_step = 0.01", 'absolute_tolerances = { "first.y" = nan }',
     r"absolute_tolerances: not a finite number \(nan\), allowed is a table of names, each"),
    ("macro_step = 0.01", 'scheme = "jakobi"', r'coupling.scheme: not known \("jakobi"\)'),
    ("stop = 1.0", "stop = -1.0", r"run.stop: -1 s, allowed is a time after run.start = 0 s"),
    ("stop = 1.0", "", r"run.stop: missing, needed is the time \(s\) at which the run ends"),
    ("stop = 1.0", "stop = 1.0\noutput_interval = 0.015", r"does not fall on the macro steps"),
    ("[units.second]", '[units."a.b"]', r"units.a.b: not a name, allowed is a text without"),
    ('"second.fmu"', '"second.fmu"\ntime_limit = 3.0', r"is for a unit with isolate = true"),
    ('name = "a chain"', "name = 3", r"name: not a text \(3\), allowed is a text"),
    ('"part.rate" = 0.5', '"part.rate" = -0.5', r"first.part.rate = -0.5: must lie in"),
    ("[coupling]", "[coupling", r"not TOML: "),
])  # fmt: skip
def test_what_makes_no_sense_is_refused_in_one_line(chain, capsys, old, new, message):
    path = chain(change=(old, new))
    with pytest.raises((SystemFault, FmuError, CouplingError), match=message):
        result_of(path)
    refusal(capsys, "couple", path, "-o", path.parent / "out")


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(SystemFault, match="no such file, allowed is an SSP or a TOML file"):
        read_system(tmp_path / "none.toml")


def test_the_command_leaves_what_run_leaves(chain, tmp_path, capsys):
    folder = tmp_path / "out"
    given = ["couple", str(chain()), "--set", "run.stop=0.5", "--figures", "-o", str(folder)]
    assert main(given) == 0
    assert "a chain: 0.5 s in" in capsys.readouterr().out
    assert {path.name for path in folder.iterdir()} == {
        "result.nc", "result.csv", "summary.json", "report.html", "made_by.json",
        "system.png", "signals.png", "steps.png",
    }  # fmt: skip
    numbers = json.loads((folder / "summary.json").read_text())
    assert numbers["status"] == "complete" and numbers["coupling"]["steps"] == 50
    assert numbers["connections"][0]["factor"] == pytest.approx(1000.0, rel=1e-12)
    with xr.open_dataset(folder / "result.nc", engine="h5netcdf") as dataset:
        assert dataset["first.y"].attrs["units"] == "m"
        assert dataset["second.u"].attrs["fed_by"] == "first.y"
        np.testing.assert_allclose(dataset["macro_step"], 0.01, rtol=1e-9)
    page = (folder / "report.html").read_text()
    assert "times 1000" in page and "first.y" in page


def test_a_unit_that_fails_leaves_what_there_was(chain, tmp_path, capsys):
    """A unit refuses a step that takes it above 1e6: after 6e5 the second does so in its second."""
    path = chain(grow=("part.gain = 2.0", "part.gain = 2e6"), rate=('"part.rate" = 0.5', ""))
    assert main(["couple", str(path), "-o", str(tmp_path / "out")]) == 1
    assert "failed in the step from t = 0.01 s" in capsys.readouterr().err
    numbers = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert numbers["status"] == "failed" and numbers["time_reached"] == pytest.approx(0.01)


@pytest.mark.parametrize("command, asked, said", [
    ("run", {"system": "chain.toml"}, "not created by `stickslip run`"),
    ("couple", {"command": "run"}, "not created by `stickslip couple`"),
    ("couple", {"system": 5}, "not created by `stickslip couple`"),
    ("couple", {"system": "chain.toml", "changes": [1]}, "not created by `stickslip couple`"),
])  # fmt: skip
def test_the_run_of_another_command_is_not_gone_on_with(tmp_path, capsys, command, asked, said):
    folder = RunFolder.begun(tmp_path, asked, {})
    folder.checkpoint.touch()
    folder.release()
    assert said in refusal(capsys, command, "--resume", tmp_path)


def cut_off(folder, system):
    """An unfinished run of a system in a folder."""
    folder.mkdir()
    run = RunFolder.begun(folder, {"system": system}, {})
    run.checkpoint.write_text("of a run that was cut off")
    run.release()
    return run.checkpoint


@pytest.mark.parametrize("named", [False, True])
def test_units_that_only_an_unfinished_run_names_are_not_run(chain, tmp_path, capsys, named):
    """A folder of somebody else's can name any: the system of the call is read, or none."""
    theirs, out = tmp_path / "theirs.toml", tmp_path / "out"
    theirs.write_text("no system at all")
    cut_off(out, str(theirs))
    words = ["couple", *([chain()] if named else []), "--resume", out]
    assert main([*map(str, words)]) == 2
    line = capsys.readouterr().err.splitlines()[-1]
    # of the run, which is no checkpoint, where the system was read
    wanted = ("checkpoint.zip",) if named else ("SYSTEM: missing", f"couple {theirs} --resume")
    assert all(each in line for each in wanted)


@pytest.mark.parametrize("old, new", [("second.fmu", "third.fmu"), ("second.u", "second.v")])
def test_what_is_refused_leaves_an_unfinished_run_alone(chain, tmp_path, old, new):
    checkpoint = cut_off(tmp_path / "out", "chain.toml")
    assert main(["couple", str(chain(change=(old, new))), "-o", str(tmp_path / "out")]) == 2
    assert checkpoint.read_text() == "of a run that was cut off"


def in_unit(path, unit):
    """The same system, both of whose ports are in a unit."""
    lag_unit(path.parent / "first.fmu", y_unit=unit)
    lag_unit(path.parent / "second.fmu", u_unit=unit)
    return path


def test_energy_that_is_taken_up_is_in_the_ledger(chain):
    done = result_of(in_unit(chain('taken = "taken"'), "J"))
    (flow,) = done.result.ledger.flows
    np.testing.assert_allclose(flow.handed, flow.taken, rtol=1e-12)
    assert flow.handed[-1] > 1.0
    assert done.result.ledger.residual == pytest.approx(0.0, abs=1e-12)


def test_a_power_is_said_as_both_integrals_and_how_far_they_go(chain, tmp_path, capsys):
    path, out = in_unit(chain(), "W"), tmp_path / "out"
    for interval, sparse in ((0.01, False), (0.1, True)):
        given = ["--set", f"run.output_interval={interval}", "-o", str(out)]
        assert main(["couple", str(path), *given]) == 0
        (power,) = json.loads((out / "summary.json").read_text())["ledger"]["powers"]
        # y = 12 (1 - e^(-t/2)); its end values held, over steps or rows, are larger
        assert power["added"] == pytest.approx(0.5 * interval * 12 * (1 - np.exp(-0.5)), rel=1e-6)
        said = f"{power['under_the_curve']:.4g} J under the output's curve"
        assert said in capsys.readouterr().out
        assert ("There are fewer rows than steps" in (out / "report.html").read_text()) == sparse

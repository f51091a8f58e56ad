"""What a system's run has to say of its settings and its steps: on the terminal, in the summary."""

import json
import shutil
from pathlib import Path

import pytest
from lag_unit import lag_unit

from cosim.cli import main
from cosim.coupling import FmuParticipant
from cosim.coupling.exchange import Statistics

LOOP = """
connections = [{{ from = "a.y", to = "b.u" }}, {{ from = "b.y", to = "a.u" }}]
run.stop = 1.0
units.a = {{ file = "a.fmu", parameters = {{ part.gain = 0.5, part.rate = 1.0, y = 1.0 }} }}
units.b = {{ file = "b.fmu", parameters = {{ part.gain = 3.0, part.rate = 1.0 }} }}
[coupling]
{coupling}
"""


@pytest.fixture
def loop(tmp_path):
    """A file of two units that feed each other, by the lines of its table [coupling]."""

    def write(coupling, a=("", ""), b=("", "")):
        lag_unit(tmp_path / "a.fmu", *a)
        lag_unit(tmp_path / "b.fmu", *b)
        (tmp_path / "loop.toml").write_text(LOOP.format(coupling=coupling))
        return str(tmp_path / "loop.toml")

    return write


def couple(path, *more):
    folder = Path(path).parent / "out"
    status = main(["couple", path, "-o", str(folder), *more])
    summary = folder / "summary.json"
    return status, json.loads(summary.read_text()) if summary.exists() else None


ACCEPT = """
macro_step = 0.25
scheme = "iterated"
acceleration = "none"
max_iterations = 2
relative_tolerance = 1e-9
on_divergence = "accept"
"""


def test_steps_accepted_without_convergence_are_said_loudly(loop, capsys):
    status, numbers = couple(loop(ACCEPT))
    said = capsys.readouterr()
    assert status == 0
    coupling = numbers["coupling"]
    assert coupling["converged"] is False
    assert coupling["unconverged"] == 4 and coupling["first_unconverged"] == 0.0
    first, at_end = [line for line in said.err.splitlines() if line.startswith("warning: ")][-2:]
    assert first.startswith("warning: at t = 0 s a step of 0.25 s has not converged in 2 iteratio")
    assert at_end.startswith("warning: 4 of 4 steps were accepted, the first from t = 0 s, whose")
    page = (Path(numbers["source"]).parent / "out" / "report.html").read_text()
    assert '<p class="warning">4 of 4 steps were accepted' in page
    status, numbers = couple(loop("macro_step = 0.25"))
    assert numbers["coupling"]["converged"] is True
    assert "first_unconverged" in numbers["coupling"]
    assert "were accepted" not in capsys.readouterr().err


def test_steps_that_grind_are_said_where_it_begins(loop, capsys):
    grinding = (
        'macro_step = 0.05\nstep_control = "doubling"\nsmallest_step = 0.05\n'
        "largest_step = 0.05\nstep_tolerance = 1e-12"
    )
    status, numbers = couple(loop(grinding))
    lines = capsys.readouterr().err.splitlines()
    assert status == 0 and numbers["coupling"]["above_tolerance"] == 20
    begun = [line for line in lines if "the smallest, is accepted with" in line]
    assert len(begun) == 1
    assert begun[0].startswith("warning: at t = 0 s a step of 0.05 s, the smallest, ")
    assert "to t = 1 s there would be 20 of them" in begun[0]
    assert any(line.startswith("warning: 20 of 20 steps were accepted") for line in lines)


def test_a_step_longer_than_the_run_is_said(loop, capsys):
    status, numbers = couple(loop("macro_step = 2.0"))
    assert status == 0
    says = "macro_step = 2 s is longer than the run, which is one step of 1 s"
    assert says in numbers["remarks"] and says in capsys.readouterr().out


@pytest.mark.parametrize(
    "coupling, a, b, said",
    [
        ('order = ["a"]', (), (), r"loop.toml: coupling.order: the order leaves out b, allowed"),
        ("", ("", "m"), ("N", ""), r"loop.toml: connections[1]: a.y -> b.u: m (m) does not fit N"),
        (
            'absolute_tolerances = { "c.y" = 1.0 }', (), (),
            "loop.toml: coupling.absolute_tolerances: no participant is named 'c'",
        ),
        (
            'step_control = "energy"\npower_bonds = [["a.y", "b.y"]]', ("N", "m"), ("m", "N"),
            "loop.toml: coupling.power_bonds: power bond a.y with b.y: m times N (kg m^2 s^-2) is",
        ),
        (
            'step_control = "energy"\npower_bonds = [["a.y", "b"]]', (), (),
            "loop.toml: coupling.power_bonds: 'b' is not a port; written as 'participant.port'",
        ),
        (
            'step_control = "energy"', (), (),
            "loop.toml: coupling.power_bonds: step_control = 'energy': needs at least one power b",
        ),
        (
            'step_control = "defect"\nsmallest_step = 1.0', (), (),
            "loop.toml: coupling: macro_step = 0.25 s: must lie between smallest_step = 1 s",
        ),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_refused_by_file_and_key(loop, capsys, coupling, a, b, said):
    path = loop(f"macro_step = 0.25\n{coupling}", a, b)
    status, _ = couple(path)
    assert status == 2
    err = capsys.readouterr().err
    assert said in err and err.count("\n") == 1
    assert not (Path(path).parent / "out").exists()


def test_a_folder_that_is_removed_in_mid_run_is_said_in_one_line(loop, capsys, monkeypatch):
    """As who cleans up does it: the run's own folder, or that of the results with all in it."""
    path = loop("macro_step = 0.01")
    for gone, said in (("unfinished", "it was removed while it was written"), (".", "was removed")):
        made = Statistics.count

        def count(self, size, gone=gone, made=made):
            made(self, size)
            if self.steps == 20:
                shutil.rmtree(Path(path).parent / "out" / gone)

        # the table looks every second; here at every row
        monkeypatch.setattr("cosim.coupling.record.table.LOOK_EVERY", -1.0)
        monkeypatch.setattr(Statistics, "count", count)
        assert main(["couple", path, "--force", "-o", str(Path(path).parent / "out")]) == 1
        monkeypatch.undo()
        lines = [x for x in capsys.readouterr().err.splitlines() if x.startswith("error: ")]
        assert len(lines) == 1 and said in lines[0] and "debug" not in lines[0]
    assert "rows until then, checkpoints and messages are lost" in lines[0]


def test_many_units_are_drawn_as_squares(tmp_path):
    """Words of 30 units in a row would be fifty inches wide."""
    lag_unit(tmp_path / "u.fmu")
    text = "".join(f'[units.u{k}]\nfile = "u.fmu"\n' for k in range(30))
    text += "".join(f'[[connections]]\nfrom = "u{k}.y"\nto = "u{k + 1}.u"\n' for k in range(29))
    (tmp_path / "row.toml").write_text(text + "[run]\nstop = 0.02\n")
    status, numbers = couple(str(tmp_path / "row.toml"), "--figures")
    assert status == 0 and len(numbers["participants"]) == 30
    assert "Units on the diagonal" in (tmp_path / "out" / "report.html").read_text()
    from PIL import Image

    width, height = Image.open(tmp_path / "out" / "system.png").size
    assert max(width, height) < 1600


def test_a_unit_of_first_derivatives_is_linear_and_that_is_said(loop, tmp_path):
    """FMI 2.0 says that inputs are interpolated, not to which order."""
    path = loop('macro_step = 0.25\nextrapolation = "quadratic"')
    smooth = {"<CoSimulation ": '<CoSimulation canInterpolateInputs="true" '}
    lag_unit(tmp_path / "a.fmu", changes=smooth)
    assert FmuParticipant(tmp_path / "a.fmu").capabilities.input_order == 1
    _, numbers = couple(path)  # the unit declares it and refuses it: a failed run says so too
    remarks = [remark for remark in numbers["remarks"] if "first derivatives" in remark]
    assert remarks == [
        "a takes no more than first derivatives of its inputs: they are linear over a step there,"
        " not quadratic"
    ]

"""A coupled run whose mechanical unit has a process of its own: the same to the last bit."""

import numpy as np
import pytest

from cosim import read_scenario, run_scenario
from cosim.cli import main

CASE = {"run.duration": 0.6, "run.output_interval": 0.01, "run.checkpoint_steps": 20}
SCHEMES = {
    "in turn": {},
    "taken back": {"coupling.scheme": "iterated", "coupling.step_control": "doubling"},
}


def case(**more):
    return read_scenario("reference").changed(CASE | more)


def same(one, other):
    assert one.result.status == other.result.status == "complete"
    np.testing.assert_array_equal(one.result.time, other.result.time)
    assert one.result.units == other.result.units
    for name, values in one.result.values.items():
        np.testing.assert_array_equal(values, other.result.values[name], err_msg=name)


@pytest.fixture(
    scope="module", params=["in turn", pytest.param("taken back", marks=pytest.mark.slow)]
)
def plain(request, fmu):
    """A run in one process, and its keys."""
    return run_scenario(case(**SCHEMES[request.param]), fmu=fmu), SCHEMES[request.param]


def test_results_are_those_of_one_process(plain, fmu):
    run, keys = plain
    isolated = case(**keys, **{"coupling.isolate": True, "coupling.time_limit": 30.0})
    same(run, run_scenario(isolated, fmu=fmu))


def test_a_unit_that_does_not_answer_in_time_is_said_in_one_line(fmu, tmp_path, capsys):
    (tmp_path / "case.toml").write_text(
        "[run]\nduration = 0.1\n[coupling]\nisolate = true\ntime_limit = 1e-4\n"
    )
    given = ["run", str(tmp_path / "case.toml"), "--fmu", str(fmu), "-o", str(tmp_path / "out")]
    assert main(given) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("error: ") and "within 0.0001 s, its time limit" in line
    assert "--debug" not in line

"""The extended model in the FMU: it does there what was measured, and what the fit did."""

import sys
from pathlib import Path

import fmpy
import numpy as np
import pytest

from cosim import read_scenario
from cosim.gap.show.model_file import model_text, shown_run
from cosim.gap.show.reproduction import reproduce, reproduced_runs

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "unit"))

from gap_answers import answer  # noqa: E402
from gap_campaigns import NOISE  # noqa: E402


@pytest.fixture(scope="module")
def gap(tmp_path_factory):
    return answer(tmp_path_factory.mktemp("campaign"))


def test_the_fmu_reproduces_the_runs_that_were_held_out(gap, fmu):
    runs = reproduced_runs(gap)
    assert [run.name for run in runs] == ["run03"]
    shown = reproduce(gap, runs[0], fmu)
    assert len(shown.time) > 100 and shown.time[-1] > 1.0
    # two hundred samples of nothing but noise: 1 within five hundredths, plus the fit's own error
    assert shown.gap < 1.2 and shown.plain_gap > 5.0
    assert shown.apart < 1e-6  # one kernel: rounding, in units of the noise


def test_fmpy_alone_does_the_same_with_the_numbers_of_the_file(gap, fmu, tmp_path):
    (tmp_path / "model.toml").write_text(model_text(gap), encoding="utf-8")
    scenario = read_scenario(tmp_path / "model.toml")
    run = shown_run(gap)
    window = np.flatnonzero(run.track.windows == 0)
    result = fmpy.simulate_fmu(
        str(fmu),
        stop_time=float(run.track.time[window[-1]]),
        output_interval=scenario.run.output_interval,
        start_values=scenario.mechanics.flat() | {"surface_speed": scenario.surface.speed},
        output=["x"],
    )
    x = np.interp(run.track.time[window], result["time"], result["x"])
    left = run.track.run.track.x[window] - x - gap.extended.values["offset.x"]
    assert np.sqrt(np.mean((left / NOISE) ** 2)) < 1.2

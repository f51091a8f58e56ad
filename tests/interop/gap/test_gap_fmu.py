"""The extended model in the FMU: it does there what was measured, and what the fit did."""

from dataclasses import replace

import fmpy
import numpy as np
import pytest
from gap_answers import PLAIN, fitted
from gap_campaigns import NOISE, motion, noisy, write_campaign
from stickslip.effects.candidate import FreeParameter

from cosim import read_scenario
from cosim.gap import read_campaign
from cosim.gap.show.model_file import model_text, scenario_of, shown_run
from cosim.gap.show.reproduction import reproduce, reproduced_runs

CREEP = 2e-3


def test_the_fmu_reproduces_the_runs_that_were_held_out(gap, fmu):
    runs = reproduced_runs(gap)
    assert [run.name for run in runs] == ["run03"]
    shown = reproduce(gap, runs[0], fmu)
    assert len(shown.time) > 100 and shown.time[-1] > 1.0
    # two hundred samples of nothing but noise: 1 within five hundredths, plus the fit's own error
    assert shown.gap < 1.2 and shown.plain_gap > 5.0
    assert shown.apart < 1e-6  # one kernel: rounding, in units of the noise


@pytest.fixture(scope="module")
def creeping(gap, tmp_path_factory):
    """Sticks that lag behind a slow surface by a fifth of its speed; the slowest is held out."""
    runs = []
    for number, speed in enumerate((0.015, 0.03, 0.01)):
        run = motion(speed=speed, duration=8.0, creep=CREEP)
        runs.append(
            {
                "surface_speed": speed,
                "hold_out": speed == 0.01,
                "columns": {"t": run.time, "x": noisy(run["x"], number)},
            }
        )
    folder = tmp_path_factory.mktemp("creeping")
    campaign = read_campaign(write_campaign(folder, runs, noise={"x": NOISE}))
    plain = fitted(campaign, PLAIN)
    free_parameter = FreeParameter("friction.stick_creep", 0.9 * CREEP, 0.1 * CREEP, 0.0, 1.0)
    return replace(
        gap, campaign=campaign, plain=plain, extended=fitted(campaign, (*PLAIN, free_parameter))
    )


def test_a_creep_is_the_fmu_s_too(creeping, fmu):
    (run,) = reproduced_runs(creeping)
    assert scenario_of(creeping, run).friction.stick_creep == pytest.approx(CREEP, rel=0.05)
    shown = reproduce(creeping, run, fmu)
    assert shown.time[-1] > 4.0
    assert shown.gap < 1.2 and shown.plain_gap > 2.0
    assert shown.apart < 1e-6


def test_fmpy_alone_does_the_same_with_the_numbers_of_the_file(gap, fmu, tmp_path):
    (tmp_path / "model.toml").write_text(model_text(gap), encoding="utf-8")
    scenario = read_scenario(tmp_path / "model.toml")
    run = shown_run(gap)
    segment = np.flatnonzero(run.track.segments == 0)
    result = fmpy.simulate_fmu(
        str(fmu),
        stop_time=float(run.track.time[segment[-1]]),
        output_interval=scenario.run.output_interval,
        start_values=scenario.mechanics.flat() | {"surface_speed": scenario.surface.speed},
        output=["x"],
    )
    x = np.interp(run.track.time[segment], result["time"], result["x"])
    left = run.track.run.track.x[segment] - x - gap.extended.values["offset.x"]
    assert np.sqrt(np.mean((left / NOISE) ** 2)) < 1.2

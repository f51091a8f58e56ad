"""The extended model in the FMU: it does there what the fit did, and what was measured."""

import fmpy
import numpy as np
from gap_campaigns import NOISE

from cosim import read_scenario
from cosim.gap.show.files import largest_difference, reproduction_line
from cosim.gap.show.model_file import model_text, shown_run
from cosim.gap.show.tracks import starts


def test_the_fmu_is_the_fitted_model(gap, fmu):
    """The fit integrates to 1e-6 of the motion's scale, the FMU to 1e-11; in noise units."""
    assert largest_difference(gap, fmu) < 1e-2
    assert "differ by less than 0.0" in reproduction_line(gap)


def test_fmpy_alone_does_the_same_with_the_numbers_of_the_file(gap, fmu, tmp_path):
    (tmp_path / "model.toml").write_text(model_text(gap), encoding="utf-8")
    scenario, run = read_scenario(tmp_path / "model.toml"), shown_run(gap)
    fitted = gap.extended.run(run.name)
    time = run.motion.time[: starts(run, fitted)[0]]
    result = fmpy.simulate_fmu(
        str(fmu),
        stop_time=float(time[-1]),
        output_interval=scenario.run.output_interval,
        start_values=scenario.mechanics.flat() | {"surface_speed": scenario.surface.speed},
        output=["x"],
    )
    x = np.interp(time, result["time"], result["x"]) + fitted.values["offset.x"]
    # the state at the very beginning is read off the track: off by half the noise and more in x
    assert np.sqrt(np.mean(((x - run.motion.x[: time.size]) / NOISE) ** 2)) < 1.6

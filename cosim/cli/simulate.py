"""`stickslip simulate`: the mechanics alone."""

from __future__ import annotations

import time
from argparse import Namespace

from stickslip import Trajectory, simulate

from cosim.cli.assessing import attach, compile_model
from cosim.cli.files import results_folder, scenario_to_run
from cosim.cli.finish import finish
from cosim.cli.progress import progress_over
from cosim.interrupts import Patience, patient_interrupts
from cosim.report import trajectory_dataset
from cosim.scenario import Scenario


def main(arguments: Namespace) -> int:
    """Simulate, write, report; the exit status."""
    began = time.perf_counter()
    scenario = scenario_to_run(arguments.scenario, coupled=False)
    folder = results_folder(arguments.output, scenario)
    compile_model()
    with patient_interrupts() as patience:
        start = time.perf_counter()
        trajectory = _simulated(scenario, patience)
        stepped = time.perf_counter() - start
        dataset = trajectory_dataset(trajectory, scenario, scenario.to_toml(), wall_time=stepped)
        attach(dataset, scenario, patience)
        return finish(dataset, folder, began, patience)


def _simulated(scenario: Scenario, patience: Patience) -> Trajectory:
    """The trajectory, up to where a Ctrl-C stopped it.

    Ctrl-C is looked at between two blocks of rows only, so that rows and events of a block are
    both kept or both not there.
    """
    run = scenario.run
    with progress_over(run.duration) as show:

        def progress(reached: float) -> None:
            patience.hold()
            show(reached)
            if patience.requested:
                patience.requested = False  # served
                raise KeyboardInterrupt

        try:
            return simulate(
                scenario.mechanics,
                run.duration,
                run.output_interval,
                interface_temperature=scenario.ambient.temperature_degC,
                progress=progress,
            )
        except KeyboardInterrupt as stop:
            if not patience.holding:
                raise
            return stop.trajectory

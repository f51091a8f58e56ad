"""`stickslip simulate`: the mechanics alone."""

import time
from argparse import Namespace

from stickslip import Trajectory

from cosim.cli import DONE
from cosim.cli.numbers import numbers_asked
from cosim.cli.runs import running
from cosim.cli.runs.run_io import Ending, progress_over, shown
from cosim.cli.scenarios import note_taken
from cosim.coupling.record import RunFolder
from cosim.interrupts import Patience, patient_interrupts
from cosim.manifest import made_by, results_in
from cosim.report.dataset import trajectory_columns
from cosim.scenario import Scenario
from cosim.simulated import simulated


def execute(arguments: Namespace) -> int:
    """Simulate, write, report; the exit status."""
    began = time.perf_counter()
    scenario = running.scenario_to_run(arguments.scenario, arguments.changes, coupled=False)
    folder = running.results_folder(arguments.output, scenario, "simulate", arguments.force)
    numbers = numbers_asked(arguments, running.KEYS)
    asked = {"resume": ""}
    # also where a coupled run was cut off: its folder is no place for another run's results
    RunFolder.begun(folder, asked, {}, force=arguments.force).finished()
    note_taken(scenario)
    _ = scenario.catalogue.compiled  # before the bar begins to count
    with patient_interrupts() as patience:
        start = time.perf_counter()
        trajectory = _simulated(scenario, patience)
        stepped = time.perf_counter() - start
        dataset = trajectory_columns(trajectory, scenario, scenario.to_toml(), wall_time=stepped)
        running.assess_motion(dataset, scenario, patience)
        made = made_by(scenario=scenario.to_toml())
        ending = Ending(folder, began, patience, numbers, shown(arguments), made["command"])
        with results_in(folder, made, force=arguments.force) as results:
            status = running.finish(dataset, ending)
            results.complete = status == DONE
        return status


def _simulated(scenario: Scenario, patience: Patience) -> Trajectory:
    """The trajectory, up to where a Ctrl-C stopped it.

    Ctrl-C is looked at between two batches of rows only, so that rows and events of a batch are
    both kept or both not there.
    """
    with progress_over(scenario.run.duration, patience) as show:

        def progress(reached: float) -> None:
            show(reached)
            if patience.requested:
                patience.requested = False  # served
                raise KeyboardInterrupt

        try:
            return simulated(scenario, progress)
        except KeyboardInterrupt as stop:
            if not patience.holding:
                raise
            # what was computed until then is on the exception, of whatever kind it is
            kept: Trajectory = stop.trajectory  # type: ignore[attr-defined]
            return kept

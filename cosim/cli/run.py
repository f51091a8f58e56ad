"""`stickslip run`: the coupled case."""

from __future__ import annotations

import time
from argparse import Namespace
from pathlib import Path

from cosim.cli.assessing import attach, compile_model
from cosim.cli.errors import BadInput, refusing
from cosim.cli.files import results_folder, scenario_to_run, writable_folder
from cosim.cli.finish import finish
from cosim.cli.progress import progress_over
from cosim.coupling import CouplingError, FmuError, ParticipantError
from cosim.coupling.case import CoupledRun, run_scenario
from cosim.interrupts import patient_interrupts
from cosim.report import run_dataset
from cosim.scenario import Scenario
from thermal import ParameterError

FIELDS = "fields"
#: Input that does not fit, as opposed to a run that fails.
REFUSED = (CouplingError, FmuError, ParameterError)


def main(arguments: Namespace) -> int:
    """Run, write, report; the exit status."""
    began = time.perf_counter()
    scenario = scenario_to_run(arguments.scenario, coupled=True)
    folder = results_folder(arguments.output, scenario)
    fields = writable_folder(folder / FIELDS, ())
    compile_model()
    with patient_interrupts() as patience:
        with progress_over(scenario.run.duration) as show:

            def progress(reached: float) -> None:
                patience.hold()
                show(reached)

            done = _coupled(
                scenario,
                fmu=arguments.fmu,
                fields=fields,
                progress=progress,
                views=arguments.animation,
            )
        patience.hold()
        dataset = run_dataset(done.result, scenario, scenario.to_toml(), snapshots=done.snapshots)
        attach(dataset, scenario, patience)
        return finish(
            dataset, folder, began, patience, _field_files(done, folder), views=done.snapshots.views
        )


def _field_files(done: CoupledRun, folder: Path) -> dict[str, str]:
    """The temperature fields as the page lists them."""
    if done.snapshots.file is None:
        return {}
    name = done.snapshots.file.relative_to(folder).as_posix()
    return {name: "temperature fields of belt and ice; opens in ParaView"}


def _coupled(scenario: Scenario, **arguments) -> CoupledRun:
    """`run_scenario`, with what it refuses as bad input."""
    try:
        with refusing(*REFUSED):
            return run_scenario(scenario, **arguments)
    except ParticipantError as error:
        # an FMU's contents are only unpacked when it starts
        if isinstance(error.__cause__, REFUSED):
            raise BadInput(str(error.__cause__)) from error
        raise

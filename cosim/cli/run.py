"""`stickslip run`: the coupled case."""

from __future__ import annotations

import time
from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cosim.cli import BadInput
from cosim.cli.arguments import add_run_arguments

if TYPE_CHECKING:
    from cosim.coupling.case import CoupledRun
    from cosim.scenario import Scenario

EXAMPLE = "stickslip run my_case.toml -o results/first"
FIELDS = "fields"


def add_arguments(parser: ArgumentParser) -> None:
    """The arguments of the command."""
    add_run_arguments(parser)
    parser.add_argument(
        "--fmu",
        metavar="FILE",
        help="the mechanical FMU (default: that in build of a checkout, or else in the user's cache"
        " folder, built when missing or stale)",
    )
    parser.add_argument(
        "--animation",
        action="store_true",
        help="also write temperature.gif: belt and ice, a frame every run.snapshot_interval",
    )


def refused() -> tuple[type[Exception], ...]:
    """What is bad input, as opposed to a run that fails."""
    import cosim.cli.running
    import cosim.coupling.case  # noqa: F401  the models, imported where Ctrl-C waits
    from cosim.coupling import CouplingError, FmuError
    from cosim.files import OutputRefused
    from cosim.scenario import ScenarioError
    from thermal import ParameterError

    return (ScenarioError, OutputRefused, CouplingError, FmuError, ParameterError)


def execute(arguments: Namespace) -> int:
    """Run, write, report; the exit status."""
    from cosim.cli import running
    from cosim.files import writable
    from cosim.interrupts import patient_interrupts
    from cosim.report import run_dataset

    began = time.perf_counter()
    scenario = running.scenario_to_run(arguments.scenario, coupled=True)
    folder = running.results_folder(arguments.output, scenario)
    fields = writable(folder / FIELDS)
    running.compile_model()
    with patient_interrupts() as patience:
        with running.progress_over(scenario.run.duration) as show:

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
        running.assess_motion(dataset, scenario, patience)
        return running.finish(
            dataset, folder, began, patience, _field_files(done, folder), views=done.snapshots.views
        )


def _field_files(done: CoupledRun, folder: Path) -> dict[str, str]:
    """The temperature fields as the page lists them."""
    if done.snapshots.file is None:
        return {}
    name = done.snapshots.file.relative_to(folder).as_posix()
    return {name: "temperature fields of belt and ice; opens in ParaView"}


def _coupled(scenario: Scenario, **arguments: Any) -> CoupledRun:
    """`run_scenario`; an FMU's contents are only unpacked, and refused, when it starts."""
    from cosim.coupling import ParticipantError
    from cosim.coupling.case import run_scenario

    try:
        return run_scenario(scenario, **arguments)
    except ParticipantError as error:
        if isinstance(error.__cause__, refused()):
            raise BadInput(" ".join(str(error.__cause__).split())) from error
        raise

"""The motion of a run, assessed: whether a rig could make it, and what exists beside it."""

from __future__ import annotations

import sys

import xarray as xr
from stickslip import Parameters, simulate
from stickslip.compiled import is_cached
from stickslip.steady_motion import Interface, assess
from stickslip.steady_motion.assessment import PATIENCE, deadline

from cosim.interrupts import Patience
from cosim.report.assessment import attach_assessment
from cosim.scenario import Scenario


def compile_model() -> None:
    """Have the compiled mechanics ready; says so where that takes a while."""
    if sys.stderr.isatty() and not is_cached():
        print(
            "compiling the mechanical model for this machine; once, up to half a minute",
            file=sys.stderr,
        )
    simulate(Parameters(), 1e-3, 1e-3)


def attach(dataset: xr.Dataset, scenario: Scenario, patience: Patience) -> None:
    """Let a complete run's dataset carry the assessment of its motion.

    Friction that feels the interface has it as the run left it, temperature and water. A Ctrl-C
    that came in the meantime ends the work: what was computed goes to disk without it.
    """
    if dataset.attrs["status"] != "complete":
        return
    interface = Interface(scenario.ambient.temperature_degC)
    if "interface_temperature" in dataset:
        interface = Interface(
            float(dataset["interface_temperature"].values[-1]),
            float(dataset["film_thickness"].values[-1]),
        )
    in_time = deadline(PATIENCE)

    def look() -> None:
        if patience.requested:
            raise TimeoutError
        in_time()

    attach_assessment(
        dataset, assess(scenario.mechanics, scenario.run.duration, interface, look=look)
    )

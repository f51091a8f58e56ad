"""Stick-slip coupled to the heat it makes: master, scenarios, studies and the command line.

In a notebook:

>>> from cosim import read_scenario, run_scenario
>>> scenario = read_scenario("reference").changed({"rig.mass": 1.2, "run.duration": 1.0})
>>> run = run_scenario(scenario)
>>> run.result.time.shape, run.result["mechanics.x"].shape
((101,), (101,))
>>> run.to_xarray()["interface_temperature"].attrs["units"]
'degC'
>>> run.plot("temperatures")
<Figure size ... with 3 Axes>
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from cosim.coupling.case import CoupledRun, run_scenario
    from cosim.scenario import Scenario, read_scenario
    from cosim.simulated import SimulatedRun, simulate_scenario

__all__ = [
    "CoupledRun",
    "Scenario",
    "SimulatedRun",
    "read_scenario",
    "run_scenario",
    "simulate_scenario",
]

_HOME = {
    "CoupledRun": "cosim.coupling.case",
    "run_scenario": "cosim.coupling.case",
    "Scenario": "cosim.scenario",
    "read_scenario": "cosim.scenario",
    "SimulatedRun": "cosim.simulated",
    "simulate_scenario": "cosim.simulated",
}


def __getattr__(name: str) -> Any:
    """Import on first use: the command line and the master alone start without the models."""
    if name in _HOME:
        return getattr(import_module(_HOME[name]), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)

"""Stick-slip coupled to the heat it makes: master, scenarios, studies and the command line.

What a program or a notebook needs is imported from here; `stickslip` and `thermal` are the two
models by themselves.

>>> from cosim import read_scenario, run_scenario
>>> scenario = read_scenario("reference").changed(rig_mass=1.2, run_duration=1.0)
>>> run = run_scenario(scenario)
>>> run["x"].shape, run.interface_temperature.attrs["units"], len(run.to_dataframe())
((101,), 'degC', 101)
>>> run.plot("temperatures")
<Figure size ... with 3 Axes>
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from cosim.coupling.case import CoupledRun, run_scenario
    from cosim.gap import read_campaign
    from cosim.gap.find import find_gap
    from cosim.gap.plan import make_plan, read_plan
    from cosim.report.compare import compare, read_result
    from cosim.scenario import Scenario, read_scenario
    from cosim.simulated import SimulatedRun, simulate_scenario
    from cosim.studies.belt_length import how_long
    from cosim.studies.friction_map import friction_map
    from cosim.studies.reproduction import reproduce
    from cosim.studies.stability import (
        case_of,
        pretension_map,
        regime_map,
        stability,
        stick_slip_range,
    )
    from cosim.studies.sweep import sweep
    from cosim.systems import read_system, run_system

__all__ = [
    "CoupledRun",
    "Scenario",
    "SimulatedRun",
    "case_of",
    "compare",
    "find_gap",
    "friction_map",
    "how_long",
    "make_plan",
    "pretension_map",
    "read_campaign",
    "read_plan",
    "read_result",
    "read_scenario",
    "read_system",
    "regime_map",
    "reproduce",
    "run_scenario",
    "run_system",
    "simulate_scenario",
    "stability",
    "stick_slip_range",
    "sweep",
]

_HOME = {
    "CoupledRun": "cosim.coupling.case",
    "run_scenario": "cosim.coupling.case",
    "Scenario": "cosim.scenario",
    "read_scenario": "cosim.scenario",
    "SimulatedRun": "cosim.simulated",
    "simulate_scenario": "cosim.simulated",
    **dict.fromkeys(("read_system", "run_system"), "cosim.systems"),
    "read_campaign": "cosim.gap",
    "find_gap": "cosim.gap.find",
    **dict.fromkeys(("make_plan", "read_plan"), "cosim.gap.plan"),
    "how_long": "cosim.studies.belt_length",
    "friction_map": "cosim.studies.friction_map",
    "sweep": "cosim.studies.sweep",
    "reproduce": "cosim.studies.reproduction",
    **dict.fromkeys(("compare", "read_result"), "cosim.report.compare"),
    **dict.fromkeys(
        ("case_of", "pretension_map", "regime_map", "stability", "stick_slip_range"),
        "cosim.studies.stability",
    ),
}


def __getattr__(name: str) -> Any:
    """Import on first use: the command line and the master alone start without the models."""
    if name in _HOME:
        return getattr(import_module(_HOME[name]), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)

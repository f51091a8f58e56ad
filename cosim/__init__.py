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

from typing import TYPE_CHECKING

from cosim.lazy import lazy

if TYPE_CHECKING:
    from cosim.coupling.case import CoupledRun as CoupledRun
    from cosim.coupling.case import run_scenario as run_scenario
    from cosim.gap import read_campaign as read_campaign
    from cosim.gap.find import find_gap as find_gap
    from cosim.gap.plan import make_plan as make_plan
    from cosim.gap.plan import read_plan as read_plan
    from cosim.report.compare import compare as compare
    from cosim.report.compare import read_result as read_result
    from cosim.scenario import Scenario as Scenario
    from cosim.scenario import read_scenario as read_scenario
    from cosim.simulated import SimulatedRun as SimulatedRun
    from cosim.simulated import simulate_scenario as simulate_scenario
    from cosim.studies.belt_length import how_long as how_long
    from cosim.studies.friction_map import friction_map as friction_map
    from cosim.studies.reproduction import reproduce as reproduce
    from cosim.studies.stability import case_of as case_of
    from cosim.studies.stability import pretension_map as pretension_map
    from cosim.studies.stability import regime_map as regime_map
    from cosim.studies.stability import stability as stability
    from cosim.studies.stability import stick_slip_range as stick_slip_range
    from cosim.studies.sweep import sweep as sweep
    from cosim.systems import read_system as read_system
    from cosim.systems import run_system as run_system

# the command line and the master alone start without the models
__getattr__, __dir__, __all__ = lazy(
    __name__,
    {
        "cosim.coupling.case": "CoupledRun run_scenario",
        "cosim.gap": "read_campaign",
        "cosim.gap.find": "find_gap",
        "cosim.gap.plan": "make_plan read_plan",
        "cosim.report.compare": "compare read_result",
        "cosim.scenario": "Scenario read_scenario",
        "cosim.simulated": "SimulatedRun simulate_scenario",
        "cosim.studies.belt_length": "how_long",
        "cosim.studies.friction_map": "friction_map",
        "cosim.studies.reproduction": "reproduce",
        "cosim.studies.stability": "case_of pretension_map regime_map stability stick_slip_range",
        "cosim.studies.sweep": "sweep",
        "cosim.systems": "read_system run_system",
    },
)

"""What a user may say in a scenario file, and what is wrong with it."""

from cosim.scenario.faults import ScenarioError
from cosim.scenario.scenario import Scenario, packaged_scenarios, read_scenario
from cosim.scenario.work import check_work

__all__ = ["Scenario", "ScenarioError", "check_work", "packaged_scenarios", "read_scenario"]

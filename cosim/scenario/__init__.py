"""What a user may say in a scenario file, and what is wrong with it."""

from cosim.scenario.faults import ScenarioError
from cosim.scenario.scenario import Scenario, packaged_scenarios, read_scenario

__all__ = ["Scenario", "ScenarioError", "packaged_scenarios", "read_scenario"]

"""What a user may say in a scenario file, and what is wrong with it."""

from cosim.scenario.faults import ScenarioError, nearest
from cosim.scenario.scenario import Scenario, packaged_scenarios, read_scenario

__all__ = ["Scenario", "ScenarioError", "nearest", "packaged_scenarios", "read_scenario"]

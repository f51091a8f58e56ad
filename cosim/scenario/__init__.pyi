from cosim.scenario.scenario import Scenario as Scenario
from cosim.scenario.scenario import as_scenario as as_scenario
from cosim.scenario.scenario import packaged_scenarios as packaged_scenarios
from cosim.scenario.scenario import read_scenario as read_scenario
from cosim.scenario.validation import ScenarioError as ScenarioError
from cosim.scenario.work import check_work as check_work

"""What a user may say in a scenario file, and what is wrong with it."""

from typing import TYPE_CHECKING

from cosim.lazy import lazy

if TYPE_CHECKING:
    from cosim.scenario.scenario import Scenario as Scenario
    from cosim.scenario.scenario import packaged_scenarios as packaged_scenarios
    from cosim.scenario.scenario import read_scenario as read_scenario
    from cosim.scenario.validation import ScenarioError as ScenarioError
    from cosim.scenario.work import check_work as check_work

# who only refuses a wrong key needs no model
__getattr__, __dir__, __all__ = lazy(
    __name__,
    {
        ".scenario": "Scenario packaged_scenarios read_scenario",
        ".validation": "ScenarioError",
        ".work": "check_work",
    },
)

"""What a user may say in a scenario file, and what is wrong with it."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from cosim.scenario.scenario import Scenario, packaged_scenarios, read_scenario
    from cosim.scenario.validation import ScenarioError
    from cosim.scenario.work import check_work

__all__ = ["Scenario", "ScenarioError", "check_work", "packaged_scenarios", "read_scenario"]

_HOME = {
    "ScenarioError": "validation",
    "Scenario": "scenario",
    "packaged_scenarios": "scenario",
    "read_scenario": "scenario",
    "check_work": "work",
}


def __getattr__(name: str) -> Any:
    """Import on first use: who only refuses a wrong key needs no model."""
    if name in _HOME:
        return getattr(import_module(f"{__name__}.{_HOME[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)

"""The mechanics of a scenario alone, as `stickslip simulate` has them, as a result."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from stickslip import Trajectory, simulate

from cosim.report.scenario_run import ScenarioRun
from cosim.scenario import Scenario, as_scenario, check_work

if TYPE_CHECKING:
    from cosim.report.columns import Columns


@dataclass(frozen=True, repr=False)
class SimulatedRun(ScenarioRun):
    """What was simulated and what came out.

    By name, as `run["x"]` or `run.x`, it has every variable of `to_xarray`.

    trajectory: the motion, sampled every `run.output_interval`, and its events.
    """

    scenario: Scenario
    trajectory: Trajectory

    def __repr__(self) -> str:
        return f"<SimulatedRun of {self.scenario.name}: {self.trajectory!r}>"

    @cached_property
    def _columns(self) -> Columns:
        from cosim.report.dataset import trajectory_columns

        return trajectory_columns(self.trajectory, self.scenario, self.scenario.to_toml())


def simulate_scenario(scenario: Scenario | str | Path = "reference") -> SimulatedRun:
    """Simulate a scenario, the name of a packaged one, or a TOML file: no FMU, no heat conduction.

    Raises ScenarioError (a ValueError of one line) for input that cannot be.

    >>> from cosim import read_scenario
    >>> simulate_scenario(read_scenario("reference").changed({"run.duration": 2.0}))
    <SimulatedRun of reference: <Trajectory of 2 s, 201 rows: ...>>
    """
    scenario = as_scenario(scenario)
    check_work(scenario, coupled=False)
    return SimulatedRun(scenario, simulated(scenario))


def simulated(scenario: Scenario, progress: Callable[[float], None] | None = None) -> Trajectory:
    """The motion of a scenario's mechanics; progress: see `stickslip.simulate`."""
    return simulate(
        scenario.mechanics,
        scenario.run.duration,
        scenario.run.output_interval,
        interface_temperature=scenario.ambient.temperature_degC,
        progress=progress,
    )

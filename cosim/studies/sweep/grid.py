"""The combinations of a sweep: every value of each axis with every value of the others."""

from __future__ import annotations

import warnings
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from math import inf, prod
from typing import Any

from pydantic import ValidationError
from stickslip import Parameters

from cosim.scenario import Scenario, ScenarioError
from cosim.scenario.validation import describe_faults
from cosim.scenario.work import check_mechanics, check_work

from .axis import SCENARIO, Axis, SweepError, axis, keys_of, scenario_axis
from .combination import Run, content_key, with_changes

#: Tables of a scenario that only a coupled run has a use for.
HEAT_TABLES = ("belt", "ice", "contact", "coupling")
#: More combinations than this are a slip of the product: hours of checking before the first run.
MOST = 1_000_000

Settings = Mapping[str, Any]


def merged(settings: Sequence[Settings]) -> dict[str, Any]:
    """The settings of one value from each axis, taken together."""
    return {key: value for setting in settings for key, value in setting.items()}


@dataclass(frozen=True)
class Grid:
    """Combinations of ``axes`` around ``base``, the last axis running fastest.

    base: mechanics, or a whole scenario. combine: makes the changes of a combination (`block.key`
    -> value) out of one setting from each axis. patience: longest that one of them may take, s.
    coupled: whether each is a coupled run.
    """

    base: Parameters
    axes: tuple[Axis, ...]
    combine: Callable[[Sequence[Settings]], dict[str, Any]] = merged
    patience: float = inf
    coupled: bool = False

    def __post_init__(self) -> None:
        if not self.axes:
            raise SweepError("nothing is varied, allowed is at least one key with its values")
        keys = Counter(key for each in self.axes for key in {*each.coordinates, each.name})
        for key, count in keys.items():
            if count > 1:
                raise SweepError(f"{key}: varied twice, allowed is once")
        if len(self) > MOST:
            raise SweepError(f"{len(self)} combinations, allowed are at most {MOST}")

    def __len__(self) -> int:
        return prod(self.shape)

    @property
    def shape(self) -> tuple[int, ...]:
        return tuple(len(each) for each in self.axes)

    @property
    def dims(self) -> tuple[str, ...]:
        return tuple(each.name for each in self.axes)

    @cached_property
    def changes(self) -> list[dict[str, Any]]:
        """`block.key` -> value, for every combination in order."""
        return [self.combine(each) for each in product(*(each.settings for each in self.axes))]

    def run_of(self, given: Mapping[str, float]) -> Run:
        """How each combination is run; given: duration, output_interval, s."""
        usual = {"duration": 30.0, "output_interval": 0.01}
        if isinstance(self.base, Scenario):
            for name in given:
                raise SweepError(f"{name}: a scenario has run.{name}, set that")
            usual = {name: getattr(self.base.run, name) for name in usual}
        return Run(**(usual | dict(given)), coupled=self.coupled)

    def keys(self, run: Run) -> list[str]:
        """The content key of every combination; SweepError, in one line, for one that cannot be."""
        keys: list[str] = []
        warned: Counter[str] = Counter()
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", UserWarning)
            for changes in self.changes:
                parameters = self._parameters(changes)
                self._check_work(parameters, changes, run)
                keys.append(content_key(parameters, run))
                warned.update({str(entry.message) for entry in caught})
                caught.clear()
        _warn_once(warned)
        return keys

    def _parameters(self, changes: Settings) -> Parameters:
        try:
            return with_changes(self.base, changes)
        except ScenarioError as error:
            fault = str(error)
        except ValidationError as report:
            fault = describe_faults(report, type(self.base))
        raise SweepError(
            fault
            if any(fault.startswith(key) for key in changes)
            else f"{_written(changes)}: {fault}"
        )

    def _check_work(self, parameters: Parameters, changes: Settings, run: Run) -> None:
        try:
            if self.coupled and isinstance(parameters, Scenario):
                _ = parameters.record_every
                check_work(parameters, coupled=True)
            else:
                patience = patience_of(parameters, self.patience)
                check_mechanics(parameters, run.of(parameters).duration, patience)
        except ScenarioError as fault:
            raise SweepError(f"{_written(changes)}: {fault}") from None


def _written(changes: Settings) -> str:
    return ", ".join(
        f"{key} = {value.name if key == SCENARIO else value}" for key, value in changes.items()
    )


def product_grid(
    parameters: Parameters | Sequence[Scenario],
    vary: Mapping[Any, Sequence[Any]],
    coupled: bool | None = None,
) -> Grid:
    """The product of the varied keys; `axis` says how keys and values are given.

    parameters: several scenarios are the first axis. coupled: see `sweep`.
    """
    several = [parameters] if isinstance(parameters, Parameters) else list(parameters)
    catalogue = several[0].catalogue
    axes = tuple(axis(*entry, Scenario.of(catalogue)) for entry in vary.items())
    keys = [key for each in axes for setting in each.settings[:1] for key in setting]
    scenarios = [one for one in several if isinstance(one, Scenario)]
    heat = [key for key in keys if key.partition(".")[0] in HEAT_TABLES]
    whole = [key for key in keys if key not in keys_of(Parameters.of(catalogue))]
    if not scenarios and whole:
        raise SweepError(f"{whole[0]}: is no key of the mechanics, allowed with a scenario")
    if coupled is False and heat:
        raise SweepError(f"{heat[0]}: does nothing in the mechanics alone, allowed is coupled")
    if coupled is None:
        coupled = bool(heat) or any(
            getattr(one, table) != getattr(scenarios[0], table)
            for one in scenarios[1:]
            for table in HEAT_TABLES
        )
    if coupled and not scenarios:
        raise SweepError("coupled: mechanics alone cannot be, allowed is a scenario")
    if len(several) > 1:
        axes = (scenario_axis(scenarios), *axes)
    base, patience = several[0], patience_of(several[0])
    if not (coupled or whole or len(several) > 1 or _feels_temperature(base)):
        base = mechanics_of(base)
    return Grid(base, axes, patience=patience, coupled=coupled)


def _feels_temperature(base: Parameters) -> bool:
    """Whether the air's temperature is not the one that the mechanics takes by itself."""
    usual = Scenario().ambient.temperature_degC
    return isinstance(base, Scenario) and base.ambient.temperature_degC != usual


def mechanics_of(parameters: Parameters) -> Parameters:
    """The mechanical part, which a scenario has more than."""
    return parameters.mechanics if isinstance(parameters, Scenario) else parameters


def patience_of(parameters: Parameters, without: float = inf) -> float:
    """Longest that a combination may take, s."""
    return parameters.run.patience if isinstance(parameters, Scenario) else without


def _warn_once(warned: Counter[str]) -> None:
    """One warning for all combinations, whose texts differ by their numbers only."""
    if warned:
        others = len(warned) - 1
        also = f" (and {others} like it in other combinations)" if others else ""
        warnings.warn(next(iter(warned)) + also, stacklevel=3)

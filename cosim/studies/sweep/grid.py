"""The combinations of a sweep: every value of each axis with every value of the others.

The published test plan is one of them: every priority of every parameter, 1306 combinations. 2
temperatures x 9 belts x 6 masses x 6 speeds x 2 kinds of guides = 1296, and 10 repeats of one
combination for its statistics: over a surface whose friction scatters, each with another seed.
`plan.toml` has them, and says what of them is assumed. In the mechanics alone the temperature acts
through the friction coefficients.
"""

import warnings
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from math import prod
from typing import Any

from pydantic import ValidationError
from stickslip import Parameters
from stickslip.packaged import packaged_tables

from ...scenario import Scenario, ScenarioError
from ...scenario.validation import describe_faults
from ...scenario.work import check_mechanics, check_work
from .axis import Axis, SweepError, axis, keys_of, labelled_axis
from .combination import SCENARIO, Run, content_key, with_changes

#: Tables of a scenario that only a coupled run has a use for.
HEAT_TABLES = ("belt", "ice", "contact", "coupling")
#: More combinations than this are a slip of the product: hours of checking before the first run.
MOST = 1_000_000

Settings = Mapping[str, Any]


def merged(settings: Iterable[Settings]) -> dict[str, Any]:
    """The settings of one value from each axis, taken together."""
    return {key: value for setting in settings for key, value in setting.items()}


@dataclass(frozen=True)
class Grid:
    """Combinations of ``axes`` around ``base``, the last axis running fastest.

    base: mechanics, or a whole scenario; run: how each is run. combine: makes the changes of a
    combination (`block.key` -> value) out of one setting from each axis.
    """

    base: Parameters
    axes: tuple[Axis, ...]
    run: Run = Run()
    combine: Callable[[Sequence[Settings]], dict[str, Any]] = merged

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
        return tuple(map(len, self.axes))

    @cached_property
    def changes(self) -> list[dict[str, Any]]:
        """`block.key` -> value, for every combination in order."""
        return [self.combine(each) for each in product(*(each.settings for each in self.axes))]

    def keys(self) -> list[str]:
        """The content key of every combination; SweepError, in one line, for one that cannot be."""
        keys: list[str] = []
        warned: Counter[str] = Counter()
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", UserWarning)
            for changes in self.changes:
                keys.append(content_key(self._checked(changes), self.run))
                warned.update({str(entry.message) for entry in caught})
                caught.clear()
        if warned:
            # one for all combinations, whose texts differ by their numbers only
            others = len(warned) - 1
            also = f" (and {others} like it in other combinations)" if others else ""
            warnings.warn(next(iter(warned)) + also, stacklevel=2)
        return keys

    def _checked(self, changes: Settings) -> Parameters:
        """A combination that can be, and whose run will end."""
        about = ", ".join(
            f"{key} = {value.name if key == SCENARIO else value}" for key, value in changes.items()
        )
        try:
            parameters = with_changes(self.base, changes)
        except (ScenarioError, ValidationError) as error:
            fault = str(error)
            if isinstance(error, ValidationError):
                fault = describe_faults(error, type(self.base))
            named = any(fault.startswith(key) for key in changes)
            raise SweepError(fault if named else f"{about}: {fault}") from None
        run = self.run.of(parameters)
        try:
            if run.coupled and isinstance(parameters, Scenario):
                _ = parameters.record_every
                check_work(parameters, coupled=True)
            else:
                check_mechanics(parameters, run.duration, run.patience)
        except ScenarioError as fault:
            raise SweepError(f"{about}: {fault}") from None
        return parameters


def product_grid(
    parameters: Parameters | Sequence[Scenario],
    vary: Mapping[Any, Sequence[Any]],
    coupled: bool | None = None,
    **times: Any,
) -> Grid:
    """The product of the varied keys; `axis` says how keys and values are given.

    parameters: several scenarios are the first axis. coupled, times (duration, output_interval):
    see `sweep`.
    """
    several = [parameters] if isinstance(parameters, Parameters) else list(parameters)
    base, scenarios = several[0], [one for one in several if isinstance(one, Scenario)]
    axes = tuple(axis(*entry, Scenario.of(base.catalogue)) for entry in vary.items())
    keys = [key for each in axes for setting in each.settings[:1] for key in setting]
    heat = [key for key in keys if key.partition(".")[0] in HEAT_TABLES]
    whole = [key for key in keys if key not in keys_of(Parameters.of(base.catalogue))]
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
        axes = (_scenario_axis(scenarios), *axes)
    run = Run(coupled=coupled).of(base)
    # where the air's temperature is the one that the mechanics takes by itself
    usual = not scenarios or scenarios[0].ambient == Scenario().ambient
    if usual and not (coupled or whole or len(several) > 1):
        base = mechanics_of(base)
    if isinstance(base, Scenario):
        for name in times:
            raise SweepError(f"{name}: a scenario has run.{name}, set that")
    return Grid(base, axes, run._replace(**times))


def _scenario_axis(scenarios: Sequence[Scenario]) -> Axis:
    """Whole scenarios, by their names; SweepError for two of one name."""
    names = [scenario.name for scenario in scenarios]
    for name, count in Counter(names).items():
        if count > 1:
            raise SweepError(f"two scenarios are named {name}, allowed is each name once")
    return labelled_axis(SCENARIO, "scenario", "1", names, [{SCENARIO: one} for one in scenarios])


def mechanics_of(parameters: Parameters) -> Parameters:
    """The mechanical part, which a scenario has more than."""
    return parameters.mechanics if isinstance(parameters, Scenario) else parameters


PLAN = packaged_tables(__package__, "plan.toml")
#: mu_k at -8 degC
BELTS: dict[str, float] = PLAN["belts"]
#: mu_s / mu_k of the published experiment
STATIC_RATIO = PLAN["published"]["mu_s"] / PLAN["published"]["mu_k"]


def plan_grid(
    parameters: Parameters,
    belts: Mapping[str, float] = BELTS,
    per_kelvin: float = PLAN["per_kelvin"],
) -> Grid:
    """The plan's 1296 combinations around ``parameters``.

    belts: name -> mu_k at -8 degC; mu_s follows by `STATIC_RATIO`. per_kelvin: part by which
    friction grows for each kelvin below that. Measured ones take the place of the assumed.
    """
    temperatures, guides = PLAN["temperatures"], PLAN["guides"]
    growth = [{"growth": 1.0 + per_kelvin * (temperatures[0] - each)} for each in temperatures]
    friction = [{"mu_k": value} for value in belts.values()]
    free = [{"rig.degrees_of_freedom": tuple(each)} for each in guides.values()]
    axes = (
        labelled_axis("temperature", "temperature of the room", "degC", temperatures, growth),
        labelled_axis("belt", "material of the belt", "1", list(belts), friction),
        axis("rig.mass", [round(PLAN["ice"] + added, 3) for added in PLAN["added_masses"]]),
        axis("surface.speed", PLAN["speeds"]),
        labelled_axis("guides", "motion that the rig allows", "1", list(guides), free),
    )
    return Grid(mechanics_of(parameters), axes, Run().of(parameters), _with_friction)


def repeats_grid(parameters: Parameters) -> Grid:
    """Ten runs of ``parameters``, each over another place of a surface whose friction scatters."""
    deviation = parameters.surface_scatter.deviation or PLAN["scatter"]
    base = with_changes(mechanics_of(parameters), {"surface_scatter.deviation": deviation})
    seeds = axis("surface_scatter.seed", range(1, PLAN["repeats"] + 1))
    return Grid(base, (seeds,), Run().of(parameters))


def _with_friction(settings: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Friction out of belt and temperature; the other axes' settings as they are."""
    growth, belt, *others = settings
    mu_k = belt["mu_k"] * growth["growth"]
    return {"friction.mu_s": STATIC_RATIO * mu_k, "friction.mu_k": mu_k} | merged(others)

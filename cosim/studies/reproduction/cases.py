"""The study's cases, and the three models that they are run with: as printed, mended, exact."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from itertools import product
from typing import Any, Self

import numpy as np
from stickslip import Parameters, simulate
from stickslip.reference.linearised import GRAVITY, Scheme, SchemeRun
from stickslip.reference.scheme_options import MENDED, PRINTED, Faults

from .motion import WINDOW, Motion, figures

Array = np.ndarray

CYCLES = 25  # the study's run: 10 cycles to settle, 15 that count
STEADY = 0.6
LONGEST_SLIP = 1.0  # s, the study's; longer natural periods count as they are
SEEDS = (0, 1, 2)
# the exact model settles within its first seconds; the study's own speed ramp takes 10 s
SETTLING = 10.0
SAMPLE = 5e-3

MASSES = (0.67, 0.896667, 1.123333, 1.35, 1.576667, 1.803333, 2.03)
STIFFNESSES = (20.17, 38.50, 53.36, 68.22)
EXTRA_STIFFNESS = 136.44
SPEEDS = (0.15, 0.25, 0.37, 0.50, 0.63, 0.82)
LENGTH, PRETENSION = 0.20, 0.01
# rad: an ideal start would hide whether straight sliding is stable
TURNED = math.radians(1.0)
GUIDED: dict[str, Any] = {"degrees_of_freedom": ("x",)}
SCATTER = 0.02  # standard deviation of mu_k per strip, not printed
# mu_k falls by two fifths over the speeds of the study: its data points are drawn, not printed
WEAKENING = 0.4


@dataclass(frozen=True)
class Case:
    """A set of the study's parameters; SI units. weakening: part of mu_k lost over its speeds."""

    mass: float = 0.67
    stiffness: float = 20.17
    speed: float = 0.15
    mu_s: float = 0.2815
    mu_k: float = 0.2086
    weakening: float = 0.0

    @property
    def mu_slope(self) -> float:
        """Loss of mu_k per m/s of sliding speed, s/m."""
        return self.weakening * self.mu_k / (SPEEDS[-1] - SPEEDS[0])

    @property
    def weight(self) -> float:
        """N"""
        return self.mass * GRAVITY

    def changed(self, **changes: float) -> Self:
        """This case with other numbers."""
        return replace(self, **changes)

    def over(self, number: str, values: Iterable[float]) -> list[Self]:
        """This case with each value of one of its numbers."""
        return [self.changed(**{number: value}) for value in values]


DATASET_1 = Case()
DATASET_2 = Case(mu_s=0.065, mu_k=0.05)
DATASETS = {1: DATASET_1, 2: DATASET_2}
#: All of the series have the second set's friction, falling with the sliding speed.
CASE = DATASET_2.changed(weakening=WEAKENING)


def plan(stiffnesses: Sequence[float] = STIFFNESSES) -> list[Case]:
    """Combinations of stiffness, mass and speed in the study's series, speed running fastest."""
    return [
        CASE.changed(stiffness=k, mass=m, speed=v)
        for k, m, v in product(stiffnesses, MASSES, SPEEDS)
    ]


def scheme(case: Case, faults: Faults, **changes: Any) -> Scheme:
    """The study's scheme for a case; friction scatters, or depends on speed, never both."""
    changes = {"scatter": 0.0 if case.weakening else SCATTER} | changes
    names = ("mass", "stiffness", "speed", "mu_s", "mu_k", "mu_slope")
    numbers = {name: getattr(case, name) for name in names}
    return Scheme(mu_k_speed=SPEEDS[0], faults=faults, **numbers, **changes)


def exact_parameters(case: Case, *, pretension: float = PRETENSION, **tables: Any) -> Parameters:
    """The exact model for a case, planar friction; starts at rest on the surface, barely turned.

    pretension: m by which the springs are stretched as installed; tables: laid over the model's.
    """
    at_rest = case.mu_k + case.mu_slope * SPEEDS[0]  # mu_k is given at the slowest surface
    mu_s = max(case.mu_s, at_rest) if case.weakening else case.mu_s
    springs = {"spring_length": LENGTH, "spring_natural_length": LENGTH - pretension}
    guided = tables.get("rig") == GUIDED
    model: dict[str, dict[str, Any]] = {
        "rig": {"mass": case.mass, **springs},
        "springs": {"stiffness": case.stiffness},
        "friction": {"mu_s": mu_s, "mu_k": at_rest},
        "velocity_weakening": {"linear": case.mu_slope / at_rest if at_rest else 0.0},
        "lateral_friction": {"ratio": 1.0},
        "surface": {"speed": case.speed},
        "initial": {"vx": case.speed, "phi": 0.0 if guided else TURNED},
    }
    laid = {name: model.get(name, {}) | values for name, values in tables.items()}
    return Parameters.model_validate(model | laid)


def longest(case: Case) -> float:
    """Time in which the study's cycles are over, s: ends a run that does not stick again.

    A cycle slips for a period or a second, and sticks for at most twice the travel to break-away
    with one spring.
    """
    period = 2.0 * math.pi * math.sqrt(case.mass / (4.0 * case.stiffness))
    stick = 2.0 * case.mu_s * case.weight / (case.stiffness * case.speed)
    return CYCLES * (max(period, LONGEST_SLIP) + stick)


def scheme_run(case: Case, faults: Faults, seed: int = 0) -> SchemeRun:
    """A whole run of the study's scheme."""
    return scheme(case, faults).run(cycles=CYCLES, duration=longest(case), seed=seed)


@lru_cache(maxsize=32)
def scheme_motion(case: Case, faults: Faults, seed: int = 0) -> Motion:
    """The motion of such a run."""
    return Motion.of_scheme(scheme_run(case, faults, seed))


@cache
def scheme_figures(case: Case, faults: Faults, seeds: tuple[int, ...] = SEEDS) -> dict[str, float]:
    """Steady figures of the study's scheme, mean over seeds."""
    return figures(*(scheme_motion(case, faults, seed).last(STEADY) for seed in seeds))


def exact_motion(case: Case, duration: float = SETTLING + WINDOW, **model: Any) -> Motion:
    """A whole run of the exact model; model: of `exact_parameters`. ValueError where it ends early.

    >>> float(exact_motion(DATASET_1, 1.0).time[-1])
    1.0
    """
    return _exact_motion(exact_parameters(case, **model), duration)


@lru_cache(maxsize=32)
def _exact_motion(parameters: Parameters, duration: float) -> Motion:
    run = simulate(parameters, duration, SAMPLE)
    if not run.complete:
        raise ValueError(run.reason)
    return Motion.of_trajectory(run)


def exact_figures(case: Case, **model: Any) -> dict[str, float]:
    """Steady figures of the exact model."""
    return _exact_figures(exact_parameters(case, **model))


@cache
def _exact_figures(parameters: Parameters) -> dict[str, float]:
    return figures(_exact_motion(parameters, SETTLING + WINDOW).between(SETTLING))


def three_motions(case: Case, **model: Any) -> tuple[Motion, Motion, Motion]:
    """Whole runs as printed, mended, exact; model: of `exact_parameters`."""
    printed, mended = (scheme_motion(case, faults) for faults in (PRINTED, MENDED))
    return printed, mended, exact_motion(case, **model)


def tabulated(
    figure: str,
    cases: Sequence[Case],
    seeds: tuple[int, ...] = SEEDS[:1],
    rig: dict[str, Any] = GUIDED,
) -> Array:
    """A steady figure of each case: (3, n), as printed, mended, exact with the block guided."""
    schemes = [
        [scheme_figures(case, faults, seeds)[figure] for case in cases]
        for faults in (PRINTED, MENDED)
    ]
    # case by case in memory, which is the order that means are summed in
    return np.stack([*schemes, exact_table(figure, cases, rig=rig)], axis=1).T


def exact_table(figure: str, cases: Sequence[Case], **model: Any) -> Array:
    """A steady figure of each case in the exact model: (n,)."""
    return np.array([exact_figures(case, **model)[figure] for case in cases])


def gridded(numbers: Array, stiffnesses: Sequence[float] = STIFFNESSES) -> Array:
    """Numbers (models, cases) of the `plan` as (models, stiffnesses, masses, speeds)."""
    return numbers.reshape(-1, len(stiffnesses), len(MASSES), len(SPEEDS))

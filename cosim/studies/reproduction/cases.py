"""The runs behind the claims: the study's cases, and the models they are run with."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cache
from itertools import product

import numpy as np
from stickslip import Parameters, simulate
from stickslip.reference.faults import MENDED, PRINTED, Faults
from stickslip.reference.linearised import GRAVITY, Scheme

from .motion import Motion, MotionFigures, average, figures

PRINTED_MODEL, MENDED_MODEL, EXACT_MODEL = "printed", "mended", "exact"

CYCLES = 25  # the study's run: 10 cycles to settle, 15 that count
STEADY = 0.6
LONGEST_SLIP = 1.0  # s, the study's; longer natural periods count as they are
SEEDS = (0, 1, 2)
# the exact model settles within its first seconds; the study's own speed ramp takes 10 s
SETTLING, WINDOW = 10.0, 20.0
SAMPLE = 5e-3

MASSES = (0.67, 0.896667, 1.123333, 1.35, 1.576667, 1.803333, 2.03)
STIFFNESSES = (20.17, 38.50, 53.36, 68.22)
EXTRA_STIFFNESS = 136.44
SPEEDS = (0.15, 0.25, 0.37, 0.50, 0.63, 0.82)
MASSES_ASSUMED = "seven masses evenly from 0.67 to 2.03 kg (only the ends are printed)"
STIFFNESS_ASSUMED = "53.36 N/m, midway, for the stiffness that is plotted but not stated"
LENGTH, PRETENSION = 0.20, 0.01
RIG_ASSUMED = (
    f"exact model: springs of {1e3 * LENGTH:.0f} mm stretched by {1e3 * PRETENSION:.0f} mm as "
    "installed (the pretension is not printed; without any, straight sliding is unstable), planar "
    "friction, contact radius 0.04 m, J = m a²/2, started turned by 1°, 10 s of settling, then "
    "20 s"
)
GUIDED_ASSUMED = (
    "exact model: block guided along x, 10 s of settling, then 20 s (whether a free block turns at "
    "high speed depends on the pretension, which is not printed)"
)
# rad: an ideal start would hide whether straight sliding is stable
TURNED = math.radians(1.0)
EXACT_START = " (exact: a block that only keeps its start shows the 1° of that)"
GUIDED = {"degrees_of_freedom": ("x",)}
SCATTER = 0.02
SCATTER_ASSUMED = (
    f"scatter of µ_k per strip: standard deviation {SCATTER} (not printed); mean of three seeds, "
    "last 60 % of 25 cycles"
)
# mu_k falls by two fifths over the speeds of the study: its data points are drawn, not printed
WEAKENING = 0.4
LAW_ASSUMED = (
    "µ_k falls linearly by 40 % of its value at 0.15 m/s between sliding speeds of 0.15 and 0.82 "
    "m/s (the study's four data points are not printed) and does not scatter; last 60 % of 25 "
    "cycles"
)


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

    def changed(self, **changes) -> Case:
        """This case with other numbers."""
        return replace(self, **changes)


DATASET_1 = Case()
DATASET_2 = Case(mu_s=0.065, mu_k=0.05)


def scheme(case: Case, faults: Faults, **changes) -> Scheme:
    """The study's scheme for a case; friction scatters, or depends on speed, never both."""
    changes = {"scatter": 0.0 if case.weakening else SCATTER} | changes
    return Scheme(
        mass=case.mass,
        stiffness=case.stiffness,
        speed=case.speed,
        mu_s=case.mu_s,
        mu_k=case.mu_k,
        mu_slope=case.mu_slope,
        mu_k_speed=SPEEDS[0],
        faults=faults,
        **changes,
    )


def exact_parameters(case: Case, *, pretension: float = PRETENSION, **blocks) -> Parameters:
    """The exact model for a case, planar friction; starts at rest on the surface, barely turned.

    pretension: m by which the springs are stretched as installed.
    """
    at_rest = case.mu_k + case.mu_slope * SPEEDS[0]  # mu_k is given at the slowest surface
    parameters = {
        "rig": {
            "mass": case.mass,
            "spring_length": LENGTH,
            "spring_natural_length": LENGTH - pretension,
        },
        "springs": {"stiffness": case.stiffness},
        "friction": {
            "mu_s": max(case.mu_s, at_rest) if case.weakening else case.mu_s,
            "mu_k": at_rest,
        },
        "velocity_weakening": {"linear": case.mu_slope / at_rest if at_rest else 0.0},
        "lateral_friction": {"ratio": 1.0},
        "surface": {"speed": case.speed},
        "initial": {"vx": case.speed, "phi": TURNED},
    }
    for name, values in blocks.items():
        parameters[name] = parameters.get(name, {}) | values
    if parameters["rig"].get("degrees_of_freedom") == ("x",):
        parameters["initial"] = parameters["initial"] | {"phi": 0.0}
    return Parameters.model_validate(parameters)


def longest(case: Case) -> float:
    """Time in which the study's cycles are over, s: ends a run that does not stick again.

    A cycle slips for a period or a second, and sticks for at most twice the travel to break-away
    with one spring.
    """
    period = 2.0 * math.pi * math.sqrt(case.mass / (4.0 * case.stiffness))
    stick = 2.0 * case.mu_s * case.weight / (case.stiffness * case.speed)
    return CYCLES * (max(period, LONGEST_SLIP) + stick)


@cache
def scheme_motion(case: Case, faults: Faults, seed: int = 0, cycles: int = CYCLES) -> Motion:
    """A whole run of the study's scheme."""
    run = scheme(case, faults).run(cycles=cycles, duration=longest(case), seed=seed)
    return Motion.of_scheme(run)


@cache
def exact_motion(parameters: Parameters, duration: float = SETTLING + WINDOW) -> Motion:
    """A whole run of the exact model; ValueError where it ends early."""
    run = simulate(parameters, duration, SAMPLE)
    if not run.complete:
        raise ValueError(run.reason)
    return Motion.of_trajectory(run)


@cache
def scheme_figures(case: Case, faults: Faults, seeds: tuple[int, ...] = SEEDS) -> MotionFigures:
    """Steady figures of the study's scheme, mean over seeds."""
    many = []
    for seed in seeds:
        run = scheme(case, faults).run(cycles=CYCLES, duration=longest(case), seed=seed)
        many.append(figures(Motion.of_scheme(run).last(STEADY)))
    return average(many)


def exact_figures(case: Case, *, pretension: float = PRETENSION, **blocks) -> MotionFigures:
    """Steady figures of the exact model."""
    return _exact_figures(exact_parameters(case, pretension=pretension, **blocks))


@cache
def _exact_figures(parameters: Parameters) -> MotionFigures:
    run = simulate(parameters, SETTLING + WINDOW, SAMPLE)
    if not run.complete:
        raise ValueError(run.reason)
    return figures(Motion.of_trajectory(run).since(SETTLING))


def many(call, cases, *rest) -> list:
    """``call(case, *rest)`` for each case, on two cores: the scheme's loop runs without the GIL."""
    with ThreadPoolExecutor(max_workers=2) as pool:
        return list(pool.map(lambda case: call(case, *rest), cases))


def three_models(cases: list[Case]) -> dict[str, list[MotionFigures]]:
    """Figures of each case: as printed, mended, exact with the block guided along x."""
    return {
        PRINTED_MODEL: many(scheme_figures, cases, PRINTED, SEEDS[:1]),
        MENDED_MODEL: many(scheme_figures, cases, MENDED, SEEDS[:1]),
        EXACT_MODEL: [exact_figures(case, rig=GUIDED) for case in cases],
    }


#: All of the series have the second set's friction, falling with the sliding speed.
CASE = DATASET_2.changed(weakening=WEAKENING)
ASSUMED = (LAW_ASSUMED, MASSES_ASSUMED, STIFFNESS_ASSUMED)

Grid = dict[str, np.ndarray]  # model -> number (stiffness, mass, speed)


def cases(stiffnesses: Sequence[float] = STIFFNESSES) -> list[Case]:
    """The combinations, the speed running fastest."""
    return [
        CASE.changed(stiffness=k, mass=m, speed=v)
        for k, m, v in product(stiffnesses, MASSES, SPEEDS)
    ]


def grid(
    number: Callable[[Case, MotionFigures], float], stiffnesses: Sequence[float] = STIFFNESSES
) -> Grid:
    """A number of every combination's steady motion, as each of the three models has it."""
    every = cases(stiffnesses)
    shape = len(stiffnesses), len(MASSES), len(SPEEDS)
    return {
        model: np.reshape([number(*pair) for pair in zip(every, figures, strict=True)], shape)
        for model, figures in three_models(every).items()
    }

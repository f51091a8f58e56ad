"""The study's cases, the models they are run with, and every number that it prints of them.

What is computed from its numbers is not one of them: a `Row` has a place of its own for it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cache
from itertools import product

import numpy as np
from stickslip import Parameters, simulate
from stickslip.reference.linearised import GRAVITY, Scheme
from stickslip.reference.scheme_errors import MENDED, PRINTED, Faults

from cosim.studies.reproduction.motion import Motion, MotionFigures, average, figures

Grid = dict[str, np.ndarray]  # model -> number (stiffness, mass, speed)

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
ASSUMED = (LAW_ASSUMED, MASSES_ASSUMED, STIFFNESS_ASSUMED)


@dataclass(frozen=True)
class Printed:
    """A number of the study, or a range between two of its numbers.

    place: section, then table, figure or equation. ValueError for a number without its place.
    """

    value: float | str
    place: str

    def __post_init__(self) -> None:
        if not self.place:
            raise ValueError(f"{self.value}: where does the study print it?")

    @property
    def number(self) -> float:
        """The value; TypeError where the study prints words."""
        if isinstance(self.value, str):
            raise TypeError(f"{self.value!r} ({self.place}) is no number")
        return self.value


def _at(place: str, **values: float | str) -> dict[str, Printed]:
    return {name: Printed(value, place) for name, value in values.items()}


#: K/k, by treatment and entry; what is not listed is printed as 0
MATRICES = {
    "zero": {
        (0, 0): Printed(4.0, "§4.2.2, eq. 4.16"), (2, 2): Printed(0.00117, "§4.2.2, eq. 4.16"),
    },
    "constant": {
        (0, 0): Printed(3.99878, "§4.2.2, eq. 4.17"), (0, 1): Printed(0.0698, "§4.2.2, eq. 4.17"),
        (1, 1): Printed(0.00122, "§4.2.2, eq. 4.17"), (2, 2): Printed(0.00117, "§4.2.2, eq. 4.17"),
    },
    "opposed": {
        (0, 0): Printed(3.99878, "§4.2.2, eq. 4.18"), (1, 1): Printed(0.00122, "§4.2.2, eq. 4.18"),
        (1, 2): Printed(-0.00119, "§4.2.2, eq. 4.18"),
        (2, 2): Printed(0.00117, "§4.2.2, eq. 4.18"),
    },
}  # fmt: skip
#: Temperature of the belt after one pass, degC, by its length, m
TEMPERATURES = {
    length: Printed(value, "§3.3.1, table 3.5")
    for length, value in ((1.0, -7.9435), (2.0, -7.9583), (3.0, -7.9693), (4.0, -7.9774))
}
STUDY = {
    **_at("§3.3.1, eq. 3.1", friction_force=4.1261),
    **_at("§3.3.1, eq. 3.4", rise_in_a_pass=0.0748),
    **_at("§3.3.3, §6.1", camera_mK=70.0),
    **_at("§4.3.1, fig. 4.6", rotation_sets_in="after 10"),
    **_at("§4.3.2, §4.3.3", minutes_updated="5 to 8", seconds_others="20 to 30"),
    **_at("§4.5, fig. 4.14", stiff_displacement=0.0),
    **_at("§4.6.2", least_hold=6.67),
    **_at("§4.6.3, fig. 4.18c", mean_x_measured=0.02, mean_x_dataset_2=0.004),
    **_at("§4.6.3", percent_in_slip="90 to 95 %"),
    **_at("§4.6.4", rotation_measured=20.0),
    **_at("§4.6.4, eq. 4.26", rotation_dataset_1=150.0, swing_dataset_1=880.0,
          rotation_dataset_2=15.0, swing_dataset_2=56.0),
    **_at("§5.1", runs_with_a_jump="three"),
    **_at("§5.4, fig. 5.11", oscillations_measured=34.0, oscillations_at_1=29.0),
    **_at("§6.2, fig. 6.4b", mean_y_measured=0.01),
    **_at("executive summary", least_mu_k=0.05, largest_mu_k=0.11),
}  # fmt: skip


def printed_numbers() -> list[Printed]:
    """Every number of the study that is compared with, each with its place."""
    entries = (one for matrix in MATRICES.values() for one in matrix.values())
    return [*entries, *TEMPERATURES.values(), *STUDY.values()]


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
#: All of the series have the second set's friction, falling with the sliding speed.
CASE = DATASET_2.changed(weakening=WEAKENING)


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


def exact_parameters(case: Case, *, pretension: float = PRETENSION, **tables) -> Parameters:
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
    for name, values in tables.items():
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


def exact_figures(case: Case, *, pretension: float = PRETENSION, **tables) -> MotionFigures:
    """Steady figures of the exact model."""
    return _exact_figures(exact_parameters(case, pretension=pretension, **tables))


@cache
def _exact_figures(parameters: Parameters) -> MotionFigures:
    run = simulate(parameters, SETTLING + WINDOW, SAMPLE)
    if not run.complete:
        raise ValueError(run.reason)
    return figures(Motion.of_trajectory(run).since(SETTLING))


def many(call, cases, *rest) -> list:
    """``call(case, *rest)`` for each case, on two cores: the scheme's loop runs without the GIL.

    Threads, not `cosim.processes`: runs are cached for the claims that follow, and a call may be a
    closure, which no process can be sent.
    """
    with ThreadPoolExecutor(max_workers=2) as pool:
        return list(pool.map(lambda case: call(case, *rest), cases))


def three_models(cases: list[Case]) -> dict[str, list[MotionFigures]]:
    """Figures of each case: as printed, mended, exact with the block guided along x."""
    return {
        PRINTED_MODEL: many(scheme_figures, cases, PRINTED, SEEDS[:1]),
        MENDED_MODEL: many(scheme_figures, cases, MENDED, SEEDS[:1]),
        EXACT_MODEL: [exact_figures(case, rig=GUIDED) for case in cases],
    }


def cases(stiffnesses: Sequence[float] = STIFFNESSES) -> list[Case]:
    """Combinations of stiffness, mass and speed in the study's series, speed running fastest."""
    return [
        CASE.changed(stiffness=k, mass=m, speed=v)
        for k, m, v in product(stiffnesses, MASSES, SPEEDS)
    ]


def grid(
    number: Callable[[Case, MotionFigures], float], stiffnesses: Sequence[float] = STIFFNESSES
) -> Grid:
    """A number of every combination's steady motion, as each of the three models has it."""
    series = cases(stiffnesses)
    shape = len(stiffnesses), len(MASSES), len(SPEEDS)
    return {
        model: np.reshape([number(*pair) for pair in zip(series, figures, strict=True)], shape)
        for model, figures in three_models(series).items()
    }

"""A block that always slides on the belt, with at most one term missing from the plain model.

    m x'' = -K x + mu m g + F,   sliding speed v = v_belt - x' > 0

F is one of four: c v of a film, -d x' against the frame, -4 k_3 x^3 of four springs, -a mu m g v of
weakening friction. Without it x is a cosine about mu m g / K: linear in mu and the starts, so that
the size of a term, in noise units, is exact least squares.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from .method import Regression

Array = NDArray[np.float64]

GRAVITY = 9.81
STIFFNESS = 4 * 20.17  # N/m, of four springs
FRICTION = 0.12
NOISE = 2e-4  # m
RATE, DURATION = 100.0, 8.0  # 1/s, s
SWING = 0.6  # amplitude of the block's speed, as part of the belt's
SETTINGS = [(mass, speed) for mass in (0.67, 1.2) for speed in (0.1, 0.2, 0.35)]
POWER = 6  # of the averages' weights (1 - s^2)^POWER
WIDTH = 1.2  # windows of the averages, in periods: of 0.6 to 1.2 the one with the most power
HELD_OUT = (1, 5)  # runs that a fit does not see

# Force of a term of strength 1 on a block of a mass, from place, speed and sliding speed.
Force = Callable[[float, float, float, float], float]
TERMS: dict[str, Force] = {
    "film_drag": lambda mass, x, v, sliding: sliding,
    "structural_damping": lambda mass, x, v, sliding: -v,
    "spring_hardening": lambda mass, x, v, sliding: -4 * x**3,
    "velocity_weakening": lambda mass, x, v, sliding: -FRICTION * mass * GRAVITY * sliding,
}
STARTS = {
    "film_drag": 0.02,
    "structural_damping": 0.02,
    "spring_hardening": 2e3,
    "velocity_weakening": 0.02,
}


@dataclass(frozen=True)
class Run:
    """One run: set points, times (s) and place (m), (n,) each."""

    mass: float
    speed: float
    t: Array
    x: Array

    @property
    def omega(self) -> float:
        """Angular frequency, 1/s."""
        return float(np.sqrt(STIFFNESS / self.mass))


def move(mass: float, speed: float, phase: float, term: str, strength: float) -> Run:
    """A run without noise; ValueError where the block does not slide throughout."""
    force = TERMS.get(term)
    omega = np.sqrt(STIFFNESS / mass)
    rest, swing = FRICTION * mass * GRAVITY / STIFFNESS, SWING * speed / omega

    def rate(_: float, state: Array) -> list[float]:
        x, v = state
        push = strength * force(mass, x, v, speed - v) if force else 0.0
        return [v, (push - STIFFNESS * x) / mass + FRICTION * GRAVITY]

    t = np.arange(int(RATE * DURATION)) / RATE
    start = [rest + swing * np.cos(phase), swing * omega * np.sin(phase)]
    done = solve_ivp(rate, (0.0, t[-1]), start, "DOP853", t, rtol=1e-9, atol=1e-12)
    if np.any(done.y[1] >= speed):
        raise ValueError(f"{term} of {strength:g}: the block does not slide throughout")
    return Run(mass, speed, t, done.y[0])


def campaign(random: np.random.Generator, term: str = "", strength: float = 0.0) -> list[Run]:
    """All runs without noise, each from a phase of its own."""
    phases = random.uniform(0.0, 2 * np.pi, len(SETTINGS))
    pairs = zip(SETTINGS, phases, strict=True)
    return [move(mass, speed, phase, term, strength) for (mass, speed), phase in pairs]


def size(runs: list[Run]) -> float:
    """Root mean square, in noise units, of what no mu and no starts make good."""
    starts = len(runs) * 2
    rows, places = [], []
    for j, run in enumerate(runs):
        columns = np.zeros((run.t.size, 1 + starts))
        columns[:, 0] = run.mass * GRAVITY / STIFFNESS
        columns[:, 1 + 2 * j] = np.cos(run.omega * run.t)
        columns[:, 2 + 2 * j] = np.sin(run.omega * run.t)
        rows.append(columns)
        places.append(run.x)
    plain, x = np.vstack(rows), np.concatenate(places)
    left = x - plain @ np.linalg.lstsq(plain, x, rcond=None)[0]
    return float(np.sqrt(np.mean(left**2)) / NOISE)


def of_size(random: np.random.Generator, term: str, wanted: float) -> list[Run]:
    """A campaign in which a term has a size; the response to it is all but linear."""
    seed, strength = int(random.integers(2**32)), STARTS[term]
    for _ in range(8):
        runs = campaign(np.random.default_rng(seed), term, strength)
        found = size(runs)
        if abs(found / wanted - 1.0) < 0.01:
            return runs
        strength *= wanted / found
    raise ValueError(f"{term}: no strength for a size of {wanted:g}")


@cache
def motion(term: str, wanted: float, seed: int) -> list[Run]:
    """A campaign without noise by a seed: with a term of a size, or with nothing missing ("")."""
    random = np.random.default_rng([seed, sorted(TERMS).index(term) if term else len(TERMS)])
    return of_size(random, term, wanted) if term else campaign(random)


def measured(runs: list[Run], random: np.random.Generator) -> list[Run]:
    """The same as a tracker writes it."""
    return [
        Run(run.mass, run.speed, run.t, run.x + random.normal(0.0, NOISE, run.x.size))
        for run in runs
    ]


def regression(runs: list[Run], regimes: int = 4, width: float = WIDTH) -> Regression:
    """Smoothed acceleration residuals, their noise independent and of one standard deviation.

    The weak form: the equation of motion averaged with weights w = (1 - s^2)^6 over windows that do
    not overlap, derivatives moved over to the weights (Messenger & Bortz, J. Comput. Phys. 443,
    2021). For the plain model it has no bias, unlike derivatives of a smoothed path.

    width : of a window, in periods. Regimes: equal numbers of windows by mean sliding speed.
    """
    y, plain, mean_speed = [], [], []
    library: dict[str, list[float]] = {name: [] for name in TERMS}
    for run in runs:
        count = round(width * 2 * np.pi / run.omega * RATE)
        weight, slope, bend = weights(count)
        deviation = NOISE * float(np.linalg.norm(bend + run.omega**2 * weight))
        for first in range(0, run.t.size - count + 1, count):
            x = run.x[first : first + count]
            place, v = float(weight @ x), float(-slope @ x)
            y.append((bend @ x + run.omega**2 * place) / deviation)
            plain.append(GRAVITY / deviation)
            mean_speed.append(run.speed - v)
            cubed = float(np.cbrt(weight @ x**3))  # so that a term's own x^3 is the mean of x^3
            for name, force in TERMS.items():
                push = force(run.mass, cubed, v, run.speed - v)
                library[name].append(push / run.mass / deviation)
    edges = np.quantile(mean_speed, np.linspace(0, 1, regimes + 1)[1:-1])
    return Regression(
        np.array(y),
        np.array(plain)[:, None],
        {name: np.array(column) for name, column in library.items()},
        np.digitize(mean_speed, edges),
    )


def weights(count: int) -> tuple[Array, Array, Array]:
    """(count,) each: weights that sum to one, and their first and second time derivatives.

    With them w . x' = -w' . x and w . x'' = w'' . x. The sums have the values of the integrals all
    but exactly, as w and so many of its derivatives vanish at both ends (Euler and Maclaurin).
    """
    s = -1.0 + (2.0 * np.arange(count) + 1.0) / count
    inside, per_second, n = 1.0 - s**2, 2.0 * RATE / count, POWER
    w = inside**n
    slope = -2 * n * s * inside ** (n - 1) * per_second
    bend = (4 * n * (n - 1) * s**2 * inside ** (n - 2) - 2 * n * inside ** (n - 1)) * per_second**2
    return w / w.sum(), slope / w.sum(), bend / w.sum()


def write(runs: list[Run], folder: Path) -> None:
    """The campaign as files for `stickslip gap`."""
    lines = [
        'name = "sliding"',
        "[rig]",
        "spring_length = 0.2",
        "spring_natural_length = 0.2",
        'degrees_of_freedom = ["x"]',
        "[noise]",
        f"x = {NOISE}",
    ]
    for number, run in enumerate(runs):
        file = f"run{number + 1:02d}.csv"
        table = np.column_stack([run.t, run.x])
        np.savetxt(folder / file, table, "%.7f", ",", header="t,x", comments="")
        lines += [
            "[[run]]",
            f'file = "{file}"',
            f"mass = {run.mass}",
            f"stiffness = {STIFFNESS / 4}",
            f"surface_speed = {run.speed}",
            f"hold_out = {str(number in HELD_OUT).lower()}",
        ]
    (folder / "campaign.toml").write_text("\n".join(lines) + "\n", encoding="utf-8")

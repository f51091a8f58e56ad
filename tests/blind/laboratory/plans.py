"""Rigs and runs: what an experimenter builds, states and sets, and what it truly is."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .apparatus import GRAVITY, Record, apparatus
from .laws import Reference

RIGS = ("guided", "bench", "planar")
SPRING_ERROR, MASS_ERROR, SPEED_ERROR = 0.01, 0.002, 0.01  # relative standard deviations


@dataclass(frozen=True)
class Run:
    """One run: what is stated, and the record of what is true, nothing hidden in it yet."""

    mass: float  # kg, stated
    stiffness: float  # N/m of one spring, stated
    speed: float  # m/s, stated
    start: tuple[float, float, float]  # m, m, rad
    hold_out: bool
    plain: Record


@dataclass(frozen=True)
class Plan:
    """A campaign's rig and runs. Lengths in m."""

    rig: str
    contact: str
    spring_length: float
    natural_length: float
    attachment_radius: float
    contact_radius: float
    duration: float  # s, of every run
    runs: tuple[Run, ...]

    @property
    def guided(self) -> bool:
        return self.rig != "planar"

    @property
    def reference(self) -> Reference:
        """The campaign's typical scales, from what is true."""
        records = [run.plain for run in self.runs]
        speeds = [float(p["belt_speed"]) for p in records]
        mass = float(np.median([p["mass"] for p in records]))
        load = mass * GRAVITY
        pulls = [p["mu_s"] * p["mass"] * GRAVITY / (4 * p["stiffness"]) for p in records]
        return Reference(
            speed=float(np.median(speeds)),
            fastest=max(speeds),
            mass=mass,
            load=load,
            friction=float(records[0]["mu_k"]) * load,
            deflection=float(np.median(pulls)),
            travel=min(speeds) * self.duration,
            longest=max(speeds) * self.duration,
            duration=self.duration,
            contact_radius=self.contact_radius,
        )


def tidy(value: float, digits: int = 3) -> float:
    """A number as people write it."""
    return float(f"{value:.{digits}g}")


def draw_scales(rng: np.random.Generator, rig: str) -> tuple[float, float, float, float]:
    """mass kg, angular frequency 1/s, mu_s, mu_k whose static deflection suits the rig."""
    least, most = (1.5e-3, 8e-3) if rig == "bench" else (8e-3, 4.0e-2)
    while True:
        mu_k = float(rng.uniform(0.08, 0.3))
        mu_s = mu_k * float(rng.uniform(1.25, 1.9))
        period = rng.uniform(0.15, 0.35) if rig == "bench" else rng.uniform(0.35, 0.9)
        omega = 2 * np.pi / float(period)
        if least < mu_s * GRAVITY / omega**2 < most:
            break
    mass = float(rng.uniform(0.05, 0.3) if rig == "bench" else rng.uniform(0.3, 1.5))
    return tidy(mass), omega, mu_s, mu_k


def draw_settings(
    rng: np.random.Generator, mass: float, stiffness: float, pace: float, loads: bool
) -> list[tuple[float, float, float]]:
    """Mass, stiffness and speed of 5 to 8 runs: all speeds with the first block, some with others.

    pace : m/s at which a block swings as far as static friction exceeds kinetic
    loads : three masses, far apart
    """
    factors = rng.uniform((0.3, 0.9, 2.2), (0.5, 1.4, 3.5))
    speeds = [tidy(pace * float(f), 2) for f in factors]
    masses = [tidy(mass * float(f)) for f in ((1.6, 2.6) if loads else (rng.uniform(1.5, 2.2),))]
    settings = [(mass, stiffness, speed) for speed in speeds]
    settings += [(m, stiffness, speeds[int(j)]) for m in masses for j in rng.permutation(3)[:2]]
    if not loads and rng.random() < 0.6:
        other = tidy(stiffness * float(rng.uniform(1.5, 2.5)))
        settings += [(mass, other, speeds[int(j)]) for j in rng.permutation(3)[:2]]
    if len(settings) < 8 and rng.random() < 0.5:  # one of them again
        settings.append(settings[int(rng.integers(3))])
    return settings


def pick_held_out(rng: np.random.Generator, settings: list[tuple[float, float, float]]) -> set[int]:
    """One or two runs without which every mass, spring and speed is still there."""
    wanted = int(rng.integers(1, 3))
    held: set[int] = set()
    for j in rng.permutation(len(settings)):
        left = [s for i, s in enumerate(settings) if i not in held | {int(j)}]
        if len(held) < wanted and all(
            {s[c] for s in left} == {s[c] for s in settings} for c in range(3)
        ):
            held.add(int(j))
    return held


def draw_contact(rng: np.random.Generator, contact: str, rig: str) -> dict[str, float]:
    """Numbers of a contact's transition and presliding. SI units."""
    finer = 0.4 if rig == "bench" else 1.0
    creep = float(rng.uniform(3e-4, 1e-3)) * finer
    return {
        "presliding": float(rng.uniform(2e-5, 1e-4)) * finer,
        "fall_speed": float(rng.uniform(1e-3, 8e-3)) * finer
        + (creep if contact == "smooth" else 0),
        "fall_power": float(rng.choice((1.0, 2.0))),
        "bristle_damping": float(rng.uniform(0.2, 0.7)),
        "elastic_share": float(rng.uniform(0.5, 0.8)),
        "creep_speed": creep,
    }


def draw_plan(
    rng: np.random.Generator,
    rig: str,
    contact: str,
    *,
    scatter: float = 0.0,
    loads: bool = False,
    aside: bool | None = None,
    slow: bool = False,
) -> Plan:
    """A rig with 5 to 8 runs.

    Parameters
    ----------
    rig : one of RIGS: guided along x, a small guided one, or free in the plane
    scatter : relative standard deviation of mu from run to run
    loads : masses far apart
    aside : starts off the middle in y and turned, so that the block swings there too
    slow : no speed so high that a little damping ends the sticking
    """
    mass, omega, mu_s, mu_k = draw_scales(rng, rig)
    stiffness = tidy(mass * omega**2 / 4, 4)
    free = rig == "planar"
    length = tidy(float(rng.uniform(0.15, 0.3)), 2)
    slackless = 1.0 if not free and rng.random() < 0.5 else float(rng.uniform(0.78, 0.87))
    radius = tidy(float(rng.uniform(0.03, 0.06)), 2)
    aside = bool(free and (rng.random() < 0.4 if aside is None else aside))
    numbers = draw_contact(rng, contact, rig)
    pace = (mu_s - mu_k) * GRAVITY / omega * (0.55 if slow else 1.0)
    settings = draw_settings(rng, mass, stiffness, pace, loads)
    lengths = length, tidy(length * slackless, 2), radius
    last = (10, 14) if rig == "bench" else (14, 26)
    return assemble(
        rng, rig, contact, settings, (mu_s, mu_k), lengths, numbers, scatter, aside, last
    )


def assemble(
    rng: np.random.Generator,
    rig: str,
    contact: str,
    settings: list[tuple[float, float, float]],
    mu: tuple[float, float],
    lengths: tuple[float, float, float],
    numbers: Mapping[str, float | NDArray],
    scatter: float,
    aside: bool,
    last: tuple[float, float],
) -> Plan:
    """The runs of a rig's settings, with errors of what is stated, starts and runs held out.

    Parameters
    ----------
    settings : mass, stiffness and speed of each run, as stated
    mu : static and kinetic
    lengths : springs installed, springs natural, radius of the contact; m
    numbers : of the contact, by field of the record
    scatter, aside : as of `draw_plan`
    last : shortest and longest that runs last, s
    """
    (mu_s, mu_k), (length, natural, radius), free = mu, lengths, rig == "planar"
    held = pick_held_out(rng, settings)
    wrong = {value: 1 + SPRING_ERROR * float(rng.normal()) for _, value, _ in settings}
    weighed = {value: 1 + MASS_ERROR * float(rng.normal()) for value, _, _ in settings}
    runs = []
    for j, (m, k, speed) in enumerate(settings):
        plain = apparatus(
            m * weighed[m],
            k * wrong[k],
            speed * (1 + SPEED_ERROR * float(rng.normal())),
            mu_s,
            mu_k,
            contact=contact,
            guided=not free,
            spring_length=length,
            natural_length=natural,
            attachment_radius=tidy(radius * 1.25, 2),
            contact_radius=radius,
        )
        for name, value in numbers.items():
            plain[name] = value
        plain["scatter"] = 1 + scatter * float(np.clip(rng.normal(), -2.5, 2.5))
        plain["phase"] = rng.uniform(0, 1)
        start = float(rng.uniform(0.2, 0.8)) * mu_k * GRAVITY * m / (4 * k)
        side = float(rng.uniform(3e-3, 8e-3) * rng.choice((-1, 1))) if aside else 0.0
        turn = float(rng.uniform(-0.08, 0.08)) if aside else 0.0
        runs.append(Run(m, k, speed, (start, side, turn), j in held, plain))
    return Plan(
        rig=rig,
        contact=contact,
        spring_length=length,
        natural_length=natural,
        attachment_radius=tidy(radius * 1.25, 2),
        contact_radius=radius,
        duration=float(np.round(rng.uniform(*last))),
        runs=tuple(runs),
    )

"""Test plans: which masses, springs and speeds a campaign has, and how each run starts."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .simulator.hidden import Hidden, State

MASSES = (0.67, 0.87, 1.07, 1.32, 1.5, 1.78, 2.03)
STIFFNESSES = (20.17, 38.5, 68.22)
PLANS = ("example", "slow", "drawn", "both_ways", "single")


@dataclass(frozen=True)
class Run:
    """One run as planned: the block's properties before any effect, and its start."""

    hidden: Hidden
    start: State
    hold_out: bool


@dataclass(frozen=True)
class Plan:
    """Runs, and how they are recorded."""

    name: str
    runs: tuple[Run, ...]
    line: bool  # the rig lets the block move along x only
    duration: float = 20.0  # s


def swing_speed(p: Hidden) -> float:
    """Surface speed above which a block that starts at rest swings for ever, m/s."""
    return p.mu_k * 9.81 * math.sqrt(p.mass / (4 * p.stiffness))


def conditions(name: str, rng: np.random.Generator, base: Hidden) -> list[tuple]:
    """Six rows of mass, stiffness, speed, hold out."""
    if name in ("example", "slow"):
        a, b, c = (0.06, 0.2, 0.4) if name == "example" else (0.008, 0.04, 0.12)
        rows = [(0.87, a, 0), (0.87, b, 1), (1.5, a, 0), (1.5, b, 0), (1.5, c, 1), (0.87, c, 0)]
        return [(m, 38.5, v, bool(h)) for m, v, h in rows]
    light, heavy = sorted(rng.choice(MASSES, 2, replace=False))
    soft, hard = sorted(rng.choice(STIFFNESSES, 2, replace=False))
    k = float(rng.choice((soft, hard)))
    if name == "single":
        v = round(rng.uniform(0.2, 0.7) * swing_speed(base._replace(mass=light, stiffness=k)), 3)
        return [(light, k, v, i in (1, 4)) for i in range(6)]
    two_springs = rng.random() < 0.3
    rows = []
    for i in range(6):
        m, spring = (light, heavy)[i // 3], (soft, hard)[i // 3] if two_springs else k
        part = (rng.uniform(0.12, 0.3), rng.uniform(0.35, 0.6), rng.uniform(0.7, 1.3))[i % 3]
        v = round(part * swing_speed(base._replace(mass=m, stiffness=spring)), 3)
        sign = -1.0 if name == "both_ways" and i % 2 else 1.0
        rows.append((m, spring, sign * v, i in (1, 5)))
    return rows


def start_of(p: Hidden, rng: np.random.Generator, how: str) -> State:
    """At rest, pulled out and let go, or riding on the surface somewhere before the break-away."""
    reach = p.mu_s * 9.81 * p.mass / (4 * p.stiffness)
    if how == "rest":
        return State()
    if how == "pulled":
        # not so far that the block overtakes the surface on its way back: there the constant part
        # of a film's drag would show, and drag and damping could be told apart at one speed
        return State(x=float(rng.uniform(1.5, 2.1)) * reach * math.copysign(1, p.speed))
    return State(x=float(rng.uniform(-0.5, 0.8)) * reach * math.copysign(1, p.speed), vx=p.speed)


def draw_plan(name: str, rng: np.random.Generator, line: bool) -> Plan:
    """A plan with friction and springs drawn; `example` and `slow` start at rest half the time."""
    mu_k = float(rng.uniform(0.1, 0.28))
    if name in ("example", "slow"):
        mu_k = float(rng.uniform(0.14, 0.22))
    base = Hidden(mu_k=mu_k, mu_s=mu_k * float(rng.uniform(1.2, 1.6)))
    if name not in ("example", "slow"):
        base = base._replace(natural=round(float(rng.uniform(0.15, 0.185)), 3))
    how = "riding"
    if name in ("example", "slow"):
        how = str(rng.choice(("rest", "riding")))
    elif name == "single":
        how = "pulled"
    runs = []
    for mass, stiffness, speed, hold_out in conditions(name, rng, base):
        p = base._replace(
            mass=float(mass),
            stiffness=float(stiffness),
            speed=float(speed),
            inertia=0.5 * float(mass) * base.radius**2,
        )
        runs.append(Run(p, start_of(p, rng, how), hold_out))
    return Plan(name, tuple(runs), line)

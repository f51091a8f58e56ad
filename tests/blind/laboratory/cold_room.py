"""Rigs, runs and cameras of the Iwan contact's suites, larger and slower than those of `plans`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .apparatus import GRAVITY
from .elements import SPREADS, spread_elements
from .plans import Plan, assemble, tidy
from .recording import Tracker, draw_tracker
from .size import Size

NOISE = (1e-4, 4e-4)  # m
LIGHTEST, HEAVIEST = 0.3, 2.0  # kg


def draw_iwan(rng: np.random.Generator, creeping: float | None) -> dict[str, float | NDArray]:
    """Numbers of an Iwan contact, from nearly ideal (0) to creeping (1); anywhere for None."""
    c = float(rng.uniform(0, 1) if creeping is None else creeping)
    spread = str(rng.choice(SPREADS))
    width = float(
        rng.uniform(*{"even": (0.5, 1), "lognormal": (0.3, 0.8), "power": (0.3, 1)}[spread])
    )
    give = 4e-6 * 40**c * float(rng.uniform(0.8, 1.25))
    return {
        "presliding": give,
        "fall_speed": 1e-3 * 6**c * float(rng.uniform(0.8, 1.25)),
        "fall_power": float(rng.choice((1.0, 2.0))),
        "rebuild_time": 2e-3 * 6**c * float(rng.uniform(0.8, 1.25)),
        "slider_creep": 5e-4 * c**2,
        **spread_elements(give, spread, width, float(rng.choice((1.0, 4.0)))),
    }


def draw_settings(
    rng: np.random.Generator, stiffness: float, pace: float, masses: list[float], speeds: int
) -> list[tuple[float, float, float]]:
    """Mass, stiffness and speed of 5 to 9 runs; all speeds with the first block."""
    edges = np.geomspace(0.3, 3.0, speeds + 1)
    paces = [
        tidy(pace * float(rng.uniform(a, b)), 2) for a, b in zip(edges, edges[1:], strict=False)
    ]
    settings = [(masses[0], stiffness, speed) for speed in paces]
    for mass in masses[1:]:
        settings += [(mass, stiffness, paces[int(j)]) for j in rng.permutation(speeds)[:2]]
    number = int(rng.integers(max(5, len(settings)), 10))
    other = tidy(stiffness * float(rng.uniform(1.4, 2.2)))
    while len(settings) < number:
        mass, _, speed = settings[int(rng.integers(len(settings)))]
        settings.append((mass, other if rng.random() < 0.4 else stiffness, speed))
    return settings


def draw_room(
    rng: np.random.Generator,
    rig: str,
    *,
    scatter: float = 0.0,
    loads: bool = False,
    aside: bool | None = None,
    slow: bool = False,
    single: bool = False,
    creeping: float | None = None,
) -> Plan:
    """A rig with 5 to 9 runs over 2 to 4 speeds and 1 to 3 masses.

    Parameters
    ----------
    rig : guided along x, or free in the plane ("planar")
    single : one speed, one mass and one spring throughout
    loads, aside, slow : as of `plans.draw_plan`; creeping: as of `draw_iwan`
    """
    while True:
        mu_k = float(rng.uniform(0.08, 0.3))
        mu_s = mu_k * float(rng.uniform(1.25, 1.9))
        omega = 2 * np.pi / float(rng.uniform(0.4, 1.0))
        if 8e-3 < mu_s * GRAVITY / omega**2 < 4e-2:
            break
    number = 1 if single else 3 if loads else int(rng.choice((1, 2, 3), p=(0.2, 0.5, 0.3)))
    ratios = [1.0, float(rng.uniform(1.5, 2.0)), float(rng.uniform(2.3, 3.0))][:number]
    first = float(rng.uniform(LIGHTEST, HEAVIEST / ratios[-1]))
    masses = [tidy(first * float(ratio)) for ratio in rng.permutation(ratios)]
    stiffness = tidy(first * omega**2 / 4, 4)
    pace = (mu_s - mu_k) * GRAVITY / omega * (0.55 if slow else 1.0)
    if single:
        settings = [(masses[0], stiffness, tidy(pace * float(rng.uniform(0.4, 1.0)), 2))]
        settings *= int(rng.integers(5, 8))
    else:
        settings = draw_settings(rng, stiffness, pace, masses, int(rng.integers(2, 5)))
    length = tidy(float(rng.uniform(0.15, 0.3)), 2)
    slackless = 1.0 if rig == "guided" and rng.random() < 0.5 else float(rng.uniform(0.78, 0.87))
    return assemble(
        rng,
        rig,
        "iwan",
        settings,
        (mu_s, mu_k),
        (length, tidy(length * slackless, 2), tidy(float(rng.uniform(0.03, 0.06)), 2)),
        draw_iwan(rng, creeping),
        scatter,
        bool(rig == "planar" and (rng.random() < 0.4 if aside is None else aside)),
        (15, 30),
    )


def room_tracker(rng: np.random.Generator, planar: bool) -> Tracker:
    """A camera of 50 to 200 frames a second; the rest is as `recording.draw_tracker` has it."""
    drawn = draw_tracker(rng, planar, False)
    rate, noise = float(rng.choice((50, 60, 90, 100, 125, 150, 200))), float(rng.uniform(*NOISE))
    return replace(
        drawn,
        rate=rate,
        noise=float(f"{noise:.2g}"),
        jitter=drawn.jitter * drawn.rate / rate,
        zero=noise * float(rng.choice((0.0, 2.0))),
    )


def room_camera(
    sizes: list[Size], tracker: Tracker, wanted: Sequence[float]
) -> tuple[list[Size], Tracker]:
    """A camera of another noise within NOISE, where what is hidden is too small or too large."""
    low, high = wanted
    least = min((s.size for s in sizes), default=low)
    most = max((s.size for s in sizes), default=low)
    gain = 1.05 * low / least if least < low else min(1.0, 0.95 * high / most)
    noise = float(f"{np.clip(tracker.noise / gain, *NOISE):.2g}")
    gain = tracker.noise / noise
    sizes = [Size(s.size * gain, s.raw * gain, s.samples) for s in sizes]
    return sizes, replace(tracker, noise=noise)

"""The orders of the Iwan contact's suites: one effect, none, two, alike, unknown, faults."""

from __future__ import annotations

import numpy as np

from .campaign import Order
from .fresh_kinds import KINDS
from .fresh_laws import LAWS
from .recording import FRESH_FAULTS

SIZES = (4.0, 25.0)
# what is hidden, effects that no data of one speed and one mass can tell from one another
TWINS = (
    ("film_drag", ("film_drag", "structural_damping")),
    ("run_in", ("run_in", "thermal_weakening")),
    ("structural_damping", ("film_drag", "structural_damping")),
    ("thermal_weakening", ("run_in", "thermal_weakening")),
)


def cycled(rng: np.random.Generator, names, count: int) -> list[str]:
    """count names, each as often as any other, in an order of the seed's."""
    names = list(names)
    drawn: list[str] = []
    while len(drawn) < count:
        drawn += [names[int(j)] for j in rng.permutation(len(names))]
    return drawn[:count]


def iwan_one(rng: np.random.Generator, count: int = 60) -> list[Order]:
    """One effect, mu scattered by 0 to 2 % from run to run."""
    scatters = rng.choice((0.0, 0.005, 0.01, 0.02), count)
    names = cycled(rng, LAWS, count)
    return [
        Order("iwan", (name,), scatter=float(s), sizes=SIZES)
        for name, s in zip(names, scatters, strict=True)
    ]


def iwan_nothing(rng: np.random.Generator, count: int = 60) -> list[Order]:
    """Nothing hidden; contacts from nearly ideal to creeping, scatters of 0 to 5 %."""
    scatters = rng.choice((0.0, 0.01, 0.02, 0.03, 0.05), count)
    levels = (rng.permutation(count) + 0.5) / count
    return [
        Order("iwan", scatter=float(s), creeping=float(c))
        for s, c in zip(scatters, levels, strict=True)
    ]


def iwan_alike(rng: np.random.Generator, count: int = 10) -> list[Order]:
    """One effect on a design where another of the catalogue would do exactly the same."""
    return [  # on a contact with little give: what a wide one gives is not the same for both
        Order("iwan", (hidden,), alike=alike, sizes=SIZES, creeping=0.0)
        for hidden, alike in (TWINS[j % len(TWINS)] for j in range(count))
    ]


def iwan_unknown(rng: np.random.Generator, count: int = 20) -> list[Order]:
    """Kinds that no catalogue holds, others than the laboratory's."""
    kinds = cycled(rng, KINDS, count)
    return [
        Order("iwan", kind=kind, scatter=float(rng.choice((0.0, 0.01))), sizes=SIZES)
        for kind in kinds
    ]


def iwan_faults(rng: np.random.Generator, count: int = 20) -> list[Order]:
    """Faults of the measurement, every second one in some runs only."""
    names = cycled(rng, FRESH_FAULTS, count)
    large = {"measurement.scale": (2.0, 25.0), "measurement.clock": (2.0, 25.0)}
    return [
        Order("iwan", fault=name, sizes=large.get(name, SIZES), some_runs=bool(j % 2))
        for j, name in enumerate(names)
    ]

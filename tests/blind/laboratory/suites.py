"""The benchmarks: for every suite the orders of its campaigns, by a seed and a count."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from itertools import combinations

import numpy as np

from . import held_back as held_back_kinds
from . import iwan_suites
from . import out_of_catalogue as developed_kinds
from .apparatus import CONTACTS
from .campaign import Order
from .iwan_suites import cycled
from .laws import LAWS
from .recording import FAULTS

Orders = list[Order]
# Pairs that one campaign can hardly tell from one another, or of which one holds the other.
BLURRED = (
    {"lateral_friction", "turning_surface"},
    {"film_drag", "velocity_weakening"},
    {"film_drag", "structural_damping"},
    {"thermal_weakening", "run_in"},
    {"thermal_weakening", "velocity_weakening"},
)
# Effects whose strength may go with mass, load or speed, and the powers it may go with: the power
# is over the law as the answers state it (a force of its own, or a share of mu).
SCALINGS: tuple[tuple[str, dict[str, float]], ...] = (
    ("thermal_weakening", {"mass": -1.0}),
    ("film_drag", {"mass": 1.0}),
    ("velocity_weakening", {"mass": -1.0}),
    ("run_in", {"mass": 1.0}),
    ("static_strengthening", {"mass": -1.0}),
    ("structural_damping", {"mass": 1.0}),
    ("surface_pattern", {"mass": -1.0}),
    ("speed_ripple", {"speed": -1.0}),
    ("run_in", {"speed": 1.0}),
    ("surface_pattern", {"speed": 1.0}),
)


def contact_and_shapes(rng: np.random.Generator, count: int = 60) -> Orders:
    """A LuGre contact throughout: three in four with an effect, the rest without."""
    without = count // 4
    scatters = rng.choice((0.0, 0.01, 0.02), count)
    effects = cycled(rng, list(LAWS), count - without)
    orders = [
        Order("lugre", (name,), scatter=float(s))
        for name, s in zip(effects, scatters, strict=False)
    ]
    orders += [Order("lugre", scatter=float(s)) for s in scatters[count - without :]]
    return [orders[int(j)] for j in rng.permutation(count)]


def one_effect(rng: np.random.Generator, count: int = 112, scatter: float = 0.0) -> Orders:
    """Every effect with every contact, about twice."""
    both = [f"{effect} {contact}" for effect in LAWS for contact in CONTACTS]
    pairs = [pair.split() for pair in cycled(rng, both, count)]
    return [Order(contact, (effect,), scatter=scatter) for effect, contact in pairs]


def scatter(rng: np.random.Generator, count: int = 112) -> Orders:
    """One effect, with mu scattered by 3 % from run to run."""
    return one_effect(rng, count, 0.03)


def nothing(rng: np.random.Generator, count: int = 100) -> Orders:
    """Nothing hidden, over all contacts and scatters of 0 to 5 %."""
    contacts = cycled(rng, list(CONTACTS), count)
    scatters = rng.choice((0.0, 0.01, 0.03, 0.05), count)
    return [Order(contact, scatter=float(s)) for contact, s in zip(contacts, scatters, strict=True)]


def kinds(rng: np.random.Generator, names: list[str], count: int) -> Orders:
    contacts = cycled(rng, list(CONTACTS), count)
    drawn = cycled(rng, names, count)
    return [
        Order(c, kind=k, scatter=float(rng.choice((0.0, 0.01))))
        for k, c in zip(drawn, contacts, strict=True)
    ]


def out_of_catalogue(rng: np.random.Generator, count: int = 40) -> Orders:
    """Kinds out of the catalogue, to develop on."""
    return kinds(rng, list(developed_kinds.KINDS), count)


def held_back(rng: np.random.Generator, count: int = 40) -> Orders:
    """Kinds out of the catalogue that were kept back: run once."""
    return kinds(rng, list(held_back_kinds.KINDS), count)


def faults(rng: np.random.Generator, count: int = 40) -> Orders:
    """Faults of the measurement, nothing else."""
    contacts = cycled(rng, list(CONTACTS), count)
    names = cycled(rng, list(FAULTS), count)
    sizes = {"measurement.scale": (1.0, 25.0), "measurement.clock": (1.0, 25.0)}
    return [
        Order(c, fault=name, sizes=sizes.get(name, (2.0, 12.0)))
        for name, c in zip(names, contacts, strict=True)
    ]


def several_effects(
    rng: np.random.Generator,
    count: int,
    number: int,
    among: Iterable[str] = CONTACTS,
    sizes: tuple[float, float] = (5.0, 30.0),
) -> Orders:
    """Sets of effects of which no two are blurred, each met about equally often."""
    sets = [
        chosen
        for chosen in combinations(LAWS, number)
        if not any(pair <= set(chosen) for pair in BLURRED)
    ]
    contacts = cycled(rng, list(among), count)
    met = dict.fromkeys(LAWS, 0)
    orders = []
    for contact in contacts:
        draw = rng.permutation(len(sets))[:8]
        chosen = min((sets[int(j)] for j in draw), key=lambda names: sum(met[n] for n in names))
        for name in chosen:
            met[name] += 1
        orders.append(Order(contact, chosen, sizes=sizes))
    return orders


def two_effects(rng: np.random.Generator, count: int = 30) -> Orders:
    return several_effects(rng, count, 2)


def three_effects(rng: np.random.Generator, count: int = 10) -> Orders:
    return several_effects(rng, count, 3)


def iwan_two(rng: np.random.Generator, count: int = 20) -> Orders:
    """Two effects, with the Iwan contact and its laws."""
    return several_effects(rng, count, 2, ["iwan"], iwan_suites.SIZES)


def scaling(rng: np.random.Generator, count: int = 20) -> Orders:
    """One effect whose strength goes with mass (load) or speed as no textbook says."""
    contacts = cycled(rng, list(CONTACTS), count)
    picked = [SCALINGS[j % len(SCALINGS)] for j in range(count)]
    return [
        Order(contact, (effect,), exponents=dict(powers))
        for contact, (effect, powers) in zip(contacts, picked, strict=True)
    ]


SUITES: dict[str, Callable[..., Orders]] = {
    suite.__name__: suite
    for suite in (
        contact_and_shapes,
        one_effect,
        scatter,
        nothing,
        out_of_catalogue,
        held_back,
        faults,
        two_effects,
        three_effects,
        scaling,
        iwan_suites.iwan_one,
        iwan_suites.iwan_nothing,
        iwan_two,
        iwan_suites.iwan_alike,
        iwan_suites.iwan_unknown,
        iwan_suites.iwan_faults,
    )
}


def orders_of(suite: str, seed: int, count: int | None = None) -> Orders:
    """The orders of a suite; `count` of them if it is given."""
    rng = np.random.default_rng([seed, list(SUITES).index(suite)])
    return SUITES[suite](rng) if count is None else SUITES[suite](rng, count)

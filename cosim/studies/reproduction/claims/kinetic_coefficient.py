"""C10: the mean kinetic coefficient: its range, and how mass, speed and stiffness act on it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure
from stickslip.reference.scheme_errors import PRINTED

from cosim.report.style import panels, picture
from cosim.studies.reproduction.cases import ASSUMED, CASE, STUDY, Grid, grid

from ..cases import (
    EXTRA_STIFFNESS,
    GUIDED,
    GUIDED_ASSUMED,
    MASSES,
    PRETENSION,
    SEEDS,
    SPEEDS,
    STIFFNESSES,
    WEAKENING,
    Case,
    exact_figures,
    many,
    scheme_figures,
)
from ..claim import OPEN, PUT_IN, Check, Claim, Margin, Row, Turn
from ..drawing import MODELS, over_mass
from .trends import LEVEL, LOAD_POWER

ALL_STIFFNESSES = (*STIFFNESSES, EXTRA_STIFFNESS)
# lines over mass count as horizontal where mu_k strays by less than this part of its mean
HORIZONTAL = 0.05
OTHER_WEAKENINGS = (0.2, 0.6)
# a spread that is less by no more than this part of it is as large
FLAT = 0.01
# the free block turns by chance: three masses of the seven say enough, and cost less
FREE_MASSES = (MASSES[0], MASSES[3], MASSES[-1])
ENDS = (ALL_STIFFNESSES[0], ALL_STIFFNESSES[-1])


def _shrinks(spreads: np.ndarray | list[float]) -> bool:
    return _ratio(spreads) < 1.0 - FLAT


def _ratio(spreads: np.ndarray | list[float]) -> float:
    """Spread at the stiffest springs by that at the softest."""
    return float(spreads[-1] / spreads[0])


def _strays(mu: np.ndarray) -> float:
    """Largest spread over mass at one stiffness and speed, relative to the mean there."""
    return float(np.max(np.ptp(mu, axis=1) / mu.mean(axis=1)))


def _spread_over_speed(mu: np.ndarray) -> np.ndarray:
    """(stiffness,): range over the speeds of the mean over masses."""
    return np.ptp(mu.mean(axis=1), axis=1)


def judge() -> Claim:
    """Range, mass, speed, stiffness."""
    mu = grid(lambda case, figures: figures.mean_friction / case.weight, ALL_STIFFNESSES)
    spreads = {model: _spread_over_speed(mu[model]) for model in MODELS}
    strays = [_strays(mu[model]) for model in MODELS]
    changes = [_change_over_mass(mu[model]) for model in MODELS]
    return Claim(
        "C10",
        "mean µ_k is 0.05 to 0.11, constant in mass, falls with speed, and its spread "
        "shrinks with stiffness",
        _rows(mu, spreads, strays, changes),
        _checks(mu, spreads, strays),
        remarks=(
            "The study says both: its summary, that friction coefficients depend linearly on "
            "mass; §5.3, that a similar one is found per mass, with figure 5.8. Linear in mass is "
            "the friction force. The claim here is §5.3's; of the summary's: over the masses µ_k "
            f"changes by {100 * changes[-1]:.1f} % in the exact model.",
            f"As printed the spread at the stiffest is {_ratio(spreads['printed']):.2f} of that at "
            f"the softest, with r in the rise (F2 mended) {_without_rotation():.3f}: what shrinks "
            "it there is the rotation. Guided along x it stays as it is. A free block turns by "
            "what the study leaves open, the pretension and the slope, and its spread shrinks "
            "with some of these and grows with others.",
            "Over a whole cycle the mean sliding speed is the surface's own; in slip it is that "
            "divided by the share of slip, which stiffness brings to 1. So µ_k at high stiffness "
            "differs between speeds by what the friction law differs.",
        ),
        assumed=(*ASSUMED, GUIDED_ASSUMED),
        pictures=(_draw(mu),),
        place="§5.3, fig. 5.8 to 5.10; executive summary",
        rests="a friction law that is put in: constant in mass, falling with speed; the spread on "
        "whether and how far the block turns",
    )


def _rows(mu: Grid, spreads: Grid, strays: list[float], changes: list[float]) -> tuple[Row, ...]:
    """The range of µ_k, and its spreads over mass and over speed."""
    rows = [
        Row("smallest mean µ_k", "1", STUDY["least_mu_k"], *(float(mu[m].min()) for m in MODELS)),
        Row("largest mean µ_k", "1", STUDY["largest_mu_k"], *(float(mu[m].max()) for m in MODELS)),
        Row("largest spread over mass, part of the mean", "1", None, *strays),
        Row(
            "not counted here, linear in mass: change of a line from 0.67 to 2.03 kg, part of the "
            "mean",
            "1",
            None,
            *changes,
        ),
    ]
    rows += [
        Row(
            f"spread over speed at k {k:.2f} N/m",
            "1",
            None,
            *(float(spreads[model][i]) for model in MODELS),
        )
        for i, k in enumerate(ALL_STIFFNESSES)
    ]
    return tuple(rows)


def _checks(mu: Grid, spreads: Grid, strays: list[float]) -> tuple[Check, ...]:
    """Range, mass, speed, stiffness."""
    by_speed = {model: mu[model].mean(axis=(0, 1)) for model in MODELS}
    return (
        Check(
            "lies in 0.05 to 0.11: the friction data behind it are not printed",
            None,
            None,
            None,
        ),
        Check(
            f"constant in mass within {100 * HORIZONTAL:.0f} %",
            *(value < HORIZONTAL for value in strays),
            margin=Margin("largest spread over mass, exact", strays[-1], HORIZONTAL),
            turns=(_load_dependent(),),
        ),
        Check(
            "falls with speed",
            *(bool(np.all(np.diff(by_speed[model]) < 0.0)) for model in MODELS),
            margin=Margin(
                "smallest step from one speed to the next, exact",
                float(np.diff(by_speed["exact"]).max()),
                0.0,
            ),
            turns=(_constant(),),
        ),
        Check(
            f"spread over speed shrinks from the softest to the stiffest springs, by more "
            f"than {100 * FLAT:.0f} %",
            *(_shrinks(spreads[model]) for model in MODELS),
            margin=Margin(
                "spread at the stiffest by that at the softest, exact",
                _ratio(spreads["exact"]),
                1.0 - FLAT,
            ),
            turns=(*map(_weakened, OTHER_WEAKENINGS), *_bent(), *_free()),
        ),
    )


def _change_over_mass(mu: np.ndarray) -> float:
    """Change of a straight line through the mean over all else, part of the mean."""
    by_mass = mu.mean(axis=(0, 2))
    slope = np.polyfit(MASSES, by_mass, 1)[0]
    return float(abs(slope) * (MASSES[-1] - MASSES[0]) / by_mass.mean())


def _load_dependent() -> Turn:
    """What a mu_k that falls with the load would show."""
    mu = (np.array(MASSES) / MASSES[0]) ** LOAD_POWER
    spread = float(np.ptp(mu) / mu.mean())
    return Turn(
        "µ_k falling with the load's power −1/3 instead of constant in mass",
        f"spread over mass {spread:.2f}",
        spread < HORIZONTAL,
        PUT_IN,
    )


def _means(weakening: float, speeds: Sequence[float], stiffness: float) -> np.ndarray:
    """Mean mu_k of the exact model at the least mass, over the speeds."""
    return np.array(
        [
            exact_figures(case, rig=GUIDED).mean_friction / case.weight
            for case in (
                CASE.changed(weakening=weakening, speed=v, stiffness=stiffness) for v in speeds
            )
        ]
    )


def _constant() -> Turn:
    mu = _means(0.0, SPEEDS, STIFFNESSES[0])
    return Turn(
        "µ_k constant instead of falling with speed",
        f"{mu[0]:.5f} at {SPEEDS[0]:.2f} m/s, {mu[-1]:.5f} at {SPEEDS[-1]:.2f} m/s",
        bool(np.all(np.diff(mu) < -LEVEL * mu[:-1])),
        PUT_IN,
    )


def _weakened(part: float) -> Turn:
    """The spread over the study's slowest and fastest surface with another slope."""
    speeds = (SPEEDS[0], SPEEDS[-1])
    return _spread_turn(
        f"µ_k falling by {100 * part:.0f} % instead of {100 * WEAKENING:.0f} %",
        [float(np.ptp(_means(part, speeds, k))) for k in ENDS],
    )


def _bent() -> list[Turn]:
    """The same fall along curves: mu_k at rest, and how it falls, by the exact model's laws."""
    low, high, left = SPEEDS[0], SPEEDS[-1], 1.0 - WEAKENING
    hyperbola = (1.0 - left) / (left * high - low)
    root = (1.0 - left**2) / (left**2 * high - low)
    laws = (
        ("1/(1 + δ v)", {"hyperbolic": hyperbola}, 1.0 + hyperbola * low),
        ("1/√(1 + c v)", {"inverse_root": root}, (1.0 + root * low) ** 0.5),
    )
    return [
        _spread_turn(
            f"µ_k falling as much along {name} instead of a straight line",
            [
                _spread_of(
                    CASE.changed(weakening=0.0),
                    k,
                    rig=GUIDED,
                    velocity_weakening=law,
                    friction={
                        "mu_s": max(CASE.mu_s, CASE.mu_k * at_rest),
                        "mu_k": CASE.mu_k * at_rest,
                    },
                )
                for k in ENDS
            ],
        )
        for name, law, at_rest in laws
    ]


def _free() -> list[Turn]:
    """The block free in the plane, which the study's is; how much it turns is left open."""
    changes = ((PRETENSION, WEAKENING), *((0.0, part) for part in (WEAKENING, *OTHER_WEAKENINGS)))
    return [
        _spread_turn(
            f"the block free, {1e3 * pretension:.0f} mm of pretension, µ_k falling by "
            f"{100 * part:.0f} %",
            [
                _spread_of(CASE.changed(weakening=part), k, FREE_MASSES, pretension=pretension)
                for k in ENDS
            ],
        )
        for pretension, part in changes
    ]


def _spread_of(case: Case, stiffness: float, masses=MASSES[:1], **model) -> float:
    """Range over the speeds of the exact model's mu_k, mean over masses."""
    series = [case.changed(stiffness=stiffness, mass=m, speed=v) for m in masses for v in SPEEDS]
    mu = many(lambda one: exact_figures(one, **model).mean_friction / one.weight, series)
    return float(np.ptp(np.reshape(mu, (len(masses), len(SPEEDS))).mean(axis=0)))


def _spread_turn(change: str, spreads: list[float]) -> Turn:
    return Turn(
        change,
        f"spread {spreads[0]:.4f} at the softest, {spreads[-1]:.4f} at the "
        f"stiffest, ratio {_ratio(spreads):.2f}",
        _shrinks(spreads),
        OPEN,
    )


def _without_rotation() -> float:
    """The ratio of the printed scheme with F2 mended."""
    spreads = []
    for stiffness in ENDS:
        series = [
            CASE.changed(stiffness=stiffness, mass=m, speed=v) for m in MASSES for v in SPEEDS
        ]
        figures = many(scheme_figures, series, PRINTED.without("F2"), SEEDS[:1])
        mu = [one.mean_friction / case.weight for one, case in zip(figures, series, strict=True)]
        spreads.append(np.ptp(np.reshape(mu, (len(MASSES), len(SPEEDS))).mean(axis=0)))
    return _ratio(spreads)


@picture(
    "C10_mu_k",
    "Mean µ_k over mass for stiffnesses to 136.44 N/m (columns) and speeds "
    "(lines), by model (rows). Study: figures 5.8 and 5.10.",
)
def _draw(mu: Grid) -> Figure:
    figure, axes = panels(
        len(MODELS), len(ALL_STIFFNESSES), height=2.1, width=10.0, sharex=True, sharey=True
    )
    over_mass(figure, axes, MASSES, ALL_STIFFNESSES, SPEEDS, mu, "mean µ_k")
    return figure

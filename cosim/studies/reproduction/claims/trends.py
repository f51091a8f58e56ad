"""C8 to C10: mean x, slip time and mean friction over mass, stiffness and speed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from scipy.stats import linregress, spearmanr
from stickslip.reference.coulomb_oscillator import CoulombOscillator
from stickslip.reference.scheme_errors import PRINTED

from cosim.report.style import INK

from ..cases import (
    CASE,
    EXTRA_STIFFNESS,
    GUIDED,
    MASSES,
    PRETENSION,
    SEEDS,
    SPEEDS,
    STIFFNESSES,
    WEAKENING,
    Case,
    exact_figures,
    exact_table,
    gridded,
    many,
    plan,
    scheme_figures,
    tabulated,
)
from ..claim import Claim
from ..drawing import Curve, Panel, by_model, figure_of, over_mass
from ..motion import MotionFigures
from ..sheet import Sheet

Array = np.ndarray

LINE = CASE.changed(stiffness=38.50, speed=0.37)
LINE_MASSES = np.array([0.1 + 0.2 * i for i in range(16)])
LEVEL = 1e-3  # a fall by less than this part from one speed to the next is none
# friction of single asperities that touch elastically grows with the load's power 2/3 (Hertz)
LOAD_POWER = -1.0 / 3.0
FINE_SPEEDS = np.array(
    [
        *(0.01, 0.02, 0.04, 0.07, 0.10, 0.15, 0.20, 0.25, 0.31, 0.37, 0.44, 0.50, 0.57, 0.63),
        *(0.70, 0.76, 0.82),
    ]
)
# a growth by as much over all speeds: equal slip times have ranks too
GROWTH = 0.01
ALL_STIFFNESSES = (*STIFFNESSES, EXTRA_STIFFNESS)
OTHER_WEAKENINGS = (0.2, 0.6)
# the free block turns by chance: three masses of the seven say enough, and cost less
FREE_MASSES = (MASSES[0], MASSES[3], MASSES[-1])
ENDS = (ALL_STIFFNESSES[0], ALL_STIFFNESSES[-1])


def straightness(x: Array, y: Array) -> float:
    """R2 of a straight line."""
    return float(linregress(x, y).rvalue ** 2)


def least_fall(values: Array) -> Array:
    """(..., n): the smallest step down along the last axis, as a part of the value before it."""
    return np.min(-np.diff(values) / np.abs(values[..., :-1]), axis=-1)


def judge_mean() -> Claim:
    """C8: means over the grid and along the finer line in mass."""
    sheet, line = Sheet("C8"), tabulated("mean_x", LINE.over("mass", LINE_MASSES))
    means = gridded(tabulated("mean_x", plan()))
    r2 = [straightness(LINE_MASSES, of_model) for of_model in line]
    by_stiffness, by_speed = means.mean(axis=(2, 3)), means.mean(axis=(1, 2))
    sheet.row("line", r2)
    for k, ours in zip(STIFFNESSES, by_stiffness.T, strict=True):
        sheet.row("stiffness", ours, k=k)
    for v, ours in zip(SPEEDS, by_speed.T, strict=True):
        sheet.row("speed", ours, v=v)
    sheet.check("linear", r2)
    # what mean x = mu_k m g/(4k) passes on
    sheet.turn("load", straightness(LINE_MASSES, LINE_MASSES ** (1.0 + LOAD_POWER)))
    sheet.check("stiffness", least_fall(by_stiffness))
    sheet.check("speed", least_fall(by_speed))
    x = exact_table("mean_x", LINE.changed(weakening=0.0).over("speed", SPEEDS), rig=GUIDED)
    sheet.turn("constant", sound=bool(least_fall(x) > LEVEL), first=1e3 * x[0], last=1e3 * x[-1])
    sheet.picture("C8_mean_x", _draw_means, means)
    sheet.picture("C8_mass", _draw_line, line)
    return sheet.claim(r2=r2[0])


def _draw_means(means: Array) -> Figure:
    return over_mass(100.0 * means, STIFFNESSES, "mean x, cm", height=2.2, sharey="row")


def _draw_line(line: Array) -> Figure:
    curves = by_model(LINE_MASSES, 100.0 * line)
    return figure_of([[Panel(curves, "mass, kg", "mean x, cm")]], height=2.8, width=5.5)


def judge_slip_time() -> Claim:
    """C9: slip times over the study's range of speeds, at m 0.67 kg and k 20.17 N/m."""
    sheet, times = Sheet("C9"), tabulated("slip_time", CASE.over("speed", FINE_SPEEDS))
    ranks = [_rank(of_model) for of_model in times]
    sheet.row("rank", ranks)
    for v in (0.01, 0.15, 0.37, 0.82):
        sheet.row("time", times[:, FINE_SPEEDS == v][:, 0], v=v)
    sheet.check("grows", ranks, answers=[_grows(of_model) for of_model in times])
    constant = CASE.changed(weakening=0.0)
    for name, case in (("constant", constant), ("no_step", constant.changed(mu_s=CASE.mu_k))):
        varied = exact_table("slip_time", case.over("speed", FINE_SPEEDS), rig=GUIDED)
        known = varied[np.isfinite(varied)]
        said = {"first": known[0], "last": known[-1], "n": len(known)}
        sheet.turn(name, sound=_grows(varied), **said)
    sheet.picture("C9_slip_time", _draw_times, times)
    sticks = np.isfinite(times[2])
    return sheet.claim(
        n=sticks.sum(),
        fastest=FINE_SPEEDS[sticks].max(),
        never=", ".join(f"{v:.2f}" for v in FINE_SPEEDS[~sticks]),
        closed=[_closed_form(v) for v in FINE_SPEEDS],
    )


def _rank(times: Array) -> float:
    """Spearman's rank correlation with the speed where there was a slip."""
    known = np.isfinite(times)
    return float(spearmanr(FINE_SPEEDS[known], times[known]).statistic)


def _grows(times: Array) -> bool:
    """A trend with speed, and one that is more than rounding."""
    known = times[np.isfinite(times)]
    return bool(_rank(times) > 0.8 and known[-1] > (1.0 + GROWTH) * known[0])


def _closed_form(speed: float) -> float:
    """Slip time with the constant coefficients, s."""
    return CoulombOscillator(
        CASE.mass, 4.0 * CASE.stiffness, speed, CASE.mu_s * CASE.weight, CASE.mu_k * CASE.weight
    ).slip_time


def _draw_times(times: Array) -> Figure:
    closed = [_closed_form(v) for v in FINE_SPEEDS]
    line = {"color": INK, "lw": 0.9, "ls": ":", "label": "closed form, constant µ"}
    curves = [*by_model(FINE_SPEEDS, times), Curve(FINE_SPEEDS, closed, line)]
    panel = Panel(curves, "surface speed, m/s", "mean slip time, s")
    return figure_of([[panel]], legend=2, height=3.0, width=6.0)


def judge_kinetic_coefficient() -> Claim:
    """C10: range of the mean mu_k, and how mass, speed and stiffness act on it."""
    sheet, cases = Sheet("C10"), plan(ALL_STIFFNESSES)
    weights = np.array([case.weight for case in cases])
    mu = gridded(tabulated("mean_friction", cases) / weights, ALL_STIFFNESSES)
    by_mass = mu.mean(axis=(1, 3))
    slopes = np.polyfit(MASSES, by_mass.T, 1)[0]
    changes = np.abs(slopes) * (MASSES[-1] - MASSES[0]) / by_mass.mean(axis=1)
    strays = np.max(np.ptp(mu, axis=2) / mu.mean(axis=2), axis=(1, 2))
    spreads = np.ptp(mu.mean(axis=2), axis=2)
    sheet.row("least", mu.min(axis=(1, 2, 3)))
    sheet.row("largest", mu.max(axis=(1, 2, 3)))
    sheet.row("strays", strays)
    sheet.row("change", changes)
    for k, ours in zip(ALL_STIFFNESSES, spreads.T, strict=True):
        sheet.row("spread", ours, k=k)
    sheet.check("range")
    sheet.check("mass", strays)
    loaded = np.array(MASSES) ** LOAD_POWER
    sheet.turn("load", np.ptp(loaded) / loaded.mean())
    sheet.check("speed", np.diff(mu.mean(axis=(1, 2))).max(axis=1))
    even = CASE.changed(weakening=0.0)
    constant = exact_table("mean_friction", even.over("speed", SPEEDS), rig=GUIDED) / even.weight
    sheet.turn(
        "constant", sound=bool(least_fall(constant) > LEVEL), first=constant[0], last=constant[-1]
    )
    sheet.check("spread", spreads[:, -1] / spreads[:, 0])
    _turn_spread(sheet)
    sheet.picture("C10_mu_k", _draw_coefficients, mu)
    mended = _spreads(
        lambda case: scheme_figures(case, PRINTED.without("F2"), SEEDS[:1]), CASE, MASSES
    )
    return sheet.claim(
        change=100.0 * changes[2],
        ratio=spreads[0, -1] / spreads[0, 0],
        mended=mended[1] / mended[0],
    )


def _turn_spread(sheet: Sheet) -> None:
    """Other slopes, other laws that fall as much, the block free as the study's is."""
    for part in OTHER_WEAKENINGS:
        found = _exact_spreads(CASE.changed(weakening=part), rig=GUIDED)
        _spread(sheet, "slope", found, part=100.0 * part)
    low, high, left = SPEEDS[0], SPEEDS[-1], 1.0 - WEAKENING
    hyperbola = (1.0 - left) / (left * high - low)
    root = (1.0 - left**2) / (left**2 * high - low)
    laws = (
        ("1/(1 + δ v)", {"hyperbolic": hyperbola}, 1.0 + hyperbola * low),
        ("1/√(1 + c v)", {"inverse_root": root}, (1.0 + root * low) ** 0.5),
    )
    for name, law, at_rest in laws:
        mu_k = CASE.mu_k * at_rest
        found = _exact_spreads(
            CASE.changed(weakening=0.0),
            rig=GUIDED,
            velocity_weakening=law,
            friction={"mu_s": max(CASE.mu_s, mu_k), "mu_k": mu_k},
        )
        _spread(sheet, "bent", found, law=name)
    # how far a free block turns hangs on what the study leaves open
    for pretension, part in ((PRETENSION, WEAKENING), (0.0, WEAKENING), (0.0, 0.2), (0.0, 0.6)):
        case = CASE.changed(weakening=part)
        found = _exact_spreads(case, FREE_MASSES, pretension=pretension)
        _spread(sheet, "free", found, pretension=1e3 * pretension, part=100.0 * part)


def _spread(sheet: Sheet, name: str, found: list[float], **said: Any) -> None:
    sheet.turn(name, found[1] / found[0], softest=found[0], stiffest=found[1], **said)


def _exact_spreads(case: Case, masses: Sequence[float] = MASSES[:1], **model) -> list[float]:
    return _spreads(lambda one: exact_figures(one, **model), case, masses)


def _spreads(
    of: Callable[[Case], MotionFigures], case: Case, masses: Sequence[float]
) -> list[float]:
    """Range over the speeds of mu_k, mean over masses, at the softest and the stiffest springs."""
    found = []
    for k in ENDS:
        series = [case.changed(stiffness=k, mass=m, speed=v) for m in masses for v in SPEEDS]
        mu = many(lambda one: of(one).mean_friction / one.weight, series)
        found.append(float(np.ptp(np.reshape(mu, (len(masses), -1)).mean(axis=0))))
    return found


def _draw_coefficients(mu: Array) -> Figure:
    return over_mass(mu, ALL_STIFFNESSES, "mean µ_k", height=2.1, width=10.0, sharey=True)

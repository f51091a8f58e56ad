"""C8 to C10: mean x, slip time and mean friction over mass, stiffness and speed."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from scipy.stats import linregress, spearmanr
from stickslip.reference.coulomb_oscillator import CoulombOscillator
from stickslip.reference.scheme_options import PRINTED

from cosim.report.palette import INK

from .. import cases
from ..cases import CASE, GUIDED, MASSES, SPEEDS, STIFFNESSES, Case
from ..claim import WRITTEN, Claim
from ..drawing import Curve, Panel, add_picture, by_model, over_mass

Array = np.ndarray

LINE = CASE.changed(stiffness=38.50, speed=0.37)
LINE_MASSES = np.array([0.1 + 0.2 * i for i in range(16)])
LEVEL = 1e-3  # a fall by less than this part from one speed to the next is none
# friction of single asperities that touch elastically grows with the load's power 2/3 (Hertz)
LOAD_POWER = -1.0 / 3.0
FINE_SPEEDS = np.array(WRITTEN["C9"]["speeds"])
# a growth by as much over all speeds: equal slip times have ranks too
GROWTH = 0.01
ALL_STIFFNESSES = (*STIFFNESSES, cases.EXTRA_STIFFNESS)
#: The series' case with a constant mu_k.
CONSTANT = CASE.changed(weakening=0.0)


def straightness(x: Array, y: Array) -> float:
    """R2 of a straight line."""
    return float(linregress(x, y).rvalue ** 2)


def least_fall(values: Array) -> Array:
    """(..., n): the smallest step down along the last axis, as a part of the value before it."""
    return np.asarray(np.min(-np.diff(values) / np.abs(values[..., :-1]), axis=-1))


def over_speeds(figure: str, case: Case, speeds: Sequence[float] | Array = SPEEDS) -> Array:
    """A steady figure of the exact model, guided, at each speed."""
    return cases.exact_table(figure, case.over("speed", speeds), rig=GUIDED)


def judge_mean(claim: Claim) -> dict[str, float]:
    """Means over the grid and along the finer line in mass."""
    line = cases.tabulated("mean_x", LINE.over("mass", LINE_MASSES))
    means = cases.gridded(cases.tabulated("mean_x", cases.plan()))
    r2 = [straightness(LINE_MASSES, of_model) for of_model in line]
    by_stiffness, by_speed = means.mean(axis=(2, 3)), means.mean(axis=(1, 2))
    claim.row("line", r2)
    claim.row_each("stiffness", by_stiffness, k=STIFFNESSES)
    claim.row_each("speed", by_speed, v=SPEEDS)
    claim.check("linear", r2)
    # what mean x = mu_k m g/(4k) passes on
    claim.turn("load", straightness(LINE_MASSES, LINE_MASSES ** (1.0 + LOAD_POWER)))
    claim.check("stiffness", least_fall(by_stiffness))
    claim.check("speed", least_fall(by_speed))
    x = 1e3 * over_speeds("mean_x", LINE.changed(weakening=0.0))
    claim.turn("constant", sound=least_fall(x) > LEVEL, first=x[0], last=x[-1])
    add_picture(claim, "C8_mean_x", over_mass(100.0 * means, STIFFNESSES))
    add_picture(claim, "C8_mass", [[Panel(by_model(LINE_MASSES, 100.0 * line))]])
    return {"r2": r2[0]}


def _rank(times: Array) -> float:
    """Spearman's rank correlation with the speed where there was a slip."""
    return float(spearmanr(FINE_SPEEDS, times, nan_policy="omit").statistic)


def _grows(times: Array) -> bool:
    """A trend with speed, and one that is more than rounding."""
    known = times[np.isfinite(times)]
    return bool(_rank(times) > 0.8 and known[-1] > (1.0 + GROWTH) * known[0])


def _closed_form(speed: float) -> float:
    """Slip time with the constant coefficients, s."""
    limits = CASE.mu_s * CASE.weight, CASE.mu_k * CASE.weight
    return CoulombOscillator(CASE.mass, 4.0 * CASE.stiffness, speed, *limits).slip_time


def judge_slip_time(claim: Claim) -> dict[str, Any]:
    """Slip times over the study's range of speeds, at m 0.67 kg and k 20.17 N/m."""
    times = cases.tabulated("slip_duration", CASE.over("speed", FINE_SPEEDS))
    ranks = [_rank(of_model) for of_model in times]
    claim.row("rank", ranks)
    told = np.isin(FINE_SPEEDS, (0.01, 0.15, 0.37, 0.82))
    claim.row_each("time", times[:, told], v=FINE_SPEEDS[told])
    claim.check("grows", [_grows(of_model) for of_model in times], margin=ranks[2])
    for name, case in (("constant", CONSTANT), ("no_step", CONSTANT.changed(mu_s=CASE.mu_k))):
        varied = over_speeds("slip_duration", case, FINE_SPEEDS)
        known = varied[np.isfinite(varied)]
        claim.turn(name, sound=_grows(varied), first=known[0], last=known[-1], n=len(known))
    closed, sticks = [_closed_form(v) for v in FINE_SPEEDS], np.isfinite(times[2])
    dotted = {"color": INK, "lw": 0.9, "ls": ":", "label": "closed form, constant µ"}
    curves = [*by_model(FINE_SPEEDS, times), Curve(FINE_SPEEDS, closed, dotted)]
    add_picture(claim, "C9_slip_time", [[Panel(curves)]])
    never = ", ".join(f"{v:.2f}" for v in FINE_SPEEDS[~sticks])
    fastest = FINE_SPEEDS[sticks].max()
    return {"n": sticks.sum(), "fastest": fastest, "never": never, "closed": closed}


def judge_kinetic_coefficient(claim: Claim) -> dict[str, float]:
    """Range of the mean mu_k, and how mass, speed and stiffness act on it."""
    series = cases.plan(ALL_STIFFNESSES)
    weights = np.array([case.weight for case in series])
    mu = cases.gridded(cases.tabulated("friction", series) / weights, ALL_STIFFNESSES)
    by_mass, spreads = mu.mean(axis=(1, 3)), np.ptp(mu.mean(axis=2), axis=2)
    slopes = np.polyfit(MASSES, by_mass.T, 1)[0]
    changes = np.abs(slopes) * (MASSES[-1] - MASSES[0]) / by_mass.mean(axis=1)
    strays = np.max(np.ptp(mu, axis=2) / mu.mean(axis=2), axis=(1, 2))
    claim.row("least", mu.min(axis=(1, 2, 3)))
    claim.row("largest", mu.max(axis=(1, 2, 3)))
    claim.row("strays", strays)
    claim.row("change", changes)
    claim.row_each("spread", spreads, k=ALL_STIFFNESSES)
    claim.check("range")
    claim.check("mass", strays)
    loaded = np.array(MASSES) ** LOAD_POWER
    claim.turn("load", np.ptp(loaded) / loaded.mean())
    claim.check("speed", np.diff(mu.mean(axis=(1, 2))).max(axis=1))
    constant = over_speeds("friction", CONSTANT) / CONSTANT.weight
    claim.turn("constant", sound=least_fall(constant) > LEVEL, mu=constant)
    ratios = spreads[:, -1] / spreads[:, 0]
    claim.check("spread", ratios)
    for name, part, loose in WRITTEN["C10"]["varied"]:
        model = {"pretension": loose} if name == "free" else {"rig": GUIDED}
        # the free block turns by chance: three masses of the seven say enough, and cost less
        masses = MASSES[::3] if name == "free" else MASSES[:1]
        case = CASE.changed(weakening=part)
        found = _spreads(partial(cases.exact_figures, **model), case, masses)
        claim.turn(name, found[1] / found[0], spreads=found, part=100.0 * part, mm=1e3 * loose)
    add_picture(claim, "C10_mu_k", over_mass(mu, ALL_STIFFNESSES))
    with_r = partial(cases.scheme_figures, faults=PRINTED.without("F2"), seeds=(0,))
    softest, stiffest = _spreads(with_r, CASE, MASSES)
    return {"change": 100.0 * changes[2], "ratio": ratios[0], "mended": stiffest / softest}


def _spreads(
    of: Callable[[Case], dict[str, float]], case: Case, masses: Sequence[float]
) -> list[float]:
    """Range over the speeds of mu_k, mean over masses, at the softest and the stiffest springs."""
    found = []
    for k in (ALL_STIFFNESSES[0], ALL_STIFFNESSES[-1]):
        mu = [
            [of(one)["friction"] / one.weight for one in heavy.over("speed", SPEEDS)]
            for heavy in case.changed(stiffness=k).over("mass", masses)
        ]
        found.append(float(np.ptp(np.mean(mu, axis=0))))
    return found

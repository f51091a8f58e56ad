"""C9: the mean duration of a slip grows with the surface's speed."""

from __future__ import annotations

import numpy as np
from scipy.stats import spearmanr
from stickslip.reference.coulomb_oscillator import CoulombOscillator

from cosim.report.style import INK, panels, picture
from cosim.studies.reproduction.cases import CASE

from ..cases import GUIDED, GUIDED_ASSUMED, LAW_ASSUMED, exact_figures, three_models
from ..claim import FAR, PUT_IN, Check, Claim, Margin, Row, Turn
from ..drawing import MODELS, by_model

SPEEDS = (
    0.01,
    0.02,
    0.04,
    0.07,
    0.10,
    0.15,
    0.20,
    0.25,
    0.31,
    0.37,
    0.44,
    0.50,
    0.57,
    0.63,
    0.70,
    0.76,
    0.82,
)
# a trend: at least this rank correlation with the speed
TREND = 0.8
# and a growth by as much over all speeds: equal slip times have ranks too
GROWTH = 0.01


def _closed_form(speed: float) -> float:
    """Slip time with the constant coefficients, s."""
    return CoulombOscillator(
        CASE.mass, 4.0 * CASE.stiffness, speed, CASE.mu_s * CASE.weight, CASE.mu_k * CASE.weight
    ).slip_time


def judge() -> Claim:
    """Slip times over the study's range of speeds, at m 0.67 kg and k 20.17 N/m."""
    times = {
        model: np.array([one.slip_time for one in figures])
        for model, figures in three_models([CASE.changed(speed=v) for v in SPEEDS]).items()
    }
    ranks = [_rank(times[model]) for model in MODELS]
    rows = [Row("rank correlation of slip time with speed", "1", None, *ranks)]
    rows += [
        Row(
            f"mean slip time at v {v:.2f} m/s",
            "s",
            None,
            *(float(times[model][SPEEDS.index(v)]) for model in MODELS),
        )
        for v in (0.01, 0.15, 0.37, 0.82)
    ]
    return Claim(
        "C9",
        "slips last longer the faster the surface",
        tuple(rows),
        (
            Check(
                f"slip time grows with speed, rank correlation above {TREND}",
                *(_grows(times[model]) for model in MODELS),
                margin=Margin("rank correlation, exact", ranks[-1], TREND),
                turns=(
                    _varied("µ_k constant instead of falling with speed", PUT_IN, weakening=0.0),
                    _varied("µ_s no more than µ_k", mu_s=CASE.mu_k, weakening=0.0),
                ),
            ),
        ),
        remarks=(
            "Closed form with constant µ: from "
            f"{_closed_form(SPEEDS[0]):.3f} s at {SPEEDS[0]:.2f} m/s to "
            f"{_closed_form(SPEEDS[-1]):.3f} s at {SPEEDS[-1]:.2f} m/s: from half a period "
            "to a whole one.",
            _no_stick(times["exact"]),
            "The study's text has its speeds from 0.15 m/s, the caption of its figure from 0.01 to "
            "0.5 m/s, and its outliers lie at 0.79 to 0.82 m/s.",
        ),
        assumed=(LAW_ASSUMED, GUIDED_ASSUMED),
        pictures=(_draw(times),),
        scope=_scope(times["exact"]),
        place="§5.2, fig. 5.6",
        rests=f"the speeds at which the exact model sticks: {np.isfinite(times['exact']).sum()} of "
        f"{len(SPEEDS)}",
    )


def _varied(change: str, weight: str = FAR, **numbers: float) -> Turn:
    """The trend of the exact model with another friction."""
    times = np.array(
        [exact_figures(CASE.changed(speed=v, **numbers), rig=GUIDED).slip_time for v in SPEEDS]
    )
    known = times[np.isfinite(times)]
    figure = f"from {known[0]:.3f} to {known[-1]:.3f} s, stick at {len(known)} of {len(SPEEDS)}"
    return Turn(change, f"{figure} speeds", _grows(times), weight)


def _grows(times: np.ndarray) -> bool:
    """A trend with speed, and one that is more than rounding."""
    known = times[np.isfinite(times)]
    return _rank(times) > TREND and known[-1] > (1.0 + GROWTH) * known[0]


def _no_stick(times: np.ndarray) -> str:
    """From which speed on the exact model has no stick at all."""
    without = [v for v, time in zip(SPEEDS, times, strict=True) if not np.isfinite(time)]
    if not without:
        return "The exact model sticks at every speed."
    return (
        f"Exact model: no stick at {', '.join(f'{v:.2f}' for v in without)} m/s. Where the speeds "
        "meet, the springs pull harder than µ_s m g, and the block slides through; the study "
        "treats its four runs from 0.79 to 0.82 m/s as outliers."
    )


def _scope(times: np.ndarray) -> str:
    """The speeds at which there is a slip to time."""
    sticks = np.isfinite(times)
    if sticks.all():
        return ""
    return (
        f"where the block sticks at all: in the exact model at {sticks.sum()} of {len(SPEEDS)} "
        f"speeds, up to {np.array(SPEEDS)[sticks].max():.2f} m/s; above that there is no slip time"
    )


def _rank(times: np.ndarray) -> float:
    """Spearman's rank correlation with the speed where there was a slip."""
    known = np.isfinite(times)
    return float(spearmanr(np.array(SPEEDS)[known], times[known]).statistic)


@picture(
    "C9_slip_time",
    "Mean slip time over the speed of the surface, m 0.67 kg, k 20.17 N/m; "
    "line: closed form with constant µ. Study: figure 5.6.",
)
def _draw(times: dict[str, np.ndarray]):
    figure, axes = panels(1, 1, height=3.0, width=6.0)
    ax = axes[0, 0]
    by_model(ax, SPEEDS, times)
    ax.plot(
        SPEEDS,
        [_closed_form(v) for v in SPEEDS],
        color=INK,
        lw=0.9,
        ls=":",
        label="closed form, constant µ",
    )
    ax.set_xlabel("surface speed, m/s")
    ax.set_ylabel("mean slip time, s")
    ax.legend()
    return figure

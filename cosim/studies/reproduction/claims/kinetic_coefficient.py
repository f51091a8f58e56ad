"""C10: the mean kinetic coefficient: its range, and how mass, speed and stiffness act on it."""

from __future__ import annotations

import numpy as np

from cosim.studies.drawing import SERIES, panels, picture

from ..cases import EXTRA_STIFFNESS, GUIDED_ASSUMED, MASSES, SPEEDS, STIFFNESSES
from ..claim import Check, Claim, Row
from ..drawing import LABELS, MODELS
from ..series import ASSUMED, Grid, grid

ALL_STIFFNESSES = (*STIFFNESSES, EXTRA_STIFFNESS)
RANGE = (0.05, 0.11)
# lines over mass count as horizontal where mu_k strays by less than this part of its mean
HORIZONTAL = 0.05

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
    by_speed = {model: mu[model].mean(axis=(0, 1)) for model in MODELS}
    strays = [_strays(mu[model]) for model in MODELS]
    rows = [
        Row("smallest mean µ_k", "1", RANGE[0], *(float(mu[m].min()) for m in MODELS)),
        Row("largest mean µ_k", "1", RANGE[1], *(float(mu[m].max()) for m in MODELS)),
        Row("largest spread over mass, part of the mean", "1", "none", *strays),
    ]
    rows += [
        Row(f"spread over speed at k {k:.2f} N/m", "1", "shrinks with k",
            *(float(spreads[model][i]) for model in MODELS))
        for i, k in enumerate(ALL_STIFFNESSES)
    ]
    return Claim(
        "C10", "mean µ_k is 0.05 to 0.11, constant in mass, falls with speed, and its spread "
        "shrinks with stiffness", tuple(rows),
        (
            Check("lies in 0.05 to 0.11: the friction data behind it are not printed",
                  None, None, None),
            Check(f"constant in mass within {100 * HORIZONTAL:.0f} %",
                  *(value < HORIZONTAL for value in strays)),
            Check("falls with speed",
                  *(bool(np.all(np.diff(by_speed[model]) < 0.0)) for model in MODELS)),
            Check("spread over speed shrinks with stiffness",
                  *(bool(np.all(np.diff(spreads[model]) < 0.0)) for model in MODELS)),
        ),
        remarks=(
            "Over a whole cycle the mean sliding speed is the surface's own; in slip it is that "
            "divided by the share of slip, which stiffness brings to 1. So µ_k at high stiffness "
            "differs between speeds by what the friction law differs.",
        ),
        assumed=(*ASSUMED, GUIDED_ASSUMED),
        pictures=(_draw(mu),),
    )


@picture("C10_mu_k", "Mean µ_k over mass for stiffnesses to 136.44 N/m (columns) and speeds "
         "(lines), by model (rows). Study: figures 5.8 and 5.10.")
def _draw(mu: Grid):
    figure, axes = panels(
        len(MODELS), len(ALL_STIFFNESSES), height=2.1, width=10.0, sharex=True, sharey=True
    )
    for row, model in enumerate(MODELS):
        for column, k in enumerate(ALL_STIFFNESSES):
            ax = axes[row, column]
            for i, v in enumerate(SPEEDS):
                ax.plot(MASSES, mu[model][column, :, i], "o-", ms=2.5, color=SERIES[i],
                        label=f"v {v:.2f} m/s")
            if row == 0:
                ax.set_title(f"k {k:.2f} N/m")
        axes[row, 0].set_ylabel(f"{LABELS[model]}\nmean µ_k")
    for ax in axes[-1]:
        ax.set_xlabel("mass, kg")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, ncols=6, loc="outside upper center")
    return figure

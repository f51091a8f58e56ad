"""C6: whether the published friction coefficients are four times too large.

The yardstick is everything that is known of the measurements: five observations, each with the
spread that its wording leaves. A model's misfit is the root mean square of its distances from
them, in those spreads.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
from matplotlib.figure import Figure
from stickslip.reference.scheme_errors import MENDED, PRINTED, Faults

from cosim.report.style import GREY, LIGHT_GREY, panels

from ..cases import (
    DATASET_1,
    DATASET_2,
    PRETENSION,
    Case,
    exact_figures,
    exact_motion,
    scheme_figures,
    scheme_motion,
)
from ..claim import Claim, responsible
from ..drawing import COLOURS, MODELS, Panel, figure_of, over_time
from ..motion import MotionFigures
from ..sheet import STUDY, WRITTEN, Sheet

Array = np.ndarray

Y_STIFFNESS = 38.50  # the mean of y is known for these springs
ENOUGH = 1.5  # one fault explains by itself what others do not lessen by a third
# pretension is not printed: the exact model is laid beside the observations with each of these, m
PRETENSIONS = tuple(0.001 * mm for mm in range(13))
CLOSE = 0.003  # m: what the curves that were laid one over the other may be off by
#: Figures of the experiment, in the order of every array here; where the study prints no number,
#: value says what counts as it.
OBSERVATIONS = WRITTEN["C6"]["observation"]
OBSERVED = np.array([one.get("value") or STUDY[one["study"]].number for one in OBSERVATIONS])
SPREADS = np.array([one["spread"] for one in OBSERVATIONS])
ROTATION, MEAN_X = 3, 1
#: The study's scheme against the observations: key in `claims.toml` -> friction, faults.
SCHEMES = {
    "printed_full": (DATASET_1, PRINTED),
    "printed_cut": (DATASET_2, PRINTED),
    "cut_F2": (DATASET_2, PRINTED.without("F2")),
    "full_F1": (DATASET_1, PRINTED.without("F1")),
    "full_F1_F12": (DATASET_1, PRINTED.without("F1", "F12")),
    "full_F1_F2": (DATASET_1, PRINTED.without("F1", "F2")),
    "mended_full": (DATASET_1, MENDED),
    "mended_cut": (DATASET_2, MENDED),
}


def observed(of: Callable[[float], MotionFigures]) -> Array:
    """(5,) what a model shows of the observations; of: its figures, for a stiffness in N/m."""
    here = of(DATASET_1.stiffness)
    stiffer = of(Y_STIFFNESS)
    return np.array([*(getattr(here, one["figure"]) for one in OBSERVATIONS[:-1]), stiffer.mean_y])


def distances(values: Array) -> Array:
    """(5,) from the observations, in spreads; a figure that a model lacks is as far as zero."""
    # the rig is its own mirror image: which way y goes is a matter of chance
    values = np.nan_to_num(np.append(values[:-1], abs(values[-1])))
    return np.abs(values - OBSERVED) / SPREADS


def misfit(values: Array, weights: Array | float = 1.0) -> float:
    """Root mean square distance; weights: 0 leaves one out, a half doubles its spread."""
    weights = weights * np.ones(len(values))
    return float(np.sqrt(np.sum((weights * distances(values)) ** 2) / np.sum(weights > 0.0)))


def of_scheme(case: Case, faults: Faults) -> Array:
    """The study's scheme."""
    return observed(lambda k: scheme_figures(case.changed(stiffness=k), faults))


def of_exact(case: Case, pretension: float = PRETENSION) -> Array:
    """The exact model."""
    return observed(lambda k: exact_figures(case.changed(stiffness=k), pretension=pretension))


@cache
def variants() -> dict[str, tuple[str, Array]]:
    """Everything that is laid beside the measurements: key -> name, what it shows."""
    full, cut = (_fitted(case) for case in (DATASET_1, DATASET_2))
    found = {key: of_scheme(*of) for key, of in SCHEMES.items()} | {
        "exact_full": of_exact(DATASET_1),
        "exact_cut": of_exact(DATASET_2),
        "exact_loose": of_exact(DATASET_1, 0.0),
        "exact_fitted": of_exact(DATASET_1, full),
        "exact_fitted_cut": of_exact(DATASET_2, cut),
    }
    said = {"full": 1e3 * full, "cut": 1e3 * cut}
    names = WRITTEN["C6"]["variant"]
    return {key: (names[key].format(**said), values) for key, values in found.items()}


def _fitted(case: Case) -> float:
    """The pretension of `PRETENSIONS` with which the exact model fits best, m."""
    return min(PRETENSIONS, key=lambda pretension: misfit(of_exact(case, pretension)))


def needed_friction(mean_x: float) -> float:
    """Mean friction by weight of a steady motion: over whole cycles it is the mean spring force."""
    return 4.0 * DATASET_1.stiffness * mean_x / DATASET_1.weight


def judge() -> Claim:
    """All observations against every variant; the claim holds where a quarter of mu fits better."""
    sheet, of = Sheet("C6"), {key: values for key, (_, values) in variants().items()}
    full = np.array([of[f"{model}_full"] for model in MODELS])
    cut = np.array([of[f"{model}_cut"] for model in MODELS])
    for one, ours in zip(OBSERVATIONS, full.T, strict=True):
        derived = one.get("value")
        sheet.row(one["figure"], ours, study=one["study"], derived=derived)
    with_full, with_cut = ([misfit(values) for values in models] for models in (full, cut))
    sheet.row("misfit_full", with_full)
    sheet.row("misfit_cut", with_cut)
    takes = needed_friction(OBSERVED[MEAN_X])
    sheet.row("takes", [None, None, needed_friction(full[2, MEAN_X])], derived=takes)
    faults = responsible(_quarter_wins)
    sheet.check("fits", np.divide(with_cut, with_full), faults=faults)
    for name, weight in (("left_out", 0.0), ("doubled", 0.5)):
        for i, one in enumerate(OBSERVATIONS):
            weights = np.where(np.arange(len(OBSERVATIONS)) == i, weight, 1.0)
            _weighed(sheet, name, full[2], cut[2], weights, says=_name(one))
    _weighed(sheet, "fitted", of["exact_fitted"], of["exact_fitted_cut"])
    low, high = (needed_friction(OBSERVED[MEAN_X] + side * CLOSE) for side in (-1.0, 1.0))
    sheet.check(
        "balance",
        answers=np.abs(cut[:, MEAN_X] - OBSERVED[MEAN_X]) <= CLOSE,
        margin=takes / DATASET_2.mu_s,
    )
    sheet.turn("other_mean", sound=low <= DATASET_2.mu_s, low=low, high=high)
    mean = of["exact_fitted_cut"][MEAN_X]
    sound = abs(mean - OBSERVED[MEAN_X]) <= CLOSE
    sheet.turn("other_pretension", 1e3 * mean, sound=sound, instead=1e3 * cut[2, MEAN_X])
    sheet.picture("C6_observations", _draw_observations)
    sheet.picture("C6_displacements", _draw_motion, live=True)
    return sheet.claim(faults=", ".join(faults) or "none", **_remarked(of))


def _quarter_wins(faults: Faults) -> bool:
    """Whether the study's dataset #2 fits better than all of mu does under these faults."""
    return misfit(of_scheme(DATASET_2, PRINTED)) < misfit(of_scheme(DATASET_1, faults))


def _weighed(
    sheet: Sheet, name: str, full: Array, cut: Array, weights: Array | float = 1.0, says: str = ""
) -> None:
    full_fit, cut_fit = misfit(full, weights), misfit(cut, weights)
    sheet.turn(name, cut_fit / full_fit, full=full_fit, cut=cut_fit, says=says)


def _name(one: dict) -> str:
    """Of an observation, as its row has it."""
    return WRITTEN["C6"]["row"][one["figure"]]["says"].removesuffix(", µ full")


def _remarked(of: dict[str, Array]) -> dict[str, object]:
    """What the remarks leave open."""
    fits = {key: misfit(values) for key, values in of.items()}
    alone, others = fits["full_F1"], min(fits["full_F1_F12"], fits["full_F1_F2"])
    better = "yes" if alone < ENOUGH * others else "in part"
    names = {key: name for key, (name, _) in variants().items()}
    best = min(fits, key=fits.__getitem__)
    met = {key: int(np.sum(distances(values) <= 1.0)) for key, values in of.items()}
    return {
        "answer": (better if alone < fits["printed_cut"] else "no").capitalize(),
        "fits": fits,
        "turned": of["full_F1"][ROTATION],
        "counts": [of["exact_full"][0], of["exact_cut"][0]],
        "best": f"{names[best]}, misfit {fits[best]:.1f}",
        "table": "; ".join(
            f"{names[key]}: misfit {fits[key]:.1f}, {met[key]} of 5 met" for key in of
        ),
        "spreads": ", ".join(
            f"{_name(one)} {value:g} ± {one['spread']:g}"
            for one, value in zip(OBSERVATIONS, OBSERVED, strict=True)
        ),
    }


def _draw_observations() -> Figure:
    figure, axes = panels(1, len(OBSERVATIONS), height=3.9, width=10.0, sharey=True)
    names = [name for name, _ in variants().values()]
    for i, (ax, one) in enumerate(zip(axes[0], OBSERVATIONS, strict=True)):
        ax.axvspan(OBSERVED[i] - SPREADS[i], OBSERVED[i] + SPREADS[i], color=LIGHT_GREY)
        ax.axvline(OBSERVED[i], color=GREY, lw=1.0)
        for place, (key, (_, values)) in enumerate(variants().items()):
            model = key.partition("_")[0]
            colour = COLOURS[MODELS.index(model) if model in MODELS else 0]
            ax.plot(values[i], place, "o", color=colour)
        ax.set_title(one["title"], fontsize=8.5)
        ax.locator_params(axis="x", nbins=4)
    axes[0, 0].set_yticks(range(len(names)), names)
    axes[0, 0].invert_yaxis()
    return figure


def _draw_motion() -> Figure:
    shown = (
        ("printed_full", scheme_motion(DATASET_1, PRINTED), COLOURS[0]),
        ("printed_cut", scheme_motion(DATASET_2, PRINTED), COLOURS[0]),
        ("mended_full", scheme_motion(DATASET_1, MENDED), COLOURS[1]),
        ("exact_full", exact_motion(DATASET_1), COLOURS[2]),
    )
    cells = []
    for key, motion, colour in shown:
        begin = 0.4 * motion.time[-1]
        line = over_time(motion, "x", 100.0, begin, begin + 10.0, color=colour)
        cells.append(Panel([line], "time, s", "x, cm", variants()[key][0], {"measured mean": 2.0}))
    return figure_of([cells[:2], cells[2:]], height=2.1, sharex=True, sharey=True)

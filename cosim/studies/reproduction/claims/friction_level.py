"""C6: whether the published friction coefficients are four times too large.

The yardstick is everything that is known of the measurements: five observations, each with the
spread that its wording leaves. A model's misfit is the root mean square of its distances from
them, in those spreads.
"""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from stickslip.reference.scheme_options import MENDED, PRINTED, Faults

from cosim.report.palette import LIGHT_GREY
from cosim.report.style import panels

from .. import cases
from ..cases import DATASET_1, DATASET_2, DATASETS, Case
from ..claim import MODELS, STUDY, WRITTEN, Claim, responsible
from ..drawing import COLOURS, Panel, add_picture, over_time
from ..motion import Motion

Array = np.ndarray

Y_STIFFNESS = 38.50  # the mean of y is known for these springs
ENOUGH = 1.5  # one fault explains by itself what others do not lessen by a third
# pretension is not printed: the exact model is laid beside the observations with each of these, m
PRETENSIONS = tuple(0.001 * mm for mm in range(13))
CLOSE = 0.003  # m: what the curves that were laid one over the other may be off by
#: Figures of the experiment, in the order of every array here; where the study prints no number,
#: value says what counts as it.
OBSERVATIONS = WRITTEN["C6"]["observation"]
OBSERVED = np.array([one.get("value") or STUDY[one["study"]].value for one in OBSERVATIONS])
SPREADS = np.array([one["spread"] for one in OBSERVATIONS])
ROTATION, MEAN_X = 3, 1


def observed(of: Callable[[float], dict[str, float]]) -> Array:
    """(5,) what a model shows of the observations; of: its figures, for a stiffness in N/m."""
    here, stiffer = of(DATASET_1.stiffness), of(Y_STIFFNESS)
    return np.array([*(here[one["figure"]] for one in OBSERVATIONS[:-1]), stiffer["mean_y"]])


def distances(values: Array) -> Array:
    """(5,) from the observations, in spreads; a figure that a model lacks is as far as zero."""
    # the rig is its own mirror image: which way y goes is a matter of chance
    values = np.nan_to_num(np.append(values[:-1], abs(values[-1])))
    return np.asarray(np.abs(values - OBSERVED) / SPREADS)


def misfit(values: Array, weights: Array | float = 1.0) -> float:
    """Root mean square distance; weights: 0 leaves one out, a half doubles its spread."""
    weights = weights * np.ones(len(values))
    return float(np.sqrt(np.sum((weights * distances(values)) ** 2) / np.sum(weights > 0.0)))


def of_scheme(case: Case, faults: Faults) -> Array:
    """The study's scheme."""
    return observed(lambda k: cases.scheme_figures(case.changed(stiffness=k), faults))


def of_exact(case: Case, pretension: float) -> Array:
    """The exact model."""
    return observed(lambda k: cases.exact_figures(case.changed(stiffness=k), pretension=pretension))


@cache
def variants() -> dict[str, tuple[str, Array]]:
    """Everything that is laid beside the measurements: key -> name, what it shows."""
    found = {}
    for key, one in WRITTEN["C6"]["variant"].items():
        case, pretension = DATASETS[one["dataset"]], one.get("pretension")
        if pretension == "fitted":
            pretension = min(PRETENSIONS, key=lambda m: misfit(of_exact(case, m)))
        if (mended := one.get("mended")) is not None:
            values = of_scheme(case, MENDED if mended == "all" else PRINTED.without(*mended))
        else:
            values = of_exact(case, pretension)
        found[key] = str(one["name"]).format(mm=1e3 * (pretension or 0.0)), values
    return found


def needed_friction(mean_x: float) -> float:
    """Mean friction by weight of a steady motion: over whole cycles it is the mean spring force."""
    return 4.0 * DATASET_1.stiffness * mean_x / DATASET_1.weight


def _quarter_wins(faults: Faults) -> bool:
    """Whether the study's dataset #2 fits better than all of mu does under these faults."""
    return misfit(of_scheme(DATASET_2, PRINTED)) < misfit(of_scheme(DATASET_1, faults))


def judge(claim: Claim) -> dict[str, Any]:
    """All observations against every variant; the claim holds where a quarter of mu fits better."""
    of = {key: values for key, (_, values) in variants().items()}
    full, cut = (np.array([of[f"{model}_{mu}"] for model in MODELS]) for mu in ("full", "cut"))
    for one, ours in zip(OBSERVATIONS, full.T, strict=True):
        claim.row(one["figure"], ours, study=one["study"], derived=one.get("value"))
    with_full, with_cut = ([misfit(values) for values in models] for models in (full, cut))
    claim.row("misfit_full", with_full)
    claim.row("misfit_cut", with_cut)
    takes = needed_friction(OBSERVED[MEAN_X])
    claim.row("takes", [None, None, needed_friction(full[2, MEAN_X])], derived=takes)
    faults = responsible(_quarter_wins)
    claim.check("fits", np.divide(with_cut, with_full), faults=faults)
    for name, weight in (("left_out", 0.0), ("doubled", 0.5)):
        for i, one in enumerate(OBSERVATIONS):
            weights = np.where(np.arange(len(OBSERVATIONS)) == i, weight, 1.0)
            fits = [misfit(values[2], weights) for values in (full, cut)]
            claim.turn(name, fits[1] / fits[0], fits=fits, says=one["name"])
    fits = [misfit(of[key]) for key in ("exact_fitted", "exact_fitted_cut")]
    claim.turn("fitted", fits[1] / fits[0], fits=fits)
    near = np.abs(cut[:, MEAN_X] - OBSERVED[MEAN_X]) <= CLOSE
    claim.check("balance", near, margin=takes / DATASET_2.mu_s)
    low, high = (needed_friction(OBSERVED[MEAN_X] + side * CLOSE) for side in (-1.0, 1.0))
    claim.turn("other_mean", sound=low <= DATASET_2.mu_s, low=low, high=high)
    mean = of["exact_fitted_cut"][MEAN_X]
    sound = abs(mean - OBSERVED[MEAN_X]) <= CLOSE
    claim.turn("other_pretension", 1e3 * mean, sound=sound, instead=1e3 * cut[2, MEAN_X])
    add_picture(claim, "C6_observations", draw=_draw_observations)
    runs = dict(zip(MODELS, cases.three_motions(DATASET_1), strict=True))
    printed, *mended = (_in_motion(f"{model}_full", run) for model, run in runs.items())
    other = _in_motion("printed_cut", cases.scheme_motion(DATASET_2, PRINTED))
    add_picture(claim, "C6_displacements", [[printed, other], mended])
    return {"faults": ", ".join(faults) or "none"} | _remarked(of)


def _remarked(of: dict[str, Array]) -> dict[str, Any]:
    """What the remarks leave open."""
    names = {key: name for key, (name, _) in variants().items()}
    fits = {key: misfit(values) for key, values in of.items()}
    met = {key: np.sum(distances(values) <= 1.0) for key, values in of.items()}
    alone, others = fits["printed_F1"], min(fits["printed_F1_F12"], fits["printed_F1_F2"])
    enough = "Yes" if alone < ENOUGH * others else "In part"
    best = min(fits, key=fits.__getitem__)
    table = [f"{names[key]}: misfit {fits[key]:.1f}, {met[key]} of 5 met" for key in of]
    return {
        "answer": enough if alone < fits["printed_cut"] else "No",
        "fits": fits,
        "turned": of["printed_F1"][ROTATION],
        "counts": [of["exact_full"][0], of["exact_cut"][0]],
        "best": f"{names[best]}, misfit {fits[best]:.1f}",
        "table": "; ".join(table),
    }


def _colour(key: str) -> str:
    """Of a variant: that of its model."""
    return COLOURS[MODELS.index(key.partition("_")[0])]


def _draw_observations(_rows: object, _written: object) -> Figure:
    figure, axes = panels(1, len(OBSERVATIONS), height=3.9, width=10.0, sharey=True)
    names = [name for name, _ in variants().values()]
    for i, (ax, one) in enumerate(zip(axes[0], OBSERVATIONS, strict=True)):
        ax.axvspan(OBSERVED[i] - SPREADS[i], OBSERVED[i] + SPREADS[i], color=LIGHT_GREY)
        for place, (key, (_, values)) in enumerate(variants().items()):
            ax.plot(values[i], place, "o", color=_colour(key))
        ax.set_title(one["title"], fontsize=8.5)
        ax.locator_params(axis="x", nbins=4)
    axes[0, 0].set_yticks(range(len(names)), names)
    axes[0, 0].invert_yaxis()
    return figure


def _in_motion(key: str, motion: Motion) -> Panel:
    """x of a variant over 10 s, steady."""
    begin = 0.4 * motion.time[-1]
    line = over_time(motion, "x", 100.0, begin, begin + 10.0, color=_colour(key))
    return Panel([line], variants()[key][0], {"measured mean": 100.0 * OBSERVED[MEAN_X]})

"""Effects as free curves, one axis after the other, scored on runs that each leaves out.

The plain model, settled, knows the friction of every stretch of every run and how surely. A curve
over an axis is a vote of the data alone: it knows of no law, and is right where a law of another
shape is at work. Along most axes friction drifts from stretch to stretch; sliding speed, position
and velocity act within one, and there the model's own response to a curve is what counts.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

from stickslip.effects.effect import AXES

from cosim.gap.data import MeasuredRun
from cosim.gap.evidence.mixed import MixedModel
from cosim.gap.evidence.products import deviations
from cosim.gap.evidence.settled import Settled, best_spreads
from cosim.processes import Map

from .axes import simulated, stretches
from .columns import FORCES, ON, of_force, of_sliding_speed, of_stretches
from .curve import Curve
from .vote import Vote, counted, quick


def curves(
    base: Settled,
    runs: Sequence[MeasuredRun],
    mapped: Map,
    axes: Collection[str] = AXES,
) -> tuple[Curve, ...]:
    """One for each of some axes along which these runs differ, the largest gain first.

    base : the model that lacks what is looked for. Of what a curve can move, and how long heat is
    remembered, the likeliest is taken. Empty where there are fewer than two runs for fitting, so
    that none can be predicted from another.
    """
    if not axes or sum(not run.hold_out for run in runs) < 2:
        return ()
    outputs, base = simulated(base), of_their_weight(base)
    drifts = [
        columns
        for along in stretches(base, runs, outputs)
        if along.axis in axes
        for on in ON
        if (columns := of_stretches(base, along, on)) is not None
    ]
    within = [of_sliding_speed(base, runs, outputs, mapped)] if "sliding speed" in axes else []
    within += [of_force(base, runs, outputs, axis, mapped) for axis in FORCES if axis in axes]
    within = [replace(each, mixed=weighted(base, each.mixed)) for each in within]
    likeliest: dict[str, Vote] = {}
    for vote in mapped(quick, [(base, columns) for columns in (*drifts, *within)]):
        best = likeliest.setdefault(vote.columns.axis, vote)
        if vote.deviance < best.deviance:
            likeliest[vote.columns.axis] = vote
    found = list(mapped(counted, [(base, vote) for vote in likeliest.values()]))
    return tuple(sorted(found, key=lambda curve: -curve.gain))


def of_their_weight(base: Settled) -> Settled:
    """The settled model with every run's noise as large as what is left of it, if that is more.

    A run that the plain model cannot be laid along, with friction of every stretch its own, would
    outvote all others by what no curve explains.
    """
    mixed = weighted(base, base.mixed)
    about = base.problem, base.fitted, base.model.free_parameters
    spreads, promised = best_spreads(mixed, *about, base.spreads)
    wide = deviations(*about, spreads)
    solution = mixed.solved(mixed.forms(wide), wide)
    return replace(
        base,
        mixed=mixed,
        solution=solution,
        ahead=spreads,
        promised=promised,
        deviance=promised,
        spreads=spreads,
        left_out=solution.left_out,
    )


def weighted(base: Settled, mixed: MixedModel) -> MixedModel:
    """Of the same runs, their products in units of what the settled model leaves."""
    left = [max(1.0, base.fitted.rms_residual([i])) for i in range(len(mixed.runs))]
    runs = [
        replace(run, grams=run.grams / size**2) for run, size in zip(mixed.runs, left, strict=True)
    ]
    return MixedModel(runs, mixed.shared, mixed.laws)


__all__ = ["Curve", "curves"]

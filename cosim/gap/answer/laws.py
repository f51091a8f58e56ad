"""What was found as free curves, and a curve in the model where the catalogue has no law for it."""

from __future__ import annotations

from collections.abc import Sequence

from stickslip import EFFECTS
from stickslip.effects.effect import AXES

from cosim.gap.curves.curves import curves
from cosim.gap.curves.tables import refined
from cosim.gap.evidence.settled import Settled
from cosim.gap.result import Law
from cosim.gap.selection.decision import needed
from cosim.gap.selection.tried import by_run, gain
from cosim.gap.selection.verdict import Finding
from cosim.processes import Map

from .models import Bench

_AXES = {effect.id: effect.axis for effect in EFFECTS if effect.axis}
#: The one axis over which the kernel looks friction up.
_SPEED = "sliding speed"


def laws_found(bench: Bench, finding: Finding, mapped: Map) -> tuple[Law, ...]:
    """Every effect's curve about the model without it; where nothing was named, all that help."""
    if finding.verdict == "unknown":
        found = curves(finding.ladder[0].settled, bench.runs, mapped)
        return tuple(Law("", curve) for curve in found if curve.helps())
    laws = []
    for below, rung in zip(finding.ladder, finding.ladder[1 : finding.chosen + 1], strict=False):
        effects = [each.candidate.effect for each in rung.members]
        axes = {_AXES[effect]: effect for effect in reversed(effects) if effect in _AXES}
        found = curves(below.settled, bench.runs, mapped, tuple(axes))
        laws += [Law(axes[curve.axis], curve) for curve in found]
    return tuple(laws)


def table_found(
    bench: Bench, finding: Finding, laws: Sequence[Law], mapped: Map
) -> tuple[Law, Settled] | None:
    """Friction over the sliding speed as a table in the model, where that surely helps.

    In every run, and by more than the likeliest of all axes would by chance. None where something
    was named and nothing is left, or where the curve is of a law that is in the model already.
    """
    if finding.verdict not in ("partial", "unknown"):
        return None
    base, axes = finding.model, {_AXES.get(effect) for effect in finding.effects}
    if _SPEED in axes:
        return None
    known = [law.curve for law in laws if finding.verdict == "unknown"]
    seen = known or curves(base, bench.runs, mapped, (_SPEED,))
    curve = next((one for one in seen if (one.axis, one.on) == (_SPEED, "mu_k")), None)
    if curve is None or not curve.helps():
        return None
    curve, after = refined(base, bench.runs, curve, mapped)
    if gain(after, base) <= needed(len(AXES)) or not (by_run(after, base) > 0.0).all():
        return None
    return Law("", curve, in_model=True), after

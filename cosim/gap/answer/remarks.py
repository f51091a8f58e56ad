"""What the reader should know beside the answer, a line each."""

from __future__ import annotations

import math
from collections.abc import Sequence

from cosim.gap.camera.quantisation import Quantisation
from cosim.gap.candidates.catalogue import laws_of_speed
from cosim.gap.data import Campaign
from cosim.gap.diagnostics.where import told_chance

#: Effects that only motion across the surface shows.
_ACROSS = ("lateral_friction", "turning_surface", "spring_misalignment")


def remarks(
    campaign: Campaign, tried: Sequence[str], rounded: Quantisation | None
) -> tuple[str, ...]:
    """What was not tried or not used and why, and in what steps the tracker writes."""
    lines = []
    if rounded:
        chance = told_chance(math.log10(rounded.p) if rounded.p > 0.0 else -math.inf)
        lines.append(
            f"{100.0 * rounded.share:.3g} % of x lie on steps of {1e6 * rounded.step:.4g} µm, "
            "which is felt beside the noise (noise alone would scatter as much with probability "
            f"p {chance}): what rounding leaves is counted as noise"
        )
    if campaign.friction_table is not None:
        lines.append(
            f"{', '.join(laws_of_speed())}: not tried, as friction.table is the law of the sliding "
            "speed; what it is wrong by is sought as a curve"
        )
    silent = [effect for effect in _ACROSS if effect not in tried]
    if silent:
        seen = any("y" in run.motion.channels for run in campaign.runs if run.track is not None)
        why = "no motion across was seen" if seen else "y was not measured"
        lines.append(f"{', '.join(silent)}: not tried, as {why}")
    if "stick_stiffness" not in tried:
        lines.append(
            "stick_stiffness: not tried, as along x it is the same as another mu_s; a campaign "
            "that states mu_s under [friction] can tell"
        )
    if any(run.track is None for run in campaign.runs):
        lines.append("runs of which only figures are known were not used")
    return tuple(lines)

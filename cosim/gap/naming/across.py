"""Whether a campaign's blocks leave their line: sideways motion or rotation that is not noise."""

from __future__ import annotations

import numpy as np

from cosim.gap.read import Campaign, MeasuredRun

#: A track is cut into so many pieces, whose means have little noise left.
_PIECES = 200
#: Scatter of the pieces' means, or mean of all, in units of one sample's noise.
_MOVES, _STANDS = 0.5, 1.0


def moves_across(campaign: Campaign) -> bool:
    """Seen in y or phi of any run; False where neither was measured or the rig allows neither."""
    free = set(campaign.rig.degrees_of_freedom) & {"y", "phi"}
    return bool(free) and any(
        _moves(run, channel)
        for run in campaign.runs
        if run.track is not None
        for channel in ("y", "phi")
        if channel in run.track.channels
    )


def _moves(run: MeasuredRun, channel: str) -> bool:
    values = run.track[channel]
    values = values[np.isfinite(values)]
    each = max(5, values.size // _PIECES)
    means = values[: values.size // each * each].reshape(-1, each).mean(axis=1)
    noise = run.noise[channel]
    alone = noise / np.sqrt(each)  # what noise leaves of the means' scatter
    scatter = np.sqrt(max(np.var(means) - alone**2, 0.0))
    return bool(scatter > _MOVES * noise or abs(means.mean()) > _STANDS * noise)

"""How fast the surface is for the block, where that is not the speed that it was set to."""

from __future__ import annotations

from collections.abc import Mapping

#: Part by which a run's surface is faster than its set-point.
SPEED_OFFSET = "offset.speed"
#: Speed at which the surface leaves a block behind that sticks, just before it breaks away, m/s: a
#: contact is sheared before it slides, in proportion to its load.
CREEP = "offset.creep"


def driven_speed(set_point: float, values: Mapping[str, float]) -> float:
    """Speed of the surface, m/s."""
    return set_point * (1.0 + values.get(SPEED_OFFSET, 0.0))

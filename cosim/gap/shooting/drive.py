"""How fast the surface is for the block, where that is not the speed that it was set to."""

from __future__ import annotations

from collections.abc import Mapping

#: Part by which a run's surface is faster than its set-point.
SPEED_OFFSET = "offset.speed"

#: Way of the surface in one period of a ripple that a roller makes, m: at another speed it has
#: another frequency.
RIPPLE_LENGTH = "speed_ripple.wavelength"


def model_parameters(set_point: float, values: Mapping[str, float]) -> dict[str, float]:
    """Values as the model has them: a ripple's wavelength as the frequency at that speed."""
    flat = dict(values)
    if RIPPLE_LENGTH in flat:
        flat["speed_ripple.frequency"] = abs(set_point) / flat.pop(RIPPLE_LENGTH)
    return flat


def driven_speed(set_point: float, values: Mapping[str, float]) -> float:
    """Speed of the surface, m/s."""
    return set_point * (1.0 + values.get(SPEED_OFFSET, 0.0))

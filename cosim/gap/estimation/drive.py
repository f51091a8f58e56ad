"""How fast the surface is for the block, where that is not the speed that it was set to."""

from __future__ import annotations

import math
from collections.abc import Mapping

from stickslip.effects.candidate import SECOND

#: Part by which a run's surface is faster than its set-point.
SPEED_OFFSET = "offset.speed"

#: Travel of the surface in one period of a ripple that a roller makes, m: at another speed it has
#: another frequency.
RIPPLE_LENGTH = "speed_ripple.wavelength"


def model_parameters(set_point: float, values: Mapping[str, float]) -> dict[str, float]:
    """Values as the model has them.

    A ripple's wavelength is the frequency at that speed; a second harmonic has amplitude and phase.
    """
    flat = dict(values)
    for effect in ("speed_ripple", "surface_pattern"):
        keys = [f"{effect}.{part}" for part in SECOND]
        if all(key in flat for key in keys):
            in_phase, ahead = (flat.pop(key) for key in keys)
            flat[f"{effect}.second_amplitude"] = math.hypot(in_phase, ahead)
            flat[f"{effect}.second_phase_deg"] = math.degrees(math.atan2(ahead, in_phase))
    if RIPPLE_LENGTH in flat:
        flat["speed_ripple.frequency"] = abs(set_point) / flat.pop(RIPPLE_LENGTH)
    return flat


def driven_speed(set_point: float, values: Mapping[str, float]) -> float:
    """Speed of the surface, m/s."""
    return set_point * (1.0 + values.get(SPEED_OFFSET, 0.0))

"""Element boundaries that crowd where the temperature is steep."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def graded(length: float, elements: int, stretch: float) -> NDArray[np.float64]:
    """Element boundaries from 0 to length, m; a geometric row, last over first is `stretch`."""
    sizes = stretch ** (np.arange(elements) / max(1, elements - 1))
    return np.concatenate(([0.0], np.cumsum(sizes) * (length / sizes.sum())))

"""The study's friction: the contact disc cut into strips along y, force = pressure x area.

The mean of mu_k falls linearly with a strip's sliding speed (slope 0: it does not). The scatter
is normal. Strips scatter independently, so force and moment of all strips together are normal
too, with the variances sum f_j^2 and sum (f_j y_j)^2 and no covariance (the strips are symmetric):
two draws stand for a hundred, exactly.
"""

import math

import numpy as np

STRIPS = 100


def strips(radius: float) -> tuple[np.ndarray, np.ndarray]:
    """Shares of pi r^2 and middles y (m) of the strips, (100,) each.

    Areas by the trapezium, as the study takes them: they add up to 0.9989 of the disc.
    """
    edges = np.linspace(-radius, radius, STRIPS + 1)
    chord = 2.0 * np.sqrt(np.maximum(radius**2 - edges**2, 0.0))
    area = 0.5 * (chord[1:] + chord[:-1]) * np.diff(edges)
    return area / (math.pi * radius**2), 0.5 * (edges[1:] + edges[:-1])

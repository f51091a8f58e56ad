"""The study's friction: the contact disc cut into strips along y, force = pressure x area.

The mean of mu_k falls linearly with a strip's sliding speed (slope 0: it does not). The scatter
is normal. Strips scatter independently, so force and moment of all strips together are normal
too, with the variances sum f_j^2 and sum (f_j y_j)^2 and no covariance (the strips are symmetric):
two draws stand for a hundred, exactly.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

STRIPS = 100


def strips(radius: float) -> tuple[np.ndarray, np.ndarray]:
    """Shares of pi r^2 and middles y (m) of the strips, (100,) each.

    Areas by the trapezium, as the study takes them: they add up to 0.9989 of the disc.
    """
    edges = np.linspace(-radius, radius, STRIPS + 1)
    chord = 2.0 * np.sqrt(np.maximum(radius**2 - edges**2, 0.0))
    area = 0.5 * (chord[1:] + chord[:-1]) * np.diff(edges)
    return area / (math.pi * radius**2), 0.5 * (edges[1:] + edges[:-1])


@njit(cache=True)
def mean_load(rig, velocity, shares, middles, load):
    """Write force (N) and moment (N m) without scatter into ``load``; velocity (3,) of the block.

    A strip at y slides at v (1 - y/R) - (x' - y phi'). Friction on every strip is along +x, the
    study's assumption.
    """
    load[0] = 0.0
    load[1] = 0.0
    for j in range(shares.size):
        y = middles[j]
        surface = rig.speed * (1.0 - rig.curvature * y)
        sliding = abs(surface - velocity[0] + y * velocity[2])
        mu = max(rig.mu_k - rig.mu_slope * (sliding - rig.mu_k_speed), 0.0)
        force = mu * shares[j] * rig.normal_force
        load[0] += force
        load[1] -= force * y


@njit(cache=True)
def even_load(rig, velocity, shares, middles, load):
    """As `mean_load`, at the price of one strip where all of them slide alike.

    Alike: a rim speed of less than 1e-12 of the sliding speed moves no digit of the force that
    matters here.
    """
    sliding = abs(rig.speed - velocity[0])
    rim = abs(velocity[2]) * middles[-1]
    if rig.curvature != 0.0 or rim > 1e-12 * sliding:
        mean_load(rig, velocity, shares, middles, load)
        return
    mu = max(rig.mu_k - rig.mu_slope * (sliding - rig.mu_k_speed), 0.0)
    load[0] = mu * rig.covered * rig.normal_force
    load[1] = 0.0


@njit(cache=True)
def _hash(seed, place, channel):
    """A number in (0, 1) that belongs to (seed, place, channel): splitmix64."""
    z = np.uint64(seed) * np.uint64(0x9E3779B97F4A7C15)
    z ^= np.uint64(place + 1_000_000) * np.uint64(0xD1342543DE82EF95)
    z += np.uint64(channel) * np.uint64(0x2545F4914F6CDD1D)
    for _ in range(2):
        z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
        z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
        z = z ^ (z >> np.uint64(31))
    return (float(z >> np.uint64(11)) + 0.5) / 9007199254740992.0


@njit(cache=True)
def field_scatter(seed, place, length, normals):
    """Write two standard normals that belong to the ``place`` (m) on the surface into ``normals``.

    Independent at nodes ``length`` apart, linear between them, unit variance everywhere.
    """
    node = math.floor(place / length)
    share = place / length - node
    normals[0] = 0.0
    normals[1] = 0.0
    for side in range(2):
        weight = share if side == 1 else 1.0 - share
        radius = math.sqrt(-2.0 * math.log(_hash(seed, int(node) + side, 0)))
        angle = 2.0 * math.pi * _hash(seed, int(node) + side, 1)
        normals[0] += weight * radius * math.cos(angle)
        normals[1] += weight * radius * math.sin(angle)
    scale = 1.0 / math.sqrt(share * share + (1.0 - share) * (1.0 - share))
    normals[0] *= scale
    normals[1] *= scale

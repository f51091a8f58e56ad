"""Cameras with a fault, written without the product's observation model: dense motions, by numpy.

Each takes times (n,), s, and a path (n, 2), m, at 1 kHz and gives both as the camera writes them,
every tenth sample.
"""

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.signal import lfilter

EVERY = slice(0, None, 10)
STEP = 1e-3


def perfect(t, path):
    return t[EVERY], path[EVERY]


def scale(t, path, part=0.03):
    return t[EVERY], (1.0 + part) * path[EVERY]


def clock(t, path, part=0.03):
    return (1.0 + part) * t[EVERY], path[EVERY]


def rotation(t, path, angle=0.05):
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    return t[EVERY], (path @ turn)[EVERY]


def steady_drift(t, path, rate=3e-4):
    return t[EVERY], (path + rate * t[:, None])[EVERY]


def settling(t, path, amount=3e-3, constant=1.5):
    return t[EVERY], (path + amount * (1.0 - np.exp(-t / constant))[:, None])[EVERY]


def logarithmic(t, path, amount=1e-3, constant=0.5):
    return t[EVERY], (path + amount * np.log(1.0 + t / constant)[:, None])[EVERY]


def rolling_shutter(t, path, delay=0.02):
    """The block is at path(s) at the time s, and its line is read out delay x / 0.1 m before."""
    read = t - delay * path[:, 0] / 0.1
    return t[EVERY], np.stack([np.interp(t[EVERY], read, axis) for axis in path.T], axis=1)


def gaussian(t, path, width=0.03):
    return t[EVERY], gaussian_filter1d(path, width / STEP, axis=0, mode="nearest")[EVERY]


def past(t, path, constant=0.03):
    """Exact for a path that is straight between the times, at rest before them."""
    keep = np.exp(-STEP / constant)
    mean = (1.0 - keep) * constant / STEP
    now, before = 1.0 - mean, mean - keep
    rested = (1.0 - now) * path[:1]
    return t[EVERY], lfilter([now, before], [1.0, -keep], path, axis=0, zi=rested)[0][EVERY]


def stepped(t, path, step=1e-3):
    return t[EVERY], step * np.round(path[EVERY] / step)

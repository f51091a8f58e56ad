"""A whole run in one call: outputs at given times."""

from .advance import advance
from .layout import DONE, O_SIZE, SHOWN, TRACKED, X
from .outputs import show


def record(
    p: "float[:]",
    u: "float[:]",
    z: "float[:]",
    w: "float[:]",
    e: "float[:]",
    times: "float[:]",
    o: "float[:]",
    first: int,
    count: int,
) -> int:
    """Advance to ``times[first] ... times[first + count - 1]``, outputs row by row to ``o``.

    Returns the number of rows written: fewer than ``count`` where `advance` gave up.
    """
    for i in range(first, first + count):
        if advance(p, u, z, w, e, times[i]) != DONE:
            return i - first
        show(p, u, z, w, o, O_SIZE * i)
    return count


def track(
    p: "float[:]",
    u: "float[:]",
    z: "float[:]",
    w: "float[:]",
    e: "float[:]",
    times: "float[:]",
    o: "float[:]",
    first: int,
    count: int,
) -> int:
    """As `record`, but only what a tracker sees: x, y and phi, `TRACKED` numbers a row."""
    for i in range(first, first + count):
        if advance(p, u, z, w, e, times[i]) != DONE:
            return i - first
        for j in range(TRACKED):
            o[TRACKED * i + j] = z[SHOWN + X + j]
    return count

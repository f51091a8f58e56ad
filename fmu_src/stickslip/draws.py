"""The kernel's array ``d``: standard random numbers. Pure Python: it travels inside the FMU.

They are those of CPython's `random.Random`, which anybody can draw again: the Mersenne Twister
MT19937 (Matsumoto & Nishimura, ACM TOMACS 8, 1998), seeded by ``init_by_array`` with the seed as
its one 32-bit word. A uniform number has 53 bits: (a 2^26 + b) / 2^53 of two outputs, the upper 27
bits of the one and the upper 26 of the next. Normal deviates come in pairs of two uniform numbers
u and w, sqrt(-2 ln(1 - w)) times cos(2 pi u), then sin(2 pi u); the second of a pair waits for the
next that is asked for, whatever uniform numbers are drawn between.
"""

from collections.abc import Sequence
from functools import lru_cache
from random import Random

from .kernel.layout import D_SIZE, DRAW_SEED, DRAW_UNIFORM


def draws(v: Sequence[float]) -> list[float]:
    """Normal deviates (mean 0, standard deviation 1) and uniform numbers from 0 to 1, by seeds.

    Each is drawn, one after the other, by the seed in ``v`` that the layout names. They are the
    same whichever of what they are for is switched on.
    """
    return list(_drawn(tuple(int(v[int(place)]) for place in DRAW_SEED)))


@lru_cache
def _drawn(seeds: tuple[int, ...]) -> list[float]:
    """By the seed of each; a fit packs the same ones thousands of times."""
    d: list[float] = []
    for i in range(D_SIZE):
        if i == 0 or DRAW_SEED[i] != DRAW_SEED[i - 1]:
            source = Random(seeds[i])
        d.append(source.random() if DRAW_UNIFORM[i] else source.gauss(0.0, 1.0))
    return d

"""Where things stand in a row of a motion: enough to go on from, and what is looked at."""

from __future__ import annotations

from .apparatus import ELEMENTS, POINTS
from .friction_law import SLOW

# state, bristles, slow states, friction N, slip m/s
BRISTLES, SLOWS, FRICTION, SLIP = 6, 6 + 2 * POINTS, 6 + 2 * POINTS + SLOW, 7 + 2 * POINTS + SLOW
COLUMNS = SLIP + 1
# and of the Iwan contact: deflections of its elements m, state of rest, force N, N, N m
REST, FORCE = COLUMNS + 2 * ELEMENTS, COLUMNS + 2 * ELEMENTS + 1
IWAN_COLUMNS = FORCE + 3

"""Whether a run stays where its rig has it: on the surface, and within the springs' length.

The mechanics goes on beyond the belt's edge as if the surface were endless, and the heat model
has no y at all: its contact is the disc in the middle of the belt, or of a slab's track. So a
block that has left the belt is told of, and from when on its heat is that of a block in the
middle.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from stickslip import Parameters
from stickslip.kernel.layout import P_ANCHOR, P_ATTACH, P_CURVATURE

from cosim.report.columns import Array, Data

from .contents import mechanics_of

Numbers = dict[str, float | None]

#: Attribute of a dataset: width of the belt (of a slab: of the track that is heated), m.
WIDTH = "belt_width"
#: A disc as wide as the belt is over its edge at once: aside by this part of its radius, less
#: than 1 % of the contact has left the belt.
SLACK = 0.05
#: Times its installed length that a spring can be: no linear spring is one beyond that.
LONGEST = 2.0
#: Part of the work that may be missing from the mechanics' ledger: the default tolerance leaves
#: some 1e-11. Below so many joules there was no work to tell.
LEDGER_LIMIT = 1e-2
LEDGER_JOULES = 1e-6


def bounds_numbers(dataset: Data) -> dict[str, Any]:
    """`left_belt`, where the surface has an edge, and `overstretched`, of the springs; {}: no rows.

    Times are None for a run that stays within its bounds.
    """
    rows = known_rows(dataset)
    time, x, y, phi = (rows[name].values for name in ("time", "x", "y", "phi"))
    if time.size == 0:
        return {}
    parameters = mechanics_of(dataset)
    found = {
        "overstretched": _overstretched(parameters, time, x, y, phi),
        "left_belt": _left_belt(dataset, parameters, time, y),
        "slab_centre": _at_centre(parameters, time, x, y),
    }
    return {name: numbers for name, numbers in found.items() if numbers}


def known_rows(dataset: Data) -> Data:
    """The rows in which the block's place is known."""
    known = [np.isfinite(dataset[name].values) for name in ("x", "y", "phi")]
    return dataset.isel(time=np.all(known, axis=0))


def allowed_aside(radius: float, width: float) -> float:
    """How far aside (m) a disc (radius, m) lies on a belt (width, m) as in its middle.

    Until its rim passes the edge or, of a disc wider than the belt, until its rim is within the
    edge on the other side; at most half the width, where the belt is no longer under its centre.
    """
    return min(max(abs(0.5 * width - radius), SLACK * radius), 0.5 * width)


def contact_share(y: float, radius: float, width: float) -> float:
    """Area of a disc at y (m) on a belt along y = 0, as a part of that in the middle."""

    def below(edge: float) -> float:
        """Part of a disc of radius 1 that lies below an edge."""
        e = float(np.clip(edge, -1.0, 1.0))
        return float((np.arcsin(e) + e * np.sqrt(1.0 - e * e)) / np.pi)

    half, y = 0.5 * width / radius, y / radius
    return float((below(half - y) - below(-half - y)) / (2.0 * below(half)))


def spring_lengths(parameters: Parameters, x: Array, y: Array, phi: Array) -> Array:
    """Lengths of the springs (4, n), m, of the block at x, y (n,) m, turned by phi (n,) rad."""
    fixed, arms = spring_ends(parameters)
    c, s = np.cos(phi), np.sin(phi)
    along = x + np.outer(arms[:, 0], c) - np.outer(arms[:, 1], s) - fixed[:, :1]
    across = y + np.outer(arms[:, 0], s) + np.outer(arms[:, 1], c) - fixed[:, 1:]
    return np.asarray(np.hypot(along, across))


def spring_ends(parameters: Parameters) -> tuple[Array, Array]:
    """Of the springs the fixed ends, and those on the block from its middle, (4, 2) each, m."""
    p = parameters.pack()
    fixed, arms = (np.reshape(p[place : place + 8], (4, 2)) for place in (P_ANCHOR, P_ATTACH))
    return fixed, arms


def _left_belt(dataset: Data, parameters: Parameters, time: Array, y: Array) -> Numbers:
    """When and where the block left the belt, and how far; {} where no edge is known."""
    width = dataset.attrs.get(WIDTH)
    heated = "heat_received" in dataset
    if width is None or (_turns(parameters) and not heated):
        return {}
    radius = parameters.rig.contact_radius
    allowed, aside = allowed_aside(radius, width), np.abs(y)
    beyond, off = aside > allowed, (aside > 0.5 * width) & (not _turns(parameters))
    farthest = int(aside.argmax())
    left = {
        "time": _first(time, beyond),
        "y": _first(y, beyond),
        "allowed": allowed,
        "farthest_y": float(y[farthest]),
        "least_contact_share": contact_share(aside[farthest], radius, width),
        "centre_off_since": _first(time, off),
    }
    return left | ({"heat_as_in_the_middle_since": left["time"]} if heated else {})


def _at_centre(parameters: Parameters, time: Array, x: Array, y: Array) -> Numbers:
    """When a slab's centre came under the block; {} for a belt."""
    if not _turns(parameters):
        return {}
    centre = 1.0 / parameters.pack()[P_CURVATURE]
    distance = np.hypot(x, y - centre)
    allowed = parameters.rig.contact_radius
    at = {name: _first(each, distance < allowed) for name, each in (("time", time), ("y", y))}
    return at | {"least_distance": float(distance.min()), "allowed": allowed}


def _overstretched(parameters: Parameters, time: Array, x: Array, y: Array, phi: Array) -> Numbers:
    longest = spring_lengths(parameters, x, y, phi).max(axis=0)
    allowed = LONGEST * parameters.rig.spring_length
    if curve := parameters.springs.force_curve_extension:
        allowed = parameters.rig.spring_natural_length + curve[-1]
    beyond = _first(time, longest > allowed)
    return {"time": beyond, "longest": float(longest.max()), "allowed": allowed}


def _turns(parameters: Parameters) -> bool:
    return bool(parameters.pack()[P_CURVATURE] != 0.0)


def _first(values: Array, rows: NDArray[np.bool_]) -> float | None:
    """The value in the first of these rows, where there is one."""
    return float(values[rows.argmax()]) if rows.any() else None


def is_believed(numbers: Mapping[str, Any]) -> bool:
    """Whether the ledger of the mechanics holds, or has nothing in it."""
    mechanics = numbers.get("ledger", {}).get("mechanics", {})
    part, joules = mechanics.get("relative_residual"), mechanics.get("largest_residual", 0.0)
    return part is None or part <= LEDGER_LIMIT or joules <= LEDGER_JOULES

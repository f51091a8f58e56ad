"""The physics, written once: plain typed scalar Python on flat arrays of floats.

The same source runs interpreted (lists of floats, nothing but `math`) and translated to C (in the
FMU, and by `stickslip.compiled` in whatever else calls it). What the arrays hold is in `layout`;
parameters become the array ``p`` in `packing`. A run::

    z, w, e, o = [0.0] * Z_SIZE, [0.0] * W_SIZE, [0.0, 0.0], [0.0] * O_SIZE
    initialise(p, z, 0.0)
    advance(p, u, z, w, e, 0.01)      # DONE, or why not
    show(p, u, z, w, o, 0)

Copying ``z`` saves the run; putting it back continues it bit for bit.

The files here are the core: motion, contact, integrator. What an effect adds stands in its own file
(`stickslip.effects`) and is called by way of `terms`, which is made from the effects'
declarations, as the places in `layout` are. `stickslip.generation.source` joins all to one text, so
that every file takes all names of `layout`, and all of the files before it that it needs.
"""

from typing import Protocol


class Floats(Protocol):
    """A flat array of floats: a list, or a numpy array."""

    def __getitem__(self, place: int, /) -> float: ...

    def __setitem__(self, place: int, value: float, /) -> None: ...


# in the order in which each file uses only those before it
MODULES = (
    "layout", "terms", "cubic", "rig.springs", "rig.drive", "rig.history",
    "friction.table", "friction.coefficient", "friction.disc", "friction.force",
    "contact", "stick", "steady_sliding", "bristles.law", "motion", "runge_kutta",
    "interpolant", "events", "bristles.step", "advance", "outputs", "exchange",
    "packing.vector", "packing.contradictions",
)  # fmt: skip

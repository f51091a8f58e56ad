"""The physics, written once: plain typed scalar Python on flat arrays of floats.

The same files run interpreted (lists of floats, nothing but `math`: in the FMU), compiled by
numba (`stickslip.compiled`) and translated to C. What the arrays hold is in `layout`; parameters
become the array ``p`` in `stickslip.packing`. A run::

    z, w, e, o = [0.0] * Z_SIZE, [0.0] * W_SIZE, [0.0, 0.0], [0.0] * O_SIZE
    initialise(p, z, 0.0)
    advance(p, u, z, w, e, 0.01)      # DONE, or why not
    show(p, u, z, w, o, 0)

Copying ``z`` saves the run; putting it back continues it bit for bit.
"""

# in the order in which each file uses only those before it
MODULES = (
    "layout",
    "springs",
    "surface",
    "coefficient",
    "disc",
    "friction",
    "contact",
    "stick",
    "creep",
    "motion",
    "runge_kutta",
    "interpolant",
    "rest",
    "events",
    "advance",
    "outputs",
    "record",
)

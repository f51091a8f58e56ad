"""From the declarations of the effects to the kernel: slots, calls of their terms, one text.

What the effects declare is read here and nowhere else. `slots` gives each number its place in the
kernel's arrays, `terms` writes the functions through which the core calls the effects' terms,
`derived` those that make the effects' numbers from their parameters, and `source` joins it all to
the one text that runs interpreted, under numba, as C and inside the FMU.
"""

"""Hidden-effect campaigns from a simulator of its own, to judge `stickslip gap` by.

Nothing here imports the product: another contact model (friction smooth in the sliding velocity,
summed over points of the disc), another integrator (tiny fixed steps, no stick/slip switch) and
other formulas for the effects. `python -m blind --help` writes campaigns.
"""

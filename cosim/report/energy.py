"""Energy of the block and work of the surface, from the recorded motion."""

from __future__ import annotations

import xarray as xr
from stickslip import Parameters
from stickslip.kernel import layout, motion

from .blocks import mechanics_of

# place of each coordinate in the kernel's picture of a moment
STATE = {
    "x": layout.X, "y": layout.Y, "phi": layout.PHI,
    "vx": layout.VX, "vy": layout.VY, "omega": layout.OMEGA,
}


def block_energy(parameters: Parameters, row: xr.Dataset) -> float:
    """Kinetic and elastic energy at one time, J, by the model's own laws."""
    moment = [0.0] * layout.BLOCK
    for name, place in STATE.items():
        moment[place] = float(row[name])
    return motion.block_energy(parameters.pack(), moment, 0)


def surface_work(dataset: xr.Dataset) -> float:
    """Work of the surface on the block, J; with external forces and damping, net of them.

    The ledger solved for it: gain of the block + friction heat - residual.
    """
    parameters = mechanics_of(dataset)
    first, last = dataset.isel(time=0), dataset.isel(time=-1)
    gain = block_energy(parameters, last) - block_energy(parameters, first)
    heat = float(last["heat"] - first["heat"])
    return gain + heat - float(last["energy_residual"])

"""Energy of the block and work of the surface, from the recorded motion."""

from __future__ import annotations

import xarray as xr
from stickslip import Parameters
from stickslip.kernel.layout import P_INERTIA, P_MASS
from stickslip.kernel.springs import spring_energy

from .blocks import mechanics_of


def block_energy(parameters: Parameters, row: xr.Dataset) -> float:
    """Kinetic and elastic energy at one time, J."""
    p = parameters.pack()
    x, y, phi, vx, vy, omega = (
        float(row[name]) for name in ("x", "y", "phi", "vx", "vy", "omega"))
    kinetic = 0.5 * p[P_MASS] * (vx * vx + vy * vy) + 0.5 * p[P_INERTIA] * omega * omega
    return kinetic + spring_energy(p, x, y, phi)


def surface_work(dataset: xr.Dataset) -> float:
    """Work of the surface (and of external forces, if any) on the block, J.

    The ledger solved for it: gain of the block + friction heat - residual.
    """
    parameters = mechanics_of(dataset)
    first, last = dataset.isel(time=0), dataset.isel(time=-1)
    gain = block_energy(parameters, last) - block_energy(parameters, first)
    heat = float(last["heat"] - first["heat"])
    return gain + heat - float(last["energy_residual"])

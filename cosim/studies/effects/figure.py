"""x(t) of the plain model and with an effect, one above the other's trace."""

from __future__ import annotations

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from stickslip import Parameters, simulate
from stickslip.compiled import compiled_kernel
from stickslip.kernel import layout
from stickslip.ports import OUTPUTS

from cosim.studies.drawing import BLUE, GREY, RC, Picture, picture

from .cases import CASES

INTERVAL = 0.005  # s
WARMER = 3.0  # K above the reference: what temperature_dependence is shown at


def effect_figure(effect_id: str) -> Picture:
    """PNG of the two motions, with the numbers of the case in its caption."""
    case = CASES[effect_id]
    sizes = ", ".join(f"{name} = {value:g}" for name, value in case.effect.items())
    rig = ", ".join(
        f"{block}.{name} = {value:g}"
        for block, keys in case.rig.items()
        for name, value in keys.items()
    )
    where = f"; both with {rig}" if rig else ""
    if effect_id == "temperature_dependence":
        where += f"; interface {WARMER:g} K above the reference"
    draw = picture(effect_id, f"Motion without and with the effect ({sizes}){where}.")(_draw)
    return draw(effect_id)


def _draw(effect_id: str) -> Figure:
    case = CASES[effect_id]
    begin, end = case.window
    with matplotlib.rc_context(RC):
        figure = Figure(figsize=(8.0, 2.5), layout="constrained")
        ax = figure.subplots()
        for name, parameters, colour in (
            ("without", case.parameters(None), GREY),
            ("with", case.parameters(effect_id), BLUE),
        ):
            time, x = _motion(parameters, end)
            shown = time >= begin
            ax.plot(time[shown], 1e3 * x[shown], color=colour, label=name)
        ax.set(xlabel="time [s]", ylabel="x [mm]", xlim=(begin, end), title=effect_id)
        figure.legend(loc="outside right upper")
    return figure


def _motion(parameters: Parameters, end: float) -> tuple[np.ndarray, np.ndarray]:
    """Times (n,) and x (n,), m; at a warmer interface where friction feels that."""
    if parameters.temperature_dependence.sensitivity == 0.0:
        run = simulate(parameters, end, INTERVAL)
        return run.time, run["x"]
    kernel = compiled_kernel()
    time = np.arange(0.0, end + 0.5 * INTERVAL, INTERVAL)
    p, u = np.array(parameters.pack()), np.zeros(layout.U_SIZE)
    u[layout.U_SPEED] = parameters.surface.speed
    u[layout.U_TEMPERATURE] = parameters.temperature_dependence.reference_degC + WARMER
    z, w, e = np.zeros(layout.Z_SIZE), np.zeros(layout.W_SIZE), np.zeros(layout.E_FIRST)
    o = np.zeros(layout.O_SIZE * time.size)
    kernel.initialise(p, z, 0.0)
    kernel.record(p, u, z, w, e, time, o, 0, time.size)
    slot = next(getattr(layout, port.slot) for port in OUTPUTS if port.name == "x")
    return time, o.reshape(-1, layout.O_SIZE)[:, slot]

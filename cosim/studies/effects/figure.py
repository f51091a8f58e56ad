"""x(t) of the plain model and with an effect, one above the other's trace."""

from __future__ import annotations

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from stickslip import simulate

from cosim.report.drawing import BLUE, GREY, RC, Picture, picture

from .cases import CASES, case_parameters

INTERVAL = 0.005  # s


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
    if case.warmer:
        where += f"; interface {case.warmer:g} K above the reference"
    if case.water:
        where += f"; {1e6 * case.water:g} µm of water in the contact"
    draw = picture(effect_id, f"Motion without and with the effect ({sizes}){where}.")(_draw)
    return draw(effect_id)


def _draw(effect_id: str) -> Figure:
    begin, end = CASES[effect_id].window
    with matplotlib.rc_context(RC):
        figure = Figure(figsize=(8.0, 2.5), layout="constrained")
        ax = figure.subplots()
        for name, on, colour in (
            ("without", False, GREY),
            ("with", True, BLUE),
        ):
            time, x = motion(effect_id, on)
            shown = time >= begin
            ax.plot(time[shown], 1e3 * x[shown], color=colour, label=name)
        ax.set(xlabel="time [s]", ylabel="x [mm]", xlim=(begin, end), title=effect_id)
        figure.legend(loc="outside right upper")
    return figure


def motion(effect_id: str, on: bool) -> tuple[np.ndarray, np.ndarray]:
    """Times (n,) and x (n,), m; with the effect, the interface is as warm as its case says."""
    case = CASES[effect_id]
    reference = case.effect.get("reference_degC")
    run = simulate(
        case_parameters(effect_id, on),
        case.window[1],
        INTERVAL,
        interface_temperature=reference + case.warmer if on and reference is not None else None,
        film_thickness=case.water,
    )
    return run.time, run["x"]

"""The catalogue as a page, with x(t) of the plain model and with each effect."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from stickslip import Parameters, simulate

from cosim.report.output import Picture, render
from cosim.report.style import BLUE, GREY, panels, picture

from .cases import CASES
from .catalogue import allowed

INTERVAL = 0.005  # s
WARMER = 3.0  # K above the reference: what temperature_dependence is shown at
WATER = 5e-6  # m in the contact: what mixed_lubrication is shown at


def page(entries: list[dict[str, Any]], pictures: dict[str, Picture]) -> str:
    """HTML of the entries of `described`, each with its picture inside."""
    return render(
        "effects.html.j2",
        "cosim.studies.effects",
        entries=entries,
        pictures=pictures,
        allowed=allowed,
    )


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
    if effect_id == "mixed_lubrication":
        where += f"; {1e6 * WATER:g} µm of water in the contact"
    draw = picture(effect_id, f"Motion without and with the effect ({sizes}){where}.")(_draw)
    return draw(effect_id)


def _draw(effect_id: str) -> Figure:
    case = CASES[effect_id]
    begin, end = case.window
    figure, ((ax,),) = panels(1, 1, height=2.5, width=8.0)
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
    """Times (n,) and x (n,), m; on a warmer and wet interface where friction feels that."""
    law = parameters.temperature_dependence
    warmer = WARMER if law.sensitivity > 0.0 else 0.0
    run = simulate(
        parameters,
        end,
        INTERVAL,
        interface_temperature=law.reference_degC + warmer,
        film_thickness=WATER,
    )
    return run.time, run["x"]

"""The catalogue as a page, with x(t) of the plain model and with each effect."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from stickslip import EFFECTS, Parameters, simulate
from stickslip.effects.effect import Case

from cosim.report.page import Picture, render
from cosim.report.style import BLUE, GREY, panels, picture

from .catalogue import allowed

INTERVAL = 0.005  # s
#: A rig that sticks and slips from the start: pretensioned springs, friction along x.
PLAIN: dict[str, dict[str, Any]] = {
    "rig": {"spring_natural_length": 0.17},
    "surface": {"speed": 0.15},
    "initial": {"vx": 0.15},
}
CASES: dict[str, Case] = {effect.id: effect.case for effect in EFFECTS}


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
    if case.warmer:
        where += f"; interface {case.warmer:g} K above the reference"
    if case.water:
        where += f"; {1e6 * case.water:g} µm of water in the contact"
    draw = picture(effect_id, f"Motion without and with the effect ({sizes}){where}.")(_draw)
    return draw(effect_id)


def _draw(effect_id: str) -> Figure:
    begin, end = CASES[effect_id].window
    figure, ((ax,),) = panels(1, 1, height=2.5, width=8.0)
    for name, on, colour in (("without", False, GREY), ("with", True, BLUE)):
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


def case_parameters(effect_id: str, on: bool) -> Parameters:
    """The rig of an effect's case, with the effect or without."""
    case = CASES[effect_id]
    tables = {
        name: PLAIN.get(name, {}) | dict(case.rig.get(name, {})) for name in PLAIN | dict(case.rig)
    }
    if on:
        tables[effect_id] = tables.get(effect_id, {}) | dict(case.effect)
    return Parameters.model_validate(tables)

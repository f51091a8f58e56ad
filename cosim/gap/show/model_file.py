"""The extended model as a scenario: `model.toml`, for `stickslip run`, `simulate` and the FMU."""

from __future__ import annotations

import math
import re
import textwrap
import warnings
from collections.abc import Mapping, Sequence
from typing import Any

import tomli_w
from stickslip.catalogue import Catalogue
from stickslip.packing import GRAVITY
from stickslip.plugins.load import file_of

from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.quantities import Quantity, fitted_quantities, unit_and_meaning
from cosim.gap.result import Gap
from cosim.gap.windows.run_model import LOADING, parameters_of
from cosim.gap.windows.windows import moves_across
from cosim.scenario import Scenario
from thermal import Ice

from .text import faults_of, gap_line
from .tracks import shown_runs

#: Enough that the motion is the fitted one for longer than any window.
DIGITS = 12
#: Tables that stand before the effects.
FIRST = ("rig", "springs", "friction", "surface")
STATE = ("x", "y", "phi", "vx", "vy", "omega")
#: Temperature of melting ice, which no room of a scenario with a block of ice reaches, degC.
MELTING = Ice().melting_point_degC
USAGE = (
    "",
    "  stickslip simulate model.toml     the mechanics alone",
    "  stickslip run model.toml          with the heat in belt and ice",
    "",
    "Keys are parameters of the FMU StickSlip3DOF too, as block.key.",
)


def safe_name(name: str) -> str:
    """A campaign's name as that of a file, a folder or a scenario."""
    return re.sub(r"[^\w.-]+", "-", name).strip("-.")[:80] or "campaign"


def shown_run(gap: Gap) -> MeasuredRun:
    """The run that stands for the campaign: the first that was held out, else the first."""
    return min(shown_runs(gap), key=lambda run: not run.hold_out)


def scenario_of(gap: Gap, run: MeasuredRun) -> Scenario:
    """The extended model at one run's mass, springs, speed and start."""
    fitted = gap.extended.run(run.name)
    tables = known_tables(gap.campaign, run)
    if not moves_across(gap.campaign):
        tables["rig"]["degrees_of_freedom"] = ("x",)
    tables["surface"]["speed"] = run.surface_speed * (1.0 + fitted.values.get("offset.speed", 0.0))
    put(tables, parameters_of(run, fitted.values))
    tables["initial"] = dict(zip(STATE, map(float, fitted.states[0, :6]), strict=True))
    if math.isnan(tables["initial"]["vx"]):  # it rides on the surface
        tables["initial"]["vx"] = tables["surface"]["speed"]
    interval = rounded(run.motion.interval, 6)
    tables["run"] = {"duration": float(run.motion.time[-1]), "output_interval": interval}
    tables["coupling"] = {"macro_step": interval}
    return scenario_from(gap.campaign, tables)


def model_text(gap: Gap) -> str:
    """The file: what it is, then every key that was known or found, with unit and meaning."""
    run, quantities = shown_run(gap), fitted_quantities(gap)
    return file_text(scenario_of(gap, run), _header(gap, run, quantities), quantities)


def file_text(
    scenario: Scenario, header: Sequence[str], quantities: Sequence[Quantity] = ()
) -> str:
    """A scenario as a commented file. quantities : what is said of fitted keys beside them."""
    given = scenario.model_dump(exclude_unset=True)
    known = {one.key: one for one in quantities if one.name == one.key}
    wrapped = [line for text in header for line in textwrap.wrap(text, 96)]
    lines = [f"# {line}".rstrip() for line in (*wrapped, *USAGE)] + [""]
    beginning = [key for key in ("name", "defaults", "effects") if key in given]
    lines += [_entry(key, given.pop(key)) for key in beginning]
    for table in sorted(filter(given.get, given), key=lambda table: table not in FIRST):
        lines += ["", f"[{table}]"]
        for key, value in given[table].items():
            name = f"{table}.{key}"
            said = _comment(name, value, known.get(name), scenario.catalogue)
            lines.append(f"{_entry(key, value):<34}  # {said}")
    return "\n".join(lines) + "\n"


def known_tables(campaign: Campaign, run: MeasuredRun) -> dict[str, dict[str, Any]]:
    """What the campaign says of a run; a room that no ice survives is left to the default."""
    tables = campaign.parameters(run)
    if campaign.rig.surface != "slab":
        tables["rig"].pop("slab_radius", None)
    if run.ambient_degC < MELTING:
        tables["ambient"] = {"temperature_degC": run.ambient_degC}
    return tables


def put(tables: dict[str, dict[str, Any]], values: Mapping[str, float]) -> None:
    """`table.parameter` -> value into the tables; on a slab the curvature is the rig's.

    Of several numbers of one name each has its number in brackets; they are in order.
    """
    for key, value in values.items():
        table, _, name = key.partition(".")
        if key == "turning_surface.curvature" and tables["rig"]["surface"] == "slab":
            tables["rig"]["slab_radius"] = 1.0 / float(value)
            continue
        name, _, number = name.partition("[")
        here = tables.setdefault(table, {})
        here[name] = (*here.get(name, ()), float(value)) if number else float(value)


def scenario_from(campaign: Campaign, tables: Mapping[str, Mapping[str, Any]]) -> Scenario:
    """A scenario of these tables in which everything else is off."""
    cut = {table: {key: rounded(value) for key, value in entries.items()}
           for table, entries in tables.items()}  # fmt: skip
    effects = [effect for effect in campaign.catalogue.effects if effect.id in tables]
    own = [str(file) for effect in effects if (file := file_of(effect))]
    first = {"name": f"{safe_name(campaign.name)}-model", **({"effects": own} if own else {})}
    with warnings.catch_warnings(action="ignore"):  # of friction that the fit decided on
        return Scenario.from_tables({**first, "defaults": "plain", **cut})


def rounded(value: Any, digits: int = DIGITS) -> Any:
    """Numbers with so many significant digits, also inside a tuple."""
    if isinstance(value, tuple):
        return tuple(rounded(one, digits) for one in value)
    return float(f"{value:.{digits}g}") if isinstance(value, float) else value


def _header(gap: Gap, run: MeasuredRun, quantities: Sequence[Quantity]) -> list[str]:
    """What a reader of the file alone has to know."""
    said = [
        f"The model of campaign {gap.campaign.name!r} at {run.name}. {gap.verdict.capitalize()}: "
        f"{gap.sentence}",
        f"Gap (1 is the tracker's noise): {gap_line(gap)}.",
    ]
    run_values, faults = gap.extended.run(run.name).values, ", ".join(faults_of(gap))
    rate = 0.1 * run.total_stiffness / (run.mass * GRAVITY)  # of the load, for each 0.1 m/s
    less = rate * run_values.get(LOADING, 0.0)
    beside = {
        "Of the class it has the member that fits best.": gap.verdict == "class",
        f"Friction is that of {run.name}, other runs differ.": run_values.get("offset.friction"),
        f"friction.mu_s is that at the speed of {run.name}: for each 0.1 m/s that the surface is "
        f"faster it {'falls' if less > 0.0 else 'rises'} by {abs(less):.2g}.": abs(less) > 1e-3,
        "Friction over the sliding speed is a table: no law of the catalogue follows it.": any(
            law.in_model for law in gap.laws
        ),
        f"Of the camera, and so not part of the model: {faults}.": faults,
    }
    said += [line for line, is_so in beside.items() if is_so]
    found = [one for one in quantities if any(one.key.startswith(name) for name in gap.effects)]
    return said + [f"Found, with a 90 % interval: {one.text}." for one in found]


def _entry(key: str, value: Any) -> str:
    """`key = value` in a line."""
    text = tomli_w.dumps({key: list(value) if isinstance(value, tuple) else value}).strip()
    return re.sub(r"\s*\n\s*", " ", text).replace("[ ", "[").replace(", ]", "]")


def _comment(key: str, value: Any, known: Quantity | None, catalogue: Catalogue) -> str:
    """`meaning, unit; interval`; a run's own friction may lie outside the campaign's."""
    unit, meaning = unit_and_meaning(key, catalogue)
    said = ", ".join(filter(None, (re.split(r"[:;\[]", meaning)[0].strip(), unit)))
    if known is None:
        return said
    if not known.interval:
        return f"{said}; {known.value}"
    whose = "fitted" if known.holds(value) else "of this run, of all"
    return f"{said}; {whose}, 90 %: {known.interval}"

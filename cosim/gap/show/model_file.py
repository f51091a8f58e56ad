"""The extended model as a scenario: `model.toml`, for `stickslip run`, `simulate` and the FMU."""

from __future__ import annotations

import re
import textwrap
import warnings
from collections.abc import Mapping
from typing import Any

import tomli_w
from stickslip.effects import EFFECTS
from stickslip.plugins.load import file_of

from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.estimation.drive import SCATTERED, TABLE, driven_speed
from cosim.gap.result import FittedRun, Gap
from cosim.scenario import Scenario
from cosim.studies.reproduction.summary import SummaryGap
from thermal import Ambient

from .quantities import unit_and_meaning
from .words import TABLE_SENTENCE, faults_of, formula, gap_line, powers_lines, sentence, verdict

#: Enough that the motion is the fitted one for longer than any segment.
DIGITS = 12
#: Tables that stand before the effects.
FIRST = ("rig", "springs", "friction", "surface")
MU_S, MU_K = SCATTERED
STATE = ("x", "y", "phi", "vx", "vy", "omega")
#: s; of a run whose time series is not known.
DURATION = 30.0
#: Part of mu_s by which a run's may differ from the campaign's without a word.
SAME = 0.005


def safe_name(name: str) -> str:
    """A campaign's name as that of a file, a folder or a scenario."""
    return re.sub(r"[^\w.-]+", "-", name).strip("-.")[:80] or "campaign"


def shown_run(gap: Gap) -> FittedRun:
    """The run that stands for the campaign: the first that was held out, or the first."""
    held = [run for run in gap.model.runs if run.track.run.hold_out]
    return (held or list(gap.model.runs))[0]


def scenario_of(gap: Gap, run: FittedRun, begun: bool = False) -> Scenario:
    """The best model at one run's mass, springs, speed and initial state.

    begun : with friction of the run's first stretch, which scatters about that of the run
    """
    measured = run.track.run
    tables = _known(gap.campaign, measured)
    tables["rig"]["degrees_of_freedom"] = gap.model.degrees_of_freedom
    fitted = {**gap.model.values, **run.own}
    tables["surface"]["speed"] = driven_speed(measured.surface_speed, fitted)
    parameters = gap.model.parameters(run)
    if begun:
        static, kinetic = run.stretch
        for key in parameters:
            if key == MU_S:
                parameters[key] *= static
            elif key == MU_K or key.startswith(TABLE):
                parameters[key] *= kinetic
    _put(tables, parameters)
    tables["initial"] = dict(zip(STATE, run.start, strict=True))
    interval = _digits(measured.motion.interval, 6)
    tables["run"] = {"duration": measured.motion.duration, "output_interval": interval}
    tables["coupling"] = {"macro_step": interval}
    return _scenario(gap.campaign, tables)


def summary_scenario(gap: SummaryGap) -> Scenario:
    """The best model at the first run's mass, springs and speed, from rest on the surface."""
    model = gap.extended or gap.plain
    tables = _known(gap.campaign, gap.campaign.runs[0])
    _put(tables, model.values)
    tables["initial"] = {"vx": gap.campaign.runs[0].surface_speed}
    tables["run"] = {"duration": DURATION}
    return _scenario(gap.campaign, tables)


def model_text(gap: Gap | SummaryGap) -> str:
    """The file: what it is, then every key that was known or found, with unit and meaning."""
    if isinstance(gap, SummaryGap):
        scenario, run = summary_scenario(gap), gap.campaign.runs[0].name
    else:
        shown = shown_run(gap)
        scenario, run = scenario_of(gap, shown), shown.name
    given = scenario.model_dump(exclude_unset=True)
    own = [] if isinstance(gap, SummaryGap) else _own_friction(gap, shown, scenario)
    beside = ("name", "defaults", "effects")
    top: dict[str, Any] = {key: given.pop(key) for key in beside if key in given}
    lines = [*_header(gap, run, own), "", *_entries(top)]
    for table in sorted(given, key=lambda table: table not in FIRST):
        if given[table]:
            lines += ["", f"[{table}]", *_entries(given[table], table)]
    return "\n".join(lines) + "\n"


def _known(campaign: Campaign, run: MeasuredRun) -> dict[str, dict[str, Any]]:
    """What the campaign says of a run; a room that no ice survives is left to the default."""
    tables = campaign.parameters(run)
    tables["rig"] = {
        key: value for key, value in tables["rig"].items()
        if key != "slab_radius" or campaign.rig.surface == "slab"
    }  # fmt: skip
    melting = next(
        m.lt for m in Ambient.model_fields["temperature_degC"].metadata if hasattr(m, "lt")
    )
    if run.ambient_degC < melting:
        tables["ambient"] = {"temperature_degC": run.ambient_degC}
    return tables


def _put(tables: dict[str, dict[str, Any]], values: Mapping[str, float]) -> None:
    """`table.parameter` -> value into the tables; on a slab the curvature is the rig's.

    Of several numbers of one name each has its number in brackets; they are in order.
    """
    for key, value in values.items():
        table, _, name = key.partition(".")
        if key == "turning_surface.curvature" and tables["rig"]["surface"] == "slab":
            tables["rig"]["slab_radius"] = 1.0 / float(value)
        else:
            name, _, number = name.partition("[")
            here = tables.setdefault(table, {})
            here[name] = (*here.get(name, ()), float(value)) if number else float(value)


def _scenario(campaign: Campaign, tables: dict[str, dict[str, Any]]) -> Scenario:
    rounded = {
        table: {key: _rounded(value) for key, value in entries.items()}
        for table, entries in tables.items()
    }
    own = [str(file) for effect in EFFECTS if effect.id in tables and (file := file_of(effect))]
    first = {"name": f"{safe_name(campaign.name)}-model", **({"effects": own} if own else {})}
    with warnings.catch_warnings(action="ignore"):  # of friction that the fit decided on
        # what was not found is not there: a file would else take it from its own defaults
        return Scenario.from_tables({**first, "defaults": "plain", **rounded})


def _rounded(value: Any) -> Any:
    if isinstance(value, tuple):
        return tuple(map(_rounded, value))
    return _digits(value, DIGITS) if isinstance(value, float) else value


def _digits(value: float, digits: int) -> float:
    return float(f"{value:.{digits}g}")


def _own_friction(gap: Gap, run: FittedRun, scenario: Scenario) -> list[str]:
    """In which this run's friction is another than that of the campaign."""
    of_campaign = gap.model.values.get(MU_S, scenario.friction.mu_s)
    if abs(scenario.friction.mu_s - of_campaign) < SAME * of_campaign:
        return []
    return [
        f"Its mu_s is that of {run.name}; of the campaign it is {of_campaign:.4g}. Friction "
        "scatters from run to run, and a contact that is loaded fast breaks away before it has "
        "all of it."
    ]


def _header(gap: Gap | SummaryGap, run: str, own: list[str]) -> list[str]:
    """What a reader of the file alone has to know; own: of the run's friction."""
    said = [
        f"The model that campaign {gap.campaign.name!r} leaves, at {run}. {verdict(gap)}",
        f"Gap: {gap_line(gap)}.",
    ]
    said += own
    if gap.verdict == "class":
        said.append("The block below is the member of the class that fits best.")
    if gap.campaign.scheme == "study":
        said.append("Fitted in the source study's scheme: the exact model moves otherwise on them.")
    if isinstance(gap, Gap):
        said += powers_lines(gap)
        if any(law.in_model for law in gap.laws):
            said.append(sentence(TABLE_SENTENCE))
    if faults_of(gap):
        said.append(f"Not part of the model, as it is of the camera: {', '.join(faults_of(gap))}.")
    if gap.empirical:
        said.append(
            "Not part of the model, as no parameter stands for it: the empirical formula for what "
            f"is left, an external force along x in SI units, {formula(gap)}"
        )
    lines = [line for text in said for line in textwrap.wrap(text, 96)]
    usage = [
        "",
        "  stickslip simulate model.toml     the mechanics alone",
        "  stickslip run model.toml          with the heat in belt and ice",
        "",
        "Keys are parameters of the FMU StickSlip3DOF too, as block.key.",
    ]
    return [f"# {line}".rstrip() for line in [*lines, *usage]]


def _entries(entries: Mapping[str, Any], table: str = "") -> list[str]:
    """`key = value   # meaning, unit` for each entry."""
    lines = []
    for key, value in entries.items():
        text = tomli_w.dumps({key: list(value) if isinstance(value, tuple) else value}).strip()
        text = re.sub(r"\s*\n\s*", " ", text).replace("[ ", "[").replace(", ]", "]")
        lines.append(f"{text:<34}{_comment(table, key)}".rstrip())
    return lines


def _comment(table: str, key: str) -> str:
    if not table:
        return ""
    unit, meaning = unit_and_meaning(f"{table}.{key}")
    meaning = re.split(r"[:;\[]", meaning)[0].strip()
    return f"  # {meaning}{f', {unit}' if unit else ''}"

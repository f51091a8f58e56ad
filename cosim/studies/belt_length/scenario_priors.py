"""The case of a scenario, and how sure it is: what it says is known as well as such figures are.

An unknown whose keys a scenario holds is drawn from a range about what it says there; one whose
keys it leaves out, from the usual range (`unknowns`). A key of what the scenario has not says
nothing, as the conductance of no rollers does: a file that spells out every key knows no more than
one that leaves such keys out. The tolerances are assumed. A range of one's own takes the place of
either.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import replace
from typing import Any

from cosim.names import unknown_name
from cosim.scenario import Scenario
from thermal.materials import GRAVITY

from .case import Case, Protocol, Range, StudyError
from .unknowns import UNKNOWNS

#: Least of what is a logarithm's: W/m2K.
_LEAST = 1e-3
#: Part of the friction that the springs of a block that never slips stay below.
_SURELY = 0.5


def scenario_case(scenario: Scenario) -> Case:
    """The belt, ice, contact, block and protocol of a scenario; StudyError for one without a belt.

    Its kinetic friction is taken as it is at the start: friction laws are the coupled run's.
    """
    surface, run, rig, friction = scenario.surface, scenario.run, scenario.rig, scenario.friction
    if rig.surface == "slab":
        raise StudyError('rig.surface = "slab": has no belt; allowed is "belt"')
    constant = run.duration - surface.run_up_time
    if friction.has_table:
        raise StudyError("friction.table_speed: allowed is one coefficient mu_k, without a table")
    if not friction.mu_k > 0.0:
        raise StudyError(f"friction.mu_k = {friction.mu_k:g}: must be above 0, or there is no heat")
    if surface.speed == 0.0:
        raise StudyError("surface.speed = 0 m/s: must not be 0, or nothing slides")
    if not constant > 0.0:
        raise StudyError(
            f"run.duration = {run.duration:g} s: nothing is left at constant speed, must be above"
            f" surface.run_up_time = {surface.run_up_time:g} s"
        )
    thermal, belt = scenario.thermal, scenario.belt
    # in still air it is that of each case's own speed; the rig's remains what a coupled run takes
    given = "air_heat_transfer" in belt.model_fields_set and belt.still_air_speed == 0.0
    air = {"still_air_speed": 0.0, "air_heat_transfer": thermal.belt.film}
    case = Case(
        length=belt.length,
        speed=abs(surface.speed),
        mass=rig.mass,
        h=belt.film if given else None,
        friction=friction.mu_k,
        ambient_degC=scenario.ambient.temperature_degC,
        protocol=Protocol(surface.run_up_time, constant),
        rig=thermal.model_copy(update={"belt": belt.model_copy(update=air)}),
        static_over_kinetic=friction.mu_s / friction.mu_k,
        stiffness=scenario.springs.stiffness,
    )
    return replace(case, ranges=tuple(_said_ranges(scenario, case)))


def check_slides(scenario: Scenario, case: Case) -> None:
    """StudyError for a block that springs cannot hold back: it is carried and makes no heat.

    Springs that pull with less than `_SURELY` of the friction at the end of a run, and a contact
    that feels no more than that of patterns and hold time. A block that begins to slide is held to
    kinetic friction. Hardening springs pull more than is reckoned here, and are left to the run.
    """
    hardening, protocol = scenario.spring_hardening, case.protocol
    if hardening.cubic or hardening.quintic:
        return
    sticks = protocol.ramp > 0.0 and scenario.initial.vx == 0.0
    mu = case.friction * (case.static_over_kinetic if sticks else 1.0)
    travel = case.speed * protocol.moving
    pull, holds = 4.0 * case.stiffness * travel, mu * case.mass * GRAVITY
    if pull < _SURELY * holds:
        raise StudyError(
            f"springs.stiffness = {case.stiffness:g} N/m: over the {travel:.3g} m that the belt "
            f"goes in a run four springs pull with at most {pull:.3g} N, and friction holds "
            f"{holds:.3g} N: the block is carried along and makes no heat; allowed are stiffer "
            "springs, longer runs or less friction"
        )


def remarks(scenario: Scenario) -> list[str]:
    """What is computed otherwise than a reader may think."""
    width, radius = scenario.belt.width, scenario.rig.contact_radius
    if scenario.ice.mesh or width >= radius:
        return []
    return [
        f"belt.width = {width:g} m is less than half of the contact, 2 rig.contact_radius = "
        f"{2.0 * radius:g} m: the ice touches it over the belt's width alone, with all its weight"
    ]


#: Keys of the resolution: a coupled run's, which lasts as long as a thousand runs of this study.
_RESOLUTION = (
    "belt.elements",
    "belt.cell_length",
    "ice.radial_elements",
    "ice.axial_elements",
    "contact.strips",
)


def ignored_keys(scenario: Scenario) -> list[str]:
    """Keys that a scenario holds and its case leaves aside, for the study has its own resolution.

    >>> from cosim import read_scenario
    >>> from cosim.studies.belt_length import ignored_keys
    >>> ignored_keys(read_scenario().changed({"belt": {"elements": 12}}))
    ['belt.elements']
    """
    return [key for key in _RESOLUTION if _said(scenario, key) is not None]


def _said_ranges(scenario: Scenario, case: Case) -> Iterator[Range]:
    """The ranges of what a scenario says itself; case: that of the scenario."""
    of_block = "block" in scenario.model_fields_set
    for unknown in UNKNOWNS:
        said = {key: _said(scenario, key) for key in unknown.said_by}
        said = {key: value for key, value in said.items() if value not in (None, ())}
        absent = unknown.there and not _said(scenario, unknown.there)
        if not said or absent or (unknown.key == "h" and case.h is None):
            continue
        own = 1.0 if unknown.unit == "x" else float(next(iter(said.values())))
        low, high = sorted(min(part * own, unknown.at_most) for part in unknown.good_to)
        if unknown.logarithmic:
            low, high = max(low, _LEAST), max(high, _LEAST)
        # keys as the scenario's file has them
        keys = [key.replace("ice.", "block.") if of_block else key for key in said]
        yield Range(
            unknown.key,
            low,
            high,
            f"{' and '.join(keys)} of the scenario, assumed to be good to"
            f" {unknown.good_to[0]:.2g} to {unknown.good_to[1]:.2g} times",
        )


def _said(scenario: Scenario, key: str) -> Any:
    """What a scenario holds itself under a key; None where it leaves that out."""
    name, _, entry = key.partition(".")
    table = getattr(scenario, name)
    return getattr(table, entry) if entry in table.model_fields_set else None


def with_ranges(case: Case, texts: Iterable[str]) -> Case:
    """A case with ranges that are given as `unknown=low,high`, or `unknown=value` for what is
    known; StudyError in one line.

    >>> from cosim.studies.belt_length import Case
    >>> with_ranges(Case(1.0, 0.5), ["roller_rise=0,0.1"]).ranges[0].high
    0.1
    """
    own = {one.key: one for one in (*case.ranges, *map(_given, texts))}
    return replace(case, ranges=tuple(own.values()))


def _given(text: str) -> Range:
    unknowns = {one.key: one for one in UNKNOWNS}
    key, _, said = text.partition("=")
    key = key.strip()
    if key not in unknowns:
        raise StudyError(f"--doubt {text}: {unknown_name('unknown', key, unknowns)}")
    unit, (least, most), ends = unknowns[key].unit, unknowns[key].allowed, []
    with suppress(ValueError):
        ends = [float(part) for part in said.split(",")]
    if not (1 <= len(ends) <= 2 and least <= ends[0] <= ends[-1] <= most):
        shown = {"1": "", "x": " times the case's own"}.get(unit, f" {unit}")
        raise StudyError(
            f"--doubt {text}: allowed is {key}=LOW,HIGH or {key}=VALUE,"
            f" {least:g} to {most:g}{shown}"
        )
    return Range(key, ends[0], ends[-1], "as asked for")

"""What is not known of the rig, in what ranges, and how the drift hangs on it.

The temperatures are linear in all heat that is put in, as long as nothing melts. So

    drift = a A + b s B + T C + d D + w E,

a the factor of the contact's friction, b the railing's friction and s its share into the belt, T
the rise of the rollers, d that of the sample at the start and w the warming of the air in the run,
as a thermostat swings it; A to E, the answers to one unit of each, hang on the other unknowns
alone. So is the rise of the interface at constant speed, with answers of its own. The part of the
contact's heat that the belt takes is none of the unknowns: it follows from how belt and ice
conduct, from the conductance between them and from where the heat arises.

A scenario says how sure it is: what it says is known as well as such figures are. An unknown whose
keys a scenario holds is drawn from a range about what it says there; one whose keys it leaves out,
from the usual range. A key of what the scenario has not says nothing, as the conductance of no
rollers does: a file that spells out every key knows no more than one that leaves such keys out. The
tolerances are assumed. A range of one's own takes the place of either.
"""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from stickslip.packaged import packaged_tables

from thermal import Belt, Layer
from thermal.arrays import Array
from thermal.contact import Footprint
from thermal.materials import GRAVITY

from ...names import unknown_name
from ...scenario import Scenario
from .case import Case, Protocol, Range, StudyError

#: Rollers and railing where the rig names none: two with 0.1 m of belt each, and as long as the
#: sample; on a short belt not more than these parts of it.
_ROLLERS, _ARC, _ARC_PART, _RAILING_PART = 2, 0.1, 0.2, 0.25


@dataclass(frozen=True)
class Unknown:
    """A range, drawn evenly, or evenly in the logarithm; `unknowns.toml` says what the fields are.

    unit "x": a factor of the case's own number; basis: where the range comes from.
    """

    key: str
    says: str
    unit: str
    low: float
    high: float
    basis: str
    allowed: Sequence[float]
    logarithmic: bool = False
    levels: int = 0
    linear: bool = False
    said_by: Sequence[str] = ()
    good_to: Sequence[float] = (1.0, 1.0)
    at_most: float = math.inf
    there: str = ""

    @property
    def fixed(self) -> bool:
        """Is there nothing to be drawn?"""
        return self.low == self.high

    def at(self, share: Array) -> Array:
        """Values at shares 0 ... 1 of the range."""
        share = self.levelled(share)
        if self.logarithmic and not self.fixed:
            return self.low * (self.high / self.low) ** share
        return self.low + (self.high - self.low) * share

    def levelled(self, share: Array) -> Array:
        """Shares in the middle of their levels."""
        if not self.levels:
            return share
        return (np.minimum(np.floor(share * self.levels), self.levels - 1) + 0.5) / self.levels


UNKNOWNS = tuple(
    Unknown(key, **entries)
    for key, entries in packaged_tables(__package__, "unknowns.toml").items()
)
#: With which the railing's share and the rollers' rise are seen where a rig has neither.
SOME_FRICTION, SOME_CONDUCTANCE = 0.1, 100.0


def unknowns_of(case: Case) -> tuple[Unknown, ...]:
    """UNKNOWNS, with the ranges that a case has of its own."""
    own = {one.key: one._asdict() for one in case.ranges}
    return tuple(replace(one, **own.get(one.key, {})) for one in UNKNOWNS)


def values(unknowns: Sequence[Unknown], shares: Array) -> dict[str, Array]:
    """Key -> values (n,) at shares (n, unknowns) of the ranges."""
    return {one.key: one.at(shares[:, i]) for i, one in enumerate(unknowns)}


#: Rises that are answered: of the belt at entry, of the interface at constant speed, of the ice's
#: face from the start, by which it is known whether it comes to melt.
ENTRY, INTERFACE, ICE = 0, 1, 2
#: Columns of A to E.
COLUMNS = CONTACT, RAILING, ROLLERS, SAMPLE, AIR = range(5)
#: K/s in K/min.
_PER_MINUTE = 1.0 / 60.0


#: Part of each unit of heat that the model is run with: so little melts no ice, and what is linear
#: answers to a whole unit, which no rig may have, from it.
_LITTLE = 1e-6


class Melts(Exception):
    """The ice melts: the drift is not linear in the heat."""


def answers(case: Case, values: dict[str, float], columns: Sequence[int] = COLUMNS) -> Array:
    """A to E of the rises of a case, K: (3, 5), as if no ice melted.

    values: of all unknowns, by key; the linear ones do not count. columns: those that are wanted,
    the others are 0. The interface's warming counts that of the air, with which a camera sees it.
    Melts where the air is as warm as melting ice.
    """
    sliding = _shaped(case, values).sliding()
    force, found = sliding.force, np.zeros((3, len(COLUMNS)))
    for column in columns:
        sliding.force = force * _LITTLE * (column == CONTACT)
        sliding.belt.railing_heat_factor = _LITTLE * (column == RAILING)
        sliding.belt.roller_rise_factor = _LITTLE * (column == ROLLERS)
        sliding.air_warming = _LITTLE * _PER_MINUTE * (column == AIR)
        sliding.reset(_LITTLE * (column == SAMPLE))
        start, end = case.follow(sliding)
        if end.melting > 0.0:
            raise Melts
        found[ENTRY, column] = end.entry
        found[INTERFACE, column] = end.mean_interface - start.mean_interface
        found[INTERFACE, column] += sliding.air_warming * case.protocol.run
        found[ICE, column] = end.ice_face
    return found / _LITTLE


def weights(values: Mapping[str, Any]) -> list[Any]:
    """How many units of each of COLUMNS there are; values: numbers, or (n,) of each unknown."""
    railing = values["railing_friction"] * values["railing_share"]
    others = [values[key] for key in ("roller_rise", "sample_rise", "air_warming")]
    return [values["friction"], railing, *others]


def combined(parts: Array, values: Mapping[str, Any]) -> Array:
    """A rise, K, from its A to E (n, 5) and the other unknowns, each a number or (n,)."""
    return np.asarray(sum(weight * parts[:, i] for i, weight in enumerate(weights(values))))


def as_it_is(case: Case) -> dict[str, float]:
    """Values with which the rig is as the case says.

    Railing and rollers that it has not take as much heat as the air in their place.
    """
    belt, contact = case.rig.belt, case.rig.contact
    return dict.fromkeys((one.key for one in UNKNOWNS if one.unit == "x"), 1.0) | {
        "h": case.film,
        "belt_side": contact.belt_side,
        "conductance": contact.conductance if case.conductance is None else case.conductance,
        "railing_friction": belt.railing_friction,
        "railing_share": belt.railing_share,
        "railing_conductance": belt.railing_conductance if belt.railing_length else case.film,
        "roller_conductance": belt.roller_conductance if belt.rollers else case.film,
        "roller_rise": belt.roller_rise if belt.rollers else 0.0,
        "sample_rise": case.ice_rise,
        "air_warming": 0.0,
    }


def with_one(case: Case, key: str, value: float) -> dict[str, float]:
    """The same but for one; where no railing or roller is, the air's heat transfer is another
    there, too.

    To see what a share of the railing's heat or a warm roller does there must be such heat, or a
    contact: `needs` says with which they are seen.
    """
    own = replace(case, h=value) if key == "h" else case
    return as_it_is(own) | needs(case, key) | {key: value}


def needs(case: Case, key: str) -> dict[str, float]:
    """What else is changed to see one unknown alone, for it is a part of it: key -> value."""
    if key == "railing_share" and case.rig.belt.railing_friction == 0.0:
        return {"railing_friction": SOME_FRICTION}
    if key == "roller_rise" and case.rig.belt.rollers == 0:
        return {"roller_conductance": SOME_CONDUCTANCE}
    return {}


def _shaped(case: Case, values: dict[str, float]) -> Case:
    """The case with the values that are not linear, and one unit of railing friction and rise."""
    belt, ice, contact = case.rig.belt, case.rig.ice, case.rig.contact
    rollers = belt.rollers or _ROLLERS
    short_arc = min(_ARC, _ARC_PART * 2.0 / rollers * case.length)
    keys = {
        "contact.conductance": values["conductance"],
        "contact.belt_side": values["belt_side"],
        "ice.conductivity": ice.conductivity * values["ice_conductivity"],
        "belt.railing_length": belt.railing_length or _room_for_railing(case),
        "belt.railing_conductance": values["railing_conductance"],
        "belt.railing_friction": 1.0,
        "belt.railing_share": 1.0,
        "belt.rollers": rollers,
        "belt.roller_arc": belt.roller_arc if belt.rollers else short_arc,
        "belt.roller_conductance": values["roller_conductance"],
        "belt.roller_rise": 1.0,
    }
    if not ice.mesh and values["contact_area"] != 1.0:
        footprint = Footprint(contact.radius, belt.width, contact.strips, contact.length)
        keys["contact.length"] = footprint.length * values["contact_area"]
    shaped = replace(case, h=values["h"], ice_rise=0.0, drawn=True)
    return shaped.changed(keys | _material(case, values))


def _material(case: Case, values: dict[str, float]) -> dict[str, Any]:
    """The belt's conductivity and heat capacity, or those of each of its layers, times factors."""

    def scaled(material: Belt | Layer) -> dict[str, float]:
        names = ("conductivity", "heat_capacity")
        return {name: values[name] * getattr(material, name) for name in names}

    belt = case.rig.belt
    if belt.layers:
        return {"belt.layers": [layer.model_dump() | scaled(layer) for layer in belt.layers]}
    if case.conductivity is not None:
        belt = belt.model_copy(update={"conductivity": case.conductivity})
    return {f"belt.{name}": value for name, value in scaled(belt).items()}


def _room_for_railing(case: Case) -> float:
    """As long as the sample, or as the rollers that a belt is said to have leave room for, m."""
    belt = case.rig.belt
    length = min(2.0 * case.rig.contact.radius, _RAILING_PART * case.length)
    if not belt.rollers:
        return length
    return min(length, 0.95 * (case.length / belt.rollers - belt.roller_arc))


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

"""What is not known of the rig, in what ranges, and how the drift hangs on it.

The temperatures are linear in all heat that is put in, as long as nothing melts. So

    drift = a A + b s B + T C + d D + w E,

a the factor of the contact's friction, b the railing's friction and s its share into the belt, T
the rise of the rollers, d that of the sample at the start and w the warming of the air in the run,
as a thermostat swings it; A to E, the answers to one unit of each, hang on the other unknowns
alone. So is the rise of the interface at constant speed, with answers of its own. The part of the
contact's heat that the belt takes is none of the unknowns: it follows from how belt and ice
conduct, from the conductance between them and from where the heat arises.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from thermal.contact.footprint import Footprint

from .case import Case

Array = NDArray[np.float64]

#: Rollers and railing where the rig names none: two with 0.1 m of belt each, and as long as the
#: sample; on a short belt not more than these parts of it.
_ROLLERS, _ARC, _ARC_PART, _RAILING_PART = 2, 0.1, 0.2, 0.25


@dataclass(frozen=True)
class Unknown:
    """A range, drawn evenly, or evenly in the logarithm; levels: how many values it has, 0 for all.

    unit "x": a factor of the case's own number; basis: where the range comes from.
    """

    key: str
    says: str
    unit: str
    low: float
    high: float
    basis: str
    logarithmic: bool = False
    levels: int = 0
    linear: bool = False

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


#: Blocks of ice take time, so their two unknowns have levels.
UNKNOWNS = (
    Unknown(
        "h",
        "heat transfer to the air",
        "W/m2K",
        4.0,
        25.0,
        "still air with radiation, to a light draught",
        logarithmic=True,
    ),
    Unknown(
        "friction",
        "friction coefficient of the ice",
        "x",
        0.7,
        1.2,
        "0.2086 was measured where the study's check of the belt takes 0.3; above: assumed",
        linear=True,
    ),
    Unknown(
        "conductivity",
        "conductivity of the belt",
        "x",
        0.5,
        4.0,
        "assumed, of 0.5 W/mK: paper to cloth filled with a conductor",
        logarithmic=True,
    ),
    Unknown(
        "heat_capacity",
        "heat capacity of the belt",
        "x",
        0.9,
        1.5,
        "assumed, of 840 J/kgK: glass fibre to plastics",
    ),
    Unknown(
        "ice_conductivity",
        "conductivity of the ice",
        "x",
        0.86,
        1.09,
        "of 2.2 W/mK: porous ice (assumed) to clear ice at -20 degC (Yen 1981)",
        levels=5,
    ),
    Unknown(
        "conductance",
        "conductance of the contact",
        "W/m2K",
        1e3,
        1e5,
        "assumed: a poor contact to one next to perfect",
        logarithmic=True,
    ),
    Unknown(
        "belt_side",
        "share of the heat that arises on the belt's face",
        "1",
        0.0,
        1.0,
        "all that is possible",
    ),
    Unknown(
        "contact_area",
        "real over nominal contact",
        "x",
        0.3,
        1.0,
        "assumed: ice that bears on a third of its face, to all of it",
        levels=8,
    ),
    Unknown(
        "railing_friction",
        "friction on the railing",
        "1",
        0.0,
        0.2,
        "none, to the most that PTFE is known for",
        linear=True,
    ),
    Unknown(
        "railing_share",
        "share of the railing's heat into the belt",
        "1",
        0.25,
        0.75,
        "assumed: about a half",
        linear=True,
    ),
    Unknown(
        "railing_conductance",
        "conductance to the railing",
        "W/m2K",
        5.0,
        100.0,
        "assumed: a gap of air to a light touch",
        logarithmic=True,
    ),
    Unknown(
        "roller_conductance",
        "conductance to the rollers",
        "W/m2K",
        10.0,
        1000.0,
        "assumed: rollers that hardly touch, to firm contact",
        logarithmic=True,
    ),
    Unknown(
        "roller_rise",
        "rollers above the air",
        "K",
        0.0,
        0.5,
        "assumed: as cold as the air, to warmed by their drive",
        linear=True,
    ),
    Unknown(
        "sample_rise",
        "sample above the air at the start, as the room's thermostat swings",
        "K",
        -0.5,
        0.5,
        "assumed: a thermostat lets the air swing by 1 K, which the sample does not follow",
        linear=True,
    ),
    Unknown(
        "air_warming",
        "warming of the air in the run, as the room's thermostat swings",
        "K/min",
        -0.3,
        0.3,
        "assumed: the same swing up and down in ten minutes",
        linear=True,
    ),
)
#: With which the railing's share and the rollers' rise are seen where a rig has neither.
SOME_FRICTION, SOME_CONDUCTANCE = 0.1, 100.0
#: What A to E hang on.
SHAPING = tuple(one for one in UNKNOWNS if not one.linear)


def unknowns_of(case: Case) -> tuple[Unknown, ...]:
    """UNKNOWNS, with the ranges that a case has of its own."""
    own = {one.key: one for one in case.ranges}
    return tuple(
        replace(one, low=own[one.key].low, high=own[one.key].high, basis=own[one.key].basis)
        if one.key in own
        else one
        for one in UNKNOWNS
    )


#: Rises that are answered: of the belt at entry, of the interface at constant speed, of the ice's
#: face from the start, by which it is known whether it comes to melt.
ENTRY, INTERFACE, ICE = 0, 1, 2
#: Columns of A to E.
CONTACT, RAILING, ROLLERS, SAMPLE, AIR = range(5)
COLUMNS = (CONTACT, RAILING, ROLLERS, SAMPLE, AIR)
#: K/s in K/min.
_PER_MINUTE = 1.0 / 60.0


#: Part of each unit of heat that the model is run with: so little melts no ice, and what is linear
#: answers to a whole unit, which no rig may have, from it.
_LITTLE = 1e-6


class Melts(Exception):
    """The ice melts: the drift is not linear in the heat."""


def answers(case: Case, values: dict[str, float], columns: Sequence[int] = COLUMNS) -> Array:
    """A to E of the rises of a case with values of SHAPING, K: (3, 5), as if no ice melted.

    The interface's warming counts that of the air, with which a camera sees it. columns: those that
    are wanted, the others are 0. Melts where the air is as warm as melting ice.
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


def combined(parts: Array, values: dict[str, Array]) -> Array:
    """A rise, K, from its A to E (n, 5) and the other unknowns, each (n,)."""
    return (
        values["friction"] * parts[:, CONTACT]
        + values["railing_friction"] * values["railing_share"] * parts[:, RAILING]
        + values["roller_rise"] * parts[:, ROLLERS]
        + values["sample_rise"] * parts[:, SAMPLE]
        + values["air_warming"] * parts[:, AIR]
    )


def as_it_is(case: Case, key: str) -> dict[str, float]:
    """Values with which the rig is as the case says, to be changed in one of them, `key`.

    Railing and rollers that it has not take as much heat as the air in their place. To see what a
    share of the railing's heat or a warm roller does there must be such heat, or a contact:
    `needs` says with which they are seen.
    """
    belt, contact = case.rig.belt, case.rig.contact
    factors = dict.fromkeys((one.key for one in UNKNOWNS if one.unit == "x"), 1.0)
    railing, rollers = belt.railing_length > 0.0, belt.rollers > 0
    values = factors | {
        "h": case.film,
        "belt_side": contact.belt_side,
        "conductance": contact.conductance if case.conductance is None else case.conductance,
        "railing_friction": belt.railing_friction,
        "railing_share": belt.railing_share,
        "railing_conductance": belt.railing_conductance if railing else case.film,
        "roller_conductance": belt.roller_conductance if rollers else case.film,
        "roller_rise": belt.roller_rise if rollers else 0.0,
        "sample_rise": case.ice_rise,
        "air_warming": 0.0,
    }
    return values | needs(case, key)


def with_one(case: Case, key: str, value: float) -> dict[str, float]:
    """Values with which the rig is as the case says but for one; where no railing or roller is, the
    air's heat transfer is another there, too."""
    return as_it_is(replace(case, h=value) if key == "h" else case, key) | {key: value}


def needs(case: Case, key: str) -> dict[str, float]:
    """What else is changed to see one unknown alone, for it is a part of it: key -> value."""
    if key == "railing_share" and case.rig.belt.railing_friction == 0.0:
        return {"railing_friction": SOME_FRICTION}
    if key == "roller_rise" and case.rig.belt.rollers == 0:
        return {"roller_conductance": SOME_CONDUCTANCE}
    return {}


def _shaped(case: Case, values: dict[str, float]) -> Case:
    """The case with values of SHAPING, and one unit of friction on the railing and of rise."""
    rig = case.rig
    belt, ice, contact = rig.belt, rig.ice, rig.contact
    footprint = Footprint(contact.radius, belt.width, contact.strips, contact.length)
    rollers = belt.rollers or _ROLLERS
    keys = {
        "contact.conductance": values["conductance"],
        "contact.belt_side": values["belt_side"],
        "ice.conductivity": ice.conductivity * values["ice_conductivity"],
        "belt.railing_length": belt.railing_length or _room_for_railing(case),
        "belt.railing_conductance": values["railing_conductance"],
        "belt.railing_friction": 1.0,
        "belt.railing_share": 1.0,
        "belt.rollers": rollers,
        "belt.roller_arc": belt.roller_arc
        if belt.rollers
        else min(_ARC, _ARC_PART * 2.0 / rollers * case.length),
        "belt.roller_conductance": values["roller_conductance"],
        "belt.roller_rise": 1.0,
    }
    if not ice.mesh and values["contact_area"] != 1.0:
        keys["contact.length"] = footprint.length * values["contact_area"]
    shaped = replace(case, h=values["h"], ice_rise=0.0, drawn=True)
    return _with_belt(shaped, values["conductivity"], values["heat_capacity"]).changed(keys)


def _room_for_railing(case: Case) -> float:
    """As long as the sample, or as the rollers that a belt is said to have leave room for, m."""
    belt, contact = case.rig.belt, case.rig.contact
    length = min(2.0 * contact.radius, _RAILING_PART * case.length)
    if not belt.rollers:
        return length
    return min(length, 0.95 * (case.length / belt.rollers - belt.roller_arc))


def _with_belt(case: Case, conductivity: float, heat_capacity: float) -> Case:
    """Factors on the belt's conductivity and heat capacity, on those of each of its layers."""
    belt = case.rig.belt
    if not belt.layers:
        own = belt.conductivity if case.conductivity is None else case.conductivity
        return case.changed(
            {
                "belt.conductivity": own * conductivity,
                "belt.heat_capacity": belt.heat_capacity * heat_capacity,
            }
        )
    layers = tuple(
        layer.model_copy(
            update={
                "conductivity": layer.conductivity * conductivity,
                "heat_capacity": layer.heat_capacity * heat_capacity,
            }
        )
        for layer in belt.layers
    )
    rig = case.rig.model_copy(update={"belt": belt.model_copy(update={"layers": layers})})
    return replace(case, rig=rig)

"""Heat exchange between belt face and ice face over one step.

Friction produces the flux f, a part s of it at the belt's face (half, unless one knows better); a
conductance h joins the faces. With p_j the flux into strip j of the belt, q_j its part that comes
through the contact, and g the flux into the ice, all constant over the step and in W/m2 of contact,

    q_j = s f + h (T_ice - T_j),        mean(q) + g + m = f,

m the flux that melts ice; the strips have equal areas. The temperatures are means over the step
of the faces, averaged over each strip and over its travel, so the conditions are the Galerkin
equations of the diffusive responses, which are symmetric and positive: no step and no conductance
makes the scheme unstable. h to infinity leaves T_j = T_ice, perfect contact. The second equation
is what makes every joule arrive.

Approximated: the fluxes are constant over a step and over a strip; the ice takes the mean flux,
uniform over the contact, and answers with its mean face temperature (the belt passes below it,
but its own temperature does not vary along x).

The belt's modes lose heat over the whole contact face; under the ice the face is not free, and
p_j = q_j + h_air T_j gives that back (T a rise above the air).

Melting: when the ice face would end the step above the melting point, g is what takes it there
exactly, and m is what remains. A film of water on the face freezes before the face gets colder: m
is then negative, down to what the film holds.
"""

from dataclasses import dataclass
from functools import partial

import numpy as np
from stickslip.quantity import Table, quantity

from thermal.arrays import Array


class Contact(Table, strict=False):
    """Where ice and belt touch, and how well heat crosses.

    A conductance above 1e3 W/m2K changes the heat shares by less than 0.005.

    radius : radius of the ice cylinder
    length : length of a rectangular contact along the motion, as wide as the belt or the cylinder,
        the narrower; 0: the contact is the part of the cylinder's face on the belt
    conductance : contact conductance between the two faces
    wiper : part of the water and of the ice on the belt that a wiper in front of the contact takes
        off
    load : weight on the contact, which squeezes melt water out; 0: that of the ice
    belt_side : share of the friction heat that arises on the belt's face, the rest on the ice's;
        what each keeps follows from the conductance and from how both conduct
    strips : strips across the belt in each of which the flux is uniform; 1 makes the flux uniform
        over the contact
    """

    radius: float = quantity(0.04, "m", gt=0.0, le=10.0)
    length: float = quantity(0.0, "m", ge=0.0, le=20.0)
    conductance: float = quantity(1e4, "W/(m2.K)", gt=0.0, le=1e12)
    wiper: float = quantity(0.0, "1", ge=0.0, le=1.0)
    load: float = quantity(0.0, "N", ge=0.0, le=1e9)
    belt_side: float = quantity(0.5, "1", ge=0.0, le=1.0)
    strips: int = quantity(16, None, ge=1, le=64)


@dataclass(frozen=True)
class BeltFace:
    """Step-mean temperature of the strips: free (strips,) K, response (strips, strips) K m2/W."""

    free: Array
    response: Array


@dataclass(frozen=True)
class IceFace:
    """Face temperature without flux (K above the air) and its response (K m2/W).

    Each as mean over the step and at its end; melting: the melting point, K above the air;
    refreezing: flux with which the film on the face would freeze within the step, W/m2.
    """

    free_mean: float
    free_end: float
    response_mean: float
    response_end: float
    melting: float
    refreezing: float = 0.0


@dataclass(frozen=True)
class Fluxes:
    """W/m2: into the belt's strips, of that from the contact, into the ice, into melting.

    melting is negative when water freezes to the ice.
    """

    belt: Array
    from_contact: Array
    ice: float
    melting: float


def _belt_fluxes(
    belt: BeltFace,
    resistance: float,
    free_face_h: float,
    own: float,
    ice_temperature: float,
    ice_response: float,
) -> tuple[Array, Array]:
    """Solve the strips for an ice face at ice_temperature - ice_response * mean(q).

    own: friction heat that arises on the belt's face, W/m2.
    """
    through = np.eye(belt.free.size) - free_face_h * belt.response
    matrix = resistance * through + belt.response + ice_response * through.mean(axis=0)
    kept = free_face_h * belt.free
    right = (
        ice_temperature
        - belt.free
        + own * resistance
        + resistance * kept
        + ice_response * kept.mean()
    )
    into_belt = np.linalg.solve(matrix, right)
    return into_belt, through @ into_belt - kept


def exchange(
    belt: BeltFace, ice: IceFace, contact: Contact, free_face_h: float, friction: float
) -> Fluxes:
    """Fluxes of one step.

    free_face_h: of the belt's film that the ice covers, W/m2K; friction: W/m2.
    """
    solve = partial(
        _belt_fluxes, belt, 1.0 / contact.conductance, free_face_h, contact.belt_side * friction
    )
    given = friction + ice.refreezing
    into_belt, from_contact = solve(ice.free_mean + ice.response_mean * given, ice.response_mean)
    into_ice = given - float(from_contact.mean())
    if ice.free_end + ice.response_end * into_ice <= ice.melting:
        return Fluxes(into_belt, from_contact, into_ice, -ice.refreezing)
    into_ice = (ice.melting - ice.free_end) / ice.response_end
    into_belt, from_contact = solve(ice.free_mean + ice.response_mean * into_ice, 0.0)
    melting = friction - float(from_contact.mean()) - into_ice
    return Fluxes(into_belt, from_contact, into_ice, melting)

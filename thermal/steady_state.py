"""The periodic steady state of steady sliding, without stepping to it.

When the belt moves by whole cells in every step, a step maps temperatures onto temperatures in the
same way each time, seen from the ice. Its fixed point follows coefficient by coefficient: with
a' = decay a + forced p from one step, and a' = a exp(i k d) from the belt's travel d, the fluxes p
that go with it solve the conditions of the contact as in any step.
"""

import numpy as np

from .contact.exchange import IceFace, exchange
from .model import BeltIceModel

#: A step after which nothing changes any more, s: its mean differs from its end by the part of it
#: that the slowest change (hours) takes.
FOREVER = 1e13

#: Rates below this are those of a belt that keeps its heat, 1/s: a year is 3e7 s.
_KEEPS_HEAT = 1e-9

#: A travel is whole cells when it is so up to this part of a cell.
_ROUNDING = 1e-9


class NoSteadyState(ValueError):
    """The belt gives no heat away, so it warms for ever; or the ice melts for ever."""


def check_gives_heat(slowest_rate: float, to_supports: bool) -> None:
    """NoSteadyState when a belt gives its heat neither to the air nor to supports."""
    if slowest_rate < _KEEPS_HEAT and not to_supports:
        raise NoSteadyState(
            "belt.air_heat_transfer = 0: a belt that gives its heat to nothing warms for ever and"
            " has no steady state; allowed is above 0, or a railing or rollers that take heat"
        )


def settle(model: BeltIceModel, duration: float, heat: float, displacement: float) -> None:
    """Put a model into the state that endless steps (s, J, m) lead to, and make one more step.

    displacement: whole cells of the belt, at most `model.longest_movement`. ValueError when it is
    not; NoSteadyState when there is none. The ledger begins with the heat that is stored then.
    """
    shift = displacement / model.belt.cell
    if abs(shift - round(shift)) > _ROUNDING or abs(displacement) > model.longest_movement:
        raise ValueError(
            f"displacement = {displacement:g} m: the steady state needs whole cells of"
            f" {model.belt.cell:g} m in a step, at most {model.longest_movement:g} m"
        )
    check_gives_heat(float(model.belt.rates[0, 0]), model.supported_belt.places.take_heat)
    parameters, area = model.parameters, model.footprint.area
    response = model.belt.periodic_response(duration, round(shift))
    found = model.supported_belt.step_response(
        duration, model.contact_position, -displacement, displacement, response
    )
    ice_end = model.ice.face_response(FOREVER)[1] * area
    fluxes = exchange(
        found.contact.face,
        IceFace(0.0, 0.0, ice_end, ice_end, parameters.melting_rise),
        parameters.contact,
        parameters.belt.film,
        heat / (duration * area),
    )
    if fluxes.melting > 0.0:
        raise NoSteadyState(
            f"heat = {heat:g} J in {duration:g} s: the ice face reaches the melting point and melts"
            " for ever; there is a steady state only for less friction heat"
        )
    loads = model.belt.load(found.patches, found.contact.fluxes(fluxes.belt))
    model.belt.amplitudes[:] = sum(response.forced[face] * load for face, load in loads.items())
    model.ice.fill(0.0)
    model.ice.advance(FOREVER, fluxes.ice * area)
    model.ledger.restore(np.zeros_like(model.ledger.array()))
    model.ledger.received = model.belt.heat() + model.ice.heat()
    model.step(duration, heat, displacement)

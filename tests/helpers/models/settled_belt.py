"""The periodic steady state of `BeltIceModel`, without stepping to it: a second way to it.

When the belt moves by whole cells in every step, a step maps temperatures onto temperatures in the
same way each time, seen from the ice. Its fixed point follows coefficient by coefficient: with
a' = decay a + forced p from one step, and a' = a exp(i k d) from the belt's travel d, the fluxes p
that go with it solve the conditions of the contact as in any step.
"""

import numpy as np
from numpy.fft import irfft

from thermal import BeltIceModel
from thermal.belt.material_frame import BeltField, Response
from thermal.contact import IceFace, exchange
from thermal.steady_sliding import FOREVER, NoSteadyState, check_gives_heat


def settle(model: BeltIceModel, duration: float, heat: float, displacement: float) -> None:
    """Put a model into the state that endless steps (s, J, m) lead to, and make one more step.

    displacement: whole cells of the belt, at most `model.longest_movement`. ValueError when it is
    not; NoSteadyState when there is none. The ledger begins with the heat that is stored then.
    """
    shift = displacement / model.belt.cell
    if abs(shift - round(shift)) > 1e-9 or abs(displacement) > model.longest_movement:
        raise ValueError(
            f"displacement = {displacement:g} m: the steady state needs whole cells of"
            f" {model.belt.cell:g} m in a step, at most {model.longest_movement:g} m"
        )
    check_gives_heat(float(model.belt.rates[0, 0]), model.supported_belt.places.take_heat)
    parameters, area = model.parameters, model.footprint.area
    response, of_a_step = (
        _periodic_response(model.belt, duration, round(shift)),
        model.belt.response,
    )
    model.belt.response = lambda _: response
    found = model.supported_belt.step_response(
        duration, model.contact_position, -displacement, displacement
    )
    model.belt.response = of_a_step
    ice_end = model.ice.face_response(FOREVER)[1] * area
    fluxes = exchange(
        found.contact.face, IceFace(0.0, 0.0, ice_end, ice_end, parameters.melting_rise),
        parameters.contact, parameters.belt.film, heat / (duration * area),
    )  # fmt: skip
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


def _periodic_response(belt: BeltField, duration: float, shift: int) -> Response:
    """Of a step before and after which the field is the same, `shift` nodes further back.

    Without memory: `forced` gives the field before the step, which the loads sustain.
    """
    once = belt.response(duration)
    turn = 2j * np.pi * shift / belt.cells * np.arange(belt.rates.shape[1])
    # exp(turn) - decay, without cancelling
    kept = once.forced / (np.expm1(turn) - np.expm1(-belt.rates * duration))
    pairs = np.einsum("amk,bmk->abk", once.free_mean, kept)
    return once._replace(
        decay=np.zeros_like(once.decay), free_mean=np.zeros_like(once.free_mean), forced=kept,
        kernels=once.kernels + irfft(pairs, belt.cells, axis=-1),
    )  # fmt: skip

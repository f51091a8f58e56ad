"""Belt and ice as small matrices: what a solver without finite elements needs of them.

Of each, the Galerkin space is cut down to a rational Krylov space that answers heat at the contact
as the whole does (`thermal.ice.sample`): of the belt through its thickness, where a solver steps it
column by column; of the ice as a body. The trial functions are orthonormal in the capacity, and the
films stay apart from conduction, so that a solver finds the modes for any heat transfer by
diagonalising one small symmetric matrix.

Modes of the operators, as many, with a static correction for those that are left out, err a hundred
times as much: what is left out has a memory of milliseconds, and a step is as short.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigh
from scipy.sparse import csr_matrix

from .arrays import Array
from .assembly import HeatSpace
from .belt.parameters import Belt
from .belt.thickness import section
from .contact import Footprint
from .ice.block import standing_block
from .ice.sample import response_space
from .materials import GRAVITY
from .parameters import ParameterError, ThermalParameters

#: Shifts (1/s) at which the belt's answer is that of all its functions: from the tenth part of a
#: short step to the slowest of its modes, each at most so many times the next; and, over the rate
#: of the first mode that carries no heat, the two lowest. See `ice.sample`.
_FASTEST, _APART, _LOWEST = 3000.0, 4.2, (0.3, 1e-3)

#: Heat transfer to the ice that its space also answers at, W/m2K, and the shifts where it matters.
_WIND, _SLOW = 300.0, np.geomspace(1e-1, 1e-5, 6)

#: Directions of the space that are the same but for this part are left out.
_SAME = 1e-9

#: Heat transfer of the ice that stands in for none while its space is made, W/m2K.
_SOME_AIR = 1.0


@dataclass(frozen=True)
class ReducedBelt:
    """n trial functions through the thickness, per metre of belt.

    conduction (n, n) W/(m K); film (n, n) m, to be multiplied by h; along (n, n) m2/s, to be
    multiplied by a wave number squared; face (n,): values at the contact face; heat (n,): what
    amplitude 1 stores, J/m.
    """

    conduction: Array
    film: Array
    along: Array
    face: Array
    heat: Array


@dataclass(frozen=True)
class ReducedIce:
    """n trial functions of the block; the forms of `thermal.assembly`, (n, n).

    across, upwards W/K; side, top m2, to be multiplied by h; sinking W/K for 1 m/s; contact (n,):
    mean over the contact, and load of 1 W there; heat (n,): what amplitude 1 stores, J.
    """

    across: Array
    upwards: Array
    side: Array
    top: Array
    sinking: Array
    contact: Array
    heat: Array
    weight: float


@dataclass(frozen=True)
class Reduction:
    """Both, and their contact."""

    parameters: ThermalParameters
    footprint: Footprint
    belt: ReducedBelt
    ice: ReducedIce


def reduce(parameters: ThermalParameters) -> Reduction:
    """Assemble and reduce. ParameterError for a belt with a railing or rollers that matter."""
    belt = parameters.belt
    if belt.railing_length > 0.0 or belt.rollers > 0:
        key = "railing_length" if belt.railing_length > 0.0 else "rollers"
        raise ParameterError(
            f"belt.{key} = {getattr(belt, key):g}: the reduced model has no supports of the belt;"
            " allowed is 0"
        )
    air = parameters.ice.air_heat_transfer or _SOME_AIR
    ice = parameters.ice.model_copy(update={"air_heat_transfer": air})
    footprint, block = standing_block(parameters.model_copy(update={"ice": ice}))
    return Reduction(
        parameters,
        footprint,
        _belt(belt, footprint.lane),
        _ice(block.space, air, ice.heat_capacity),
    )


def _belt(belt: Belt, lane: float) -> ReducedBelt:
    body = section(belt.stack, 1.0, belt.elements, lane)
    space = body.space(np.eye(body.basis.N))
    conduction, film = (factor.T @ factor for factor in (space.upwards, space.side))
    along = body.weighted(body.medium.conductivity).toarray()
    stored, contact_face = space.capacity, space.contact
    trial = _answers(stored, conduction, conduction + belt.film * film, contact_face)
    trial, heat = _constant_first(trial, trial.T @ space.heat)
    conduction, film, along = (trial.T @ form @ trial for form in (conduction, film, along))
    return ReducedBelt(_conserving(conduction), film, along, face=contact_face @ trial, heat=heat)


def _answers(stored: Array, conduction: Array, loss: Array, load: Array) -> Array:
    """Trial functions (N, n), orthonormal in the capacity, that answer a load: all where few."""
    rates, modes = eigh(conduction, stored)
    low, lowest = (part * rates[1] for part in _LOWEST)
    count = 1 + max(1, int(np.ceil(np.log(_FASTEST / low) / np.log(_APART))))
    shifts = [*np.geomspace(max(_FASTEST, _APART * low), low, count), lowest]
    if rates.size <= len(shifts) + 1:
        return np.asarray(modes)
    found = [np.linalg.solve(shift * stored + loss, load) for shift in shifts]
    trial, _ = np.linalg.qr(modes.T @ stored @ np.column_stack([np.ones(load.size), *found]))
    return np.asarray(modes @ trial)


def _ice(space: HeatSpace, air: float, heat_capacity: float) -> ReducedIce:
    still = _loss(space, 1.0)
    trial = response_space(csr_matrix(space.capacity), csr_matrix(still), space.contact)
    windy = _loss(space, _WIND / air)
    found = [np.linalg.solve(shift * space.capacity + windy, space.contact) for shift in _SLOW]
    trial = _orthonormal(np.column_stack([trial, *found]), space.capacity)
    trial, heat = _constant_first(trial, trial.T @ space.heat)
    across, upwards, side, top = (
        (factor @ trial).T @ (factor @ trial)
        for factor in (space.across, space.upwards, space.side, space.top)
    )
    return ReducedIce(
        across=_conserving(across),
        upwards=_conserving(upwards),
        side=side / air,
        top=top / air,
        sinking=trial.T @ space.sinking @ trial,
        contact=trial.T @ space.contact,
        heat=heat,
        weight=GRAVITY * space.whole_capacity / heat_capacity,
    )


def _loss(space: HeatSpace, times: float) -> Array:
    """Conduction and films, W/K, these so many times as strong."""
    films = [np.sqrt(times) * factor for factor in (space.side, space.top)]
    whole = np.concatenate((space.across, space.upwards, *films))
    found: Array = whole.T @ whole
    return found


def _orthonormal(functions: Array, capacity: Array) -> Array:
    """The same space, orthonormal in the capacity; functions (N, n) as sizes of their own."""
    lower = np.linalg.cholesky(capacity)
    scaled = lower.T @ functions
    basis, sizes, _ = np.linalg.svd(scaled / np.linalg.norm(scaled, axis=0), full_matrices=False)
    return np.linalg.solve(lower.T, basis[:, sizes > _SAME * sizes[0]])


def _constant_first(trial: Array, heat: Array) -> tuple[Array, Array]:
    """The same space (N, n), its first function the constant, and the heat (n,) of each.

    heat (n,): of each function now, J for amplitude 1. Of orthonormal functions these are the
    coefficients of the constant, which is in the space.
    """
    size = np.linalg.norm(heat)
    rotation, _ = np.linalg.qr(heat[:, None], mode="complete")
    rotation[:, 0] *= np.sign(rotation[:, 0] @ heat)
    return trial @ rotation, np.append(size, np.zeros(heat.size - 1))


def _conserving(form: Array) -> Array:
    """Conduction (n, n) without what rounding lets the constant lose: it conducts nothing."""
    form[0, :] = form[:, 0] = 0.0
    return form

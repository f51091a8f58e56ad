"""Belt and ice, joined by the contact: the thermal model that a coupled run advances.

Its heat ledger says what friction produced, and where it went.
"""

import math
from dataclasses import astuple, dataclass, fields

import numpy as np
from numpy.typing import NDArray

from .arrays import Array, interpolated
from .belt.material_frame import BeltField
from .belt.supports import SupportedBelt
from .contact import Fluxes, Footprint, IceFace, exchange
from .ice.block import StandingBlock, standing_block
from .ice.cylinder import Cylinder
from .ice.melting import Meltwater
from .ice.sample import Sample
from .parameters import ThermalParameters


@dataclass
class HeatLedger:
    """Totals since the start, J.

    `received`: friction heat of the contact; `from_railing`: what entered the belt of the heat that
    its rubbing on the railing makes.
    `to_air` and `to_supports` are integrated along with the temperatures, `belt` and `ice` are
    read off the temperature fields, `meltwater` off the water that there is: none of them is
    inferred from the others, so `residual` can fail.
    """

    received: float = 0.0
    from_railing: float = 0.0
    from_contact_to_belt: float = 0.0
    to_air: float = 0.0
    to_supports: float = 0.0
    meltwater: float = 0.0
    belt: float = 0.0
    ice: float = 0.0

    @property
    def stored(self) -> float:
        """In belt, ice and melt water."""
        return self.belt + self.ice + self.meltwater

    @property
    def lost(self) -> float:
        """To air and supports, less what rubbing on the railing brings."""
        return self.to_air + self.to_supports - self.from_railing

    @property
    def residual(self) -> float:
        """Received less everything found: 0 up to rounding."""
        return self.received - (self.stored + self.lost)

    @property
    def belt_share(self) -> float:
        """Share of the friction heat that went into the belt so far; 0 before any."""
        return self.from_contact_to_belt / self.received if self.received > 0.0 else 0.0

    def array(self) -> NDArray[np.float64]:
        """The totals as numbers, for saving."""
        return np.array(astuple(self))

    def restore(self, numbers: NDArray[np.float64]) -> None:
        """Take totals that `array` returned."""
        for field, number in zip(fields(self), numbers, strict=True):
            setattr(self, field.name, float(number))


#: Longest movement of the patch in one internal step, as a share of the contact's length; longer
#: macro steps are cut. At 1/16 the temperatures err by 0.1 % of their rise, at 1/8 by 0.3 %.
MOVEMENT = 1 / 16

#: Entry and exit temperatures are read this far outside the contact, as a share of its length:
#: beyond the travel over which heat of the last internal step is spread.
_PROBE = 1 / 8

#: Most loops in one step: the internal steps follow the movement, more would seem to hang.
MOST_LOOPS = 1000


class BeltIceModel:
    """Belt under a standing block of ice, both starting at the temperature of the air.

    parameters: checked numbers. block: what `standing_block` makes of them, for whoever has made
    it elsewhere; the model takes it for itself. Positions are material coordinates of the belt, m;
    the ice stands at `contact_position`, which runs backwards along the belt as the belt runs
    forwards.
    """

    def __init__(
        self, parameters: ThermalParameters | None = None, block: StandingBlock | None = None
    ) -> None:
        parameters = parameters or ThermalParameters()
        self.parameters: ThermalParameters = parameters
        footprint, ice = standing_block(parameters) if block is None else block
        self.footprint: Footprint = footprint
        self.ice: Cylinder | Sample = ice
        self.supported_belt: SupportedBelt = SupportedBelt(parameters.belt, self.footprint)
        self.belt: BeltField = self.supported_belt.belt
        self.ledger: HeatLedger = HeatLedger()
        self._ambient = parameters.ambient.temperature_degC
        self.meltwater: Meltwater = Meltwater(parameters, self.footprint, self.ice, self.belt)
        self.longest_movement: float = MOVEMENT * self.footprint.length
        #: Distance of entry and exit from the contact's centre, m.
        self._probe = 0.5 * min(
            (1.0 + 2.0 * _PROBE) * self.footprint.length, parameters.belt.length
        )
        self._travel = 0.0
        self._direction = 1.0
        self._melt_rate = 0.0

    @property
    def contact_position(self) -> float:
        """Centre of the contact in the belt's own coordinate, in [0, length), m."""
        length = self.parameters.belt.length
        return (0.5 * length - self._travel) % length

    def step(
        self, duration: float, heat: float, displacement: float, travel: float | None = None
    ) -> None:
        """Advance by duration (s, > 0).

        heat: friction heat produced in the step, J, >= 0. displacement: of the belt's
        material under the contact, m, signed, up to 1000 loops. travel: of the belt over its
        railing, m, signed; left out: the displacement, of a block that stands still. All three
        are spread evenly over the step. ValueError for anything else; the state is then
        unchanged.
        """
        travel = displacement if travel is None else travel
        _check_step(duration, heat, displacement, travel, self.parameters.belt.length)
        parts = max(
            math.ceil(abs(displacement) / self.longest_movement),
            self.meltwater.ablation.parts(heat),
        )
        melted = self.meltwater.melted
        for _ in range(parts):
            self._advance(duration / parts, heat / parts, displacement / parts, travel / parts)
        if displacement != 0.0:
            self._direction = math.copysign(1.0, displacement)
        self.ledger.belt, self.ledger.ice = self.belt.heat(), self.ice.heat()
        self.ledger.meltwater = self.meltwater.heat
        self._melt_rate = (self.meltwater.melted - melted) / duration

    def _advance(self, duration: float, heat: float, displacement: float, travel: float) -> None:
        """One internal step: what it finds, the fluxes, both fields, the ledger."""
        centre, area = self.contact_position, self.footprint.area
        found = self.supported_belt.step_response(duration, centre, -displacement, travel)

        contact, film = self.parameters.contact, self.parameters.belt.film
        friction = heat / (duration * area)

        def solve(ice_face: IceFace) -> Fluxes:
            return exchange(found.contact.face, ice_face, contact, film, friction)

        fluxes, sinking, recession = self.meltwater.exchange(duration, displacement, solve)
        to_air, to_supports = self.supported_belt.advance(
            duration, found, fluxes.belt, self.meltwater.freezing(duration)
        )
        ice_to_air = self.ice.advance(duration, fluxes.ice * area, sinking, recession)
        self.meltwater.advance(duration, displacement, centre, fluxes.melting)
        ledger = self.ledger
        ledger.received += heat
        ledger.to_air += to_air + ice_to_air
        ledger.to_supports += to_supports
        ledger.from_contact_to_belt += (
            float(fluxes.from_contact.sum()) * self.footprint.strip_area * duration
        )
        ledger.from_railing += found.rubbed
        self._travel = math.fmod(self._travel + displacement, self.parameters.belt.length)

    def outputs(self) -> dict[str, float]:
        """Values at the end of the last step: degC, 1, kg/s (mean over the step), kg, m, J.

        The interface temperature is the mean of the two faces, each averaged over the contact's
        area. Entry and exit: belt face an eighth of the contact's length before and behind the
        contact, seen in the direction of the last movement. Melted: what the block has lost;
        refrozen: what of it lies on the belt as ice; wiped ice: what of it froze there and was
        taken off by a wiper.
        """
        face = self.belt.face()
        first, loads = self.footprint.loads(self.contact_position, 0.0, self.belt.cell)
        under = face[(first + np.arange(loads.shape[1])) % face.size]
        belt_face = float((loads @ under / self.footprint.strip_area).mean())
        ice_face = self.ice.face()
        ahead = self._direction * self._probe * np.array([-1.0, 1.0])
        entry, exit_ = interpolated(face, (self.contact_position + ahead) / self.belt.cell)
        ledger = self.ledger
        return {
            "interface_temperature": self._ambient + 0.5 * (belt_face + ice_face),
            "belt_entry_temperature": self._ambient + float(entry),
            "belt_exit_temperature": self._ambient + float(exit_),
            "ice_face_temperature": self._ambient + ice_face,
            "belt_share": ledger.belt_share,
            "melt_rate": self._melt_rate,
            "melted_mass": self.meltwater.melted,
            "refrozen_mass": float(self.meltwater.on_belt.frozen.sum()),
            "wiped_ice_mass": self.meltwater.wiped_ice,
            "film_thickness": self.meltwater.film.thickness,
            "heat_received": ledger.received,
            "railing_heat": ledger.from_railing,
            "belt_heat": ledger.belt,
            "ice_heat": ledger.ice,
            "air_heat": ledger.to_air,
            "support_heat": ledger.to_supports,
            "latent_heat": self.meltwater.latent_heat,
            "meltwater_heat": ledger.meltwater,
            "heat_residual": ledger.residual,
        }

    def belt_profile(self) -> tuple[Array, Array]:
        """Material position (cells,) m and temperature of the contact face (cells,) degC."""
        return self.belt.position, self._ambient + self.belt.face()

    def belt_field(self) -> tuple[Array, Array, Array]:
        """Position (cells,) m, depth (depths,) m below the contact face, degC (cells, depths)."""
        return self.belt.position, self.belt.depth, self._ambient + self.belt.field()

    def _parts(self) -> list[Array]:
        """Everything that a continuation needs."""
        return [
            np.array([self._travel, self._direction, self._melt_rate]),
            self.ledger.array(),
            self.ice.state(),
            self.meltwater.state(),
            self.belt.amplitudes.view(np.float64).ravel(),
        ]

    def state(self) -> Array:
        """Everything that a continuation needs, as a copy; its length depends on the mesh."""
        return np.concatenate(self._parts())

    def restore(self, array: Array) -> None:
        """Take a state that `state` returned; the continuation is the same bit for bit."""
        array = np.asarray(array, dtype=np.float64)
        sizes = np.cumsum([part.size for part in self._parts()])
        if array.shape != (sizes[-1],):
            raise ValueError(
                f"thermal state has shape {array.shape}, expected ({sizes[-1]},): it was saved with"
                " another mesh"
            )
        own, ledger, ice, meltwater, belt = np.split(array, sizes[:-1])
        self._travel, self._direction, self._melt_rate = (float(x) for x in own)
        self.ledger.restore(ledger)
        self.ice.restore(ice)
        self.meltwater.restore(meltwater)
        self.belt.amplitudes.view(np.float64)[:] = belt.reshape(self.belt.amplitudes.shape[0], -1)


def _check_step(
    duration: float, heat: float, displacement: float, travel: float, length: float
) -> None:
    for name, value, unit in (
        ("duration", duration, "s"),
        ("heat", heat, "J"),
        ("displacement", displacement, "m"),
        ("travel", travel, "m"),
    ):
        if not math.isfinite(value):
            raise ValueError(f"{name} = {value} {unit} is not a finite number")
    if duration <= 0.0:
        raise ValueError(f"duration = {duration:g} s must be positive")
    if heat < 0.0:
        raise ValueError(f"heat = {heat:g} J must not be negative: friction produces heat")
    if abs(displacement) > MOST_LOOPS * length:
        raise ValueError(
            f"displacement = {displacement:g} m is more than {MOST_LOOPS} loops of"
            f" the {length:g} m belt in one step: take shorter steps"
        )

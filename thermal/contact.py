"""The contact of ice and belt: its footprint, the heat that crosses it, the water in and off it.

`Footprint`: the round contact on a belt that is averaged over its width.

The ice is a disc of radius a, the belt a strip of width w through the disc's centre; they touch
on the area A of their intersection, under the lane of width b = min(w, 2 a). The 2-D belt
(x, thickness) is the mean over that lane, and the contact on it a rectangle of the same area:
b wide and A / b long, which is the mean length of the disc's chords along the motion. Area, heat
per length of belt and mean time under the ice are then those of the disc. (The exact mean
over the disc of the face temperature of a thick belt under uniform flux is 1.8 % higher at
a = 40 mm, w = 75 mm; a footprint that follows the disc's width along x would be 5.8 % off,
because it mixes touched and untouched belt at one x.)

The rectangle is cut across the belt into strips of equal length, each with its own flux. Loads
on the hat functions of a uniform mesh, and their mean over a movement, are differences of
repeated integrals of the rectangle, and therefore exact wherever the edges fall.

`exchange`: heat between belt face and ice face over one step.

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

`MeltFilm`: water between ice and belt, fed by melting, dragged out by the belt, squeezed out by the
ice.

The film is shared evenly by the contact. In Couette flow the water moves at half the belt's speed
on the average, and a film that grows evenly along the way under the ice is twice as thick at the
exit as in the mean: so the belt drags out |v| h per width, and each bit of water stays for one
residence l/|v|,

    dh/dt = melt rate - |v| h / l - 2 p h^3 / (3 eta a^2),

h here the film's mean thickness, l the length of the contact. The last term is the slow approach of
a disc of radius a under the pressure p to a plane through water of viscosity eta (Stefan 1874;
Reynolds 1886). Melting, shear and squeeze are the balance that Colbeck (The kinetic friction of
snow, J. Glaciol. 34, 1988) takes for a melt film. Each term is advanced exactly, melting and shear
together, then the squeeze.

Where the shear of the film itself is all that melts, melt rate = eta v^2 / (rho L h), so that a
steady film is h = sqrt(eta v l / (rho L)) thick and is sheared with sqrt(eta v rho L / l). The
latter is exact: along the way x the film grows as sqrt(4 eta v x / (rho L)), and that is the mean
of eta v / h over it. (Water that moved with the belt, at twice the speed, would leave a film that
is thinner by the root of two, and sheared with sqrt(2 eta v rho L / l).)

`BeltWater`: melt water that the belt carries away, freezes and thaws again.

Water that leaves the contact lies on the belt's face. Where the face would end a step below the
melting point, the water freezes and its heat warms the face, but not above the melting point; where
the face would end above it, ice on the belt thaws in the same way. What is still water when it
comes under the block again joins the film.

Approximated: water and ice on the belt have no heat capacity of their own (10 um of ice hold 3 % of
a belt's 588 J/m2K), so freezing gives the belt at once all that melting took; what freezing in
one place does to its neighbours within a step is taken as if all places froze. Nothing dries the
belt, but a wiper in front of the contact may take water and ice off it.
"""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np
from stickslip.quantity import Table, quantity

from thermal.arrays import Array
from thermal.materials import WATER_DENSITY, WATER_VISCOSITY


def disc_on_strip(radius: float, width: float) -> float:
    """Area (m2) of a disc that lies on a strip of given width through its centre (m)."""
    half = min(0.5 * width, radius)
    found: float = 2.0 * (
        half * np.sqrt(radius**2 - half**2) + radius**2 * np.arcsin(half / radius)
    )
    return found


class Footprint:
    """Equivalent rectangle of a disc (radius, m) on a belt (width, m), cut into strips.

    length (m, > 0): the contact is itself a rectangle of that length along the motion. `lane`
    and `length` (m) are the sides, `area` (m2) is theirs and the true contact's.
    """

    def __init__(self, radius: float, width: float, strips: int, length: float = 0.0) -> None:
        self.radius = radius
        self.width = width
        self.strips = strips
        self.lane: float = min(width, 2.0 * radius)
        self.rectangular: bool = length > 0.0
        self.area: float = (
            length * self.lane if self.rectangular else float(disc_on_strip(radius, width))
        )
        self.length: float = self.area / self.lane
        #: Edges of the strips, m from the centre: (strips + 1,).
        self.edges: Array = np.linspace(-0.5 * self.length, 0.5 * self.length, strips + 1)

    @property
    def strip_area(self) -> float:
        """Area of one strip, m2."""
        return self.area / self.strips

    @property
    def touching(self) -> float:
        """Radius (m) up to which the ice's face touches all round."""
        return np.sqrt(self.area / np.pi) if self.rectangular else 0.5 * self.width

    def arc_share(self, r: Array) -> Array:
        """Share of the circle of radius r (m) about the disc's centre that lies on the belt.

        The ice is a body of revolution: a rectangle becomes the disc of its area there.
        """
        if self.rectangular:
            return np.where(r <= self.touching, 1.0, 0.0)
        half = 0.5 * self.width
        return 2.0 / np.pi * np.arcsin(np.minimum(1.0, half / np.maximum(r, half)))

    def loads(self, centre: float, movement: float, cell: float) -> tuple[int, Array]:
        """Loads of the strips on hat functions, as mean over a movement of the contact.

        centre: of the contact at the start, m; movement: signed, m; cell: spacing of the nodes
        i * cell, m. Returns the first node's number (unwrapped, may be negative) and the
        loads, shape (strips, nodes), m2; every row sums to a strip's area.
        """
        return strip_loads(self.edges, self.lane, centre, movement, cell)


def strip_loads(
    edges: Array, lane: float, centre: float, movement: float, cell: float
) -> tuple[int, Array]:
    """Loads of neighbouring strips, as `Footprint.loads`; edges: (strips + 1,) m from centre."""
    first = int(np.floor((centre + min(movement, 0.0) + edges[0]) / cell))
    last = int(np.ceil((centre + max(movement, 0.0) + edges[-1]) / cell))
    x = np.arange(first - 1, last + 2) * cell - centre
    past = np.maximum(x - edges[:, None], 0.0)
    moved = np.maximum(x - movement - edges[:, None], 0.0)
    # (past^3 - moved^3) / (6 movement), factored: no digits are lost for a small movement.
    share = np.where((past > 0.0) & (moved > 0.0), 1.0, (past - moved) / (movement or 1.0))
    integral = share * (past * past + past * moved + moved * moved) / 6.0
    of_strips = integral[:-1] - integral[1:]
    loads = of_strips[:, 2:] - 2.0 * of_strips[:, 1:-1] + of_strips[:, :-2]
    areas = np.diff(edges) * lane
    return first, loads * (areas / loads.sum(axis=1))[:, None]


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


class MeltFilm:
    """`mass` (kg) of water under the ice, and `squeezed` (kg) out of its sides since the start.

    area m2 and length m of the contact; pressure Pa.
    """

    def __init__(self, area: float, length: float, pressure: float) -> None:
        self._area, self._length = area, length
        #: dh/dt = -squeeze h^3, 1/(m2 s); a^2 = area / pi.
        self._squeeze = 2.0 * pressure * math.pi / (3.0 * WATER_VISCOSITY * area)
        self.mass: float = 0.0
        self.squeezed: float = 0.0

    @property
    def thickness(self) -> float:
        """Mean over the contact, m."""
        return self.mass / (WATER_DENSITY * self._area)

    def available(self, displacement: float) -> float:
        """Most mass (kg) that can freeze evenly over a step in which the belt moves (m)."""
        residences = abs(displacement) / self._length
        if residences == 0.0:
            return self.mass
        return self.mass * residences / math.expm1(residences)

    def advance(self, duration: float, displacement: float, melted: float) -> float:
        """Advance by duration (s); the mass (kg) that the belt took along behind the contact.

        melted: kg, evenly over the step; negative: frozen, at most what is `available`.
        """
        residences = abs(displacement) / self._length
        kept = 1.0 if residences == 0.0 else -math.expm1(-residences) / residences
        # all of it may freeze, but for rounding
        whole = max(0.0, self.mass + melted)
        stays = min(whole, max(0.0, self.mass * math.exp(-residences) + melted * kept))
        self.mass = stays
        thickness = self.thickness
        self.mass = stays / math.sqrt(1.0 + 2.0 * self._squeeze * thickness**2 * duration)
        self.squeezed += stays - self.mass
        return whole - stays


class BeltWater:
    """`water` and `frozen` (cells,), kg on the belt at its nodes, `cell` (m) apart.

    melt_heat: J for a kilogram; melting: the melting point, K above the air.
    """

    def __init__(self, cells: int, cell: float, melt_heat: float, melting: float) -> None:
        self.water: Array = np.zeros(cells)
        self.frozen: Array = np.zeros(cells)
        self._cell = cell
        self._melt_heat = melt_heat
        self._melting = melting

    @property
    def wet(self) -> bool:
        """Whether there is anything on the belt."""
        return bool(self.water.any() or self.frozen.any())

    def lay(self, mass: float, edge: float, movement: float) -> None:
        """Lay down mass (kg) evenly where an edge of the contact (m) passes in a movement (m)."""
        if mass <= 0.0:
            return
        half = 0.5 * self._cell
        first, loads = strip_loads(np.array([-half, half]), 1.0, edge, movement, self._cell)
        share = loads[0] / loads[0].sum()
        np.add.at(self.water, (first + np.arange(share.size)) % self.water.size, mass * share)

    def wipe(self, edge: float, movement: float, share: float) -> tuple[float, float]:
        """Masses (kg) of water and of ice that a wiper takes off the nodes it passes.

        It stands where the edge (m) does and moves along; share: what it takes of either.
        """
        low, high = sorted((edge, edge + movement))
        nodes = np.arange(math.ceil(low / self._cell), math.ceil(high / self._cell))
        nodes = np.unique(nodes % self.water.size)
        taken = share * float(self.water[nodes].sum()), share * float(self.frozen[nodes].sum())
        self.water[nodes] *= 1.0 - share
        self.frozen[nodes] *= 1.0 - share
        return taken

    def pick_up(self, centre: float, length: float) -> float:
        """Mass (kg) of water on the nodes below the contact, a cell from its edges; taken away."""
        reach = 0.5 * length / self._cell - 1.0
        first = int(np.ceil(centre / self._cell - reach))
        count = min(int(np.floor(centre / self._cell + reach)) - first + 1, self.water.size)
        nodes = (first + np.arange(max(0, count))) % self.water.size
        taken = float(self.water[nodes].sum())
        self.water[nodes] = 0.0
        return taken

    def freeze(self, duration: float, face: Array, response: float) -> Array:
        """Freeze and thaw over a step; power into the belt's face (cells,) W per node.

        face: at the end of the step if nothing froze, K (cells,); response: its rise for 1 W on
        every node, K/W.
        """
        wanted = (self._melting - face) * (duration / (response * self._melt_heat))
        mass = np.clip(wanted, -self.frozen, self.water)
        self.water -= mass
        self.frozen += mass
        return mass * (self._melt_heat / duration)

"""A block that melts on a belt, written down once more from the equations: finite volumes.

Nothing of the model is used. Belt: cells along the loop, each with its own column through the
thickness, in the belt's frame; the contact covers a part of a cell. Ice: one column, in the frame
of its face, into which the ice moves at the rate it melts. Backward Euler for conduction, explicit
for all else. Face of the ice at 0 degC where it melts; then what is left of the friction heat melts
rho L a second. Film: dh/dt = melted - v h / l. The block slides on springs along x with

    mu = (1 - w) mu_k + w^2 eta v / (h p),   w = h / (h + s).
"""

from dataclasses import dataclass, field

import numpy as np

LOAD_DENSITY = dict(ice=917.0, water=999.8)  # kg/m3
ICE_C, ICE_K, LATENT, ETA = 2050.0, 2.2, 334e3, 1.79e-3
BELT_RHO_C, BELT_K, THICK = 700.0 * 840.0, 0.5, 1e-3
CONDUCTANCE, BELT_AIR = 7.5e4, 15.0
MU_S, MU_K = 0.2815, 0.2086


def graded(depth: float, cells: int, finest: float) -> np.ndarray:
    """Sizes (cells,) that grow by one ratio from the finest and fill the depth, m."""
    low, high = 1.0 + 1e-9, 2.0
    for _ in range(200):
        ratio = 0.5 * (low + high)
        total = finest * (ratio**cells - 1.0) / (ratio - 1.0)
        low, high = (ratio, high) if total < depth else (low, ratio)
    return finest * ratio ** np.arange(cells)


def conduction(sizes: np.ndarray, conductivity: float) -> np.ndarray:
    """W/m2 into each cell (n,) per kelvin of each (n, n); both ends insulated."""
    matrix = np.zeros((sizes.size, sizes.size))
    for i in range(sizes.size - 1):
        between = 2.0 * conductivity / (sizes[i] + sizes[i + 1])
        matrix[i, i] -= between
        matrix[i, i + 1] += between
        matrix[i + 1, i + 1] -= between
        matrix[i + 1, i] += between
    return matrix


@dataclass
class MeltingBlock:
    """SI units, temperatures in degC."""

    air: float = -2.0
    mass: float = 40.0
    stiffness: float = 6000.0  # of all springs
    damping: float = 100.0
    speed: float = 3.0
    ramp: float = 3.0
    roughness: float = 2e-6
    loop: float = 4.0
    area: float = 4.93316e-3  # of a disc of 40 mm that lies on a belt of 75 mm
    width: float = 0.075
    dt: float = 5e-4
    rows: dict = field(default_factory=lambda: {n: [] for n in "t friction film melted".split()})

    def __post_init__(self):
        self.length = self.area / self.width
        self.pressure = self.mass * 9.81 / (np.pi * 0.04**2)
        self.belt_z = graded(THICK, 16, 1.5e-5)
        self.ice_z = graded(0.03, 40, 2e-5)
        self.x_edges = np.linspace(0.0, self.loop, 801)
        self.belt = np.full((800, 16), self.air)
        self.ice = np.full(40, self.air)
        self.water, self.frozen, self.covered = np.zeros(800), np.zeros(800), np.zeros(800)
        self.film = self.melted = self.way = self.x = self.vx = self.time = 0.0
        self.melting, self.slips, self.onset = 0.0, False, None
        self.belt_capacity = BELT_RHO_C * self.belt_z
        self.ice_capacity = LOAD_DENSITY["ice"] * ICE_C * self.ice_z
        steps = np.diag(self.belt_capacity) / self.dt - conduction(self.belt_z, BELT_K)
        self.belt_inverse = np.linalg.inv(steps).T
        self.ice_matrix = np.diag(self.ice_capacity) / self.dt - conduction(self.ice_z, ICE_K)

    def coefficient(self, sliding: float) -> float:
        if self.film <= 0.0:
            return MU_K
        w = self.film / (self.film + self.roughness)
        return (1.0 - w) * MU_K + w**2 * ETA * sliding / (self.film * self.pressure)

    def move(self) -> tuple[float, float]:
        """One step of the block: sliding speed and friction force over it."""
        surface = self.speed * min(1.0, self.time / self.ramp)
        rate = self.speed / self.ramp * (self.time < self.ramp)
        if not self.slips:
            self.vx = surface
            held = self.stiffness * self.x + self.damping * surface + self.mass * rate
            self.slips = held > MU_S * self.mass * 9.81
            if not self.slips:
                self.x += self.vx * self.dt
                return 0.0, held
        sliding = surface - self.vx
        force = self.coefficient(sliding) * self.mass * 9.81 if sliding >= 0.0 else held
        pull = force - self.stiffness * self.x - self.damping * self.vx
        self.vx = min(self.vx + self.dt * pull / self.mass, surface)
        self.x += self.dt * self.vx
        return surface - self.vx, force

    def cover(self, moved: float) -> np.ndarray:
        """Part of each cell (800,) under the ice once the belt has moved; water laid and wiped."""
        self.way += moved
        low = (0.5 * self.loop - self.way) % self.loop - 0.5 * self.length
        covered = np.zeros(800)
        for turn in (-self.loop, 0.0, self.loop):
            inside = np.clip(self.x_edges, low + turn, low + turn + self.length)
            covered += np.diff(inside) / np.diff(self.x_edges)
        left = np.maximum(0.0, self.covered - covered)
        entered = covered > self.covered
        self.water[entered] = self.frozen[entered] = 0.0
        self.water += left * LOAD_DENSITY["water"] * self.film
        self.covered = covered
        return covered

    def heat(self, flux: float, covered: np.ndarray) -> None:
        """Friction heat (W/m2) into belt, ice and melting, over one step."""
        of_belt, of_ice = 0.5 * self.belt_z[0] / BELT_K, 0.5 * self.ice_z[0] / ICE_K
        share = covered / covered.sum()
        below = float(share @ self.belt[:, 0])
        inner = 1.0 + CONDUCTANCE * of_belt
        # q = (flux/2 + h (T_face - T_belt)) / inner, T_face = T_ice + of_ice (flux - q)
        mean = (0.5 * flux + CONDUCTANCE * (self.ice[0] + of_ice * flux - below)) / (
            inner + CONDUCTANCE * of_ice
        )
        face = self.ice[0] + of_ice * (flux - mean)
        self.melting = 0.0
        if face > 0.0 or self.film > 0.0:
            face = 0.0
        into = (0.5 * flux + CONDUCTANCE * (face - self.belt[:, 0])) / inner
        into_ice = (face - self.ice[0]) / of_ice
        if face == 0.0:
            self.melting = flux - float(share @ into) - into_ice
            self.onset = self.time if self.onset is None else self.onset
        self._advance_belt(into, covered)
        self._advance_ice(into_ice)

    def _advance_belt(self, into: np.ndarray, covered: np.ndarray) -> None:
        gain = self.belt * self.belt_capacity / self.dt
        gain[:, 0] += covered * into - (1.0 - covered) * BELT_AIR * (self.belt[:, 0] - self.air)
        gain[:, -1] -= BELT_AIR * (self.belt[:, -1] - self.air)
        self.belt = gain @ self.belt_inverse
        frozen = np.clip(
            -self.belt[:, 0] * self.belt_capacity[0] / LATENT, -self.frozen, self.water
        )
        self.water -= frozen
        self.frozen += frozen
        self.belt[:, 0] += frozen * LATENT / self.belt_capacity[0]

    def _advance_ice(self, into: float) -> None:
        recession = max(0.0, self.melting) / (LOAD_DENSITY["ice"] * LATENT)
        # cells move with the face: of the ice beyond each the heat of the next flows in
        moved = recession * LOAD_DENSITY["ice"] * ICE_C * np.diff(self.ice, append=self.air)
        gain = self.ice * self.ice_capacity / self.dt + moved
        gain[0] += into
        self.ice = np.linalg.solve(self.ice_matrix, gain)

    def run(self, until: float) -> "MeltingBlock":
        while self.time < until - 0.5 * self.dt:
            sliding, force = self.move()
            covered = self.cover(sliding * self.dt)
            self.heat(force * sliding / self.area, covered)
            rate = self.melting / LATENT  # kg/(m2 s)
            self.film += self.dt * (
                rate / LOAD_DENSITY["water"] - sliding * self.film / self.length
            )
            self.film = max(0.0, self.film)
            self.melted += self.dt * rate * self.area
            self.time += self.dt
            for name, value in zip(
                self.rows, (self.time, force, self.film, self.melted), strict=True
            ):
                self.rows[name].append(value)
        return self

    def at(self, name: str, time: float) -> float:
        return float(np.interp(time, self.rows["t"], self.rows[name]))

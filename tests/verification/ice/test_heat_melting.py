"""The melting face of the ice alone, against closed forms of moving boundaries.

Flux into an ice whose belt takes nothing; the field starts from the closed form.
"""

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import erfc

from thermal import Contact, Ice
from thermal.contact import BeltFace, exchange
from thermal.ice.body import IceMelted
from thermal.ice.cylinder import Cylinder
from thermal.ice.melting import Ablation

K, RHO, C, LATENT = 2.2, 917.0, 2050.0, 334e3
ALPHA = K / (RHO * C)
#: Melting point over the air, K.
MELTING = 8.0
NO_BELT = BeltFace(np.zeros(1), np.full((1, 1), 1e15))

#: The flux into the ice is constant over a step, while the exact one changes along with it.
ORDER_IN_TIME = 1.5
ORDER_OF_P2 = 3


class Block:
    """Ice under a prescribed flux (W/m2), with its ledger."""

    def __init__(self, rise, height=0.12, elements=16):
        parameters = Ice(
            height=height, air_heat_transfer=0.0, axial_elements=elements, radial_elements=1
        )
        self.ice = Cylinder(parameters, 0.04)
        # the modes span all functions of the mesh: interpolation is a change of basis
        self.ice.amplitudes[:] = np.linalg.solve(self.ice._shapes, rise(self.ice.basis.doflocs[1]))
        self.ablation = Ablation(self.ice, parameters, self.ice.space.area, MELTING)
        self.first, self.received, self.melting = self.ice.heat(), 0.0, 0.0

    def step(self, duration, flux, available=0.0):
        step = self.ablation.exchange(
            duration, available, lambda face: exchange(NO_BELT, face, Contact(), 0.0, flux)
        )
        area = self.ice.space.area
        self.ice.advance(duration, step.fluxes.ice * area, step.sinking, step.recession)
        self.received += flux * duration * area
        self.melting += step.fluxes.melting * duration * area
        return step.recession

    @property
    def profile(self):
        return self.ice.z, self.ice.field()[0]

    @property
    def residual(self):
        return self.received - self.melting - (self.ice.heat() - self.first)


@pytest.mark.parametrize(("speed", "height"), [(3e-5, 0.5), (3e-4, 0.1)])
def test_steady_ablation(speed, height):
    """q = rho V (L + c dT) keeps T = dT exp(-V z/alpha) before a face that recedes at V."""

    def exact(z):
        return MELTING * np.exp(-speed * z / ALPHA)

    block = Block(exact, height)
    for _ in range(100):
        block.step(0.1, RHO * speed * (LATENT + C * MELTING))
        assert block.ablation.speed == pytest.approx(speed, rel=2e-4)
    z, rise = block.profile
    assert block.ice.melted_depth == pytest.approx(10.0 * speed, rel=5e-5)
    assert rise == pytest.approx(exact(z), abs=5e-4 * MELTING)
    assert rise[0] == pytest.approx(MELTING, abs=1e-10)
    assert abs(block.residual) < 1e-12 * block.received


class Neumann:
    """Neumann's Stefan problem on the side of the ice, at x > s = 2 lambda sqrt(alpha t).

    rise = dT erfc(x/(2 sqrt(alpha t))) / erfc(lambda); the water in front of the face brings a
    flux Q/sqrt(t). lambda < 0: water at the melting point freezes on.
    """

    def __init__(self, strength):
        self.strength = strength
        self.root = brentq(self._balance, -0.5, 3.0)

    def _balance(self, root):
        into_ice = K * MELTING * np.exp(-(root**2)) / (np.sqrt(np.pi * ALPHA) * erfc(root))
        return RHO * LATENT * root * np.sqrt(ALPHA) + into_ice - self.strength

    def front(self, t):
        return 2.0 * self.root * np.sqrt(ALPHA * t)

    def rise(self, z, t):
        x = z + self.front(t)
        return MELTING * erfc(x / (2.0 * np.sqrt(ALPHA * t))) / erfc(self.root)

    def errors(self, elements, steps, water=0.0, begin=10.0, end=40.0):
        """Relative error of the melted depth, largest error of the profile over dT."""
        times = np.linspace(begin, end, steps + 1)
        flux = 2.0 * self.strength * np.diff(np.sqrt(times)) / np.diff(times)
        block = Block(lambda z: self.rise(z, begin), elements=elements)
        for q in flux:
            water += RHO * block.ice.space.area * block.step(np.diff(times)[0], q, water)
        z, rise = block.profile
        depth = block.ice.melted_depth / (self.front(end) - self.front(begin)) - 1.0
        assert abs(block.residual) < 1e-10 * abs(block.melting)
        return abs(depth), np.abs(rise - self.rise(z, end)).max() / MELTING


@pytest.mark.parametrize("strength", [1.5e4, 4e4])
def test_neumanns_stefan_problem(strength):
    depth, profile = Neumann(strength).errors(elements=16, steps=320)
    assert depth < 1e-3
    assert profile < 5e-4


def test_water_freezes_to_the_face_as_in_stefans_problem():
    freezing = Neumann(0.0)
    assert freezing.root < -0.01
    depth, profile = freezing.errors(elements=16, steps=320, water=1.0)
    assert depth < 1e-3
    assert profile < 5e-4


def test_order_in_time():
    errors = [Neumann(4e4).errors(32, steps)[0] for steps in (5, 10, 20, 40)]
    orders = np.log2(errors[:-1] / np.array(errors[1:]))
    assert orders == pytest.approx(ORDER_IN_TIME, abs=0.2)


def test_order_in_the_mesh():
    profiles = [Neumann(4e4).errors(elements, 160)[1] for elements in (4, 8, 16)]
    orders = np.log2(profiles[:-1] / np.array(profiles[1:]))
    assert orders.min() > ORDER_OF_P2


def test_a_film_that_is_used_up_lets_the_face_cool():
    """Ice at dT z/0.01 draws heat from the face; the film gives what it has and no more."""
    block = Block(lambda z: MELTING * np.exp(-z / 0.01))
    water = 1e-5
    frozen = 0.0
    for _ in range(20):
        frozen -= RHO * block.ice.space.area * block.step(0.5, 0.0, water - frozen)
    assert frozen == pytest.approx(water, rel=1e-9)
    assert block.ice.face() < MELTING - 0.01
    assert abs(block.residual) < 1e-12 * abs(block.ice.heat())


def test_a_block_that_melts_away_says_so():
    block = Block(lambda z: 0.0 * z, height=1e-3)
    with pytest.raises(IceMelted, match="of its 0.001 m less than 5e-05 m are left"):
        for _ in range(1000):
            block.step(0.1, 1e5)

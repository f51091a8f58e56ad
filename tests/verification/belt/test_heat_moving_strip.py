"""A strip source that moves over a half-space: Jaeger 1942, at a low Peclet number.

With alpha the diffusivity, X = v x/(2 alpha) from the middle of the strip, along the motion of the
body, and L = v l/(2 alpha) for the half-length l, the surface has

    T = 2 q alpha/(pi lambda v) int_{X-L}^{X+L} exp(s) K0(|s|) ds,   s along the body's motion.
"""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import k0

from thermal import Belt, BeltIceModel, Contact, Ice, SteadySliding, ThermalParameters

HALF_LENGTH, PECLET = 2.5e-3, 0.5
K, RHO, C = 0.5, 700.0, 840.0
ALPHA = K / (RHO * C)
SPEED = 2.0 * ALPHA * PECLET / HALF_LENGTH
#: Where the strip has been long enough, and not yet met its own trace; half-lengths.
WAY, LOOP = 40.0, 70.0
FLUX = 1e3
PLACES = HALF_LENGTH * np.array([-2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0])
#: Cells of the stepped model, half-lengths, and the orders that they show.
CELLS = np.array([0.2, 0.1, 0.05])
ORDER_INSIDE, ORDER_IN_FRONT = 2.0, 1.0


def jaeger(x):
    """K at places (n,) m behind the middle of the strip."""

    def one(place):
        low, high = place - PECLET, place + PECLET
        inside = [0.0] if low < 0.0 < high else None
        return quad(lambda s: np.exp(s) * k0(abs(s)), low, high, points=inside, epsabs=1e-12)[0]

    scale = 2.0 * FLUX * ALPHA / (np.pi * K * SPEED)
    return scale * np.array([one(SPEED * place / (2.0 * ALPHA)) for place in x])


def parameters(cell, elements=30):
    """A belt so thick and long that it is a half-space; uniform flux, no ice. Default material."""
    return ThermalParameters(
        belt=Belt(length=LOOP * HALF_LENGTH, thickness=30.0 * HALF_LENGTH, width=0.005,
                  air_heat_transfer=0.0, cell_length=cell, elements=elements),
        ice=Ice(conductivity=1e-9, heat_capacity=1e-3, air_heat_transfer=0.0),
        contact=Contact(radius=3e-3, length=2.0 * HALF_LENGTH, strips=1),
    )  # fmt: skip


def test_contact_frame_follows_jaeger():
    force = FLUX * (2.0 * HALF_LENGTH * 0.005) / SPEED
    sliding = SteadySliding(parameters(1e-3), SPEED, force, waves=700)
    sliding.run(WAY * HALF_LENGTH / SPEED)
    assert sliding.face(PLACES) == pytest.approx(jaeger(PLACES), rel=2e-3)


def test_stepped_model_converges_to_jaeger():
    """Steps of one cell. At least second order inside and behind it, first order in front of it.

    At the edges themselves the slope is infinite, and a cell of 1/20 l still errs by 3 %.
    """
    inside, front, edges = PLACES[[2, 3, 4, 6]], PLACES[:1], PLACES[[1, 5]]
    errors = {"inside": [], "front": [], "edges": []}
    for part in CELLS:
        model = BeltIceModel(parameters(part * HALF_LENGTH, elements=20))
        cell = model.belt.cell
        for _ in range(round(WAY * HALF_LENGTH / cell)):
            model.step(cell / SPEED, FLUX * model.footprint.area * cell / SPEED, cell)
        face = np.append(model.belt.face(), model.belt.face()[0])
        for name, x in (("inside", inside), ("front", front), ("edges", edges)):
            place = (model.contact_position + x) / cell % model.belt.cells
            seen = np.interp(place, np.arange(face.size), face)
            errors[name].append(np.sqrt(np.mean((seen / jaeger(x) - 1.0) ** 2)))
    assert errors["inside"][-1] < 2e-4
    orders = {
        name: np.polyfit(np.log(CELLS), np.log(error), 1)[0] for name, error in errors.items()
    }
    assert orders["inside"] > ORDER_INSIDE - 0.2
    assert orders["front"] > ORDER_IN_FRONT - 0.2
    assert errors["edges"][-1] < 0.03

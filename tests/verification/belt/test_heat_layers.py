"""A belt of layers, and what its railing and rollers take from it, against closed forms."""

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.optimize import brentq
from skfem import BilinearForm, CellBasis, ElementQuad2, MeshQuad

from thermal import Belt, BeltIceModel, Contact, Ice, Layer, ThermalParameters
from thermal.belt.material_frame import CONTACT, BeltField
from thermal.belt.thickness import thickness_of

GRIT = Layer(thickness=0.3e-3, density=2600.0, heat_capacity=780.0, conductivity=2.0)
CLOTH = Layer(thickness=0.7e-3, density=500.0, heat_capacity=1300.0, conductivity=0.12)
ORDER_OF_P2_EIGENVALUES = 4
# The graded meshes are similar only in the limit of many elements.
ASYMPTOTIC = 0.25

# An ice that takes nothing; through a good contact it would carry heat along the belt.
ALONE = {
    "ice": Ice(conductivity=1e-9, heat_capacity=1e-3, air_heat_transfer=0.0),
    "contact": Contact(conductance=1e-6),
}


def two_layers(h, elements):
    return Belt(layers=(GRIT, CLOTH), air_heat_transfer=h, elements=elements)


def slowest_rate(h):
    """First root of the two-layer slab with film h on both faces, temperatures as cosines."""

    def mismatch(rate):
        flux, temperature = h, 1.0  # at z = 0: k T' = h T
        for layer in (GRIT, CLOTH):
            k, capacity = layer.conductivity, layer.density * layer.heat_capacity
            wave = np.sqrt(rate * capacity / k)
            c, s = np.cos(wave * layer.thickness), np.sin(wave * layer.thickness)
            temperature, flux = (
                temperature * c + flux / (k * wave) * s,
                flux * c - temperature * k * wave * s,
            )
        return flux + h * temperature

    lumped = 2.0 * h / Belt(layers=(GRIT, CLOTH)).capacity_per_area
    return brentq(mismatch, 1e-6, lumped, xtol=1e-15)


def test_two_layers_cool_at_their_slowest_rate_with_the_order_of_p2():
    h = 500.0
    exact = slowest_rate(h)
    elements = np.array([4, 8, 16])
    errors = [
        abs(thickness_of(two_layers(h, int(n)), 1.0).rates[0] / exact - 1.0) for n in elements
    ]
    orders = np.diff(np.log(errors)) / np.diff(np.log(1.0 / elements))
    assert orders[-1] == pytest.approx(ORDER_OF_P2_EIGENVALUES, abs=ASYMPTOTIC)
    assert errors[0] < 5e-4


def test_heat_crosses_layers_in_series():
    """Long after a flux q is switched on: T_contact - T_back = q_through sum(d / k)."""
    h, q = 5.0, 1e3
    belt = BeltField(
        Belt(layers=(GRIT, CLOTH), air_heat_transfer=h, length=0.3, cell_length=0.01), 1.0
    )
    load = {CONTACT: np.zeros(belt.cells // 2 + 1, dtype=complex)}
    load[CONTACT][0] = q * belt.cells * belt.cell
    belt.advance(1e6, load)
    contact, back = belt.face(0)[0], belt.face(1)[0]
    through = h * back
    resistance = sum(layer.thickness / layer.conductivity for layer in (GRIT, CLOTH))
    assert contact - back == pytest.approx(through * resistance, rel=1e-9)
    assert h * contact + through == pytest.approx(q, rel=1e-9)


def test_conduction_along_layers_is_that_of_the_assembled_problem():
    """A wave of a contact's length: what the coupling of the modes changes is below 1e-3 of it."""
    length, belt = 0.07, Belt(layers=(GRIT, CLOTH), air_heat_transfer=0.0, elements=4)
    modes = thickness_of(belt, 1.0)
    wave = 2.0 * np.pi / length
    mesh = MeshQuad.init_tensor(np.linspace(0.0, 0.5 * length, 9), modes.depth[::2])
    basis = CellBasis(mesh, ElementQuad2())
    below = mesh.p[1, mesh.t].mean(axis=0) > GRIT.thickness
    k = np.where(below, CLOTH.conductivity, GRIT.conductivity)[:, None]
    capacity = np.where(
        below, CLOTH.density * CLOTH.heat_capacity, GRIT.density * GRIT.heat_capacity
    )[:, None]
    stiffness = BilinearForm(
        lambda u, v, w: k * (u.grad[0] * v.grad[0] + u.grad[1] * v.grad[1])
    ).assemble(basis)
    mass = BilinearForm(lambda u, v, w: capacity * u * v).assemble(basis)
    rates = eigh(stiffness.toarray(), mass.toarray(), eigvals_only=True)
    # The mesh is half a wave long with insulated ends: its first rate is that wave's.
    assert modes.rates[0] + modes.along[0] * wave**2 == pytest.approx(rates[1], rel=1e-3)


THIN = {"thickness": 1e-4, "density": 7000.0, "conductivity": 50.0, "air_heat_transfer": 0.0}


def left_after(speed, **belt):
    """A thin belt after three seconds: the model, and the part of its heat that it still has."""
    thin = THIN | {"length": 0.6, "cell_length": 2e-3} | belt
    model = BeltIceModel(ThermalParameters(belt=Belt(**thin), **ALONE))
    model.belt.amplitudes[0, 0] = 1.0
    before = model.belt.heat()
    for _ in range(300):
        model.step(0.01, 0.0, speed * 0.01)
    return model, model.belt.heat() / before


@pytest.mark.parametrize("support", [
    {"railing_length": 0.12, "railing_conductance": 300.0},
    {"rollers": 1, "roller_arc": 0.12, "roller_conductance": 300.0},
])  # fmt: skip
def test_a_support_cools_what_runs_over_it(support):
    """A thin belt loses the part 1 - exp(-h l/(v c'')) of its heat on a support of length l."""
    speed = 0.2
    model, left = left_after(speed, **support)
    kept = np.exp(-300.0 * 0.12 / (speed * 1e-4 * 7000.0 * 840.0))
    assert left == pytest.approx(kept, rel=1e-3)
    lost = model.belt.heat() * (1.0 / left - 1.0)
    assert model.outputs()["support_heat"] == pytest.approx(lost, rel=1e-6)


def test_a_railing_without_conductance_only_covers():
    """The back under it gives nothing to the air: the loop is that much shorter to the film."""
    h, speed, covered = 50.0, 0.2, 0.3
    kept = {}
    for railing in (0.0, covered):
        belt = {"railing_length": railing, "air_heat_transfer": h}
        model, kept[railing] = left_after(speed, **belt)
        assert model.outputs()["support_heat"] == 0.0
    saved = np.exp(h * covered / (speed * 1e-4 * 7000.0 * 840.0))
    assert kept[covered] / kept[0.0] == pytest.approx(saved, rel=1e-3)

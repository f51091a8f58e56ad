"""A sample from a mesh of tetrahedra: closed forms of the box, and the axisymmetric model."""

import numpy as np
import pytest
from sample_meshes import box, cylinder, write
from scipy.linalg import eigh
from scipy.optimize import brentq
from scipy.sparse.linalg import eigsh

from thermal import Ice as IceParameters
from thermal.ice import Ice
from thermal.ice_body import IceBody
from thermal.krylov import response_space
from thermal.relaxation import mean_decay
from thermal.sample import Sample, assembled

K, RHO, C = 2.2, 917.0, 2050.0
ALPHA = K / (RHO * C)
EXTENT = (0.08, 0.06, 0.1)
WIDE = 1.0

#: The round side is a polygon: its area and its circumference err by the square of a side.
ORDER_OF_THE_POLYGON = 2
ORDER_OF_P2_EIGENVALUES = 4


def sample(tmp_path, mesh, h=0.0, width=WIDE):
    path = write(tmp_path / "sample.vtu", *mesh)
    return Sample(IceParameters(air_heat_transfer=h), path, width)


def slab(t, height):
    """Face of an insulated slab under 1 W/m2, K m2/W."""
    n = np.arange(1, 200_000)
    series = np.sum(-np.expm1(-ALPHA * (n * np.pi / height) ** 2 * t) / n**2)
    return t / (RHO * C * height) + 2.0 * height / (K * np.pi**2) * series


def test_constant_flux_into_a_box(tmp_path):
    ice = sample(tmp_path, box((2, 2, 4), EXTENT))
    for t in (0.01, 0.1, 1.0, 30.0, 1e3, 1e5):
        assert ice.face_response(t)[1] * ice.area == pytest.approx(slab(t, EXTENT[2]), rel=1.5e-3)


def test_slowest_rate_of_the_cooled_box(tmp_path):
    """Both pairs of sides: y tan y = h l/(2 k); height, insulated below: y tan y = h H/k."""
    h = 50.0

    def root(biot):
        return brentq(lambda s: s * np.tan(s) - biot, 1e-6, 1.57)

    exact = ALPHA * ((root(h * EXTENT[2] / K) / EXTENT[2]) ** 2 + sum(
        (root(0.5 * h * length / K) / (0.5 * length)) ** 2 for length in EXTENT[:2]))
    errors = []
    for n in (3, 6):
        points, cells = box((n, n, n), EXTENT)
        body = assembled(IceParameters(air_heat_transfer=h), points, cells, WIDE)
        rates = eigsh(body.conduction(), 1, body.capacity(), sigma=0.0, return_eigenvectors=False)
        errors.append(rates[0] / exact - 1.0)
    assert np.log2(errors[0] / errors[1]) == pytest.approx(ORDER_OF_P2_EIGENVALUES, abs=0.4)
    assert errors[1] < 1e-4


def test_the_small_space_answers_as_the_whole_mesh():
    """Step responses from 0.1 ms to a day, against all modes of the mesh."""
    points, cells = box((2, 2, 3), EXTENT)
    body = assembled(IceParameters(), points, cells, 0.02)
    load, area = body.contact()
    reduced = IceBody(body.space(response_space(
        body.capacity().tocsr(), body.conduction().tocsr(), load)))
    rates, shapes = eigh(body.conduction().toarray(), body.capacity().toarray())
    face = shapes.T @ load / area
    for t in np.geomspace(1e-4, 1e5, 19):
        exact = np.sum(face**2 * t * mean_decay(rates * t))
        assert reduced.face_response(t)[1] == pytest.approx(exact, rel=3e-6)


def differences(tmp_path, across):
    """Face of a cooled cylinder against the axisymmetric model after some times, relative."""
    ice = sample(tmp_path, cylinder(across, 6), h=50.0)
    round_ = Ice(IceParameters(air_heat_transfer=50.0), 0.04)
    area = np.pi * 0.04**2
    return np.array([
        ice.face_response(t)[1] * ice.area / (round_.face_response(t)[1] * area) - 1.0
        for t in (1.0, 30.0, 3e3, 1e5)])


def test_cylinder_against_the_axisymmetric_model(tmp_path):
    coarse, fine = differences(tmp_path, 3), differences(tmp_path, 6)
    assert np.abs(fine[:2]).max() < 1.5e-3, "before the side matters only the layers err"
    assert np.abs(fine).max() < 0.01
    # in steady state the circumference decides
    assert np.log2(coarse[3] / fine[3]) == pytest.approx(ORDER_OF_THE_POLYGON, abs=0.4)


def test_contact_on_a_narrow_belt(tmp_path):
    """A third of the base on the belt: soon colder than a slab, at last warmed as a whole."""
    ice = sample(tmp_path, box((1, 6, 4), EXTENT), width=0.02)
    assert ice.area == pytest.approx(0.08 * 0.02)
    assert ice.breadth == 0.02
    assert ice.face_response(30.0)[1] * ice.area < 0.9 * slab(30.0, EXTENT[2])
    late = ice.face_response(2e6)[1] - ice.face_response(1e6)[1]
    assert late / 1e6 == pytest.approx(1.0 / (RHO * C * np.prod(EXTENT)), rel=1e-9)


def test_heat_is_conserved(tmp_path):
    ice = sample(tmp_path, box((2, 2, 2), EXTENT), h=10.0)
    air = sum(ice.advance(30.0, float(n % 5)) for n in range(1000))
    received = 30.0 * 2000.0
    assert air > 0.5 * received
    assert ice.heat() + air == pytest.approx(received, rel=1e-10)


def test_section_shows_the_field(tmp_path):
    ice = sample(tmp_path, cylinder(2, 4))
    ice.advance(100.0, 5.0)
    x, z, rise = ice.section()
    assert rise.shape == (x.size, z.size)
    middle = rise[x.size // 2]
    assert middle[0] == pytest.approx(ice.face(), rel=0.02)
    assert np.diff(middle).max() < 1e-4 * middle[0]
    assert np.isfinite(rise).all()

"""A sample from a mesh of tetrahedra: closed forms of the box, and the axisymmetric model."""

import meshio
import numpy as np
import pytest
from sample_meshes import box, cylinder, write
from scipy.linalg import eigh
from scipy.special import erfc

import thermal
from thermal import Belt, BeltIceModel, Ice, SteadySliding, ThermalParameters
from thermal.ice.body import IceBody
from thermal.ice.cylinder import Cylinder
from thermal.ice.sample import Sample, assembled, response_space
from thermal.relaxation import mean_decay

K, RHO, C = 2.2, 917.0, 2050.0
ALPHA = K / (RHO * C)
EXTENT = (0.08, 0.06, 0.1)
WIDE = 1.0

#: The round side is a polygon: its area and its circumference err by the square of a side.
ORDER_OF_THE_POLYGON = 2


def sample(tmp_path, mesh, h=0.0, width=WIDE):
    path = write(tmp_path / "sample.vtu", *mesh)
    return Sample(Ice(air_heat_transfer=h), path, width)


def test_the_small_space_answers_as_the_whole_mesh():
    """Step responses from 0.1 ms to a day, against all modes of the mesh."""
    points, cells = box((2, 2, 3), EXTENT)
    body = assembled(Ice(), points, cells, 0.02)
    load, area = body.contact()
    reduced = IceBody(
        body.space(response_space(body.capacity().tocsr(), body.conduction().tocsr(), load))
    )
    rates, shapes = eigh(body.conduction().toarray(), body.capacity().toarray())
    face = shapes.T @ load / area
    for t in np.geomspace(1e-4, 1e5, 19):
        exact = np.sum(face**2 * t * mean_decay(rates * t))
        assert reduced.face_response(t)[1] == pytest.approx(exact, rel=3e-6)


def differences(tmp_path, across):
    """Face of a cooled cylinder against the axisymmetric model after some times, relative."""
    ice = sample(tmp_path, cylinder(across, 5), h=50.0)
    round_ = Cylinder(Ice(air_heat_transfer=50.0), 0.04)
    area = np.pi * 0.04**2
    return np.array(
        [
            ice.face_response(t)[1] * ice.area / (round_.face_response(t)[1] * area) - 1.0
            for t in (1.0, 30.0, 3e3, 1e5)
        ]
    )


def test_cylinder_against_the_axisymmetric_model(tmp_path):
    coarse, fine = differences(tmp_path, 2), differences(tmp_path, 4)
    assert np.abs(fine[:2]).max() < 1.5e-3, "before the side matters only the layers err"
    assert np.abs(fine).max() < 0.02, "16 sides"
    # in steady state the circumference decides
    assert np.log2(coarse[3] / fine[3]) == pytest.approx(ORDER_OF_THE_POLYGON, abs=0.4)


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
    assert np.isfinite(rise).all()
    deep = 2.0 * np.sqrt(100.0 * ALPHA)
    s = z / deep
    exact = 5.0 / ice.area * deep / K * (np.exp(-(s**2)) / np.sqrt(np.pi) - s * erfc(s))
    assert rise[x.size // 2] == pytest.approx(exact, abs=0.01 * exact[0])


def test_fields_of_a_sample_read_back(tmp_path):
    path = write(tmp_path / "sample.vtu", *cylinder(2, 3))
    model = BeltIceModel(ThermalParameters(belt=Belt(cell_length=5e-3), ice=Ice(mesh=str(path))))
    model.step(1.0, 5.0, 0.1)
    mesh = meshio.read(thermal.FieldSeries(tmp_path, model).write(0.0))
    kinds = {block.type: block.data for block in mesh.cells}
    assert set(kinds) == {"quad", "tetra"}
    assert len(kinds["tetra"]) == len(model.ice.cells)
    seen = mesh.point_data["temperature_degC"][kinds["tetra"]]
    assert seen.max() == pytest.approx(-8.0 + model.ice.at_points().max(), abs=1e-12)
    heights = mesh.points[kinds["tetra"]][..., 2]
    assert heights.min() == 0.0 and heights.max() == pytest.approx(0.1)


def test_refusals_name_the_key(tmp_path):
    big = write(tmp_path / "mm.vtu", 1e3 * cylinder(2, 2)[0], cylinder(2, 2)[1])
    with pytest.raises(thermal.MeshError, match=r"^ice\.mesh: .*mm\.vtu: .* is the file in mm\?"):
        BeltIceModel(ThermalParameters(ice=Ice(mesh=str(big))))
    beside = write(tmp_path / "beside.vtu", cylinder(2, 2)[0] + [0.0, 0.2, 0.0], cylinder(2, 2)[1])
    with pytest.raises(thermal.MeshError, match="its base does not lie on the belt"):
        BeltIceModel(ThermalParameters(ice=Ice(mesh=str(beside))))
    long_base = write(tmp_path / "long.vtu", *box((2, 2, 2), (0.1, 0.02, 0.05)))
    with pytest.raises(
        thermal.ParameterError, match=r"belt\.length = 0\.09 m is shorter than the contact"
    ):
        BeltIceModel(
            ThermalParameters(
                belt=Belt(length=0.09, width=0.01),
                contact=thermal.Contact(radius=0.01),
                ice=Ice(mesh=str(long_base)),
            )
        )


def test_steady_sliding_takes_the_sample(tmp_path):
    path = write(tmp_path / "cylinder.vtu", *cylinder(4, 4))
    steady = []
    for mesh in ("", str(path)):
        parameters = ThermalParameters(belt=Belt(width=0.1, cell_length=4e-3), ice=Ice(mesh=mesh))
        steady.append(SteadySliding(parameters, 0.5, 2.0).settle().ice_face)
    assert steady[1] == pytest.approx(steady[0], rel=0.03), "the polygon is 2.6 % smaller"
    assert steady[1] != steady[0]

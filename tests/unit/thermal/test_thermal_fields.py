from xml.etree import ElementTree

import meshio
import numpy as np
import pytest

from thermal import Belt, BeltIceModel, FieldSeries, ThermalParameters, rig_view


@pytest.fixture
def model():
    model = BeltIceModel(ThermalParameters(belt=Belt(cell_length=5e-3)))
    for _ in range(20):
        model.step(0.01, 0.03, 0.0081)
    return model


def collection(path):
    return [
        (float(entry.get("timestep")), entry.get("file"))
        for entry in ElementTree.parse(path).iter("DataSet")
    ]


def test_series_reads_back(model, tmp_path):
    series = FieldSeries(tmp_path, model)
    series.write(0.2)
    model.step(0.1, 0.3, 0.05)
    series.write(0.3)
    assert collection(series.path) == [
        (0.2, "temperature_00000.vtu"),
        (0.3, "temperature_00001.vtu"),
    ]
    mesh = meshio.read(tmp_path / "temperature_00001.vtu")
    temperature = mesh.point_data["temperature_degC"]
    part = mesh.cell_data["part"][0]
    nodes = mesh.cells[0].data
    belt, ice = nodes[part == 0], nodes[part == 1]
    assert temperature[ice].max() == pytest.approx(rig_view(model).ice.max(), abs=1e-12)
    assert temperature[belt].max() <= model.belt_field()[2].max() + 1e-12
    assert mesh.points[belt][..., 2].max() == 0.0
    assert mesh.points[ice][..., 2].min() == 0.0
    assert mesh.points[ice][..., 0].min() == pytest.approx(-0.04)
    np.testing.assert_allclose(mesh.point_data["rise_K"], temperature + 8.0, atol=1e-12)
    warped = mesh.points + mesh.point_data["stretch_m"]
    assert warped[belt][..., 2].min() == pytest.approx(-0.1), "a tenth of 1 m"
    assert np.array_equal(warped[ice], mesh.points[ice])


def test_the_stretched_view_is_the_same_on_a_thicker_belt(model, tmp_path):
    """Its factor stands in its name; time, cells and temperatures are those of the true one."""
    series = FieldSeries(tmp_path, model)
    series.write(0.2)
    assert series.factor == 100.0
    name = "temperature_belt_100x"
    assert collection(tmp_path / f"{name}.pvd") == [(0.2, f"{name}_00000.vtu")]
    true = meshio.read(tmp_path / "temperature_00000.vtu")
    thick = meshio.read(tmp_path / "temperature_belt_100x_00000.vtu")
    np.testing.assert_array_equal(thick.cells[0].data, true.cells[0].data)
    np.testing.assert_array_equal(thick.point_data["rise_K"], true.point_data["rise_K"])
    np.testing.assert_array_equal(thick.points[:, :2], true.points[:, :2])
    below = true.points[:, 2] < 0.0
    np.testing.assert_allclose(thick.points[below, 2], 100.0 * true.points[below, 2], rtol=1e-12)
    np.testing.assert_array_equal(thick.points[~below], true.points[~below])
    assert set(thick.point_data) == {"temperature_degC", "rise_K"}, "it cannot be stretched twice"


def test_cells_cover_belt_and_ice_once(model, tmp_path):
    mesh = meshio.read(FieldSeries(tmp_path, model).write(0.0))
    x, _, z = np.moveaxis(mesh.points[mesh.cells[0].data], -1, 0)
    shoelace = 0.5 * np.sum(x * np.roll(z, -1, axis=1) - z * np.roll(x, -1, axis=1), axis=1)
    part = mesh.cell_data["part"][0]
    assert np.abs(shoelace[part == 0]).sum() == pytest.approx(1.0 * 1e-3)
    assert np.abs(shoelace[part == 1]).sum() == pytest.approx(0.08 * 0.10)
    assert len(set(np.sign(shoelace[part == 1]))) == 1


def test_the_contact_is_seen_at_the_origin(model, tmp_path):
    mesh = meshio.read(FieldSeries(tmp_path, model).write(0.0))
    top = (mesh.points[:, 2] == 0.0) & (np.abs(mesh.points[:, 0]) > 0.06)
    x, temperature = mesh.points[top, 0], mesh.point_data["temperature_degC"][top]
    assert temperature[(x > 0.06) & (x < 0.1)].min() > -7.97, "behind the ice the belt is warm"
    assert temperature[x < -0.06].max() == pytest.approx(-8.0, abs=1e-6)


def test_an_interrupted_write_leaves_the_series_readable(model, tmp_path, monkeypatch):
    series = FieldSeries(tmp_path, model)
    series.write(1.0)

    def dies_half_way(self, path, **_):
        path.write_text("<VTKFile")
        raise KeyboardInterrupt

    monkeypatch.setattr(meshio.Mesh, "write", dies_half_way)
    with pytest.raises(KeyboardInterrupt):
        series.write(2.0)
    monkeypatch.undo()
    assert collection(series.path) == [(1.0, "temperature_00000.vtu")]
    for _, file in collection(series.path):
        meshio.read(tmp_path / file)
    series.write(2.0)
    assert [time for time, _ in collection(series.path)] == [1.0, 2.0]
    assert not list(tmp_path.glob("*.partial"))


def test_time_must_advance(model, tmp_path):
    series = FieldSeries(tmp_path, model)
    series.write(1.0)
    with pytest.raises(ValueError, match="after the last one"):
        series.write(1.0)
    with pytest.raises(ValueError, match="nan"):
        series.write(float("nan"))


def test_missing_folder(model, tmp_path):
    with pytest.raises(ValueError, match="no such folder"):
        FieldSeries(tmp_path / "nowhere", model)

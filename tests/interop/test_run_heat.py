"""What `stickslip run` does with the heat: a sample from a mesh, an animation, melting away."""

import json

import meshio
import numpy as np
import pytest
import xarray as xr
from command_line import SHORT_CASE, stickslip_here
from PIL import Image
from skfem import MeshTet

SHORT = SHORT_CASE.format(run_up=0.2, duration=1.0, snapshots=0.25)


#: A film of ice that the first friction melts away.
MELTS = """
ice = { height = 1e-6, latent_heat = 1.0, heat_capacity = 1.0 }
ambient.temperature_degC = -1e-6
"""


def run(folder, fmu, text, *arguments):
    (folder / "case.toml").write_text(text)
    return stickslip_here(folder, "run", "case.toml", "--fmu", fmu, "-o", "out", *arguments)


@pytest.fixture
def mesh():
    side = np.linspace(-0.03, 0.03, 3)
    return MeshTet.init_tensor(side, side, np.linspace(0.0, 0.08, 4))


def test_a_sample_beside_the_scenario_and_an_animation(tmp_path, fmu, mesh):
    meshio.Mesh(mesh.p.T, [("tetra", mesh.t.T)]).write(tmp_path / "block.vtk")
    done = run(tmp_path, fmu, SHORT + '[ice]\nmesh = "block.vtk"\n', "--animation", "--fields")
    assert (done.returncode, done.stderr) == (0, "")
    with Image.open(tmp_path / "out" / "temperature.gif") as animation:
        assert animation.n_frames == 5
    assert "temperature.gif" in (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    fields = meshio.read(tmp_path / "out" / "fields" / "temperature_00004.vtu")
    assert {block.type for block in fields.cells} == {"quad", "tetra"}
    heat = json.loads((tmp_path / "out" / "summary.json").read_text())["ledger"]["heat"]
    assert heat["relative_residual"] < 1e-10


def test_without_asking_there_is_no_animation_and_melting_away_ends_the_run(tmp_path, fmu):
    text = SHORT + MELTS + "[mixed_lubrication]\nshare = 1e-6\n"
    done = run(tmp_path, fmu, text)
    assert done.returncode == 1
    *notes, line = done.stderr.splitlines()
    assert "the ice has melted: of its 1e-06 m less than 5e-08 m are left" in line
    assert all(note.startswith("note: ") for note in notes)
    assert not (tmp_path / "out" / "temperature.gif").exists()
    with xr.open_dataset(tmp_path / "out" / "result.nc") as dataset:
        assert dataset.attrs["status"] == "failed"
        assert dataset.sizes["time"] > 1

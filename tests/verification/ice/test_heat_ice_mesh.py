"""Mesh files of a sample: what is read, and what is refused in one line that says why."""

import re

import meshio
import numpy as np
import pytest
from refusals import one_line
from sample_meshes import box, cylinder, write

from thermal.ice.mesh_file import (
    MeshError,
    base_of,
    cut_at_base,
    layer_height,
    mesh_of,
    read_sample,
)

EXTENT = (0.08, 0.06, 0.1)


@pytest.fixture
def cube():
    return box((3, 3, 3), EXTENT)


def volume(points, cells):
    corners = points[cells]
    return np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])).sum() / 6.0


@pytest.mark.parametrize("suffix", [".msh", ".vtk", ".vtu", ".inp"])
def test_formats(tmp_path, cube, suffix):
    points, cells = read_sample(write(tmp_path / f"sample{suffix}", *cube))
    assert points.shape == (64, 3) and cells.shape == (162, 4)
    assert volume(points, cells) == pytest.approx(np.prod(EXTENT))


def test_surface_triangles_and_unused_nodes_do_no_harm(tmp_path, cube):
    points, cells = cube
    mesh = meshio.Mesh(
        np.concatenate(([[9.0, 9.0, 9.0]], points)),
        [("triangle", np.array([[1, 2, 3]])), ("tetra", cells + 1)],
    )
    mesh.write(tmp_path / "sample.vtu")
    assert read_sample(tmp_path / "sample.vtu")[0].shape == (64, 3)


def test_curved_tetrahedra_count_by_their_corners(tmp_path, cube):
    points, cells = cube
    middles = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]
    nodes = np.concatenate([points] + [points[cells[:, list(e)]].mean(axis=1) for e in middles])
    more = len(points) + np.arange(6)[None, :] * len(cells) + np.arange(len(cells))[:, None]
    path = write(tmp_path / "curved.vtu", nodes, np.concatenate((cells, more), axis=1), "tetra10")
    assert volume(*read_sample(path)) == pytest.approx(np.prod(EXTENT))


def refused(path, says):
    line = one_line(MeshError, read_sample, path)
    assert line.startswith(str(path)) and re.search(says, line), line


@pytest.mark.parametrize(("factor", "says"), [
    (1000.0, r"the sample is 80 x 60 x 100 m, allowed is up to 2 m: is the file in mm\?"),
    (100.0, r"is the file in cm\?"),
    (1e-3, "the sample is 8e-05 x 6e-05 x 0.0001 m, allowed is at least 0.002 m"),
])  # fmt: skip
def test_wrong_units(tmp_path, cube, factor, says):
    refused(write(tmp_path / "sample.vtu", factor * cube[0], cube[1]), says)


@pytest.mark.parametrize(("name", "content", "says"), [
    ("absent.msh", None, "no such file"),
    ("empty.msh", "", "cannot be read as a mesh"),
    ("text.vtk", "hello", "cannot be read as a mesh"),
    ("broken.vtu", "<VTKFile>", "cannot be read as a mesh"),
    ("sample.xyz", "1 2 3", "cannot be read as a mesh"),
])  # fmt: skip
def test_unreadable(tmp_path, capsys, name, content, says):
    if content is not None:
        (tmp_path / name).write_text(content)
    refused(tmp_path / name, says)
    assert not any(capsys.readouterr()), "nothing but the error is said"


def not_a_number(points, cells):
    points[5, 1] = np.nan
    return points, cells


def two_pieces(points, cells):
    beside = points + [0.2, 0.0, 0.0]
    return np.concatenate((points, beside)), np.concatenate((cells, cells + len(points)))


def inner_node(points):
    return np.flatnonzero(np.all(np.abs(points - [0, 0, 0.05]) < 0.03, axis=1))[0]


def without_volume(points, cells):
    inner = inner_node(points)
    mates = cells[(cells == inner).any(axis=1)][0]
    points[inner] = points[mates[mates != inner]].mean(axis=0)
    return points, cells


def folded(points, cells):
    points[inner_node(points)] += [0.05, 0.0, 0.0]
    return points, cells


def a_facet_of_three(points, cells):
    mesh = mesh_of(points, cells)
    inner = np.bincount(mesh.t2f.ravel()) == 2
    third = np.append(mesh.facets.T[inner][0], len(points))[None, :]
    return np.concatenate((points, [[0.0, 0.0, 0.033]])), np.concatenate((cells, third))


def hollow(points, cells):
    points, cells = box((5, 5, 5), EXTENT)
    centres = points[cells].mean(axis=1) - [0.0, 0.0, 0.05]
    return points, np.delete(cells, np.argmin(np.linalg.norm(centres, axis=1)), axis=0)


def touching_along_an_edge(points, cells):
    x, y, z = points[cells].mean(axis=1).T
    corner = (x < -0.0134) & (y < -0.0101) | (x > 0.0134) & (y > 0.0101)
    middle = (np.abs(x) < 0.0133) & (np.abs(y) < 0.0099)
    return points, cells[(z > 0.034) | ((z < 0.033) & (corner | middle))]


def above_the_belt(points, cells):
    return points + [0, 0, 0.01], cells


def round_below(points, cells):
    low = points[:, 2] == 0.0
    points[low, 2] += 0.3 * np.hypot(*(points[low, :2] - points[low][0, :2]).T)
    return points, cells


@pytest.mark.parametrize(("spoil", "says"), [
    (not_a_number, "without three finite coordinates"),
    (two_pieces, "falls into 2 pieces that share no facet"),
    (without_volume, "have no volume"),
    (folded, "tetrahedra overlap: the mesh is folded"),
    (a_facet_of_three, "1 facets belong to more than two tetrahedra"),
    (hollow, "1 hollows inside, allowed is solid ice"),
    (touching_along_an_edge, "surface is not closed"),
    (above_the_belt, "its lowest node is at z = 0.01 m, allowed is a base at z = 0"),
    (round_below, "no flat base at z = 0"),
])  # fmt: skip
def test_a_spoilt_sample(tmp_path, cube, spoil, says):
    points, cells = cube
    refused(write(tmp_path / "s.vtu", *spoil(points.copy(), cells)), says)


@pytest.mark.parametrize(("cells", "kind", "says"), [
    ([[0, 1, 3]], "triangle", r"has no volume cells \(triangle\), allowed are tetrahedra"),
    ([[0, 1, 3, 2, 4, 5, 7, 6]], "hexahedron", r"has other volume cells \(hexahedron\)"),
])  # fmt: skip
def test_other_cells(tmp_path, cells, kind, says):
    corners = np.array(np.meshgrid([0, 0.1], [0, 0.1], [0, 0.1])).reshape(3, -1).T
    refused(write(tmp_path / "s.vtu", corners, np.array(cells), kind), says)


@pytest.mark.parametrize("mesh", [box((3, 2, 2), EXTENT), cylinder(4, 3)])
def test_layers_at_the_base_keep_shape_and_mesh(tmp_path, mesh):
    points, cells = mesh
    first = layer_height(points, cells, points[:, 2] == 0.0)
    shape = volume(points, cells)
    for layer in range(1, 4):
        points, cells = cut_at_base(points, cells, points[:, 2] == 0.0)
        assert layer_height(points, cells, points[:, 2] == 0.0) == pytest.approx(first * 0.4**layer)
    assert volume(points, cells) == pytest.approx(shape, rel=1e-12)
    read, kept = read_sample(write(tmp_path / "s.vtu", points, cells))
    assert len(kept) == len(cells), "still a mesh without fault"
    assert mesh_base_area((read, kept)) == pytest.approx(mesh_base_area(mesh))


def mesh_base_area(mesh):
    points, cells = mesh
    whole = mesh_of(points, cells)
    surface = whole.facets.T[whole.boundary_facets()]
    a, b, c = np.moveaxis(points[surface[base_of(points, surface)]], 1, 0)
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()

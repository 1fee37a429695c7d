"""Meshes in memory: of gmsh, of meshio, of arrays, of files."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import plummer

RING = "examples/modal/ring.toml"
PEDESTAL = "examples/modal/pedestal.toml"
ALONE = {"modes": {"count": 8}}


def frequencies(path: str, mesh: Any) -> Any:
    case = plummer.Case.load(path, set=ALONE)
    if mesh is not None:
        case["housing.mesh"] = mesh
    return case.modes().frequencies_hz


@pytest.mark.parametrize(("path", "file"), [(RING, "ring_6_9"), (PEDESTAL, "pedestal")])
def test_a_mesh_that_was_read_is_that_of_the_file(path: str, file: str) -> None:
    mesh = plummer.Mesh.read(f"meshes/{file}.msh")
    np.testing.assert_array_equal(frequencies(path, mesh), frequencies(path, None))
    assert "housing" in mesh.groups and sum(mesh.kinds.values()) > 100


@pytest.mark.parametrize(("path", "file"), [(RING, "ring_6_9"), (PEDESTAL, "pedestal")])
def test_a_mesh_of_meshio_has_its_groups(path: str, file: str) -> None:
    meshio = pytest.importorskip("meshio")
    mesh = plummer.Mesh.from_meshio(meshio.read(f"meshes/{file}.msh"))
    own = plummer.Mesh.read(f"meshes/{file}.msh")
    assert set(mesh.groups) == set(own.groups) and len(mesh.points) == len(own.points)
    # nodes and elements follow each other otherwise, which changes round-off; rigid modes of a free body are round-off
    np.testing.assert_allclose(frequencies(path, mesh), frequencies(path, None), rtol=1e-9, atol=0.1)


def test_physical_groups_of_meshio_in_several_blocks() -> None:
    meshio = pytest.importorskip("meshio")
    points = np.array([[x, y, z] for x in range(4) for y in range(2) for z in range(2)], dtype=float)
    bricks = [("hexahedron", 4 * x + np.array([[0, 4, 6, 2, 1, 5, 7, 3]])) for x in range(3)]
    of_gmsh = {"gmsh:physical": [np.array([1]), np.array([2]), np.array([2])]}
    names = {"light": np.array([1, 3]), "heavy": np.array([2, 3])}
    mesh = plummer.Mesh.from_meshio(meshio.Mesh(points, bricks, cell_data=of_gmsh, field_data=names))
    materials = {name: {"young": 1e9, "poisson": 0.3, "density": density} for name, density in (("light", 1.0), ("heavy", 10.0))}
    parts = [{"group": name, "material": name} for name in materials]
    case = plummer.Case({"materials": materials, "housing": {"mesh": mesh, "length_unit": "m", "parts": parts}, "modes": {"count": 7}})
    assert case.modes().mass_kg == pytest.approx(21.0)


def test_the_open_model_of_gmsh_is_a_mesh_without_a_file() -> None:
    gmsh = pytest.importorskip("gmsh")
    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.open("meshes/pedestal.msh")
        mesh = plummer.Mesh.from_gmsh()
        own = plummer.Mesh.read("meshes/pedestal.msh")
        assert set(mesh.groups) == set(own.groups) and mesh.kinds == own.kinds
        np.testing.assert_array_equal(np.sort(mesh.node_tags), np.sort(own.node_tags))
        np.testing.assert_allclose(frequencies(PEDESTAL, mesh), frequencies(PEDESTAL, None), rtol=1e-9)
        gmsh.clear()
        with pytest.raises(plummer.MeshError):
            plummer.Mesh.from_gmsh()
        # of two boxes the one in a group counts, as in a file
        boxes = [gmsh.model.occ.addBox(2 * place, 0, 0, 1, 1, 1) for place in range(2)]
        gmsh.model.occ.synchronize()
        gmsh.model.mesh.generate(3)
        gmsh.model.addPhysicalGroup(3, boxes[:1], name="one")
        mesh = plummer.Mesh.from_gmsh()
        assert list(mesh.kinds) == ["Tet4"] and mesh.points[:, 0].max() == 1.0
    finally:
        gmsh.finalize()


def test_arrays_are_a_mesh_and_a_case() -> None:
    # a bar of 100 x 10 x 10 mm in 20-node bricks would bend; in 8-node ones its first axial mode is sqrt(E / rho) / 2 L
    x, y, z = np.meshgrid(np.linspace(0, 0.1, 21), [0, 0.01], [0, 0.01], indexing="ij")
    index = np.arange(84).reshape(21, 2, 2)
    a, b = index[:-1], index[1:]
    bricks = np.stack([a[:, 0, 0], b[:, 0, 0], b[:, 1, 0], a[:, 1, 0], a[:, 0, 1], b[:, 0, 1], b[:, 1, 1], a[:, 1, 1]], axis=1)
    points = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    mesh = plummer.Mesh.from_arrays(points, {"hexahedron": bricks}, {"bar": {"hexahedron": np.arange(20)}})
    assert mesh.groups == ["bar"] and mesh.kinds == {"Hex8": 20}
    case = plummer.Case(
        {
            "materials": {"string": {"young": 2e11, "poisson": 0.0, "density": 8000.0}},
            "housing": {"mesh": mesh, "length_unit": "m", "parts": [{"group": "bar", "material": "string"}]},
            "modes": {"count": 30},
        }
    )
    modes = case.modes()
    axial = np.abs(modes.shapes[:, :, 0]).max(axis=1) > 3 * np.abs(modes.shapes[:, :, 1:]).max(axis=(1, 2))
    first = modes.frequencies_hz[axial & (np.arange(30) >= 6)][0]
    assert first == pytest.approx(np.sqrt(2e11 / 8000) / 0.2, rel=2e-3)
    # the mesh stays when another key is set
    case["modes.count"] = 7
    assert case.modes().count == 7


def test_arrays_that_are_no_mesh_are_refused() -> None:
    square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    for cells, groups, words in [
        ({"quad": [[0, 1, 2, 9]]}, None, "node 9"),
        ({"quad": [[0, 1, 2, -1]]}, None, "node -1"),
        ({"pentagon": [[0, 1, 2, 3]]}, None, "'pentagon', expected some of vertex"),
        ({"quad": [0, 1, 2, 3]}, None, r"shape \(4,\)"),
        ({"quad8": [[0, 1, 2, 3]]}, None, r"shape \(1, 4\), expected \[elements, 8\]"),
        ({"quad": [[0, 1.5, 2, 3]]}, None, "expected whole numbers"),
        ({"quad": [[0, 1, 2, 3]]}, {"plate": {"quad": [4]}}, "element 4"),
        ({"quad": [[0, 1, 2, 3]]}, {"plate": {"quad": [-1]}}, "element -1, expected indices from 0"),
        ({"quad": [[0, 1, 2, 3]]}, {"plate": {"quad": [True, False]}}, r"mask of shape \(2,\), expected \(1,\)"),
        ({"quad": [[0, 1, 2, 3]]}, {"plate": {"quads": [0]}}, "'plate' has elements of kind 'quads', expected some of quad"),
    ]:
        with pytest.raises(plummer.MeshError, match=words):
            plummer.Mesh.from_arrays(square, cells, groups)
    with pytest.raises(plummer.MeshError, match=r"shape \(4, 1\), expected \[nodes, 3\]"):
        plummer.Mesh.from_arrays([[0], [1], [2], [3]], {"quad": [[0, 1, 2, 3]]})
    with pytest.raises(plummer.MeshError, match=r"points: node 2 is at \[1.0, nan\], expected finite numbers"):
        plummer.Mesh.from_arrays([*square[:2], [1, np.nan], square[3]], {"quad": [[0, 1, 2, 3]]})
    with pytest.raises(plummer.MeshError, match="order: found 'abaqus'"):
        plummer.Mesh.from_arrays(square, {"quad": [[0, 1, 2, 3]]}, order="abaqus")
    mask = plummer.Mesh.from_arrays(square, {"quad": [[0, 1, 2, 3]]}, {"plate": {"quad": [True]}})
    assert mask.groups == ["plate"]
    with pytest.raises(plummer.MeshError, match="cannot read the mesh nothing.msh"):
        plummer.Mesh.read("nothing.msh")

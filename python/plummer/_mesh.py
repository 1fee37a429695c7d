"""Meshes in memory."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from . import _plummer
from ._errors import InputError, MeshError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

#: gmsh's types of elements by meshio's names.
KINDS = {
    "vertex": 15,
    "line": 1,
    "line3": 8,
    "triangle": 2,
    "triangle6": 9,
    "quad": 3,
    "quad8": 16,
    "quad9": 10,
    "tetra": 4,
    "tetra10": 11,
    "hexahedron": 5,
    "hexahedron20": 17,
    "hexahedron27": 12,
    "wedge": 6,
    "wedge15": 18,
    "wedge18": 13,
    "pyramid": 7,
    "pyramid13": 19,
    "pyramid14": 14,
}
#: A kind of elements: their nodes [elements, nodes of each], indices from 0.
Cells = Mapping[str, "ArrayLike"]
#: Elements of a group by index from 0, for each kind.
Groups = Mapping[str, Mapping[str, "ArrayLike"]]


class Mesh:
    """A mesh with named groups. It stands where a case names a mesh file: ``case["housing.mesh"] = mesh``.

    Coordinates are in the unit that the case says, ``housing.length_unit``.

    >>> import numpy as np, plummer
    >>> points = [[0, 0], [1, 0], [1, 1], [0, 1]]
    >>> mesh = plummer.Mesh.from_arrays(points, {"quad": [[0, 1, 2, 3]]}, {"plate": {"quad": [0]}})
    >>> mesh
    <plummer.Mesh: 4 nodes, 1 Quad4; plate>
    """

    def __init__(self, mesh: _plummer.Mesh) -> None:
        self._mesh = mesh

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Mesh:
        """A mesh file of gmsh, Abaqus or CalculiX.

        Raises:
            MeshError: a file that cannot be read.
        """
        name = os.fspath(path)
        try:
            with open(name, "rb") as file:
                content = file.read()
        except OSError as error:
            raise MeshError(f"cannot read the mesh {name}: {error.strerror}") from error
        return cls(_plummer.Mesh.of_bytes(content, name))

    @classmethod
    def from_arrays(cls, points: ArrayLike, cells: Cells, groups: Groups | None = None, *, order: str = "gmsh") -> Mesh:
        """A mesh of arrays.

        Args:
            points: coordinates [nodes, 3] or [nodes, 2].
            cells: nodes [elements, nodes of each] by kind: ``"tetra10"``, ``"hexahedron"``, ``"triangle6"``, ...
            groups: elements by name and kind.
            order: ``"gmsh"``, or ``"vtk"`` as meshio has it: how the nodes of an element follow each other.

        Raises:
            MeshError: a node or an element that is not there, an unknown kind, coordinates that are no finite numbers. What is wrong
                with elements is told where the mesh is computed with.
        """
        import numpy as np

        if order not in ("gmsh", "vtk"):
            raise MeshError(f'order: found {order!r}, expected "gmsh" or "vtk"')
        for name, of in (groups or {}).items():
            for kind in of:
                if kind not in cells:
                    raise MeshError(f"groups: {name!r} has elements of kind {kind!r}, expected some of {', '.join(cells)}")
        given = []
        for kind, nodes in cells.items():
            if kind not in KINDS:
                raise MeshError(f"cells: found {kind!r}, expected some of {', '.join(KINDS)}")
            table = _whole(f"cells: {kind}", nodes)
            count, of_vtk = _plummer.node_order(KINDS[kind])
            if table.ndim != 2 or table.shape[1] != count:
                raise MeshError(f"cells: {kind} has an array of shape {table.shape}, expected [elements, {count}]")
            if order == "vtk" and kind in ("wedge18", "pyramid14"):
                raise MeshError(f'cells: found {kind}, of which programs differ in the order of nodes, expected it with order="gmsh"')
            if order == "vtk":
                table = table[:, np.argsort(of_vtk)]
            own = [
                (name, _members(f"groups: {name}, {kind}", of[kind], len(table)))
                for name, of in (groups or {}).items()
                if kind in of
            ]
            given.append((KINDS[kind], np.ascontiguousarray(table).reshape(-1), own))
        return cls(_plummer.Mesh.of_cells(_coordinates(points), given))

    @classmethod
    def from_meshio(cls, mesh: Any) -> Mesh:
        """A mesh of meshio, with its cell sets, and with the physical groups of a file of gmsh.

        Physical groups without a name have that of dimension and number,
        ``"physical volume 1"``.

        Raises:
            MeshError: kinds of elements that no model has.
        """
        import numpy as np

        dimensions = ("point", "curve", "surface", "volume")
        names = {(int(tag), int(dimension)): name for name, (tag, dimension) in mesh.field_data.items()}
        of_block = mesh.cell_data.get("gmsh:physical")
        cells: dict[str, list[Any]] = {}
        groups: dict[str, dict[str, list[int]]] = {}
        for block, found in enumerate(mesh.cells):
            if found.type not in KINDS:
                raise MeshError(f"cells: found {found.type}, of which no model is, expected some of {', '.join(KINDS)}")
            before = sum(len(part) for part in cells.setdefault(found.type, []))
            cells[found.type].append(found.data)
            for name, sets in mesh.cell_sets.items():
                members = sets[block] if len(sets) > block else None
                if members is not None and len(members) and not name.startswith("gmsh:"):
                    groups.setdefault(name, {}).setdefault(found.type, []).extend(before + int(member) for member in members)
            for place, tag in enumerate([] if of_block is None else of_block[block]):
                own = names.get((int(tag), found.dim), f"physical {dimensions[found.dim]} {int(tag)}")
                if tag and own not in mesh.cell_sets:
                    groups.setdefault(own, {}).setdefault(found.type, []).append(before + place)
        joined = {kind: np.concatenate(parts) for kind, parts in cells.items()}
        return cls.from_arrays(mesh.points, joined, groups, order="vtk")

    @classmethod
    def from_gmsh(cls) -> Mesh:
        """The mesh of the open model of gmsh, with its physical groups; no file is written.

        As in a file of gmsh, elements outside all groups are left out where there are groups.

        Raises:
            MeshError: no mesh, or kinds of elements that no model has.
        """
        import gmsh
        import numpy as np

        found = [(dim, tag, gmsh.model.getPhysicalName(dim, tag)) for dim, tag in gmsh.model.getPhysicalGroups()]
        groups = [
            (int(dim), int(tag), name, [int(own) for own in gmsh.model.getEntitiesForPhysicalGroup(dim, tag)])
            for dim, tag, name in found
        ]
        grouped = {(dim, own) for dim, _, _, entities in groups for own in entities}
        blocks = []
        for dim, tag in gmsh.model.getEntities():
            if groups and (dim, tag) not in grouped:
                continue
            for kind, elements, nodes in zip(*gmsh.model.mesh.getElements(dim, tag)):
                blocks.append((int(dim), int(tag), int(kind), np.asarray(elements, np.uint64), np.asarray(nodes, np.uint64)))
        tags, points, _ = gmsh.model.mesh.getNodes()
        tags, points = np.asarray(tags, np.uint64), np.asarray(points, float).reshape(-1, 3)
        used = np.isin(tags, np.concatenate([block[4] for block in blocks])) if blocks else np.zeros(len(tags), bool)
        return cls(_plummer.Mesh.of_entities(points[used], tags[used], blocks, groups))

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickled, (self._mesh.content(),)

    @property
    def points(self) -> NDArray[np.float64]:
        """Coordinates of the nodes [nodes, 3], in the unit of the mesh."""
        return self._mesh.points()

    @property
    def node_tags(self) -> NDArray[np.uint64]:
        """Tags of the nodes [nodes]."""
        return self._mesh.node_tags()

    @property
    def groups(self) -> list[str]:
        """Names of the groups."""
        return [name for name, _, _ in self._mesh.groups()]

    @property
    def kinds(self) -> dict[str, int]:
        """Number of elements of each kind."""
        return dict(self._mesh.kinds())

    @property
    def name(self) -> str:
        """What a case calls it: a name by its content."""
        return f"mesh-in-memory-{hashlib.sha256(self._mesh.content()).hexdigest()[:16]}.msh"

    def __repr__(self) -> str:
        kinds = ", ".join(f"{count} {kind}" for kind, count in self.kinds.items())
        return f"<plummer.Mesh: {len(self.points)} nodes, {kinds}; {', '.join(self.groups)}>"


def _coordinates(given: ArrayLike) -> NDArray[np.float64]:
    import numpy as np

    array = np.asarray(given)
    if array.ndim != 2 or array.shape[1] not in (2, 3):
        raise MeshError(f"points: found an array of shape {array.shape}, expected [nodes, 3] or [nodes, 2]")
    if array.dtype.kind not in "iuf" or np.ma.is_masked(given):
        raise MeshError(f"points: found {'masked values' if np.ma.is_masked(given) else array.dtype}, expected real numbers")
    wrong = np.flatnonzero(~np.isfinite(array).all(axis=1))
    if wrong.size:
        raise MeshError(f"points: node {wrong[0]} is at {array[wrong[0]].tolist()}, expected finite numbers")
    return array.astype(float)


def _whole(what: str, given: ArrayLike) -> NDArray[np.int64]:
    import numpy as np

    array = np.asarray(given)
    if array.size and (array.dtype.kind not in "iu" or np.ma.is_masked(given)):
        raise MeshError(f"{what} has numbers of type {array.dtype}, expected whole numbers")
    return array.astype(np.int64)


def _members(what: str, given: ArrayLike, count: int) -> list[int]:
    import numpy as np

    array = np.asarray(given)
    if array.dtype == bool:
        if array.shape != (count,):
            raise MeshError(f"{what} is a mask of shape {array.shape}, expected ({count},)")
        array = np.flatnonzero(array)
    members = _whole(what, array).ravel()
    if members.size and members.min() < 0:
        raise MeshError(f"{what} has element {members.min()}, expected indices from 0")
    return [int(member) for member in members]


def _unpickled(content: bytes) -> Mesh:
    return Mesh(_plummer.Mesh.of_bytes(content, "the mesh"))


def named(value: Any, found: dict[str, _plummer.Mesh]) -> Any:
    """The same value without keys that are ``None``, and with names in the place of meshes, which go into ``found``."""
    if isinstance(value, Mesh):
        found[value.name] = value._mesh
        return value.name
    if isinstance(value, (bytes, bytearray)):
        raise InputError(f"found {value!r}, expected text, a number, True, False, a list or a dict")
    if isinstance(value, Mapping):
        return {key: named(item, found) for key, item in value.items() if item is not None}
    if isinstance(value, Sequence) and not isinstance(value, (str, bytes)):
        return [named(item, found) for item in value]
    return value

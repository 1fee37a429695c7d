"""Modes."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _plummer
from ._errors import InputError
from ._mesh import KINDS
from ._result import Result

if TYPE_CHECKING:
    import numpy as np
    import pandas
    from matplotlib.axes import Axes
    from numpy.typing import NDArray


class Modes(Result):
    """Modes without contact, and what proves them.

    >>> import plummer
    >>> modes = plummer.Case.load("examples/modal/ring.toml").modes()
    >>> modes.count, modes.rigid
    (12, 3)
    >>> bool((modes.error_bounds_hz < 1e-3).all())
    True
    """

    def __init__(self, computed: _plummer.Modes) -> None:
        self._computed: _plummer.Modes = computed

    @cached_property
    def _shapes(self) -> _plummer.Shapes:
        return self._computed.shapes()

    @property
    def frequencies_hz(self) -> NDArray[np.float64]:
        """Eigenfrequencies [modes], Hz, ascending."""
        return self._shapes[0]

    @property
    def shapes(self) -> NDArray[np.float64]:
        """Displacements [modes, points, 3] along the mesh's axes, kg^-1/2: modal masses are 1 kg."""
        return self._shapes[1]

    @property
    def points_m(self) -> NDArray[np.float64]:
        """Nodes of the mesh, then of the rings [points, 3], m."""
        return self._shapes[2]

    @property
    def node_tags(self) -> NDArray[np.uint64] | None:
        """Tags of the nodes in the mesh [points]; ``None`` where rings have nodes too."""
        return self._shapes[3]

    @property
    def count(self) -> int:
        """Number of modes."""
        return len(self.frequencies_hz)

    @property
    def rigid(self) -> int:
        """Number of modes without strain."""
        return int(self.summary["rigid_modes"])

    def _array(self, key: str) -> NDArray[np.float64]:
        import numpy as np

        return np.array(self.summary[key], dtype=float)

    @cached_property
    def error_bounds_hz(self) -> NDArray[np.float64]:
        """Bounds of what the solver leaves of each frequency's error [modes], Hz."""
        return self._array("error_bounds_hz")

    @cached_property
    def residuals(self) -> NDArray[np.float64]:
        """Relative residuals [modes]."""
        return self._array("residuals")

    @cached_property
    def effective_masses(self) -> NDArray[np.float64] | None:
        """Effective masses [modes, directions], kg, of rotations kg m^2; ``None`` of a superelement from a file."""
        return None if self.summary["effective_mass"] is None else self._array("effective_mass")

    @cached_property
    def participation_factors(self) -> NDArray[np.float64] | None:
        """Participation factors [modes, directions], kg^1/2, of rotations kg^1/2 m."""
        return None if self.summary["participation_factors"] is None else self._array("participation_factors")

    @property
    def mass_kg(self) -> float | None:
        """Mass, kg; ``None`` of a superelement from a file."""
        mass: float | None = self.summary["mass_kg"]
        return mass

    @property
    def loaded(self) -> dict[str, Any] | None:
        """Modes linearised at the static equilibrium, as modes.json has them; ``None`` where the case asks for none."""
        loaded: dict[str, Any] | None = self.summary["loaded"]
        return loaded

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each mode: frequency, bound, effective masses."""
        import pandas

        columns: dict[str, Any] = {"frequency_hz": self.frequencies_hz, "error_bound_hz": self.error_bounds_hz}
        masses = self.effective_masses
        if masses is not None:
            names = ["x", "y", "z", "about_x", "about_y", "about_z"] if masses.shape[1] == 6 else ["x", "y", "about_z"]
            columns.update({f"effective_mass_{name}": masses[:, place] for place, name in enumerate(names)})
        index = pandas.RangeIndex(1, self.count + 1, name="mode")
        return pandas.DataFrame(columns, index=index)

    def to_meshio(self) -> Any:
        """The housing's elements with a point field ``"mode 1"``, ... for each mode, as a mesh of meshio.

        meshio writes it for ParaView and others: ``modes.to_meshio().write("modes.vtu")``. Nodes of rings are left out.

        Raises:
            InputError: a case without a housing's mesh.
        """
        import meshio

        cells = self._computed.cells()
        if not cells:
            raise InputError("to_meshio: the case has no mesh of a housing")
        names = {kind: name for name, kind in KINDS.items()}
        count = 1 + max(int(nodes.max()) for _, nodes in cells)
        count = max(count, len(self.points_m) if self.node_tags is not None else count)
        fields = {f"mode {number}": shape[:count] for number, shape in enumerate(self.shapes, 1)}
        # meshio has no Pyramid14 of its own order: VTK's has no node on the base
        blocks = [("pyramid13" if names[kind] == "pyramid14" else names[kind], nodes) for kind, nodes in cells]
        return meshio.Mesh(self.points_m[:count], blocks, point_data=fields)

    def plot(self, mode: int | None = None, *, scale: float = 0.1, ax: Axes | None = None) -> Axes:
        """Frequencies by number; or the shape of a mode, counted from 0, ``scale`` times the structure's size at most."""
        import matplotlib.pyplot as plt
        import numpy as np

        if mode is None:
            ax = ax or plt.figure().add_subplot()
            ax.plot(np.arange(1, self.count + 1), self.frequencies_hz, "o")
            ax.set(xlabel="mode", ylabel="frequency (Hz)", ylim=(0, None))
            return ax
        points, shape = self.points_m, self.shapes[mode]
        size = np.linalg.norm(np.ptp(points, axis=0))
        moved = np.linalg.norm(shape, axis=1)
        where = points + scale * size / moved.max() * shape
        space: Any = ax or plt.figure().add_subplot(projection="3d")
        space.scatter(*(1e3 * where).T, c=moved, s=4)
        space.set(xlabel="x (mm)", ylabel="y (mm)", zlabel="z (mm)", title=f"{self.frequencies_hz[mode]:.1f} Hz")
        space.set_aspect("equal")
        drawn: Axes = space
        return drawn

    def _write(self, folder: Path) -> None:
        self._computed.write(folder)

    def __repr__(self) -> str:
        return f"<plummer.Modes: {self.count} from {self.frequencies_hz[0]:.4g} to {self.frequencies_hz[-1]:.6g} Hz>"

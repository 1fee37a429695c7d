"""Superelements."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from . import _plummer
from ._result import Result

if TYPE_CHECKING:
    import numpy as np
    import pandas
    from matplotlib.axes import Axes
    from numpy.typing import NDArray


class Coordinate(NamedTuple):
    """An interface coordinate of a superelement: what a row of its matrices is."""

    #: "housing", "ring", "centre", "interface" or "modal"
    body: str
    #: tag of the node, or its number
    node: int
    #: "x", "y", "z", "radial", "tangential", "axial", "about_x", ..., or "generalised"
    direction: str
    #: "m", "rad" or "generalised"
    unit: str
    #: position of the node, m; NaN where it has none
    position_m: tuple[float, float, float]
    #: unit vector along or about which it moves; NaN where it has none
    axis: tuple[float, float, float]

    @property
    def name(self) -> str:
        """Body, node and direction in a word."""
        return f"{self.body}:{self.node}:{self.direction}"


class Superelement(Result):
    """A condensed housing: its matrices over interface coordinates, then over amplitudes of vectors of the interior.

    >>> import plummer
    >>> element = plummer.Case.load("examples/housings/ring.toml").condense()
    >>> element.order == len(element.names)
    True
    >>> element.error_estimate < 0.01
    True
    """

    def __init__(self, computed: _plummer.Superelement) -> None:
        self._computed: _plummer.Superelement = computed

    @cached_property
    def stiffness(self) -> NDArray[np.float64]:
        """k [order, order], N/m between displacements."""
        return self._computed.stiffness()

    @cached_property
    def mass(self) -> NDArray[np.float64]:
        """m [order, order], kg between displacements."""
        return self._computed.mass()

    @cached_property
    def damping(self) -> NDArray[np.float64] | None:
        """c [order, order], viscous, N s/m between displacements; ``None``: undamped."""
        return self._computed.damping()

    @cached_property
    def structural_damping(self) -> NDArray[np.float64] | None:
        """Imaginary part of the stiffness [order, order], N/m between displacements; ``None``: none."""
        return self._computed.structural()

    @cached_property
    def weight(self) -> NDArray[np.float64] | None:
        """Forces of unit accelerations along x, y, z [order, 3], kg for displacements."""
        return self._computed.weight()

    @cached_property
    def interface(self) -> list[Coordinate]:
        """What the first rows are."""
        return [Coordinate(*row) for row in self._computed.interface()]

    @cached_property
    def modal_hz(self) -> NDArray[np.float64]:
        """Frequencies of the vectors of the interior [order - interface], Hz."""
        return self._computed.modal_hz()

    @cached_property
    def sensors(self) -> dict[str, NDArray[np.float64]]:
        """Rows [order] by the sensors' names: a row times the coordinates is the sensor's displacement, m."""
        return self._computed.sensors()

    @property
    def order(self) -> int:
        """Number of coordinates."""
        return len(self.stiffness)

    @property
    def names(self) -> list[str]:
        """A name for each row."""
        return [row.name for row in self.interface] + [f"modal:{mode}:generalised" for mode in range(len(self.modal_hz))]

    @property
    def error_estimate(self) -> float:
        """Largest estimated relative error of the frequencies in the band."""
        return float(self.summary["estimate"]["largest"])

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each interface coordinate."""
        import pandas

        return pandas.DataFrame(self.interface, index=pandas.Index([row.name for row in self.interface], name="name"))

    def plot(self, *, ax: Axes | None = None) -> Axes:
        """Estimated errors of the frequencies in the band."""
        import matplotlib.pyplot as plt

        ax = ax or plt.figure().add_subplot()
        ax.semilogy(self.summary["frequencies_hz"], self.summary["estimated_relative_error"], "o")
        ax.set(xlabel="frequency (Hz)", ylabel="estimated relative error")
        return ax

    def _write(self, folder: Path) -> None:
        self._computed.write(folder)

    def __repr__(self) -> str:
        return f"<plummer.Superelement: {len(self.interface)} interface coordinates, {len(self.modal_hz)} vectors>"

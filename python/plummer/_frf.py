"""Transfer paths."""

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


class TransferPath(NamedTuple):
    """From a force to a sensor."""

    force: str
    sensor: str


class Frf(Result):
    """Responses of the sensors to unit forces.

    >>> import plummer
    >>> frf = plummer.Case.load("examples/transfer/pedestal.toml").frf()
    >>> frf.accelerance.dtype
    dtype('complex128')
    """

    def __init__(self, computed: _plummer.Frf) -> None:
        self._computed: _plummer.Frf = computed

    @cached_property
    def frequencies_hz(self) -> NDArray[np.float64]:
        """Frequencies of the responses [frequencies], Hz."""
        return self._computed.frequencies_hz()

    @cached_property
    def paths(self) -> list[TransferPath]:
        """Force and sensor of each path."""
        return [TransferPath(*path) for path in self._computed.paths()]

    @cached_property
    def receptance(self) -> NDArray[np.complex128]:
        """Displacement over force [paths, frequencies], m/N."""
        return self._computed.responses("receptance")

    @cached_property
    def mobility(self) -> NDArray[np.complex128]:
        """Velocity over force [paths, frequencies], m/(N s)."""
        return self._computed.responses("mobility")

    @cached_property
    def accelerance(self) -> NDArray[np.complex128]:
        """Acceleration over force [paths, frequencies], 1/kg."""
        return self._computed.responses("accelerance")

    @cached_property
    def estimated_error(self) -> NDArray[np.float64] | None:
        """Largest estimated relative error of the paths [frequencies]; ``None`` of a housing of which no mesh is known."""
        import numpy as np

        errors = self.summary["estimated_error"]
        return None if errors is None else np.array(errors, dtype=float)

    def to_dataframe(self) -> pandas.DataFrame:
        """Receptances, a column for each path, over the frequency."""
        import pandas

        columns = pandas.MultiIndex.from_tuples(self.paths, names=["force", "sensor"])
        index = pandas.Index(self.frequencies_hz, name="frequency_hz")
        return pandas.DataFrame(self.receptance.T, index=index, columns=columns)

    def plot(self, *, ax: Axes | None = None) -> Axes:
        """Accelerances over the frequency."""
        import matplotlib.pyplot as plt

        ax = ax or plt.figure().add_subplot()
        for path, values in zip(self.paths, abs(self.accelerance)):
            ax.semilogy(self.frequencies_hz, values, label=f"{path.force} to {path.sensor}")
        ax.set(xlabel="frequency (Hz)", ylabel="accelerance (1/kg)")
        ax.legend()
        return ax

    def _write(self, folder: Path) -> None:
        self._computed.write(folder)

    def __repr__(self) -> str:
        return f"<plummer.Frf: {len(self.paths)} paths, {len(self.frequencies_hz)} frequencies>"

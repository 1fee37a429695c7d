"""Runs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _plummer
from ._analysis import WindowVerdict, rows, verdicts
from ._result import Result

if TYPE_CHECKING:
    import numpy as np
    import pandas
    from matplotlib.axes import Axes
    from numpy.typing import NDArray


class Signal:
    """A signal: values over time. ``numpy.asarray(signal)`` gives the values."""

    def __init__(self, name: str, time_s: NDArray[np.float64], values: NDArray[np.float64], unit: str) -> None:
        #: name of the sensor
        self.name = name
        #: instants [instants], s
        self.time_s = time_s
        #: [instants], in ``unit``
        self.values = values
        #: unit of the values
        self.unit = unit

    @property
    def rate_hz(self) -> float:
        """Sampling rate, Hz."""
        return float((len(self.time_s) - 1) / (self.time_s[-1] - self.time_s[0]))

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        import numpy as np

        return np.array(self.values, dtype=dtype) if copy else np.asarray(self.values, dtype=dtype)

    def __len__(self) -> int:
        return len(self.values)

    def plot(self, *, ax: Axes | None = None) -> Axes:
        """Values over time."""
        import matplotlib.pyplot as plt

        ax = ax or plt.figure().add_subplot()
        ax.plot(self.time_s, self.values, label=self.name, linewidth=0.6)
        ax.set(xlabel="time (s)", ylabel=f"{self.name} ({self.unit})")
        return ax

    def __repr__(self) -> str:
        return f"<plummer.Signal {self.name!r}: {len(self)} values in {self.unit}>"


class Signals(Mapping[str, Signal]):
    """What a run recorded: a mapping of the sensors' names to their signals."""

    def __init__(self, record: _plummer.Record) -> None:
        self._record = record

    @cached_property
    def _columns(self) -> dict[str, Any]:
        return self._record.columns()

    @cached_property
    def _signals(self) -> dict[str, Signal]:
        sensors = self._record.sensors().items()
        return {name: Signal(name, self.time_s, values, "m/s^2") for name, values in sensors}

    def __getitem__(self, sensor: str) -> Signal:
        return self._signals[sensor]

    def __iter__(self) -> Iterator[str]:
        return iter(self._signals)

    def __len__(self) -> int:
        return len(self._signals)

    @property
    def time_s(self) -> NDArray[np.float64]:
        """Instants [instants], s."""
        time: NDArray[np.float64] = self._columns["time_s"]
        return time

    @cached_property
    def shaft_m(self) -> NDArray[np.float64]:
        """Displacement of the shaft [instants, 2], m; of a shaft in space [instants, 3]."""
        import numpy as np

        columns = [self._columns[f"shaft_{axis}"] for axis in "xyz"]
        return np.stack([column for column in columns if column is not None], axis=1)

    @cached_property
    def tilt_rad(self) -> NDArray[np.float64] | None:
        """Tilt of a shaft in space about x and y [instants, 2], rad; ``None`` in the plane."""
        import numpy as np

        if self._columns["tilt_x"] is None:
            return None
        return np.stack([self._columns["tilt_x"], self._columns["tilt_y"]], axis=1)

    @property
    def ball_radius_m(self) -> NDArray[np.float64]:
        """Radial positions of the balls [instants, balls], m."""
        radius: NDArray[np.float64] = self._columns["ball_radius"]
        return radius

    @property
    def outer_force_n(self) -> NDArray[np.float64]:
        """Forces at the outer race [instants, balls], N."""
        force: NDArray[np.float64] = self._columns["outer_force"]
        return force

    @property
    def inner_force_n(self) -> NDArray[np.float64]:
        """Forces at the inner race [instants, balls], N."""
        force: NDArray[np.float64] = self._columns["inner_force"]
        return force

    @property
    def contact_angles_rad(self) -> tuple[NDArray[np.float64], NDArray[np.float64]] | None:
        """Contact angles at the outer and the inner race, each [instants, balls], rad; ``None`` in the plane."""
        outer = self._columns["outer_angle"]
        return None if outer is None else (outer, self._columns["inner_angle"])

    def to_dataframe(self) -> pandas.DataFrame:
        """The sensors' signals, m/s^2, over time."""
        import pandas

        columns = {name: signal.values for name, signal in self.items()}
        return pandas.DataFrame(columns, index=pandas.Index(self.time_s, name="time_s"))

    def plot(self, sensor: str | None = None, *, ax: Axes | None = None) -> Axes:
        """Signals of all sensors, or of one, over time."""
        import matplotlib.pyplot as plt

        ax = ax or plt.figure().add_subplot()
        for signal in [self[sensor]] if sensor else self.values():
            signal.plot(ax=ax)
        ax.set_ylabel("acceleration (m/s$^2$)")
        ax.legend()
        return ax

    def __repr__(self) -> str:
        return f"<plummer.{type(self).__name__}: {len(self.time_s)} instants of {', '.join(self)}>"


class Run(Signals, Result):
    """A simulated run: a mapping of the sensors' names to their signals.

    >>> import plummer
    >>> run = plummer.Case.load("examples/scenes/impact.toml").run()
    >>> list(run)
    ['P1']
    >>> run["P1"].values.shape == run.time_s.shape
    True
    >>> run.inner_force_n.shape == (len(run.time_s), 7)  # instants, balls
    True
    """

    def __init__(self, computed: _plummer.Run) -> None:
        super().__init__(computed.record)
        self._computed: _plummer.Run = computed

    @cached_property
    def _shaft(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        speed, angle = self._computed.shaft(self.time_s)
        return speed, angle

    @property
    def shaft_speed_hz(self) -> NDArray[np.float64]:
        """Speed of the shaft as the case prescribes it [instants], Hz."""
        return self._shaft[0]

    @property
    def shaft_angle_rad(self) -> NDArray[np.float64]:
        """Angle of the shaft since t = 0, which goes on over the turns [instants], rad."""
        return self._shaft[1]

    def _write(self, folder: Path) -> None:
        import numpy as np

        arrays: dict[str, Any] = {name: column for name, column in self._columns.items() if column is not None}
        arrays.update({name: signal.values for name, signal in self.items()})
        arrays.update(shaft_speed_hz=self.shaft_speed_hz, shaft_angle_rad=self.shaft_angle_rad)
        np.savez(folder / "signals.npz", **arrays)

    @property
    def verdicts(self) -> list[WindowVerdict]:
        """What each analysed window says of each part of each bearing."""
        return verdicts(self.summary["windows"])

    @property
    def distrust(self) -> str | None:
        """Why the signals cannot be trusted; ``None``: nothing speaks against them."""
        return self._computed.distrust

    @property
    def blew_up(self) -> str | None:
        """Why the signals end early; ``None``: they do not."""
        return self._computed.blew_up

    def verdicts_dataframe(self) -> pandas.DataFrame:
        """A row for each part in each analysed window."""
        import pandas

        return pandas.DataFrame(rows(self.verdicts))

"""Diagnosis of a signal."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple, Union

from . import _plummer
from ._errors import ComputationError, InputError, SignalWarning
from ._progress import Progress, Stages

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes
    from numpy.typing import ArrayLike, NDArray

    from ._case import Case
    from ._run import Signal

#: A constant speed, Hz; or times (s) with the speed then (Hz), straight between.
Speed = Union[float, Sequence[tuple[float, float]]]


class FaultVerdict(NamedTuple):
    """What a window of a signal says of a part."""

    #: "outer race", "inner race", "ball" or "cage"
    part: str
    #: "named": a fault is indicated; "not seen" or "not enough evidence"
    conclusion: str
    #: probability that a sound bearing's signal has such lines; ``None`` where it was not judged
    false_alarm: float | None
    #: strength of the lines, dB over the floor; ``None`` without lines
    strength_db: float | None
    #: order of the lines, per turn of the shaft; ``None`` without lines
    order: float | None
    #: in a sentence
    why: str


class WindowVerdict(NamedTuple):
    """What a window of a signal says."""

    #: sensor or channel
    sensor: str
    #: label of the bearing; empty for the only one
    bearing: str
    #: start, s
    from_s: float
    #: end, s
    to_s: float
    #: speed of the shaft that orders are of, Hz: the given one, sharpened by the signal's lines
    speed_hz: float
    #: mean speed of the shaft as it was given, Hz
    given_speed_hz: float
    #: whose word ``speed_hz`` is: "given", "sharpened", ...; ``None`` without a verdict
    speed_source: str | None
    #: root mean square, in the signal's unit
    rms: float
    #: each part
    faults: list[FaultVerdict]
    #: why nothing was judged; ``None``: it was
    not_judged: str | None
    #: parts whose lines grew since the baseline; ``Analysis.windows`` has by how much
    grown: list[str]

    @property
    def indicated(self) -> list[str]:
        """The parts that are indicated."""
        return [fault.part for fault in self.faults if fault.conclusion == "named"]


def _not_judged(verdict: dict[str, Any]) -> str | None:
    """Why no part was judged; ``None``: one was."""
    faults = verdict.get("faults")
    if not faults:
        reason: str = verdict["reason"]
        return reason
    why: str = faults[0]["why"]
    return why if all(fault["false_alarm"] is None for fault in faults) else None


def verdicts(windows: list[dict[str, Any]]) -> list[WindowVerdict]:
    """What windows of a JSON file say."""
    found = []
    for window in windows:
        verdict = window["verdict"]
        faults = [
            FaultVerdict(
                fault["fault"],
                fault["conclusion"],
                fault["false_alarm"],
                fault["strength_db"],
                fault["order"],
                fault["why"],
            )
            for fault in verdict.get("faults", [])
        ]
        found.append(
            WindowVerdict(
                window["sensor"],
                window.get("bearing") or "",
                window["from"],
                window["to"],
                verdict.get("speed_hz", window["speed_hz"]),
                window["speed_hz"],
                verdict.get("speed_source"),
                window["rms"],
                faults,
                _not_judged(verdict),
                [line["name"] for line in window.get("changes", {}).get("lines", []) if line["conclusion"] == "grew"],
            )
        )
    return found


def rows(verdicts: list[WindowVerdict]) -> list[dict[str, Any]]:
    """A row for each part in each window."""
    return [
        {**{key: value for key, value in window._asdict().items() if key not in ("faults", "not_judged", "grown")}, **fault._asdict()}
        for window in verdicts
        for fault in window.faults
    ]


class Analysis(Sequence[WindowVerdict]):
    """An analysed signal: the verdicts of its windows."""

    def __init__(self, computed: _plummer.Analysis) -> None:
        #: what analysis.json says of each window
        self.windows: list[dict[str, Any]] = computed.windows()
        #: what is wrong with the signal, its speed and its baseline, a sentence each
        self.warnings: list[str] = computed.warnings
        self._spectra = computed.spectra()

    @cached_property
    def verdicts(self) -> list[WindowVerdict]:
        """What each window says of each part."""
        return verdicts(self.windows)

    def __getitem__(self, window: Any) -> Any:
        return self.verdicts[window]

    def __len__(self) -> int:
        return len(self.verdicts)

    @property
    def indicated(self) -> list[str]:
        """The parts that are indicated in a window, each once."""
        return list(dict.fromkeys(part for window in self.verdicts for part in window.indicated))

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each part in each window."""
        import pandas

        return pandas.DataFrame(rows(self.verdicts))

    def plot(self, window: int = 0, *, ax: Axes | None = None) -> Axes:
        """The spectrum of a window's envelope, with the lines of the bearing's parts."""
        import matplotlib.pyplot as plt

        ax = ax or plt.figure().add_subplot()
        frequency_hz, amplitude = self._spectra[window]
        found = self.windows[window]
        lines = [(line["fault"], line["expected_order"] * found["speed_hz"]) for line in found["fault_lines"]]
        top = 1.2 * max([hz for _, hz in lines], default=float(frequency_hz[-1]))
        shown = frequency_hz <= top
        ax.plot(frequency_hz[shown], amplitude[shown], linewidth=0.8)
        colours = {part: f"C{place + 1}" for place, part in enumerate(dict.fromkeys(part for part, _ in lines))}
        for part, hz in lines:
            ax.axvline(hz, color=colours[part], linestyle=":", label=part)
        labels = dict(zip(ax.get_legend_handles_labels()[1], ax.get_legend_handles_labels()[0]))
        ax.legend(labels.values(), labels.keys())
        ax.set(xlabel="frequency (Hz)", ylabel=f"envelope ({found['unit'] or 'unit of the signal'})")
        return ax

    def _repr_html_(self) -> str:
        try:
            table: str = self.to_dataframe().to_html(index=False)
        except ImportError:
            return f"<pre>{self!r}</pre>"
        return table

    def __repr__(self) -> str:
        return f"<plummer.Analysis: {len(self)} windows, indicated: {', '.join(self.indicated) or 'nothing'}>"


def _number(what: str, given: Any) -> float:
    """A number, not its text."""
    if not isinstance(given, (bool, str, bytes)):
        try:
            return float(given)
        except (TypeError, ValueError):
            pass
    raise InputError(f"{what}: found {given!r}, expected a number")


def _pairs(what: str, given: Any, of: str) -> list[tuple[float, float]]:
    """Pairs of numbers; one pair alone counts as such."""
    import numpy as np

    try:
        array = np.asarray([] if given is None else given, dtype=float)
    except (TypeError, ValueError):
        array = np.empty(1)
    if array.shape == (2,):
        array = array[None]
    if isinstance(given, (str, bytes)) or not (array.size == 0 or (array.ndim == 2 and array.shape[1] == 2)):
        raise InputError(f"{what}: found {given!r}, expected {of}")
    return [(float(first), float(second)) for first, second in array.reshape(-1, 2)]


def _speed(what: str, given: Any) -> list[tuple[float, float]]:
    """Times (s) with the speed then (Hz)."""
    import numpy as np

    if np.ndim(given) == 0 and not isinstance(given, (str, bytes)):
        return [(0.0, _number(what, given))]
    of = "a number, Hz, or pairs of time (s) and speed (Hz)"
    if np.ndim(given) == 1:
        raise InputError(f"{what}: found {given!r}, expected {of}")
    return _pairs(what, given, of)


def _samples(what: str, x: ArrayLike | Signal) -> NDArray[Any]:
    """Values [samples] of a signal, as the extension takes them."""
    import numpy as np

    if np.ma.is_masked(x):
        raise InputError(f"{what}: found masked samples, expected every sample", "fill them, or cut the signal there")
    given = np.asarray(x)
    if given.dtype.kind not in "iuf":
        raise InputError(f"{what}: found values of type {given.dtype}, expected real numbers")
    if given.ndim != 1:
        raise InputError(f"{what}: found an array of shape {given.shape}, expected one of one dimension")
    return np.ascontiguousarray(given, dtype=float)


def _bearing(
    bearing: str | int | Case | None,
    geometry: tuple[int | None, float | None, float | None],
    orders: Mapping[str, float] | None,
) -> Any:
    """The bearing as the extension takes it; ``None`` for a case."""
    import operator

    from ._case import Case

    given = [name is not None for name in (bearing, orders)] + [any(value is not None for value in geometry)]
    if sum(given) != 1 or (given[2] and None in geometry):
        raise InputError(
            "bearing: expected one of bearing, orders, or balls with ball_diameter and pitch_diameter",
            'write bearing="6205", or orders={"outer": 3.58, "inner": 5.42}',
        )
    if given[2]:
        try:
            balls = operator.index(geometry[0])  # type: ignore[arg-type]
        except TypeError:
            raise InputError(f"balls: found {geometry[0]!r}, expected a whole number") from None
        return balls, _number("ball_diameter", geometry[1]), _number("pitch_diameter", geometry[2])
    if orders is not None:
        names = ("outer", "inner", "ball", "cage")
        if not isinstance(orders, Mapping) or not orders or not set(orders) <= set(names):
            raise InputError(f"orders: found {orders!r}, expected a dict of some of {', '.join(names)}")
        return tuple(None if orders.get(name) is None else _number(f"orders: {name}", orders[name]) for name in names)
    if isinstance(bearing, Case):
        return None
    if isinstance(bearing, bool) or not isinstance(bearing, (str, int)):
        raise InputError(f"bearing: found {bearing!r}, expected a name of the catalogue or a case")
    return str(bearing)


def analyze(
    x: ArrayLike | Signal,
    *,
    speed_hz: Speed | None = None,
    rate_hz: float | None = None,
    bearing: str | int | Case | None = None,
    balls: int | None = None,
    ball_diameter: float | None = None,
    pitch_diameter: float | None = None,
    orders: Mapping[str, float] | None = None,
    contact_angle_deg: float = 0.0,
    geometry_error: float | None = None,
    windows_s: Sequence[tuple[float, float]] = (),
    high_pass_hz: float | None = None,
    band_hz: tuple[float, float] | str | None = None,
    whiten: bool = False,
    start_s: float | None = None,
    unit: str = "",
    channel: str = "signal",
    baseline: ArrayLike | Signal | None = None,
    baseline_speed_hz: Speed | None = None,
    baseline_rate_hz: float | None = None,
    baseline_window_s: tuple[float, float] | None = None,
    progress: Progress = None,
) -> Analysis:
    """Which part of a bearing a signal indicates, as ``plummer analyze`` says it.

    Args:
        x: samples [samples], evenly in time; or a signal of a run, whose rate and unit it has.
        speed_hz: speed of the shaft, Hz; or times (s) with the speed then. ``None``: that of the case that ``bearing`` is.
        rate_hz: sampling rate, Hz.
        bearing: name in the catalogue, such as ``"6205"``; or a case with bearing and shaft in the plane.
        balls: number of balls, with ``ball_diameter`` and ``pitch_diameter`` in one unit, in the place of ``bearing``.
        orders: events per turn, some of ``outer``, ``inner``, ``ball`` and ``cage``, in the place of ``bearing``.
        contact_angle_deg: contact angle, degrees, of a bearing by its name or its balls.
        geometry_error: how far orders may be off, relative, 0 to 0.1; ``None``: 0.01, or 0 of a run's signal with its case.
        windows_s: windows from, to (s); none: all of the signal.
        high_pass_hz: corner of the high-pass before the envelope, Hz.
        band_hz: band before the envelope, Hz, or ``"kurtogram"``, in the place of ``high_pass_hz``.
        whiten: shows the spectrum of the whitened signal's squared envelope.
        start_s: time of the first sample, s; ``None``: 0, or that of a run's signal.
        unit: unit of the samples.
        channel: name of the signal.
        baseline: earlier signal of the same machine, sensor and gain: ``grown`` of its windows says what grew since.
        baseline_speed_hz: speed of the shaft then, as ``speed_hz``; ``None``: the same.
        baseline_rate_hz: its sampling rate, Hz; ``None``: the same.
        baseline_window_s: window of it that counts, s; ``None``: the window of the signal if it holds that, else all of it.
        progress: ``True`` for a bar; or what is called as tqdm is.

    Raises:
        InputError: no bearing, a window outside the signal, a filter beyond half the sampling rate.
        ComputationError: no part could be judged in any window.

    Warns:
        SignalWarning: samples that are clipped or stand still, a spectrum that ends early, a speed that no line confirms or that was given
            for another time, a baseline that is doubtful.

    >>> import numpy as np, plummer
    >>> time = np.arange(24000) / 12000
    >>> strikes = np.exp(-800 * (time % (1 / 107.36))) * np.sin(2 * np.pi * 3000 * (time % (1 / 107.36)))
    >>> noise = 0.05 * np.random.default_rng(1).standard_normal((2, time.size))
    >>> found = plummer.analyze(strikes + noise[0], rate_hz=12000, bearing="6205", speed_hz=29.95, baseline=noise[1])
    >>> found.indicated, found[0].grown
    (['outer race'], ['outer race'])
    """
    from ._case import Case
    from ._run import Signal

    doubts = []

    def known(signal: ArrayLike | Signal, rate_hz: float | None, start_s: float | None, speed_hz: Speed | None, name: str) -> dict[str, Any]:
        what, own_unit = "" if name == channel else "baseline_", unit
        rate_hz = None if rate_hz is None else _number(f"{what}rate_hz", rate_hz)
        if isinstance(signal, Signal):
            if rate_hz is not None and abs(rate_hz / signal.rate_hz - 1) > 0.01:
                doubts.append(f"{what}rate_hz takes {rate_hz:g} Hz for what the signal says are {signal.rate_hz:g} Hz")
            rate_hz = signal.rate_hz if rate_hz is None else rate_hz
            start_s = float(signal.time_s[0]) if start_s is None else start_s
            own_unit, name = unit or signal.unit, signal.name if name in ("signal", "baseline") else name
        if rate_hz is None:
            raise InputError("rate_hz: found nothing, expected the sampling rate, Hz")
        speed = None if speed_hz is None else _speed(f"{what}speed_hz", speed_hz)
        start_s = 0.0 if start_s is None else _number("start_s", start_s)
        return {"rate_hz": rate_hz, "start_s": start_s, "unit": own_unit, "channel": name, "speed_hz": speed}

    of = _bearing(bearing, (balls, ball_diameter, pitch_diameter), orders)
    case = bearing if isinstance(bearing, Case) else None
    if speed_hz is None and case is None:
        raise InputError("speed_hz: found nothing, expected the speed of the shaft, Hz")
    if band_hz is not None and high_pass_hz is not None:
        raise InputError("band_hz: found a band beside high_pass_hz, expected one of both")
    if geometry_error is None:
        geometry_error = 0.0 if case is not None and isinstance(x, Signal) else 0.01
    kurtogram = isinstance(band_hz, str) and band_hz == "kurtogram"
    expected = 'from below to, Hz, or "kurtogram"'
    bands = [] if band_hz is None or kurtogram else _pairs("band_hz", band_hz, expected)
    if len(bands) > 1 or any(not 0 < low < high for low, high in bands):
        raise InputError(f"band_hz: found {band_hz!r}, expected {expected}")
    asked = {
        "bearing": of,
        "contact_angle_deg": _number("contact_angle_deg", contact_angle_deg),
        "geometry_error": _number("geometry_error", geometry_error),
        "windows_s": _pairs("windows_s", windows_s, "pairs of from and to, s"),
        "high_pass_hz": None if high_pass_hz is None else _number("high_pass_hz", high_pass_hz),
        "band_hz": bands[0] if bands else None,
        "kurtogram": kurtogram,
        "whiten": whiten,
    }
    own = known(x, rate_hz, start_s, speed_hz, channel)
    earlier = None
    if baseline is not None:
        speed = speed_hz if baseline_speed_hz is None else baseline_speed_hz
        rate = own["rate_hz"] if baseline_rate_hz is None and not isinstance(baseline, Signal) else baseline_rate_hz
        window = None if baseline_window_s is None else _pairs("baseline_window_s", baseline_window_s, "from and to, s")
        earlier = (_samples("baseline", baseline), known(baseline, rate, None, speed, "baseline"), window[0] if window else None)
    with Stages(progress) as stages:
        found = Analysis(_plummer.analyze(_samples("signal", x), own, asked, None if case is None else case._case, earlier, stages.told))
    found.warnings[:0] = doubts
    for text in found.warnings:
        warnings.warn(text, SignalWarning, stacklevel=2)
    reasons = [window.not_judged for window in found]
    if all(reasons):
        help = "where the window is too short, take a longer one; where lines coincide, check bearing or orders, and speed_hz"
        raise ComputationError(f"no part could be judged in any window: {'; '.join(map(str, dict.fromkeys(reasons)))}", help)
    return found

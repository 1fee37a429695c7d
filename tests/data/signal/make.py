"""Reference values for the tests of `src/signal`: python3 make.py [SUBJECT ...] writes SUBJECT.json beside this file.

NumPy 2.4.6, SciPy 1.17.1. Inputs are rounded to 1e-4, so that a file holds exactly what was filtered.
"""

import json
import sys
from pathlib import Path

import numpy as np
from scipy import signal

HERE = Path(__file__).parent


def write(name, content):
    text = json.dumps(content, separators=(",", ":"))
    (HERE / f"{name}.json").write_text(text.replace('},{"', '},\n{"') + "\n")


def noisy(samples, seed):
    """Offset, slope, two tones, clicks and noise."""
    k = np.arange(samples)
    x = 1.5 + 2e-3 * k + np.sin(0.46 * k + 0.3) + 0.8 * np.cos(0.057 * k)
    x += 0.5 * np.random.default_rng(seed).standard_normal(samples)
    x[13::97] += 2.0
    return np.round(x, 4)


def butterworth():
    """sosfilt and sosfiltfilt with their defaults, at a rate of 1 Hz."""
    x = noisy(400, 1)
    at = list(range(0, 400, 40)) + [1, 7, 398, 399]
    bands = [("lowpass", [f]) for f in (0.01, 0.1, 0.45)]
    bands += [("highpass", [f]) for f in (0.01, 0.1, 0.45)]
    bands += [("bandpass", list(b)) for b in ((0.02, 0.4), (0.1, 0.15), (0.2, 0.202), (0.02, 0.0202))]
    cases = []
    for kind, edges in bands:
        for order in (1, 2, 3, 4, 5, 8, 11, 12):
            if order > 4 and edges in ([0.01], [0.02, 0.0202]):
                continue
            sos = signal.butter(order, edges if len(edges) > 1 else edges[0], kind, fs=1.0, output="sos")
            cases.append({
                "kind": kind, "edges": edges, "order": order,
                "zero_phase": [float(v) for v in signal.sosfiltfilt(sos, x)[at]],
                "causal": [float(v) for v in signal.sosfilt(sos, x)[at]],
            })
    write("butterworth", {"x": x.tolist(), "at": at, "cases": cases})


def envelope():
    """abs(hilbert(x)) for an even and an odd number of samples."""
    cases = []
    for samples in (240, 241):
        x = noisy(samples, 2)
        cases.append({"x": x.tolist(), "envelope": np.abs(signal.hilbert(x)).tolist()})
    write("envelope", {"cases": cases})


def welch():
    """welch with all windows, even and odd segments, both scalings, at a rate of 1 kHz."""
    x = noisy(300, 3)
    cases = []
    for window in ("boxcar", "hann", "hamming", "blackman", "flattop"):
        for segment, overlap in ((64, 32), (51, 20)):
            for scaling in ("density", "spectrum"):
                f, p = signal.welch(x, 1e3, window, segment, overlap, scaling=scaling)
                cases.append({
                    "window": window, "segment": segment, "overlap": overlap, "scaling": scaling,
                    "frequency": f.tolist(), "power": p.tolist(),
                })
    write("welch", {"x": x.tolist(), "cases": cases})


def compare_cwt(x, w0, rate, frequency, rows):
    """Largest difference of other packages from the rows, by frequency, over the largest amplitude there."""
    import pywt
    from ssqueezepy import cwt as squeezed

    c = w0 / (2 * np.pi)
    wide = np.concatenate([np.zeros(1000), x, np.zeros(1000)])
    tone = np.cos(2 * np.pi * 0.15 * np.arange(4000))
    for f, row in zip(frequency, rows):
        scale = c * rate / f
        other = 2 * np.abs(pywt.cwt(x, [scale], f"cmor2.0-{c}")[0][0]) / np.sqrt(scale)
        of = dict(scales=scale * 2 ** (np.arange(64) / 32), padtype="zero", l1_norm=True)
        w = np.abs(squeezed(wide, ("morlet", {"mu": w0}), **of)[0][0])[1000:-1000]
        of = dict(scales=c / 0.15 * 2 ** (np.arange(64) / 32), padtype="zero", l1_norm=True)
        unit = np.abs(squeezed(tone, ("morlet", {"mu": w0}), **of)[0][0])[2000]
        print(f, "PyWavelets", np.abs(other - row).max() / row.max(), "ssqueezepy", np.abs(w / unit - row).max() / row.max())


def cwt():
    """Amplitudes by convolution in the time domain with the Morlet wavelet of w0 cycles, its mean removed.

    That wavelet is not analytic: at 10 cycles it differs by exp(-50), and the peak of its spectrum is at w0 to exp(-100).

    `python3 make.py cwt compare` prints how far two packages are from these rows: ssqueezepy 0.6.6 (zero padding, L1 norm)
    by 3e-7 of the largest value, PyWavelets 1.8.0 ("cmorB-C", w0 = 2 pi C sqrt(B / 2), amplitude 2 |W| / sqrt(scale)) by
    4 to 12 %: it interpolates a table of the wavelet's integral and cuts the wavelet at +-8, here 5.7 deviations.
    """
    x, w0, rate = noisy(200, 4), 10.0, 1e3
    frequency = [20.0, 60.0, 150.0, 250.0]
    t = np.arange(-199, 200) / rate
    rows = []
    for f in frequency:
        s = w0 / (2 * np.pi * f)
        wavelet = np.exp(-0.5 * (t / s) ** 2) * (np.exp(1j * w0 * t / s) - np.exp(-0.5 * w0 ** 2))
        wavelet *= 2 / (rate * s * np.sqrt(2 * np.pi))
        rows.append(np.abs(np.convolve(x - x.mean(), wavelet)[199:399]))
    if "compare" in sys.argv:
        compare_cwt(x - x.mean(), w0, rate, frequency, rows)
    write("cwt", {"x": x.tolist(), "cycles": w0, "frequency": frequency, "rows": [r[::5].tolist() for r in rows]})


def kurtogram():
    """The tree of Antoni (2007), with the filters of his program and an analytic root without 64 samples at each end."""
    x = noisy(1500, 5)

    def band(signal_, taps, ratio, place):
        y = signal.lfilter(taps, 1.0, signal_)[len(taps) - 1::ratio]
        return y * (-1.0) ** np.arange(len(y)) if place % 2 else y

    def taps(order, cut_off, middle):
        return signal.firwin(order + 1, cut_off) * np.exp(1j * np.pi * middle * np.arange(order + 1))

    def kurtosis(c):
        return float(np.mean(np.abs(c) ** 4) / np.mean(np.abs(c) ** 2) ** 2 - 2)

    halves = [taps(16, 0.4, m) for m in (1 / 4, 3 / 4)]
    thirds = [taps(24, 0.4 * 2 / 3, m) for m in (1 / 6, 3 / 6, 5 / 6)]
    level = [signal.hilbert(x - x.mean())[64:-64]]
    rows = [[kurtosis(c) for c in level]]
    for depth in range(1, 4):
        in_three = [band(c, thirds[i], 3, i) for c in level for i in range(3)]
        if depth > 1:
            rows.append([kurtosis(c) for c in in_three])
        level = [band(c, halves[i], 2, i) for c in level for i in range(2)]
        rows.append([kurtosis(c) for c in level])
    write("kurtogram", {"x": x.tolist(), "rows": sorted(rows, key=len)})


SUBJECTS = [butterworth, envelope, welch, cwt, kurtogram]

if __name__ == "__main__":
    for subject in SUBJECTS:
        if len(sys.argv) == 1 or subject.__name__ in sys.argv[1:]:
            subject()

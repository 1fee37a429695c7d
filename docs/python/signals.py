"""Order spectrum of a run's envelope: signals.npz with NumPy and SciPy alone.

    python3 signals.py out/outer-dent/signals.npz
"""

import sys

import numpy as np
from scipy.signal import butter, hilbert, sosfiltfilt

signals = np.load(sys.argv[1])
time, p1 = signals["time_s"], signals["P1"]  # s, m/s^2
rate = 1 / (time[1] - time[0])
envelope = np.abs(hilbert(sosfiltfilt(butter(4, 5000, "highpass", fs=rate, output="sos"), p1)))

# the shaft's turns of this run-up: 10 Hz a second from 0.2 s on
turns = 5 * np.clip(time - 0.2, 0, None) ** 2
window = (time >= 1.0) & (time <= 2.6)
a_turn = 64
even = np.arange(turns[window][0], turns[window][-1], 1 / a_turn)
# averages over equal angles, so that nothing above them is folded down
sums = np.interp(even, turns, np.cumsum(envelope))
counts = np.interp(even, turns, np.arange(len(time)))
over_angle = np.diff(sums) / np.diff(counts)

spectrum = np.abs(np.fft.rfft((over_angle - over_angle.mean()) * np.hanning(len(over_angle)))) * 4 / len(over_angle)
orders = np.fft.rfftfreq(len(over_angle), 1 / a_turn)
for harmonic in (1, 2, 3):
    expected = harmonic * 2.56797
    near = np.abs(orders - expected) < 0.1
    best = np.argmax(np.where(near, spectrum, 0))
    floor = np.median(spectrum[np.abs(orders - expected) < 1])
    print(f"{harmonic} x outer race: order {orders[best]:.2f}, {spectrum[best] / floor:.0f} times the median about it")

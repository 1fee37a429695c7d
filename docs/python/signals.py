"""Order spectrum of the envelope of a run's signal, and what stands out of it at the orders of the bearing's parts.

    python3 signals.py out/outer-dent P1 1.0 2.6
"""

import json
import sys

import numpy as np
from scipy.signal import butter, hilbert, sosfiltfilt

folder, sensor, begin, end = sys.argv[1:]
run = np.load(f"{folder}/signals.npz")
time, turns = run["time_s"], run["shaft_angle_rad"] / (2 * np.pi)
high_pass = butter(4, 5000, "highpass", fs=1 / (time[1] - time[0]), output="sos")
envelope = np.abs(hilbert(sosfiltfilt(high_pass, run[sensor])))

# means over equal angles, so that no frequency above them is folded down
a_turn = 64
window = (time >= float(begin)) & (time <= float(end))
angles = np.arange(turns[window][0], turns[window][-1], 1 / a_turn)
sums, counts = np.interp(angles, turns, np.cumsum(envelope)), np.interp(angles, turns, np.arange(len(time)))
means = np.diff(sums) / np.diff(counts)

spectrum = np.abs(np.fft.rfft((means - means.mean()) * np.hanning(len(means))))
orders = np.fft.rfftfreq(len(means), 1 / a_turn)
with open(f"{folder}/run.json") as file:
    parts = json.load(file)["defect_orders"]
for part in ("outer", "inner", "ball"):
    heights = []
    for line in parts[part] * np.arange(1, 4):
        about = np.abs(orders - line)
        heights.append(spectrum[about < 0.05].max() / np.median(spectrum[about < 1]))
    heights = ", ".join(f"{height:.1f}" for height in heights)
    print(f"{part}: order {parts[part]:.3f}, its harmonics {heights} times the median about them")

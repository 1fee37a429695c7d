# %% [markdown]
# # Learning curves of simulated faults
#
# A data set is swept over bearings, damage and noise. A plain classifier learns from more and more of the bearings; its
# errors on bearings that it never saw say how many are enough. Needs SciPy, scikit-learn, matplotlib.

# %%
import os
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from numpy.typing import NDArray
from scipy.signal import butter, hilbert, sosfiltfilt
from sklearn.linear_model import LogisticRegression
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler

import plummer

# the folder of the repository, from whichever folder of it the cells run
os.chdir(next(folder for folder in (Path.cwd(), *Path.cwd().parents) if (folder / "examples").is_dir()))
OUT = Path("out/notebooks")

# %% [markdown]
# ## The signals
# The specification of `examples/datasets`, with its cheapest machine and half a second a signal.

# %%
data = plummer.dataset(
    "examples/datasets/two_machines.toml",
    OUT / "signals",
    count=96,
    force=True,
    set={
        "machines": [{"case": "../tadina2011/outer-dent.toml"}],
        "signals_per_specimen": 2,
        "recorder.duration_s": 0.5,
        "split": {"train": 0.7, "test": 0.3},
    },
)
data

# %% [markdown]
# ## Features
# How high the lines of each part stand over the floor of the envelope's spectrum. The line and its second and third
# harmonic count, each the largest within 3 %.


# %%
def features(signal: NDArray[np.float32], lines_hz: list[float]) -> list[float]:
    """Decibels over the median of the lines of outer race, inner race and ball in the envelope from 1 to 4.5 kHz."""
    band = sosfiltfilt(butter(4, [1000, 4500], "bandpass", fs=data.rate_hz, output="sos"), signal)
    envelope = np.abs(hilbert(band)) ** 2
    spectrum = np.abs(np.fft.rfft((envelope - envelope.mean()) * np.hanning(len(envelope))))
    hz = np.fft.rfftfreq(len(envelope), 1 / data.rate_hz)
    found = []
    for line in lines_hz:
        for harmonic in (1, 2, 3):
            near = np.abs(hz / (harmonic * line) - 1) < 0.03
            around = np.abs(hz / (harmonic * line) - 1) < 0.3
            found.append(20 * np.log10(spectrum[near].max() / np.median(spectrum[around])))
    return found


lines = np.column_stack([data["bpfo_hz"], data["bpfi_hz"], 2 * data["bsf_hz"]])
x = np.array([features(signal, list(own)) for signal, own in zip(data.signals, lines)])
y, specimen = data.labels, data["specimen"]
train, test = ((data.splits == part) & data["trusted"].astype(bool) for part in ("train", "test"))
assert not set(specimen[train]) & set(specimen[test])

# %% [markdown]
# ## The curve
# Bearings are drawn at random ten times for each point.

# %%
rng = np.random.default_rng(1)
bearings = np.unique(specimen[train])
sizes = [8, 16, len(bearings)]
scores = []
for size in sizes:
    own = []
    for _ in range(10):
        chosen = np.isin(specimen, rng.choice(bearings, size, replace=False))
        if len(np.unique(y[chosen])) < 2:
            continue
        model = make_pipeline(StandardScaler(), LogisticRegression(C=0.1, class_weight="balanced", max_iter=1000))
        own.append(model.fit(x[chosen], y[chosen]).score(x[test], y[test]))
    scores.append((np.mean(own), np.std(own)))
    print(f"{size:3} bearings: {scores[-1][0]:.2f} +- {scores[-1][1]:.2f} of {test.sum()} signals right")
assert scores[-1][0] > 0.5  # four classes: chance is a quarter

# %%
figure, ax = plt.subplots()
ax.errorbar(sizes, [mean for mean, _ in scores], [deviation for _, deviation in scores], fmt="o-")
ax.set(xlabel="bearings to learn from", ylabel="right on other bearings", ylim=(0, 1))
figure.savefig(OUT / "learning_curve.png")

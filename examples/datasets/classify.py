"""Does a classifier that is trained on simulated signals alone name the damaged part of measured bearings?

    python3 classify.py DATASET MEASURED [--hold-out EXPRESSION] [--plummer PROGRAM]

DATASET is a folder that `plummer dataset` wrote: `signals-*.npz` with `signals` [n x samples], `rate_hz`, `label_names` and
`split_names`, and a value a signal of `label`, `split`, `trusted`, `speed_hz`, `bpfo_hz`, `bpfi_hz`, `bsf_hz`, `ftf_hz`. MEASURED
is a folder with `records.csv`: a row a record with `id`, `file` (npz with `signal` and `rate_hz`), `set`, `speed_hz`, the orders
`outer`, `inner`, `ball` (twice BSF) and `cage`, `truth`, `size_mil` and `grade`. Records whose `id` matches the regular expression
are reported apart.

The same features and the same classifiers are trained on the simulated signals, and on the measured records of all other specimens. A
specimen is a damaged part: neither its windows nor the other channel of its recordings are on both sides. With a program the verdicts
of `plummer analyze` stand beside them. Needs numpy, scipy and scikit-learn; no measured signal belongs to the repository.
"""

import argparse
import csv
import json
import pathlib
import re
import subprocess
import tempfile
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from scipy.ndimage import median_filter
from scipy.signal import resample_poly
from sklearn.base import ClassifierMixin
from sklearn.ensemble import RandomForestClassifier
from sklearn.linear_model import LogisticRegression
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler

RATE = 12_000  # Hz; every signal is brought to this rate and cut into windows of one second
BANDS = ((500, 5700), (500, 2200), (2200, 3900), (3900, 5700))  # Hz, of the envelopes
PARTS = ("outer", "inner", "ball", "cage")
CLASSES = ("ball", "inner", "none", "outer")
SLIP = np.linspace(-0.012, 0.012, 25)  # how far a part's line may lie from its order, relative
HARMONICS = np.arange(1, 6)
HIGHEST_DB = 26.0
PAD = 4  # zeros behind a window, for levels between the bins


@dataclass
class Window:
    """A second of a signal: its features, the damaged part, and where it comes from."""

    features: np.ndarray
    label: str
    record: str
    specimen: str
    group: str


def at_rate(signal: np.ndarray, rate_hz: float) -> np.ndarray:
    """The signal at RATE, low-pass filtered before samples are dropped."""
    ratio = Fraction(RATE / rate_hz).limit_denominator(4096)
    signal = np.asarray(signal, dtype=float).ravel()
    return signal if ratio == 1 else resample_poly(signal, ratio.numerator, ratio.denominator)


def envelope_levels(window: np.ndarray) -> np.ndarray:
    """Level (dB over the floor) of the whitened signal's envelope spectrum in each band, RATE / (PAD n) apart."""
    n = len(window)
    spectrum = np.fft.rfft(window - window.mean())
    spectrum /= median_filter(np.abs(spectrum), size=50 * n // RATE | 1, mode="nearest") + 1e-30
    spectrum /= np.maximum(np.abs(spectrum) / 3, 1)  # tones and resonances count little more than the bands between them
    frequency = np.fft.rfftfreq(n, 1 / RATE)
    levels = []
    for low, high in BANDS:
        analytic = np.zeros(n, dtype=complex)
        analytic[: len(spectrum)] = 2 * spectrum * ((frequency >= low) & (frequency < high))
        envelope = np.abs(np.fft.ifft(analytic))
        lines = np.abs(np.fft.rfft((envelope - envelope.mean()) * np.hanning(n), PAD * n))[: PAD * n // 10]
        floor = np.repeat(median_filter(lines[::PAD], size=61 * n // RATE | 1, mode="nearest"), PAD)[: len(lines)]
        levels.append(20 * np.log10(lines / floor + 1e-6))
    return np.array(levels)


def features(window: np.ndarray, speed_hz: float, orders: dict[str, float]) -> np.ndarray:
    """Levels of each part's lines: mean of five harmonics in the best band, the same on the mean of all bands, and the first three.

    Sidebands, the shaft's own lines and kurtosis are left out: simulated ones differ from measured ones, and the classifiers get worse.
    """
    levels = envelope_levels(window)
    step = RATE / (PAD * len(window)) / speed_hz  # orders a bin

    def level(order: np.ndarray) -> np.ndarray:
        bins = np.clip(np.rint(order / step).astype(int), 2, levels.shape[1] - 3)
        return np.clip(np.max([levels[:, bins + shift] for shift in range(-2, 3)], axis=0), 0, HIGHEST_DB)

    found: list[float] = []
    for part in PARTS:
        combs = orders[part] * (1 + SLIP)[:, None] * HARMONICS
        heights = level(combs)  # bands x slips x harmonics
        means = heights.mean(axis=-1)
        band, slip = np.unravel_index(np.argmax(means), means.shape)
        found += [means[band, slip], means.max(axis=1).mean(), *heights[band, slip, :3]]
    return np.array(found)


def windows(signal: np.ndarray, rate_hz: float) -> Iterator[np.ndarray]:
    """Whole seconds of a signal at RATE."""
    signal = at_rate(signal, rate_hz)
    for start in range(0, len(signal) - RATE + 1, RATE):
        yield signal[start : start + RATE]


def simulated(folder: pathlib.Path) -> tuple[list[Window], list[Window]]:
    """Training and test windows of a data set."""
    both: dict[bool, list[Window]] = {True: [], False: []}
    for shard in sorted(folder.glob("signals-*.npz")):
        with np.load(shard) as file:
            data = {name: file[name] for name in file.files}
        for row, signal in enumerate(data["signals"]):
            speed = float(data["speed_hz"][row])
            lines = {"outer": data["bpfo_hz"], "inner": data["bpfi_hz"], "ball": 2 * data["bsf_hz"], "cage": data["ftf_hz"]}
            orders = {part: float(line[row]) / speed for part, line in lines.items()}
            label, name = str(data["label_names"][data["label"][row]]), f"{shard.stem}:{row}"
            if label not in CLASSES or not data["trusted"][row]:
                continue  # several parts at once, or an estimated error as large as the signal
            for window in windows(signal, float(data["rate_hz"][0])):
                train = str(data["split_names"][data["split"][row]]) == "train"
                both[train].append(Window(features(window, speed, orders), label, name, str(data["specimen"][row]), "simulated"))
    return both[True], both[False]


def measured(folder: pathlib.Path, held: str | None) -> list[Window]:
    """Windows of the records, with the specimen that is damaged in their recording."""
    with open(folder / "records.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    damage = {recording(row): f"{row['set'].removesuffix(' 48 kHz')} {row['truth']} {row['size_mil']}" for row in rows if row["truth"] != "none"}
    found = []
    for row in rows:
        with np.load(folder / row["file"]) as file:
            signal, rate = file["signal"], float(np.ravel(file["rate_hz"])[0])
        if held and re.search(held, row["id"]):
            group = "held out, sound" if row["truth"] == "none" else "held out, damaged"
        elif row["truth"] == "none":
            group = "sound"
        else:
            group = "clear" if row["grade"] in ("Y1", "Y2") else "others"
        for window in windows(signal, rate):
            values = features(window, float(row["speed_hz"]), {part: float(row[part]) for part in PARTS})
            found.append(Window(values, row["truth"].split()[0], row["id"], damage.get(recording(row), row["id"]), group))
    return found


def recording(row: dict[str, str]) -> str:
    """A record's name without the end of the machine that it was taken at."""
    return re.sub("_(DE|FE)$", "", row["id"])


def classifiers() -> dict[str, ClassifierMixin]:
    """Chosen before any result was seen."""
    logistic = LogisticRegression(C=0.1, class_weight="balanced", max_iter=2000)
    forest = RandomForestClassifier(300, min_samples_leaf=5, class_weight="balanced_subsample", random_state=0)
    return {"logistic": make_pipeline(StandardScaler(), logistic), "forest": forest}


def probabilities(name: str, train: list[Window], test: list[Window]) -> np.ndarray:
    """Logarithm of each class's probability for each window of `test`."""
    model = classifiers()[name].fit([window.features for window in train], [window.label for window in train])
    table = np.full((len(test), len(CLASSES)), 1e-3)
    table[:, [CLASSES.index(label) for label in model.classes_]] = model.predict_proba([window.features for window in test])
    return np.log(np.maximum(table, 1e-3))


def by_record(test: list[Window], logs: np.ndarray) -> dict[str, str]:
    """A record's class is that of the largest mean over its windows."""
    sums: dict[str, np.ndarray] = defaultdict(lambda: np.zeros(len(CLASSES)))
    for window, log in zip(test, logs):
        sums[window.record] += log
    return {record: CLASSES[int(np.argmax(total))] for record, total in sums.items()}


def of_other_specimens(name: str, test: list[Window]) -> dict[str, str]:
    """Each specimen is judged by what the others taught."""
    verdicts: dict[str, str] = {}
    for specimen in sorted({window.specimen for window in test}):
        own = [window for window in test if window.specimen == specimen]
        verdicts |= by_record(own, probabilities(name, [window for window in test if window.specimen != specimen], own))
    return verdicts


def of_plummer(program: str, folder: pathlib.Path) -> dict[str, str]:
    """The part that `plummer analyze` names alone; "several" if it names more."""
    verdicts = {}
    with open(folder / "records.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        with tempfile.TemporaryDirectory() as scratch:
            orders = ",".join(f"{part}={row[part]}" for part in PARTS)
            command = [program, "analyze", str(folder / row["file"]), "--channel", "signal", "--orders", orders]
            subprocess.run([*command, "--speed", row["speed_hz"], "--out", f"{scratch}/o", "--quiet"], check=True, capture_output=True)
            faults = json.loads(pathlib.Path(scratch, "o", "analysis.json").read_text())["windows"][0]["verdict"]["faults"]
        named = [fault["fault"].split()[0] for fault in faults if fault["conclusion"] == "named"]
        verdicts[row["id"]] = named[0] if len(named) == 1 else "several" if named else "none"
    return verdicts


def balanced(truths: list[str], named: list[str]) -> float:
    """Mean over the classes of the share that is right."""
    pairs = list(zip(truths, named))
    return float(np.mean([np.mean([right == name for right, name in pairs if right == label]) for label in sorted(set(truths))]))


def table(title: str, verdicts: dict[str, str], test: list[Window]) -> None:
    """Accuracy by group of records, with 95 % intervals by drawing specimens with replacement, and who was taken for whom."""
    groups: dict[str, dict[str, Window]] = defaultdict(dict)
    for window in test:
        groups[window.group][window.record] = window
        if window.group in ("clear", "sound"):
            groups["clear and sound"][window.record] = window
    for group, records in sorted(groups.items()):
        specimens: dict[str, list[tuple[str, str]]] = defaultdict(list)
        for record, window in records.items():
            specimens[window.specimen].append((window.label, verdicts[record]))
        draws, random = [], np.random.default_rng(1)
        for _ in range(1000):
            drawn = [pair for one in random.choice(list(specimens), len(specimens)) for pair in specimens[one]]
            draws.append((np.mean([a == b for a, b in drawn]), balanced(*map(list, zip(*drawn)))))
        (low, low_balanced), (high, high_balanced) = np.percentile(draws, [2.5, 97.5], axis=0)
        pairs = [pair for own in specimens.values() for pair in own]
        right = sum(a == b for a, b in pairs)
        print(
            f"{title:34s} {group:18s} {right:3d} of {len(pairs):3d} ({len(specimens):2d} specimens)  {right / len(pairs):5.1%} [{low:4.0%}, {high:4.0%}]"
            f"  balanced {balanced(*map(list, zip(*pairs))):5.1%} [{low_balanced:4.0%}, {high_balanced:4.0%}]"
        )
        for label in CLASSES:
            named = [b for a, b in pairs if a == label]
            if named:
                print(f"    {label:6s}" + "".join(f"{name:>8s} {named.count(name):3d}" for name in (*CLASSES, "several")))


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("dataset", type=pathlib.Path)
    arguments.add_argument("measured", type=pathlib.Path)
    arguments.add_argument("--hold-out", metavar="EXPRESSION", help="records to report apart, by a regular expression on their id")
    arguments.add_argument("--plummer", metavar="PROGRAM", help="judge by `plummer analyze` too")
    given = arguments.parse_args()
    train, own_test = simulated(given.dataset)
    test = measured(given.measured, given.hold_out)
    for name in classifiers():
        if own_test:
            table(f"simulated to simulated, {name}", by_record(own_test, probabilities(name, train, own_test)), own_test)
        table(f"simulated to measured, {name}", by_record(test, probabilities(name, train, test)), test)
        table(f"other specimens, {name}", of_other_specimens(name, test), test)
    if given.plummer:
        table("plummer analyze", of_plummer(given.plummer, given.measured), test)


if __name__ == "__main__":
    main()

"""Measured records of bearings judged by the usual means of SciPy and by plummer, in one table.

    pip install numpy scipy
    cargo build --release
    python3 benches/verdicts.py FOLDER [--plummer PROGRAM] [--combs 500] [--each]

FOLDER holds records.csv and its files: a row a record, with `id`, `file` (.npz with `signal` and `rate_hz`), `set`,
`grade`, `speed_hz`, the orders `outer`, `inner`, `ball` and `cage`, and `truth` ("outer race", "inner race", "ball" or
"none"). Without a program at the path of `--plummer` only the baseline judges.

The baseline is the state of practice. The squared envelope of the signal, as it is and prewhitened in the cepstrum
(P. Borghesani et al., Mech. Syst. Signal Process. 36, 2013), has an amplitude spectrum; every line counts in decibels
above the median around it. A part's score is the mean of its lines 1 to 5, the comb moved as one by at most 1 % to
where that is highest. Lines at multiples of the shaft count for nothing above their surroundings, its speed taken from
the spectrum too. The best of the three parts is named where it is above all of several hundred combs of the same kind
at random orders, which keep away from half multiples of the three orders and of the shaft. No truth goes into that
threshold. "Best of three" is without it.

Cells: right alone / wrong, that is a wrong part named, alone or beside the right one / nothing named. Sound records:
named falsely / nothing named.
"""

import argparse
import collections
import csv
import json
import os
import pathlib
import platform
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np
import scipy
from scipy import fft, ndimage, signal

PROGRAM = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", "target"), "release/plummer")

PARTS = ("outer", "inner", "ball")
NAMES = ("outer race", "inner race", "ball")
LINES = np.arange(1, 6)
SHAFT_LINES = np.arange(1, 11)
# The comb may move by so much: slip, load and the stated speed.
TOLERANCE = 0.01
# Random orders lie between these multiples of the least and the greatest order.
DRAWN = (0.7, 1.5)
# Bins on either side of a line that a Hann window fills.
LEAK = 2
PLAIN, WHITE, OWN = "envelope", "prewhitened envelope", "plummer"


def prewhitened(x):
    """All lines of the spectrum made equal, phases kept."""
    lines = fft.rfft(x - x.mean())
    return fft.irfft(lines / np.maximum(np.abs(lines), np.finfo(float).tiny), len(x))


def envelope_spectrum(x, rate, shaft, highest):
    """Squared envelope's amplitudes in dB above the median over one shaft frequency, and the bins' width in Hz."""
    envelope = np.abs(signal.hilbert(x - x.mean())) ** 2
    lines = np.abs(fft.rfft((envelope - envelope.mean()) * signal.windows.hann(len(x))))
    width = rate / len(x)
    lines = lines[: int(highest / width) + 1]
    around = ndimage.median_filter(lines, int(shaft / width) | 1, mode="nearest")
    return 20 * np.log10(np.maximum(lines, np.finfo(float).tiny) / around), width


def combs(decibels, width, firsts, lines):
    """Mean of the lines of combs with these first frequencies, each moved to where it is highest, and that factor."""
    firsts = np.atleast_1d(firsts)
    factors = 1 + np.arange(-TOLERANCE, TOLERANCE, width / (lines[-1] * firsts.max()))
    bins = np.rint(firsts[:, None, None] * factors[:, None] * lines / width).astype(int)
    means = decibels[bins].mean(axis=-1)
    return means.max(axis=1), factors[means.argmax(axis=1)]


def without_shaft(decibels, width, shaft):
    """Lines at multiples of the shaft's speed cut down to their surroundings."""
    _, [factor] = combs(decibels, width, shaft, SHAFT_LINES)
    turns = np.arange(len(decibels)) * width / (shaft * factor)
    near = np.abs(turns - np.rint(turns)) * shaft <= LEAK * width
    return np.where(near, np.minimum(decibels, 0), decibels)


def random_orders(orders, count):
    """Orders no damage of this bearing has: away from half multiples of its own orders and of the shaft."""
    rng, drawn = np.random.default_rng(1), []
    while len(drawn) < count:
        order = rng.uniform(DRAWN[0] * min(orders), DRAWN[1] * max(orders))
        if all(abs(order - np.rint(2 * order / own) * own / 2) > 2 * TOLERANCE * order for own in (*orders, 1.0)):
            drawn.append(order)
    return np.array(drawn)


def baseline(x, rate, shaft, orders, count):
    """Scores of the three parts, and the threshold."""
    highest = 1.1 * shaft * max(LINES[-1] * DRAWN[1] * max(orders), SHAFT_LINES[-1])
    decibels, width = envelope_spectrum(x, rate, shaft, highest)
    decibels = without_shaft(decibels, width, shaft)
    scores, _ = combs(decibels, width, shaft * np.array(orders), LINES)
    others, _ = combs(decibels, width, shaft * random_orders(orders, count), LINES)
    return scores, others.max()


def asked_plummer(program, folder, record):
    """What plummer names, and None where it gives no verdict."""
    with tempfile.TemporaryDirectory() as scratch:
        orders = ",".join(f"{key}={record[key]}" for key in (*PARTS, "cage"))
        command = [str(program), "analyze", str(folder / record["file"]), "--channel", "signal", "--orders", orders]
        command += ["--speed", record["speed_hz"], "--out", f"{scratch}/o", "--quiet"]
        answer = subprocess.run(command, capture_output=True, text=True)
        try:
            analysis = json.loads(pathlib.Path(scratch, "o", "analysis.json").read_text())
            faults = analysis["windows"][0]["verdict"]["faults"]
        except (OSError, KeyError, IndexError):
            print(f"plummer gives no verdict on {record['id']}: {answer.stderr.strip()[-200:]}", file=sys.stderr)
            return None
    return [fault["fault"] for fault in faults if fault["conclusion"] == "named"]


def judged(record, folder, program, count):
    """What every judge names, the baseline's best of three, what they saw, and seconds."""
    orders, shaft = [float(record[part]) for part in PARTS], float(record["speed_hz"])
    named, best, seen, seconds = {}, {}, {}, {}
    for judge in (PLAIN, WHITE):
        clock = time.perf_counter()
        with np.load(folder / record["file"]) as held:
            x, rate = held["signal"].astype(float), float(np.ravel(held["rate_hz"])[0])
        scores, threshold = baseline(prewhitened(x) if judge == WHITE else x, rate, shaft, orders, count)
        best[judge] = NAMES[scores.argmax()]
        named[judge] = [best[judge]] if scores.max() > threshold else []
        seconds[judge] = time.perf_counter() - clock
        seen[judge] = f"{' '.join(f'{s:5.1f}' for s in scores)} of {threshold:4.1f} dB"
    if program:
        clock = time.perf_counter()
        named[OWN] = asked_plummer(program, folder, record)
        seconds[OWN] = time.perf_counter() - clock
    return named, best, seen, seconds


def outcome(named, truth):
    if not named:
        return "nothing"
    return "right" if named == [truth] else "wrong"


def main():
    as_written = argparse.RawDescriptionHelpFormatter
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=as_written)
    arguments.add_argument("folder", type=pathlib.Path)
    arguments.add_argument("--plummer", type=pathlib.Path, default=PROGRAM)
    arguments.add_argument("--combs", type=int, default=500, help="random combs that the best part must be above")
    each = "a line a record too: scores of outer race, inner race and ball, and the threshold"
    arguments.add_argument("--each", action="store_true", help=each)
    asked = arguments.parse_args()
    program = asked.plummer.resolve() if asked.plummer.exists() else None
    if not program:
        print(f"no program at {asked.plummer}: only the baseline judges", file=sys.stderr)
    judges = [PLAIN, WHITE] + [OWN] * bool(program)
    counts, times = collections.defaultdict(collections.Counter), collections.defaultdict(list)
    with open(asked.folder / "records.csv", newline="") as table:
        records = list(csv.DictReader(table))
    for record in records:
        named, best, seen, seconds = judged(record, asked.folder, program, asked.combs)
        sound = record["truth"] == "none"
        own_row = ", ".join(filter(None, (record["set"], record["grade"])))
        for row in (own_row, "**all sound**" if sound else "**all damaged**"):
            counts[row]["number"] += 1
            counts[row]["sound"] += sound
            for judge in judges:
                counts[row][judge, outcome(named[judge], record["truth"])] += 1
                counts[row][judge, "no verdict"] += named[judge] is None
                counts[row][judge, "best"] += best.get(judge) == record["truth"]
        for judge in judges:
            times[judge].append(seconds[judge])
        if asked.each:
            line = f"{record['id']:28} {record['grade']:3} {record['truth']:11}"
            for judge in judges:
                line += f" | {seen.get(judge, '')} {'+'.join(named[judge] or []) or '-':10}"
            print(line, flush=True)
    versions = f"Python {platform.python_version()}, NumPy {np.__version__}, SciPy {scipy.__version__}"
    print(f"{versions}, {platform.machine()}.\n")
    head = ["records", "number"]
    for judge in judges:
        head += [f"{judge}, best of three: right"] * (judge != OWN) + [f"{judge}: right alone / wrong / nothing"]
    print("| " + " | ".join(head) + " |\n" + "|---" * len(head) + "|")
    for row in sorted(counts, key=lambda row: (row.startswith("**"), counts[row]["sound"] > 0, row)):
        of, cells = counts[row], []
        for judge in judges:
            right, wrong, nothing = (of[judge, kind] for kind in ("right", "wrong", "nothing"))
            of_three = "" if of["sound"] else str(of[judge, "best"])
            found = f"falsely {wrong} / {nothing}" if of["sound"] else f"{right} / {wrong} / {nothing}"
            cells += [of_three] * (judge != OWN) + [found]
        print(f"| {row} | {of['number']} | " + " | ".join(cells) + " |")
    print("\nMedian seconds a record, reading included: ", end="")
    print(", ".join(f"{judge} {statistics.median(times[judge]):.2f}" for judge in judges) + ".")
    silent = sum(counts[row][OWN, "no verdict"] for row in counts if row.startswith("**"))
    if silent:
        print(f"plummer gave no verdict on {silent}; they count as nothing named.")


if __name__ == "__main__":
    main()

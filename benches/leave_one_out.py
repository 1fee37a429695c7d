"""The verdict's two thresholds chosen without the specimen that they then judge.

    cargo build --release
    python3 benches/leave_one_out.py FOLDER [--plummer PROGRAM]

FOLDER is that of verdicts.py; `records.csv` tells specimens apart by `set`, `truth`, `size_mil` and `place_oclock`. Each specimen's records are
judged with the threshold of a race (dB) and that of a ball by the cage's lines (dB) that are best on all others: most right verdicts, less five
times the wrong ones. Of equally good pairs there are many; the least, the middle and the greatest are judged. All other conditions are the
program's, and so is what it prints: lines of the cage are told only from 8 dB on, so that lower thresholds are not tried.
"""

import argparse
import collections
import csv
import itertools
import json
import os
import pathlib
import subprocess
import tempfile

PROGRAM = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", "target"), "release/plummer")

PARTS = ("outer", "inner", "ball", "cage")
RACES = [0.5 * half for half in range(16, 45)]
CAGES = [0.5 * half for half in range(16, 35)]
WRONG = 5


def figures(program, folder, record):
    """What the program tells of each part: level where all but the level is fulfilled, and the cage's level."""
    with tempfile.TemporaryDirectory() as scratch:
        orders = ",".join(f"{key}={record[key]}" for key in PARTS)
        command = [str(program), "analyze", str(folder / record["file"]), "--channel", "signal", "--orders", orders]
        command += ["--speed", record["speed_hz"], "--out", f"{scratch}/o", "--quiet"]
        subprocess.run(command, check=True, capture_output=True)
        window = json.loads(pathlib.Path(scratch, "o", "analysis.json").read_text())["windows"][0]
    verdict = window["verdict"]
    short = verdict["turns"] < 96
    levels, cage = {}, None
    for part in verdict["faults"]:
        if part["cage_lines"]:
            cage = part["cage_lines"]["strength_db"]
            continue
        seen, impulsive = part["harmonics_seen"], part["impulsiveness"]
        first = any(line["seen"] and line["harmonic"] <= 2 for line in part["harmonics"])
        clear = seen >= (2 if short else 3) and first and (impulsive is None or impulsive >= (0.4 if short else 0.2))
        if part["false_alarm"] is not None and part["false_alarm"] < 1e-3 and clear and part["fault"] != "cage":
            levels[part["fault"]] = part["strength_db"] + (3 if short else 0)
    return levels, cage


def named(record, race, cage):
    levels, of_cage = record["figures"]
    parts = [part for part, level in levels.items() if level >= race]
    return parts or ["ball"] * (of_cage is not None and of_cage >= cage)


def outcome(record, pair):
    found, truth = named(record, *pair), record["truth"]
    if truth == "none":
        return "named" if found else "clean"
    return "nothing" if not found else "right" if found == [truth] else "wrong"


def worth(records, pair):
    counts = collections.Counter(outcome(record, pair) for record in records)
    return counts["right"] - WRONG * (counts["wrong"] + counts["named"])


def best(records):
    """All pairs that are best, in order."""
    worths = {pair: worth(records, pair) for pair in itertools.product(RACES, CAGES)}
    most = max(worths.values())
    return sorted(pair for pair, value in worths.items() if value == most)


def main():
    as_written = argparse.RawDescriptionHelpFormatter
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=as_written)
    arguments.add_argument("folder", type=pathlib.Path)
    arguments.add_argument("--plummer", type=pathlib.Path, default=PROGRAM)
    asked = arguments.parse_args()
    with open(asked.folder / "records.csv", newline="") as table:
        records = list(csv.DictReader(table))
    specimens = collections.defaultdict(list)
    for record in records:
        record["figures"] = figures(asked.plummer.resolve(), asked.folder, record)
        specimens[tuple(record[key] for key in ("set", "truth", "size_mil", "place_oclock"))].append(record)
    counts = collections.defaultdict(collections.Counter)
    for specimen in specimens.values():
        pairs = best([record for record in records if record not in specimen])
        races, cages = (sorted({pair[axis] for pair in pairs}) for axis in (0, 1))
        for choice, place in (("least", lambda axis: axis[0]), ("middle", lambda axis: 0.5 * (axis[0] + axis[-1])), ("greatest", lambda axis: axis[-1])):
            pair = place(races), place(cages)
            for record in specimen:
                kind = outcome(record, pair)
                counts[choice][record["set"], record["grade"], kind] += 1
                if kind in ("wrong", "named"):
                    print(f"{choice}: {record['id']} ({record['truth']}): {', '.join(named(record, *pair))} with {pair[0]} and {pair[1]} dB")
    rows = sorted({key[:2] for of in counts.values() for key in of})
    print("\n| records | " + " | ".join(counts) + " |\n" + "|---" * (1 + len(counts)) + "|")
    for row in rows:
        cells = [", ".join(f"{of[(*row, kind)]} {kind}" for kind in ("right", "wrong", "nothing", "clean", "named") if of[(*row, kind)]) for of in counts.values()]
        print(f"| {' '.join(row)} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()

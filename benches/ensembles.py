"""Many short runs of one scene: simulated seconds for each second of a core, by `plummer dataset` and by single runs.

    cargo build --release
    python3 benches/ensembles.py [--count 1000] [--singles 20]

Signals of 0.1 s of the dented bearing, balls and dents drawn anew, at 25.6 kHz without settling. The single runs are whole
processes of `plummer run` on some of the data set's cases; a data set builds the structure once and writes no reports. Both on
one thread.
"""

import argparse
import json
import pathlib
import tempfile

from housings import PROGRAM, ROOT, process

START, LENGTH, RATE_HZ = 2.3, 0.1, 25_600
CASE = ROOT / "examples/tadina2011/outer-dent.toml"
SPEC = f"""
seed = 1
[[machines]]
case = "{CASE}"
[per_machine]
"transient.start" = {START}
[per_signal]
"bearing.first_ball_deg" = {{ uniform = [0, 360] }}
[fault.outer]
share = 1
angle_deg = 270
length = {{ uniform = [0.3e-3, 1e-3] }}
depth = {{ uniform = [3e-6, 20e-6] }}
width = 0.41e-3
profile = "in-plane"
rim_radius = 0.05e-3
[recorder]
rate_hz = {RATE_HZ}
duration_s = {LENGTH}
settle_s = 0
"""


def table(values):
    """A table as a case has it."""
    return "{" + ", ".join(f"{key} = {json.dumps(value)}" for key, value in values.items()) + "}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=1000, help="signals of the data set")
    parser.add_argument("--singles", type=int, default=20, help="single runs")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "spec.toml").write_text(SPEC)
        data_set = [PROGRAM, "dataset", "spec.toml", "--count", str(options.count), "--out", "set"]
        together, _ = process([*data_set, "--threads", "1", "--quiet"], folder, 1)
        signals = json.loads((folder / "set/manifest.json").read_text())["signals"]
        left_out = sum(signal["file"] is None for signal in signals)
        alone, chosen = 0.0, signals[:: max(len(signals) // options.singles, 1)][: options.singles]
        for signal in chosen:
            keys = {
                **signal["drawn"],
                "bearing.defects": "[" + ", ".join(table(fault) for fault in signal["faults"]) + "]",
                "transient.end": START + LENGTH,
                "transient.output_hz": 4 * RATE_HZ,
                "accuracy.band_hz": [0, RATE_HZ // 2],
                "analysis.envelope": [],
            }
            pairs = [part for key, value in keys.items() for part in ("--set", f"{key}={value}")]
            run = [PROGRAM, "run", CASE, *pairs, "--out", "run", "--threads", "1", "--force", "--quiet"]
            figures, _ = process(run, folder, 1)
            alone += figures["cpu"]
    singly, in_set = LENGTH * options.singles / alone, LENGTH * options.count / together["cpu"]
    print("| runs of 0.1 s | number | simulated seconds a second of a core |")
    print("|---|---|---|")
    print(f"| `plummer run`, one process each | {options.singles} | {singly:.3f} |")
    print(f"| `plummer dataset` | {options.count} ({left_out} left out) | {in_set:.3f}, {in_set / singly:.2f} times |")


if __name__ == "__main__":
    main()

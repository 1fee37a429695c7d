"""Which choice moves which amplitude of Tadina & Boltezar (2011), figures 9 to 16, in four tables.

    pip install numpy
    cargo build --release
    python3 benches/paper_amplitudes.py [--plummer PROGRAM] [--tables ours,source,damping,angle]

`ours` are examples/tadina2011/*.toml with one choice at a time changed to the source's. `source` is what it prints, as far
as plummer has keys: its beams on 36 springs (beam.toml), Table 1's stiffness, no contact damping, C = beta K (17), dents
with almost vertical walls and the contact's curvature by (23) and (24); one choice at a time is changed back. The printed
equations need all 216 modes and take ten times as long, so the rows say where they are used; the others have the
consistent ones. `damping` has alpha and beta of (17) over decades. `angle` turns the inner race's dent against the
unbalance, which both turn with the shaft.

Acceleration at P1 from 2.2 to 2.8 s, m/s^2: 99.9th percentile of the magnitude for each start (smallest and largest,
medians of the starts: the source's figures show one run). A run begins at rest in equilibrium at 2.0 s or 13.7 and 27.4 ms
later; what it begins with has died away by 2.2 s.
One thread a run; results do not depend on it.
"""

import argparse
import functools
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

PROGRAM = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", "target"), "release/plummer")

EXAMPLES = pathlib.Path(__file__).parent.parent / "examples/tadina2011"
STARTS = (2.0, 2.0137, 2.0274)
FROM, END = 2.2, 2.8
KINDS = ("healthy", "outer", "inner", "flat")
# The radius of a rim: the cases' own, and a tenth of it for a wall.
ROUND, SHARP = 5e-5, 5e-6

OURS = {"case": "healthy.toml"}
# What beam.toml leaves out of a run.
BEAMS = {
    "case": "beam.toml",
    "speed": "{profile=[{time=0.2,hz=0.0},{time=4.7,hz=45.0}]}",
    "sensors": '[{name="P1",ring_deg=90,direction=[0,1,0]}]',
    "bearing.first_ball_deg": "270",
    "bearing.formulation": '"consistent"',
}
TABLE_1 = {"bearing.stiffness": "{inner=3.828e9,outer=3.867e9}"}
HERTZ = {"bearing.stiffness": '"hertz"'}
WALLS = {"rim": SHARP, "curvature": "paper"}
ROUND_RIMS = {"rim": ROUND, "curvature": "profile"}
STIFFNESS_PROPORTIONAL = {"damping": "{alpha=0,beta=1.5e-6}"}
MODAL = {"damping": "{modal=0.03}"}
NO_CONTACT_DAMPING = {"bearing.contact_damping": "0"}
CONTACT_DAMPING = {"bearing.contact_damping": "2"}
# The shaft's weight as a load: then the balls, and the housing, have none.
NO_BALL_WEIGHT = {"shaft.gravity": "[0,0]", "shaft.loads": "[{force=[0,-1.4715]}]"}
PRINTED = {"bearing.formulation": '"printed"', "transient.modes": '"all"'}
SOURCE = BEAMS | TABLE_1 | NO_CONTACT_DAMPING | STIFFNESS_PROPORTIONAL | WALLS
ONE_START = {"starts": STARTS[:1]}

FROM_OURS = (
    ("our cases", {}),
    ("contact stiffness of Table 1", TABLE_1),
    ("no contact damping", NO_CONTACT_DAMPING),
    ("C = 1.5e-6 s K instead of 3 % a mode", STIFFNESS_PROPORTIONAL),
    ("dents with walls, curvature by (23), (24)", WALLS),
    ("beams on 36 springs instead of the mesh", BEAMS | MODAL | CONTACT_DAMPING | HERTZ),
    ("printed equations", PRINTED | ONE_START),
    ("radial play of 5 um", {"bearing.radial_play": "5e-6"}),
    ("no unbalance", {"shaft.unbalance": "0"}),
    ("balls without weight", NO_BALL_WEIGHT),
    ("sampled at 1 MHz instead of 100 kHz", {"transient.output_hz": "1000000"}),
)
FROM_SOURCE = (
    ("the source's choices, consistent equations", {}),
    ("contact stiffness from the geometry", HERTZ),
    ("contact damping 2 s/m", CONTACT_DAMPING),
    ("3 % a mode", MODAL),
    ("rounded rims, the profile's curvature", ROUND_RIMS),
    ("our mesh instead of the beams", {key: None for key in BEAMS} | OURS),
    ("radial play of 5 um", {"bearing.radial_play": "5e-6"}),
    ("balls without weight", NO_BALL_WEIGHT),
    ("printed equations", PRINTED | ONE_START),
    ("printed equations and balls without weight", PRINTED | NO_BALL_WEIGHT | ONE_START),
)
DAMPING = [(f"alpha = {a:g} 1/s, beta = {b:g} s", {"damping": f"{{alpha={a},beta={b}}}"} | ONE_START) for a, b in (
    (1e2, 0), (1e3, 0), (1e4, 0), (1e5, 0), (0, 1e-8), (0, 1e-7), (0, 1e-6), (0, 3e-6), (0, 1e-5))]
ANGLES = range(0, 360, 45)


def defects(kind, rim, curvature, angle):
    """The dents and the flat of figure 8."""
    common = f"rim_radius={rim},curvature="
    race = f"length={0.75e-3 if kind == 'outer' else 0.8e-3},depth=1.5e-5,{common}"
    return {
        "healthy": "[]",
        "outer": f'[{{on="outer",angle_deg=270,{race}"{curvature}"}}]',
        "inner": f'[{{on="inner",angle_deg={angle},{race}"{curvature}"}}]',
        "flat": f'[{{on="ball",ball=0,angle_deg=0,flat_radius=2e-3,depth=1e-5,{common}"{curvature}"}}]',
    }[kind]


@functools.cache
def acceleration(program, case, settings):
    """P1 from 2.2 s on, or None where the run is refused."""
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "run", EXAMPLES / case, "--out", f"{folder}/o", "--quiet", "--threads", "1"]
        for setting in settings:
            command += ["--set", setting]
        answer = subprocess.run([str(word) for word in command], capture_output=True, text=True)
        if answer.returncode:
            print(answer.stderr.strip()[-300:], file=sys.stderr)
            return None
        with np.load(f"{folder}/o/signals.npz") as held:
            return held["P1"][held["time_s"] >= FROM]


def signals(program, kind, choices):
    """P1 for every start."""
    keys = {"case": "healthy.toml", "rim": ROUND, "curvature": "profile", "angle": 0, "starts": STARTS} | choices
    own = {name: keys.pop(name) for name in ("case", "rim", "curvature", "angle", "starts")}
    keys = {"transient.output_hz": "100000", "transient.method": '"auto"'} | keys
    keys["bearing.defects"] = defects(kind, own["rim"], own["curvature"], own["angle"])
    keys |= {"transient.end": END, "analysis.envelope": "[]"}
    found = []
    for start in own["starts"]:
        settings = tuple(f"{key}={value}" for key, value in keys.items() if value is not None)
        found.append(acceleration(program, own["case"], settings + (f"transient.start={start}",)))
    return [signal for signal in found if signal is not None]


def cell(found):
    if not found:
        return "refused"
    percentiles = ", ".join(f"{np.percentile(abs(signal), 99.9):.0f}" for signal in found)
    smallest, largest = (np.median([extreme(signal) for signal in found]) for extreme in (np.min, np.max))
    return f"{percentiles} ({smallest:.0f}, {largest:.0f})"


def table(program, head, base, rows, kinds=KINDS):
    print(f"\n| {head} | " + " | ".join(kinds) + " |\n|---" + "|---" * len(kinds) + "|", flush=True)
    for name, changes in rows:
        cells = [cell(signals(program, kind, base | changes)) for kind in kinds]
        print(f"| {name} | " + " | ".join(cells) + " |", flush=True)


def main():
    as_written = argparse.RawDescriptionHelpFormatter
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=as_written)
    arguments.add_argument("--plummer", type=pathlib.Path, default=PROGRAM)
    arguments.add_argument("--tables", default="ours,source,damping,angle")
    asked = arguments.parse_args()
    program = asked.plummer.resolve()
    if not program.exists():
        sys.exit(f"no program at {asked.plummer}: cargo build --release, or --plummer")
    for name in asked.tables.split(","):
        if name == "ours":
            table(program, "our cases but for", OURS, FROM_OURS)
        elif name == "source":
            table(program, "the source's choices but for", SOURCE, FROM_SOURCE)
        elif name == "damping":
            table(program, "the source's choices with", SOURCE, DAMPING)
        elif name == "angle":
            turned = [(f"{angle} degrees", {"angle": angle}) for angle in ANGLES]
            table(program, "our cases, dent ahead of the unbalance by", OURS, turned, ("inner",))
        else:
            sys.exit(f"--tables: no table {name}; there are ours, source, damping and angle")


if __name__ == "__main__":
    main()

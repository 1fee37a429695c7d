"""The estimated error of runs beside their true one: examples and variants of them, each beside all modes in short steps.

    pip install numpy scipy
    cargo build --release
    python3 benches/estimates.py [--plummer PROGRAM] [--held-out] [NAME ...]

The truth has all modes, balls with inertia and `exponential-adams` in equal steps; its own error is the difference from
twice its step. The error is that of `estimated_error`: of the worst sensor in the band, root mean square since the start,
the largest at any time from the first stretch (2 ms, or 30 periods of the band's end) until `estimate_held_s`. Vectors of
condensed housings are the same in both, unless the scene names more for the truth. `--held-out` takes the scenes that
nobody had looked at when the estimate was made.
"""

import argparse
import json
import os
import pathlib
import subprocess
import tempfile
import tomllib

import numpy as np
from scipy import signal

PROGRAM = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", "target"), "release/plummer")
BAND_5K = "accuracy.band_hz=[0,5000]"
UNDAMPED = "bearing.contact_damping=0"
MORE_VECTORS = ["condense.fixed_interface_modes={up_to_hz=1.2e6}"]
# name: case, start and end in ms, keys, keys of the truth alone
SCENES = {
    "smooth": ("scenes/smooth", 0, 10, [], []),
    "healthy": ("scenes/healthy", 0, 10, [], []),
    "impact": ("scenes/impact", 0, 8, [], []),
    "rattle": ("scenes/rattle", 0, 8, [], []),
    "outer dent": ("tadina2011/outer-dent", 2300, 2310, [], []),
    "inner dent": ("tadina2011/inner-dent", 2300, 2310, [], []),
    "flat": ("tadina2011/ball-flat", 2300, 2310, [], []),
    "ring, more vectors": ("housings/ring", 0, 6, [], MORE_VECTORS),
    "undamped, 5 kHz": ("scenes/smooth", 0, 20, [UNDAMPED, BAND_5K], []),
    "quasi-static, 5 kHz": ("scenes/smooth", 0, 20, [UNDAMPED, BAND_5K, "bearing.balls_inertia=quasi-static"], []),
    "spindle": ("machines/spindle", 0, 10, [], []),
    "pillow block": ("housings/pillow_block", 0, 5, [], []),
    # longer than an estimate is looked at
    "healthy, 50 ms": ("scenes/healthy", 0, 50, ["speed.profile=[{time=0,hz=27}]"], []),
    "impact, 50 ms": ("scenes/impact", 0, 50, ["bearing.defects.0.depth=1.2e-5"], []),
    "rattle, 50 ms": ("scenes/rattle", 0, 50, ["speed.profile=[{time=0,hz=35}]"], []),
    "inner dent, 50 ms": ("tadina2011/inner-dent", 2000, 2050, [], []),
    "flat, 50 ms": ("tadina2011/ball-flat", 2600, 2650, [], []),
}
HELD_OUT = {
    "healthy, 33 Hz": ("scenes/healthy", 0, 10, ["speed.profile=[{time=0,hz=33}]", "shaft.unbalance=5e-5"], []),
    "impact, shallow": ("scenes/impact", 0, 8, ["speed.profile=[{time=0,hz=31}]", "bearing.defects.0.depth=8e-6",
                        "bearing.contact_damping=1", "bearing.first_ball_deg=295.714"], []),
    "undamped, 5 kHz, heavier": ("scenes/smooth", 0, 20, [UNDAMPED, BAND_5K, "bearing.radial_play=-3e-6",
                                 "shaft.loads=[{force=[0,-20]}]"], []),
    "inner dent, deeper": ("tadina2011/inner-dent", 1700, 1712, ["bearing.defects.0.depth=3e-5"], []),
    "smooth, 20 kHz": ("scenes/smooth", 0, 10, ["bearing.contact_damping=0.3", "bearing.radial_play=-1e-6",
                       "speed.profile=[{time=0,hz=55}]", "accuracy.band_hz=[0,20000]"], []),
    "spindle, slower": ("machines/spindle", 0, 10, ["speed.profile=[{time=0,rpm=2500}]"], []),
    "rattle, damped": ("scenes/rattle", 0, 8, ["speed.profile=[{time=0,hz=38}]", "bearing.contact_damping=0.1"], []),
    "flat, faster": ("tadina2011/ball-flat", 3000, 3010, [], []),
}
STEP_S, MACHINE_STEP_S, FINE_STEP_S, FINE = 5e-8, 1e-7, 2.5e-8, ("impact", "rattle", "outer dent", "impact, shallow")
SENSORS_ARE_NOT = {"time_s", "shaft_x", "shaft_y", "shaft_z", "tilt_x", "tilt_y", "ball_radius", "ball_axial", "outer_force",
                   "inner_force", "outer_angle", "inner_angle", "shaft_speed_hz", "shaft_angle_rad"}


def run(program, path, keys, band_hz):
    """run.json and the sensors' signals in the band."""
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "run", path, "--threads", "1", "--quiet", "--out", folder + "/run"]
        done = subprocess.run(command + [word for key in keys for word in ("--set", key)], capture_output=True, text=True)
        summary = pathlib.Path(folder, "run/run.json")
        if not summary.exists():
            raise SystemExit(done.stderr)
        arrays = np.load(folder + "/run/signals.npz")
        time = arrays["time_s"]
        rate = (len(time) - 1) / (time[-1] - time[0])
        taps = None
        if band_hz < 0.45 * rate:
            edge = min(1.1 * band_hz, rate / 2)
            count, beta = signal.kaiserord(80, 2 * (edge - band_hz) / rate)
            taps = signal.firwin(count | 1, 0.5 * (edge + band_hz), window=("kaiser", beta), fs=rate)
        sensors = [limited(arrays[name], taps) for name in arrays.files if name not in SENSORS_ARE_NOT]
        return json.loads(summary.read_text()), time - time[0], np.array(sensors)


def limited(x, taps):
    """At rest before the start, mirrored beyond the end."""
    half = 0 if taps is None else len(taps) // 2
    if half == 0 or half >= len(x):
        return x
    return signal.fftconvolve(np.concatenate([np.zeros(half), x, x[-half - 1 : -1][::-1]]), taps, mode="valid")


def since_start(a, b):
    return np.sqrt(np.cumsum((a - b) ** 2, axis=1) / np.maximum(np.cumsum(b**2, axis=1), 1e-300)).max(axis=0)


def row(program, name, case, start, end, keys, of_truth):
    path = f"examples/{case}.toml"
    keys = keys + [f"transient.start={start * 1e-3!r}", f"transient.end={end * 1e-3!r}", "analysis.envelope=[]"]
    given = [key.split("=")[1] for key in keys if key.startswith("accuracy.band_hz")]
    band = json.loads(given[0]) if given else tomllib.loads(pathlib.Path(path).read_text())["accuracy"]["band_hz"]
    summary, time, found = run(program, path, keys, band[1])
    machine = case.startswith("machines")
    all_modes = ["transient.modes=all", "transient.method=exponential-adams"] + of_truth
    all_modes += [] if machine else ["bearing.balls_inertia=dynamic", "transient.residual=false"]
    named = {key.split("=")[0] for key in all_modes}
    all_modes += [key for key in keys if key.split("=")[0] not in named]
    step = FINE_STEP_S if name in FINE else MACHINE_STEP_S if machine else STEP_S
    truth, rough = (run(program, path, all_modes + [f"transient.step={h!r}"], band[1])[2] for h in (step, 2 * step))
    held = summary["estimate_held_s"] or 0.0
    first, last = (min(np.searchsorted(time, t), len(time) - 1) for t in (min(max(2e-3, 30 / band[1]), held), held))
    error, own = since_start(found, truth), since_start(rough, truth)
    worst, estimate = error[first : last + 1].max(), summary["estimated_error"]
    growth = [summary[f"estimate_{until}_growth"] for until in ("held", "looked")]
    held_growth, looked_growth = ("-" if g is None else f"{g:.3g}" for g in growth)
    ratio = "-" if estimate is None else f"{estimate / worst:.1f}"
    print(f"| {name} | {end - start} | {estimate and f'{estimate:.2g}'} | {summary['estimate_covers']}, {1e3 * held:.1f} ms "
          f"| {held_growth} ({looked_growth}) | {worst:.2g} | {ratio} | {error[-1]:.2g} | {own[last]:.1g} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--plummer", default=str(PROGRAM))
    parser.add_argument("--held-out", action="store_true")
    parser.add_argument("names", nargs="*")
    asked = parser.parse_args()
    scenes = HELD_OUT if asked.held_out else SCENES
    print("| scene | ms | estimate | covers | growth (as far as looked) | true error | estimate / error | of all | truth's own |")
    print("|---|---|---|---|---|---|---|---|---|")
    for name in asked.names or scenes:
        row(asked.plummer, name, *scenes[name])


if __name__ == "__main__":
    main()

"""plummer against other integrators on the same equations: work against precision.

    pip install numpy scipy scikit-sundae
    python3 benches/peers.py [--scenes smooth,impact] [--repeats 5] [--json points.json]

Builds the module in benches/peers (cargo, release), runs every integrator on the coupled system of each scene, seven modes
and the static residual, over the same span from the same state at rest, and prints tables in Markdown. SciPy's compiled
integrators and CVODE call the compiled right-hand side through Python; those of Rust have it without. Every integrator
works on coordinates and velocities in units of the largest that each of them reaches, with relative and absolute tolerance the
same number. The error is that of the sensor's acceleration in the scene's band, root mean square of the difference over that
of the reference; states become accelerations by plummer's recorder for all of them, outside the times. Timed runs keep no
samples where the package allows that.
"""

import argparse
import importlib.util
import json
import pathlib
import platform
import shutil
import statistics
import subprocess
import sys
import time

import numpy as np
import scipy
from scipy.integrate import ode, odeint, solve_ivp

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent
CRATE = HERE / "peers"

# What the low-pass of the band needs beyond the span whose error counts, s.
MARGIN = 0.8e-3
OUTPUT_HZ, BAND_HZ = 100_000, 40_000
# Between two samples of the other integrators, s: what a sensor shows above half that rate would fold into the band.
SAMPLE = 1 / OUTPUT_HZ / 16
TARGETS = (1e-2, 1e-3)
# File, start and length of the span whose error counts, s: from rest with a ball in the dent or before it, and not longer than
# nearby solutions stay together.
SCENES = {
    "smooth": ("examples/scenes/smooth.toml", 0.0, 2.5e-3),
    "healthy": ("examples/scenes/healthy.toml", 0.0, 2.5e-3),
    "impact": ("examples/scenes/impact.toml", 0.0, 1.0e-3),
    "outer-dent": ("examples/tadina2011/outer-dent.toml", 2.3045, 2.0e-3),
}
MODEL = ["transient.modes=7", "transient.residual=true", f"transient.output_hz={OUTPUT_HZ}", "analysis.envelope=[]"]
STEPS_AT_MOST = 10**7
# No more repetitions after so many seconds.
LONG = 2.0
CHOSEN = "plummer, as the program chooses"


def built():
    """The module, built and loaded."""
    command = ["cargo", "build", "--release", "--manifest-path", str(CRATE / "Cargo.toml")]
    # named, whatever CARGO_TARGET_DIR says
    subprocess.run([*command, "--target-dir", str(CRATE / "target")], check=True)
    release = CRATE / "target" / "release"
    library = next(p for p in (release / "libpeers.so", release / "libpeers.dylib", release / "peers.dll") if p.exists())
    module = release / ("peers.pyd" if library.suffix == ".dll" else "peers.so")
    shutil.copyfile(library, module)
    found = importlib.util.spec_from_file_location("peers", module)
    peers = importlib.util.module_from_spec(found)
    found.loader.exec_module(peers)
    return peers


def tolerances(first, last):
    """Half decades."""
    return [10.0 ** (-k / 2) for k in range(2 * first, 2 * last + 1)]


class Bench:
    """A scene, and all integrators on it."""

    def __init__(self, peers, name, repeats):
        path, start, self.span = SCENES[name]
        self.seconds, self.repeats = self.span + MARGIN, repeats
        end = f"transient.end={start + self.seconds!r}"
        self.scene = peers.Scene(str(ROOT / path), [*MODEL, f"transient.start={start!r}", end])
        self.times = np.minimum(np.arange(round(self.seconds / SAMPLE) + 1) * SAMPLE, self.seconds)
        reach = np.abs(self.own("dop853", 1e-8, SAMPLE, True)[3]).max(axis=0)
        self.scene.set_scale(reach)
        self.start = self.scene.start()
        self.reference = self.signal(self.own("dop853", 1e-10, SAMPLE, True)[3], SAMPLE)
        other = self.own("exponential-adams", None, SAMPLE / 64, True)
        self.disagreement = self.error(self.signal(other[3], other[2]))

    def own(self, method, tolerance, step, keep):
        return self.scene.plummer(method, tolerance, [step, self.seconds, 1 / OUTPUT_HZ], keep)

    def signal(self, states, interval):
        ratio = round(1 / OUTPUT_HZ / interval)
        return self.scene.acceleration(np.ascontiguousarray(states), interval, ratio, BAND_HZ)

    def error(self, signal):
        count = round(self.span * OUTPUT_HZ)
        difference = signal[:count] - self.reference[:count]
        return float(np.linalg.norm(difference) / np.linalg.norm(self.reference[:count]))

    def often(self, run):
        """Median of the seconds that `run` returns first, and what else it returns; fewer times where it takes long."""
        runs, begun = [run()], time.perf_counter()
        while len(runs) < self.repeats and time.perf_counter() - begun < LONG:
            runs.append(run())
        return statistics.median(r[0] for r in runs), runs[0][1]

    def plummer(self, method, tolerance, step):
        """Error, evaluations and seconds of one of plummer's methods."""

        def run():
            kept = self.own(method, tolerance, step, True)
            seconds, evaluations = self.often(lambda: self.own(method, tolerance, step, False))
            return self.error(self.signal(kept[3], kept[2])), evaluations, seconds

        return (f"{tolerance:.1e}, {step:.2e} s" if tolerance else f"{step:.2e} s"), run

    def rust(self, package, method, tolerance):
        """The same of a method of another Rust package."""

        def run():
            kept = package(method, tolerance, self.seconds, SAMPLE)
            seconds, evaluations = self.often(lambda: package(method, tolerance, self.seconds, None))
            return self.error(self.signal(kept[3], SAMPLE)), evaluations, seconds

        return f"{tolerance:.1e}", run

    def python(self, package, tolerance):
        """The same of a package of Python: `package(tolerance, times)` gives states [samples x size], of times None nothing."""

        def once():
            self.scene.take_evaluations()
            clock = time.perf_counter()
            package(tolerance, None)
            return time.perf_counter() - clock, self.scene.take_evaluations()

        def run():
            states = package(tolerance, self.times)
            seconds, evaluations = self.often(once)
            return self.error(self.signal(states, SAMPLE)), evaluations, seconds

        return f"{tolerance:.1e}", run

    def solve_ivp(self, method):
        implicit = {"jac": self.scene.jacobian} if method in ("Radau", "BDF") else {}

        def run(tolerance, times):
            found = solve_ivp(self.scene.rhs, (0, self.seconds), self.start, method, times, rtol=tolerance, atol=tolerance, **implicit)
            if not found.success:
                raise RuntimeError(found.message)
            return found.y.T

        return run

    def compiled_dop853(self, tolerance, times):
        """`ode` gives its steps and nothing between; what is between is made outside the times."""
        solver = ode(self.scene.rhs).set_integrator("dop853", rtol=tolerance, atol=tolerance, nsteps=STEPS_AT_MOST)
        at, states = [], []
        if times is not None:
            # it hands its steps out in a buffer of its own, and -1 would stop it
            solver.set_solout(lambda t, x: (at.append(t), states.append(x.copy()))[0])
        solver.set_initial_value(self.start, 0.0)
        solver.integrate(self.seconds)
        if not solver.successful():
            raise RuntimeError(f"dop853 of scipy.integrate.ode: {solver.get_return_code()}")
        if times is None:
            return None
        return self.scene.between_steps(np.array(at), np.array(states), SAMPLE, len(times))

    def compiled_lsoda(self, tolerance, times):
        times = np.array([0.0, self.seconds]) if times is None else times
        states, what = odeint(
            self.scene.rhs, self.start, times, tfirst=True, rtol=tolerance, atol=tolerance, mxstep=STEPS_AT_MOST, full_output=True
        )
        if what["message"] != "Integration successful.":
            raise RuntimeError(what["message"])
        return states

    def cvode(self, method):
        from sksundae.cvode import CVODE

        implicit = {"jacfn": self.cvode_jacobian} if method == "BDF" else {}

        def run(tolerance, times):
            options = {"rtol": tolerance, "atol": tolerance, "max_num_steps": STEPS_AT_MOST, **implicit}
            solver = CVODE(self.scene.rhs_into, method=method, **options)
            # two times would give every step
            times = np.array([0.0, 0.5, 1.0]) * self.seconds if times is None else times
            found = solver.solve(times, self.start)
            if not found.success:
                raise RuntimeError(found.message)
            return found.y

        return run

    def cvode_jacobian(self, t, x, _dx, jacobian):
        jacobian[:, :] = self.scene.jacobian(t, x)

    def methods(self):
        """Name of each, and its points: parameter, and what runs it."""
        chosen, tolerance, step = self.scene.chosen
        adams = "exponential-adams"
        by_tolerance = [10.0 ** (-k / 3) for k in range(2, 16)]
        steps = [1 / OUTPUT_HZ / n for n in (7, 8, 10, 12, 14, 16, 20, 25, 32, 40, 50, 64, 80, 100)]
        yield CHOSEN, [self.plummer(chosen, tolerance, step)]
        yield f"plummer {adams}, tolerance", [self.plummer(adams, t, step) for t in by_tolerance]
        yield f"plummer {adams}, equal steps", [self.plummer(adams, None, s) for s in steps]
        yield "plummer dop853", [self.plummer("dop853", t, 1 / OUTPUT_HZ / 6) for t in tolerances(1, 8)]
        yield "plummer newmark", [self.plummer("newmark", None, 1 / OUTPUT_HZ / n) for n in (16, 32, 64, 128, 256)]
        python = [
            ("SciPy ode DOP853, compiled", self.compiled_dop853, 7),
            ("SciPy odeint LSODA, compiled", self.compiled_lsoda, 8),
            ("SciPy solve_ivp DOP853", self.solve_ivp("DOP853"), 7),
            ("SciPy solve_ivp LSODA", self.solve_ivp("LSODA"), 8),
            ("SciPy solve_ivp Radau", self.solve_ivp("Radau"), 5),
            ("SciPy solve_ivp BDF", self.solve_ivp("BDF"), 6),
        ]
        if importlib.util.find_spec("sksundae"):
            python += [("CVODE Adams", self.cvode("Adams"), 8), ("CVODE BDF", self.cvode("BDF"), 8)]
        for name, package, last in python:
            yield name, [self.python(package, t) for t in tolerances(1, last)]
        for method, last in (("bdf", 8), ("tr_bdf2", 6), ("esdirk34", 7), ("tsit45", 8)):
            yield f"diffsol {method}", [self.rust(self.scene.diffsol, method, t) for t in tolerances(1, last)]
        for method, last in (("dop853", 7), ("dopri5", 8)):
            yield f"ode_solvers {method}", [self.rust(self.scene.ode_solvers, method, t) for t in tolerances(1, last)]

    def overhead(self):
        """Seconds of an evaluation called from Python, and of one called from Rust, over the reference's states."""
        states = self.own("exponential-adams", None, SAMPLE, True)[3]
        bare = min(self.scene.bare_seconds(SAMPLE, states) for _ in range(5))
        rhs, from_python = self.scene.rhs, []
        for _ in range(5):
            clock = time.perf_counter()
            for t, x in zip(self.times, states):
                rhs(t, x)
            from_python.append((time.perf_counter() - clock) / len(states))
        return bare, min(from_python)


def at_error(points, target, work):
    """Work for an error of at most `target`, by the logarithms between the points on both sides of it where there are such."""
    good = [p for p in points if p["error"] <= target]
    if not good:
        return None
    best = min(good, key=lambda p: p[work])
    worse = [p for p in points if p["error"] > target and p[work] < best[work]]
    if not worse:
        return best[work]
    last = min(worse, key=lambda p: p["error"])
    (e0, e1), (w0, w1) = ([np.log(p[key]) for p in (last, best)] for key in ("error", work))
    return float(np.exp(w0 + (w1 - w0) * (np.log(target) - e0) / (e1 - e0)))


def measured(bench, note):
    """All points, and what failed."""
    points, failures = {}, {}
    for name, runs in bench.methods():
        points[name] = []
        for parameter, run in runs:
            try:
                error, evaluations, seconds = run()
            except Exception as failure:  # what a package says is part of the result
                failures.setdefault(name, []).append(f"{parameter}: {failure}")
                note(f"  {name:40} {parameter:18} {failure}")
                continue
            point = {
                "parameter": parameter,
                "error": error,
                "evaluations": evaluations / bench.seconds,
                "seconds": seconds / bench.seconds,
            }
            points[name].append(point)
            note(f"  {name:40} {parameter:18} error {error:.2e}  {evaluations:7} evaluations  {point['seconds']:8.3f} s/s")
    return points, failures


def shown(value, digits=3):
    if value is None:
        return ""
    if value >= 10 ** (digits - 1):
        return f"{value:.0f}"
    return f"{value:.{digits}g}"


def work_at(points, target, work):
    """Work of every integrator at an error, and the least of plummer's exponential-adams."""
    found = {name: at_error(runs, target, work) for name, runs in points.items() if name != CHOSEN}
    own = [value for name, value in found.items() if "exponential-adams" in name and value]
    return found, min(own, default=None)


def table(points):
    """Work at the targets and what it is in units of the best of plummer's exponential-adams."""
    head = [f"{100 * t:g} %: {what}" for t in TARGETS for what in ("evaluations/ms", "ratio", "s per s", "ratio")]
    lines = ["| integrator | " + " | ".join(head) + " |", "|---" * (len(head) + 1) + "|"]
    columns = [(work_at(points, t, work), scale) for t in TARGETS for work, scale in (("evaluations", 1e-3), ("seconds", 1.0))]
    for name in columns[0][0][0]:
        cells = []
        for (found, best), scale in columns:
            value = found[name]
            cells += [shown(value and value * scale), shown(value and best and value / best)]
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    return lines


def summary(everything, target):
    """Evaluations and seconds in units of the best of plummer's exponential-adams, scene by scene."""
    head = f"| at {100 * target:g} %: evaluations, seconds | " + " | ".join(everything) + " |"
    lines = [head, "|---" * (len(everything) + 1) + "|"]
    columns = [[work_at(scene["points"], target, work) for work in ("evaluations", "seconds")] for scene in everything.values()]
    for name in columns[0][0][0]:
        cells = []
        for column in columns:
            ratios = [shown(found[name] / best, 2) if found.get(name) and best else "none" for found, best in column]
            cells.append(", ".join(ratios) if "none" not in ratios else "")
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    own = [" | ".join(f"{column[0][1] / 1e3:.0f}/ms, {column[1][1]:.2g} s/s" if column[0][1] else "" for column in columns)]
    lines.append("| **1 is** | " + own[0] + " |")
    return lines


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--scenes", default=",".join(SCENES))
    arguments.add_argument("--repeats", type=int, default=5, help="timed runs of each point, of which the median counts")
    arguments.add_argument("--json", type=pathlib.Path, help="where all points go")
    asked = arguments.parse_args()
    peers = built()

    def note(line):
        print(line, file=sys.stderr, flush=True)

    everything = {}
    print(f"Python {platform.python_version()}, NumPy {np.__version__}, SciPy {scipy.__version__}, {platform.machine()}.")
    for name in asked.scenes.split(","):
        note(name)
        bench = Bench(peers, name, asked.repeats)
        bare, from_python = bench.overhead()
        points, failures = measured(bench, note)
        [chosen] = points[CHOSEN]
        everything[name] = {
            "disagreement": bench.disagreement,
            "bare_s": bare,
            "from_python_s": from_python,
            "points": points,
            "failures": failures,
        }
        print(f"\n### {name}\n")
        print(
            f"{1e3 * bench.span:g} ms from rest; the reference (dop853 at 1e-10) and exponential-adams at {SAMPLE / 64:.1e} s differ by "
            f"{bench.disagreement:.1e}. An evaluation takes {1e6 * bare:.2f} µs, called from Python {1e6 * from_python:.2f} µs. "
            f"As the program chooses: error {100 * chosen['error']:.2g} %, {chosen['evaluations'] / 1e3:.0f} evaluations/ms, "
            f"{chosen['seconds']:.3g} s per simulated second.\n"
        )
        print("\n".join(table(points)))
        for failed, why in failures.items():
            print(f"\n{failed} failed at {len(why)} points, first {why[0]}")
    print("\n### In units of plummer's exponential-adams")
    for target in TARGETS:
        print("\n" + "\n".join(summary(everything, target)))
    if asked.json:
        asked.json.write_text(json.dumps(everything, indent=1) + "\n")


if __name__ == "__main__":
    main()

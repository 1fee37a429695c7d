"""Modes of a pillow block by size: plummer beside CalculiX and SLEPc, in seconds of the processor, wall time and memory.

    apt-get install gmsh calculix-ccx python3-slepc4py-real libopenblas0-pthread
    cargo build --release
    python3 benches/housings.py [--sizes 59,244] [--programs plummer,calculix,slepc] [--repeats 3] [--threads 1,2]

The meshes are meshes/pedestal.geo with both element sizes times a factor (59: tests/data/pedestal_60k.msh), the feet
fixed, `integration = "4-point"` as in CalculiX. Every row is a whole process: plummer reads the mesh, counts the modes and writes its report; CalculiX reads the
input file of `plummer export`; SLEPc reads matrices and solves by Krylov-Schur with MUMPS at the shift zero. With the
reference BLAS it takes three times as long. The frequencies of the others are compared with plummer's. Medians of the
repetitions; programs take turns.
"""

import argparse
import json
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent
PROGRAM = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"), "release/plummer").resolve()
# Thousands of degrees of freedom, and the factor of the element sizes that gives them; one is a mesh of the tests.
SIZES = {"10": 1.0, "59": None, "76": 0.41, "182": 0.299, "244": 0.268, "482": 0.21, "1156": 0.1565, "3042": 0.1095}
CASE = """
[housing]
mesh = "{name}.msh"
length_unit = "{unit}"
parts = [{{ group = "housing", material = "aluminium" }}]
supports = [{{ group = "feet", fixed = ["x", "y", "z"] }}]
integration = "4-point"
[modes]
count = {modes}
"""
# Where Debian puts the packages of PETSc with real numbers.
DEBIAN = ["/usr/lib/petscdir/petsc3.18", "/usr/lib/slepcdir/slepc3.18"]


def process(command, folder, threads, env=None):
    """Seconds of the processor, of the wall, and MiB of a whole process; its standard output."""
    env = {**os.environ, "OMP_NUM_THREADS": str(threads), "OPENBLAS_NUM_THREADS": str(threads), **(env or {})}
    with tempfile.TemporaryFile("w+") as out:
        begin = time.perf_counter()
        child = subprocess.Popen(command, cwd=folder, stdout=out, stderr=subprocess.STDOUT, env=env)
        _, status, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        wall = time.perf_counter() - begin
        out.seek(0)
        text = out.read()
    if child.returncode:
        sys.exit(f"{command[0]}: exit code {child.returncode}\n{text[-2000:]}")
    return {"cpu": used.ru_utime + used.ru_stime, "wall": wall, "mib": used.ru_maxrss / 1024}, text


class Block:
    """The pillow block of one size, with what each program needs of it."""

    def __init__(self, size, folder, modes):
        self.name, self.folder, self.modes = f"pedestal_{size}k", folder, modes
        if SIZES[size]:
            self.mesh(SIZES[size])
        else:
            shutil.copyfile(ROOT / "tests/data/pedestal_60k.msh", folder / f"{self.name}.msh")
        unit = "mm" if SIZES[size] else "m"
        (folder / f"{self.name}.toml").write_text(CASE.format(name=self.name, unit=unit, modes=modes))

    def mesh(self, factor):
        geometry = (ROOT / "meshes/pedestal.geo").read_text()
        for length in ("fine", "coarse"):
            geometry = re.sub(rf"^{length} = ([^;]*);", rf"{length} = \1*{factor};", geometry, flags=re.M)
        (self.folder / f"{self.name}.geo").write_text(geometry)
        gmsh = ["gmsh", "-3", "-v", "0", "-format", "msh41", "-bin", "-o", f"{self.name}.msh", f"{self.name}.geo"]
        subprocess.run(gmsh, cwd=self.folder, check=True)

    def export(self, to):
        out = self.folder / f"{self.name}_{to}"
        if not out.exists():
            command = [PROGRAM, "export", "--to", to, f"{self.name}.toml", "--out", out, "--quiet"]
            subprocess.run(command, cwd=self.folder, check=True)
        return out

    def plummer(self, threads):
        """A run of plummer, with the frequencies and whether they were counted."""
        command = [PROGRAM, "modes", f"{self.name}.toml", "--threads", str(threads), "--out", "modes", "--force", "--quiet"]
        figures, _ = process(command, self.folder, threads)
        result = json.loads((self.folder / "modes/modes.json").read_text())
        figures["dof"] = result["dof"]
        count = result["count_check"]
        return figures, result["frequencies_hz"], "yes" if count and count["counted"] == count["found"] else "no"

    def calculix(self, threads):
        out = self.export("inp")
        figures, _ = process(["ccx", "-i", "housing"], out, threads)
        rows = re.findall(r"^ +\d+ +\S+ +\S+ +(\S+) +\S+\s*$", (out / "housing.dat").read_text(), flags=re.M)
        return figures, [float(row) for row in rows[: self.modes]], "no"

    def slepc(self, threads):
        out = self.export("npz")
        paths = [f"{root}/x86_64-linux-gnu-real/lib/python3/dist-packages" for root in DEBIAN]
        env = {"PYTHONPATH": ":".join([*paths, "/usr/lib/python3/dist-packages"])}
        figures, text = process(["/usr/bin/python3", HERE / "slepc_modes.py", out, str(self.modes)], out, threads, env)
        return figures, json.loads(text.splitlines()[-1]), "no"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sizes", default="10,59,244", help=f"thousands of degrees of freedom, of {', '.join(SIZES)}")
    parser.add_argument("--programs", default="plummer,calculix,slepc")
    parser.add_argument("--threads", default="1,2")
    parser.add_argument("--modes", type=int, default=20)
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    threads = [int(count) for count in options.threads.split(",")]
    heads = ["degrees of freedom", "program", "threads", "CPU, s", "wall, s", "peak, MiB", "CPU of plummer over its", "counted",
             "frequencies differ by"]
    print("| " + " | ".join(heads) + " |")
    print("|---" * len(heads) + "|")
    for size in options.sizes.split(","):
        with tempfile.TemporaryDirectory() as folder:
            block = Block(size, pathlib.Path(folder), options.modes)
            runs = [(program, count) for program in options.programs.split(",") for count in threads]
            found = {run: [] for run in runs}
            for _ in range(options.repeats):
                for program, count in runs:
                    found[program, count].append(getattr(block, program)(count))
            report(found)


def report(found):
    """A row of each program and number of threads."""
    middle = {
        run: {key: statistics.median(figures[key] for figures, *_ in all_of) for key in ("cpu", "wall", "mib")}
        for run, all_of in found.items()
    }
    (reference, expected, _), dof = next(iter(found.values()))[0], next(iter(found.values()))[0][0].get("dof", "")
    own = middle.get(("plummer", 1), {}).get("cpu")
    for (program, threads), of in middle.items():
        _, frequencies, counted = found[program, threads][0]
        apart = max(abs(f / e - 1) for f, e in zip(frequencies, expected, strict=True))
        ratio = f"{own / of['cpu']:.3f}" if own and program != "plummer" else ""
        seconds = f"{of['cpu']:.2f} | {of['wall']:.2f} | {of['mib']:.0f}"
        print(f"| {dof} | {program} | {threads} | {seconds} | {ratio} | {counted} | {apart:.1e} |", flush=True)


if __name__ == "__main__":
    main()

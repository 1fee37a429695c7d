#!/usr/bin/env python3
"""What becomes of the meshes of a folder: scripts/meshes.py FOLDER [PROGRAM]

Runs `plummer inspect` on every .msh and .inp below FOLDER and prints a table: read, refused for a reason that docs/limits.md
gives, refused for another reason, wrong. A mesh counts as wrong if the same file, read and written again by gmsh in another
version of its format, has another number of elements of any kind or another volume, or if the program crashes. Without gmsh
on the path nothing is compared, and the table says so. Exit code 1 if anything is wrong or refused without such a reason.
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

# what a refusal may say, and what docs/limits.md calls it
REASONS = {
    r"MSH version 1": "MSH 1.0",
    r"MSH version 3": "MSH 3",
    r"not a gmsh mesh": "not a gmsh mesh",
    r"no \$Nodes|no \$Elements|no \*NODE|has no elements": "no nodes or no elements",
    r"which is not the whole body": "one partition of several",
    r"make it one of second order": "order 3 and higher, or a special element",
    r"shells are not modelled": "surfaces in space (shells)",
    r"inverted, folded or without size": "folded elements",
    r"lie on the corners|lie in one another|reaches? into|middle node|count twice": "material counted twice, or cracks",
    r"occurs a second time|does not exist|expected .* found|the file ends": "damaged",
}


def inspect(program, mesh, folder):
    """Exit code, result (None without one) and message."""
    run = subprocess.run(
        [program, "inspect", mesh, "--length-unit", "m", "--out", folder, "--force"], capture_output=True, text=True, errors="replace", timeout=600
    )
    result = folder / "inspect.json"
    found = json.loads(result.read_text()) if result.exists() else None
    result.unlink(missing_ok=True)
    message = [line for line in run.stderr.splitlines() if line.startswith("error")]
    return run.returncode, found, message[0] if message else run.stderr[-200:]


def numbers(found):
    """Elements of the highest dimension by kind, and their size."""
    kinds = {kind["kind"]: kind["count"] for kind in found["elements"]}
    top = found["dimension"]
    of_dimension = {"Tri": 2, "Quad": 2, "Tet": 3, "Hex": 3, "Wedge": 3, "Pyramid": 3}
    kinds = {k: n for k, n in kinds.items() if of_dimension.get(re.sub(r"\d", "", k)) == top}
    return kinds, found["size"]


def again(gmsh, mesh, version, folder):
    """The mesh as gmsh reads it, in another version; None where gmsh makes nothing of it."""
    copy = folder / f"{version}.msh"
    copy.unlink(missing_ok=True)
    command = [gmsh, mesh, "-save", "-save_all", "-format", version, "-o", copy, "-v", "0"]
    subprocess.run(command, capture_output=True, timeout=600)
    return copy if copy.exists() else None


def judge(program, gmsh, mesh, folder):
    code, found, message = inspect(program, mesh, folder)
    if code not in (0, 1, 2) or "panicked" in message:
        return "wrong", f"exit code {code}: {message}"
    if code != 0:
        reason = next((name for pattern, name in REASONS.items() if re.search(pattern, message)), None)
        return ("refused", reason) if reason else ("refused without a reason", message)
    if gmsh is None or mesh.suffix == ".inp":
        return "read, not compared", ""
    version = "msh22" if "4." in str(found["format"]) else "msh41"
    copy = again(gmsh, mesh, version, folder)
    if copy is None:
        return "read, not compared", "gmsh does not read it"
    code, other, message = inspect(program, copy, folder)
    if other is None:
        return "read, not compared", f"gmsh's copy: {message}"
    (kinds, size), (kinds_again, size_again) = numbers(found), numbers(other)
    # MSH 2.2 has 16 digits as 4.1 does; the sum of volumes is that of another order
    if kinds != kinds_again or abs(size - size_again) > 1e-9 * max(size, size_again):
        return "wrong", f"{kinds} {size}, by way of gmsh {kinds_again} {size_again}"
    return "read", ""


def main(folder, program="plummer"):
    gmsh = shutil.which("gmsh")
    meshes = sorted(p for p in pathlib.Path(folder).rglob("*") if p.suffix in (".msh", ".inp"))
    table = {}
    with tempfile.TemporaryDirectory() as scratch:
        for mesh in meshes:
            verdict, why = judge(program, gmsh, mesh, pathlib.Path(scratch))
            table.setdefault((verdict, why if verdict == "refused" else ""), []).append((mesh, why))
    print(f"{len(meshes)} files" + ("" if gmsh else "; gmsh was not found, nothing was compared"))
    for (verdict, reason), files in sorted(table.items()):
        print(f"{len(files):5d}  {verdict}{': ' if reason else ''}{reason}")
    bad = [(verdict, file) for (verdict, _), files in table.items() for file in files if verdict not in ("read", "refused")]
    for verdict, (mesh, why) in bad:
        print(f"{verdict}: {mesh}: {why}")
    return any(verdict in ("wrong", "refused without a reason") for verdict, _ in table)


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))

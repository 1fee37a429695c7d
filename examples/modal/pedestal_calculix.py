"""Modes of meshes/pedestal.msh on fixed feet by CalculiX: writes pedestal_calculix.csv, which pedestal.toml compares with.

The mesh (gmsh MSH 4.1, ASCII, mm) becomes CalculiX's input: C3D10 with its middle nodes in CalculiX's order, E 70 GPa, nu 0.33,
rho 2700 kg/m^3, the nodes of "feet" held, the lowest modes by *FREQUENCY. Shapes are read from its .frd file; every 12th corner node is
kept. Needs ccx (tried: 2.20) and Python's standard library:

    python3 pedestal_calculix.py > pedestal_calculix.csv
"""

import pathlib
import subprocess
import tempfile

MODES = 10
EVERY = 12
MESH = pathlib.Path(__file__).parent / "../../meshes/pedestal.msh"
TET10, TRI6 = 11, 9
TO_CALCULIX = [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]  # gmsh has the edges 2-3 and 1-3 the other way round


def section(lines, name):
    start = lines.index(f"${name}") + 1
    return iter(lines[start : lines.index(f"$End{name}")])


def read_mesh(path):
    """Nodes by tag in m, Tet10 as lists of tags, and the nodes of the group "feet"."""
    lines = path.read_text().splitlines()
    names = section(lines, "PhysicalNames")
    next(names)
    (feet,) = [int(line.split()[1]) for line in names if line.endswith('"feet"')]
    entities = section(lines, "Entities")
    points, curves, surfaces, _ = map(int, next(entities).split())
    for _ in range(points + curves):
        next(entities)
    held_surfaces = set()
    for _ in range(surfaces):
        words = next(entities).split()
        groups = [int(word) for word in words[8 : 8 + int(words[7])]]
        if feet in groups:
            held_surfaces.add(int(words[0]))
    nodes, rows = {}, section(lines, "Nodes")
    for _ in range(int(next(rows).split()[0])):
        count = int(next(rows).split()[3])
        tags = [int(next(rows)) for _ in range(count)]
        for tag in tags:
            nodes[tag] = [1e-3 * float(word) for word in next(rows).split()]
    solids, held, rows = [], set(), section(lines, "Elements")
    for _ in range(int(next(rows).split()[0])):
        _, entity, kind, count = map(int, next(rows).split())
        for _ in range(count):
            tags = [int(word) for word in next(rows).split()[1:]]
            if kind == TET10:
                solids.append(tags)
            elif kind == TRI6 and entity in held_surfaces:
                held.update(tags)
    return nodes, solids, held


def calculix_input(nodes, solids, held):
    yield "*NODE, NSET=ALL"
    for tag, place in sorted(nodes.items()):
        yield f"{tag}, " + ", ".join(f"{x:.12e}" for x in place)
    yield "*ELEMENT, TYPE=C3D10, ELSET=BODY"
    for number, tags in enumerate(solids, 1):
        yield f"{number}, " + ", ".join(str(tags[k]) for k in TO_CALCULIX)
    yield "*NSET, NSET=FEET"
    for tag in sorted(held):
        yield f"{tag},"
    yield "*MATERIAL, NAME=ALUMINIUM\n*ELASTIC\n70e9, 0.33\n*DENSITY\n2700.\n*SOLID SECTION, ELSET=BODY, MATERIAL=ALUMINIUM"
    yield "*BOUNDARY\nFEET, 1, 3"
    yield f"*STEP\n*FREQUENCY, SOLVER=ARPACK\n{MODES}\n*NODE FILE\nU\n*END STEP"


def frequencies(dat):
    """Hz: the fourth number of each row below EIGENVALUE OUTPUT."""
    found = []
    for line in dat.splitlines():
        words = line.split()
        if len(words) == 5 and words[0].isdigit() and int(words[0]) == len(found) + 1:
            found.append(float(words[3]))
        if len(found) == MODES:
            return found
    raise SystemExit("ccx wrote fewer modes than asked for")


def shapes(frd):
    """Displacements by node, a dictionary a mode."""
    found = []
    for line in frd.splitlines():
        if line.startswith(" -4  DISP"):
            found.append({})
        elif line.startswith(" -4"):
            found.append(None)
        elif line.startswith(" -1") and found and found[-1] is not None:
            found[-1][int(line[3:13])] = [float(line[13 + 12 * k : 25 + 12 * k]) for k in range(3)]
    return [shape for shape in found if shape]


def main():
    nodes, solids, held = read_mesh(MESH)
    with tempfile.TemporaryDirectory() as folder:
        job = pathlib.Path(folder) / "job"
        job.with_suffix(".inp").write_text("\n".join(calculix_input(nodes, solids, held)) + "\n")
        subprocess.run(["ccx", "-i", "job"], cwd=folder, check=True, capture_output=True)
        hertz = frequencies(job.with_suffix(".dat").read_text())
        displacements = shapes(job.with_suffix(".frd").read_text())
    corners = {tag for tags in solids for tag in tags[:4]}
    kept = sorted(corners - held)[::EVERY]
    print('# meshes/pedestal.msh, E 70 GPa, nu 0.33, 2700 kg/m^3, "feet" held: CalculiX 2.20, C3D10, by pedestal_calculix.py')
    print("mode,frequency_hz,node,ux,uy,uz")
    for number, (hz, shape) in enumerate(zip(hertz, displacements), 1):
        largest = max(abs(u) for moved in shape.values() for u in moved)
        for tag in kept:
            row = ",".join(f"{u / largest:.5f}" for u in shape[tag])
            print(f"{number},{hz:.4f},{tag},{row}")


main()

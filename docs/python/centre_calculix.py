"""Centre node of the pedestal's bore in CalculiX: rigid, and in the mean of the displacements; alone, with a mass, on springs.

    bore() { echo "condense={ fixed_interface_modes=12, interface={ centres=[{ group='bore', point=[$1], tie='$2' }] } }"; }
    plummer export examples/modal/pedestal.toml --to inp --out out/deck
    plummer condense examples/modal/pedestal.toml --out out/rigid --set "$(bore '5e-4, 3e-4, 1e-3' rigid)"
    plummer condense examples/modal/pedestal.toml --out out/mean \
        --set "$(bore '-2.7044141631804253e-5, -4.127769562000267e-5, 3.7387613728153537e-6' mean)"
    python3 docs/python/centre_calculix.py out/deck/housing.inp out/rigid out/mean       # needs ccx, numpy, scipy

There are twelve vectors, as the estimated error counts no mass on the node. The case integrates as CalculiX does, with four points.
`*DISTRIBUTING COUPLING` takes the mean displacement of the nodes, wherever the reference node is, and no rotation. That is a mean
centre in the middle of its nodes, without moments.
`*COUPLING` with `*DISTRIBUTING` carries loads only: masses and springs on its reference node have no effect.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import scipy.linalg

WITHIN = 1e-4  # of frequencies: CalculiX integrates the mass with four points too
POINT = "0.0005, 0.0003, 0.001"
MASS, ALONG, ABOUT = 0.05, (2e7, 5e7, 3e7), (2e3, 4e3, 3e3)
RIGID = f"*NODE\n900001, {POINT}\n900002, {POINT}\n*RIGID BODY, NSET=bore, REF NODE=900001, ROT NODE=900002\n"
MEAN = f"*NODE\n900001, {POINT}\n*ELEMENT, TYPE=DCOUP3D, ELSET=centre\n900010, 900001\n*DISTRIBUTING COUPLING, ELSET=centre\nbore, 1.\n"


def mass():
    return f"*ELEMENT, TYPE=MASS, ELSET=lump\n900101, 900001\n*MASS, ELSET=lump\n{MASS}\n"


def springs(node, stiffness):
    cards = "*ELEMENT, TYPE=SPRING1, ELSET=s{0}\n{0}, {1}\n*SPRING, ELSET=s{0}\n{2}\n{3}\n"
    return "".join(cards.format(10 * (node - 900001) + 900200 + axis, node, axis, k) for axis, k in enumerate(stiffness, 1))


def frequencies(deck, cards):
    with tempfile.TemporaryDirectory() as folder:
        model, step = deck.split("*STEP")
        Path(folder, "job.inp").write_text(model + cards + "*STEP" + step)
        subprocess.run(["ccx", "-i", "job"], cwd=folder, check=True, capture_output=True)
        table = Path(folder, "job.dat").read_text().split("P A R T I C")[0]
    return np.array([float(line.split()[3]) for line in table.splitlines() if re.match(r"\s+\d+\s+[-0-9.]+E", line)])


def condensed(folder, mass, springs):
    """Frequencies of the superelement with these on its centre node, whose six rows come first."""
    s = np.load(f"{folder}/superelement.npz")
    k, m = s["k"].copy(), s["m"].copy()
    k[range(6), range(6)] += springs
    m[range(3), range(3)] += mass
    return np.sqrt(scipy.linalg.eigh(k, m, eigvals_only=True)) / (2 * np.pi)


deck, rigid, mean = Path(sys.argv[1]).read_text(), *sys.argv[2:]
print(*subprocess.run(["ccx", "-v"], capture_output=True, text=True).stdout.split(), f"SciPy {scipy.__version__}")
good, free = True, (0, 0, 0)
for name, cards, folder, lump, held in (
    ("rigid", RIGID, rigid, 0, free + free),
    ("rigid, mass", RIGID + mass(), rigid, MASS, free + free),
    ("rigid, springs", RIGID + springs(900001, ALONG) + springs(900002, ABOUT), rigid, 0, ALONG + ABOUT),
    ("mean, mass", MEAN + mass(), mean, MASS, free + free),
    ("mean, springs along", MEAN + springs(900001, ALONG), mean, 0, ALONG + free),
):
    theirs, ours = frequencies(deck, cards)[:3], condensed(folder, lump, held)[:3]
    apart = abs(ours / theirs - 1).max()
    good &= apart < WITHIN
    print(name, *(f"{hz:.2f}" for hz in theirs), "ours", *(f"{hz:.2f}" for hz in ours), f"difference {apart:.1e}")
print(f"within {WITHIN:.0e}:", good)
sys.exit(0 if good else 1)

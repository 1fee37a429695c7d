"""Centre node of the pedestal's bore in CalculiX: rigid, and in the mean of the displacements; alone, with a mass, on springs.

    plummer export examples/modal/pedestal.toml --to inp --out out/deck
    python3 centre_calculix.py out/deck/housing.inp                    # needs ccx

`*DISTRIBUTING COUPLING` takes the mean displacement of the nodes, wherever the reference node is, and no rotation.
`*COUPLING` with `*DISTRIBUTING` carries loads only: masses and springs on its reference node have no effect.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

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
    return [line.split()[3] for line in table.splitlines() if re.match(r"\s+\d+\s+[-0-9.]+E", line)]


deck = Path(sys.argv[1]).read_text()
for name, cards in {
    "rigid": RIGID,
    "rigid, mass": RIGID + mass(),
    "rigid, springs": RIGID + springs(900001, ALONG) + springs(900002, ABOUT),
    "mean, mass": MEAN + mass(),
    "mean, springs along": MEAN + springs(900001, ALONG),
}.items():
    print(name, *(f"{float(hz):.2f}" for hz in frequencies(deck, cards)[:4]))

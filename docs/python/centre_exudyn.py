"""Centre nodes of the pedestal's bore and feet by Exudyn, on the matrices of plummer: fixed-interface and free frequencies.

    case="examples/modal/pedestal.toml --set housing.supports=[] --set housing.integration=full"
    bore="group = 'bore', point = [-2.7044141631804253e-5, -4.127769562000267e-5, 3.7387613728153537e-6]"    # means of the nodes
    feet="group = 'feet', point = [2.1431528471191147e-7, -0.013, 0.0001336425771000694]"
    plummer export $case --to mtx --out out/matrices
    for tie in rigid mean; do
        plummer condense $case --out out/$tie --set "accuracy = { band_hz = [0, 10000], target = 0.1 }" \
            --set "condense = { fixed_interface_modes = 12, enhanced = false,
            interface = { centres = [{ $bore, tie = '$tie' }, { $feet, tie = '$tie' }] } }"
    done
    python3 docs/python/centre_exudyn.py out/matrices out/rigid out/mean       # needs numpy, scipy, exudyn
"""

import csv
import sys

import exudyn
import numpy as np
import scipy.linalg
import scipy.sparse
from exudyn.FEM import FEMinterface, HCBstaticModeSelection
from scipy.io import mmread

WITHIN, RIGID = 1e-6, 1e-9  # of frequencies; of the forces of rigid motions, against the sum of their parts
folder, *condensed = sys.argv[1:]
k, m = (scipy.sparse.csr_matrix(mmread(f"{folder}/{name}.mtx")) for name in ("stiffness", "mass"))
rows = list(csv.DictReader(open(f"{folder}/dofs.csv")))[::3]  # three rows a node
x = np.array([[float(row[axis]) for axis in ("x_m", "y_m", "z_m")] for row in rows])
bore = np.flatnonzero(np.hypot(x[:, 0], x[:, 1]) < 6.001e-3)
feet = np.flatnonzero(x[:, 1] < -12.999e-3)
print(f"Exudyn {exudyn.__version__}, SciPy {scipy.__version__}, NumPy {np.__version__}")
for nodes in (bore, feet):
    print(f"{len(nodes)} nodes about {x[nodes].mean(axis=0)} m")

good = True
for tie, own in zip((HCBstaticModeSelection.RBE2, HCBstaticModeSelection.RBE3), condensed):
    fem = FEMinterface()
    fem.nodes, fem.stiffnessMatrix, fem.massMatrix = {"Position": x}, k, m
    fem.ComputeHurtyCraigBamptonModes([list(bore), list(feet)], 12, computationMode=tie, excludeRigidBodyMotion=False)
    v = fem.modeBasis["matrix"]
    v = v / np.linalg.norm(v, axis=0)
    reduced = scipy.linalg.eigh(v.T @ (k @ v), v.T @ (m @ v), eigvals_only=True)[6:]
    s = np.load(f"{own}/superelement.npz")
    free = scipy.linalg.eigh(s["k"], s["m"], eigvals_only=True)[6:]
    for what, theirs, ours in (
        ("held", np.sqrt(np.sort(fem.eigenValues)) / (2 * np.pi), s["modal_hz"]),
        ("free", np.sqrt(reduced) / (2 * np.pi), np.sqrt(free) / (2 * np.pi)),
    ):
        apart = abs(ours / theirs - 1).max()
        good &= apart < WITHIN
        print(tie, what, *(f"{hz:.9g}" for hz in theirs))
        print(f"    largest difference of {len(ours)} frequencies {apart:.1e}")
    motion = np.zeros((len(s["k"]), 6))  # of the interface by displacements and turns of the whole
    place, axis = s["interface_positions"], s["interface_axes"]
    turns = s["interface_dofs"][:, 1] > 3
    motion[: len(axis), :3] = np.where(turns[:, None], 0, axis)
    motion[: len(axis), 3:] = np.where(turns[:, None], axis, np.cross(place, axis))
    rest = (abs(s["k"] @ motion) / (abs(s["k"]) @ abs(motion)).max(axis=0)).max()
    good &= rest < RIGID
    print(f"    forces of the six rigid motions {rest:.1e}")
print(f"frequencies within {WITHIN:.0e}, rigid motions within {RIGID:.0e}:", good)
sys.exit(0 if good else 1)

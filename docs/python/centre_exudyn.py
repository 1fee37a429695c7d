"""Centre nodes of the pedestal's bore and feet by Exudyn, on the matrices of plummer: fixed-interface and free frequencies.

    plummer export pedestal_free.toml --to mtx --out out/matrices      # examples/modal/pedestal.toml without supports
    python3 centre_exudyn.py out/matrices                              # needs numpy, scipy, exudyn
"""

import csv
import sys

import numpy as np
import scipy.linalg
import scipy.sparse
from exudyn.FEM import FEMinterface, HCBstaticModeSelection
from scipy.io import mmread

folder = sys.argv[1]
k, m = (scipy.sparse.csr_matrix(mmread(f"{folder}/{name}.mtx")) for name in ("stiffness", "mass"))
rows = list(csv.DictReader(open(f"{folder}/dofs.csv")))[::3]  # three rows a node
x = np.array([[float(row[axis]) for axis in ("x_m", "y_m", "z_m")] for row in rows])
bore = np.flatnonzero(np.hypot(x[:, 0], x[:, 1]) < 6.001e-3)
feet = np.flatnonzero(x[:, 1] < -12.999e-3)
for nodes in (bore, feet):
    print(f"{len(nodes)} nodes about {x[nodes].mean(axis=0)} m")

for tie in (HCBstaticModeSelection.RBE2, HCBstaticModeSelection.RBE3):
    fem = FEMinterface()
    fem.nodes, fem.stiffnessMatrix, fem.massMatrix = {"Position": x}, k, m
    fem.ComputeHurtyCraigBamptonModes([list(bore), list(feet)], 12, computationMode=tie, excludeRigidBodyMotion=False)
    v = fem.modeBasis["matrix"]
    v = v / np.linalg.norm(v, axis=0)
    reduced = scipy.linalg.eigh(v.T @ (k @ v), v.T @ (m @ v), eigvals_only=True)[6:]
    for what, values in (("held", np.sort(fem.eigenValues)), ("free", reduced)):
        print(tie, what, *(f"{hz:.9g}" for hz in np.sqrt(values) / (2 * np.pi)))

"""Writes the files of this folder: python3 make.py (NumPy, pyYeti 1.4.7).

Every way in which pyyeti.nastran.op4 writes: both byte orders and text; dense, sparse, big sparse columns. Each file has
the same three matrices: STIFF, symmetric with zeros inside its columns and a column of zeros; RECT; CPLX, complex.
"""

import numpy as np
from pyyeti.nastran import op4

stiff = np.zeros((6, 6))
for i in range(6):
    for j in range(6):
        if (i + j) % 3 != 1 and 2 not in (i, j):
            stiff[i, j] = (1 + i) * (1 + j) / 3 * (-1) ** (i + j)
rect = np.array([[0.0, 1e-30, 0.0, 4.0], [0.0, -1e30, 0.5, 0.0], [0.0, 3.0, 0.0, -1 / 7]])
cplx = np.array([[1 + 2j, 0], [0, -3j]])
names, matrices = ["STIFF", "CPLX", "RECT"], [stiff, cplx, rect]

for sparse, kind in [("dense", "dense"), ("nonbigmat", "sparse"), ("bigmat", "big_sparse")]:
    for endian, order in [("<", "little"), (">", "big")]:
        op4.write(f"{order}_{kind}.op4", names, matrices, endian=endian, sparse=sparse)
    op4.write(f"text_{kind}.op4", names, matrices, binary=False, sparse=sparse)

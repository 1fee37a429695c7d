"""The lowest modes of matrices that `plummer export --to npz` wrote, by SLEPc with MUMPS: prints frequencies in Hz as JSON.

    python3 benches/slepc_modes.py FOLDER COUNT
"""

import json
import math
import sys

import numpy as np
from petsc4py import PETSc
from slepc4py import SLEPc


def matrix(path):
    """A symmetric matrix in SciPy's sparse format [n x n]."""
    stored = np.load(path)
    order = stored["shape"][0]
    arrays = (stored["indptr"].astype(PETSc.IntType), stored["indices"].astype(PETSc.IntType), stored["data"])
    made = PETSc.Mat().createAIJ(size=(order, order), csr=arrays)
    made.setOption(PETSc.Mat.Option.SYMMETRIC, True)
    return made


folder, count = sys.argv[1], int(sys.argv[2])
solver = SLEPc.EPS().create()
solver.setOperators(matrix(f"{folder}/stiffness.npz"), matrix(f"{folder}/mass.npz"))
solver.setProblemType(SLEPc.EPS.ProblemType.GHEP)
solver.setWhichEigenpairs(SLEPc.EPS.Which.TARGET_MAGNITUDE)
solver.setTarget(0.0)
solver.setDimensions(count)
transform = solver.getST()
transform.setType(SLEPc.ST.Type.SINVERT)
transform.setMatStructure(PETSc.Mat.Structure.SUBSET_NONZERO_PATTERN)
direct = transform.getKSP()
direct.setType(PETSc.KSP.Type.PREONLY)
direct.getPC().setType(PETSc.PC.Type.CHOLESKY)
direct.getPC().setFactorSolverType("mumps")
solver.solve()
values = sorted(solver.getEigenvalue(place).real for place in range(solver.getConverged()))[:count]
print(json.dumps([math.sqrt(max(value, 0.0)) / (2 * math.pi) for value in values]))

import numpy as np
from scipy.io import mmread
from scipy.sparse.linalg import eigsh

k, m = mmread("out/matrices/stiffness.mtx").tocsc(), mmread("out/matrices/mass.mtx").tocsc()
values, shapes = eigsh(k, k=6, M=m, sigma=0.0)
print(*(f"{hz:.3f}" for hz in np.sqrt(values) / (2 * np.pi)))

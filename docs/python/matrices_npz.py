import numpy as np
from scipy.sparse import load_npz
from scipy.sparse.linalg import eigsh

k, m = load_npz("out/matrices/stiffness.npz").tocsc(), load_npz("out/matrices/mass.npz").tocsc()
values, shapes = eigsh(k, k=6, M=m, sigma=0.0)  # a free structure: sigma a little below zero, such as -1e4
print(*(f"{hz:.3f}" for hz in np.sqrt(values) / (2 * np.pi)))

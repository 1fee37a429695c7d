"""Frequencies and shapes of `plummer modes`: modes.npz.

    python3 modes.py out/pedestal/modes.npz
"""

import sys

import numpy as np

modes = np.load(sys.argv[1])
shapes, nodes = modes["shapes"], modes["nodes"]  # [modes x nodes x 3], [nodes x 3] in m
for number, (hz, shape) in enumerate(zip(modes["frequencies_hz"], shapes), 1):
    size = np.linalg.norm(shape, axis=1)
    place = nodes[size.argmax()] * 1e3
    share = (shape**2).sum(axis=0) / (shape**2).sum()
    print(f"{number}: {hz:9.1f} Hz, most at ({place[0]:.1f}, {place[1]:.1f}, {place[2]:.1f}) mm, along x y z", share.round(2))

flat = shapes.reshape(len(shapes), -1)
products = flat @ flat.T
mac = products**2 / np.outer(np.diag(products), np.diag(products))
print("largest MAC of two modes:", np.max(mac - np.eye(len(mac))).round(3))

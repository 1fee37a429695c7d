"""A condensed housing: superelement.npz of `plummer condense`.

    python3 superelement.py out/pedestal/superelement.npz
"""

import sys

import numpy as np

s = np.load(sys.argv[1])
k, m, dofs = s["k"], s["m"], s["interface_dofs"]  # rows of the interface first; node and component of each
print(f"{len(dofs)} interface coordinates and {len(k) - len(dofs)} vectors of the interior, from {s['modal_hz'][0]:.0f} Hz on")
print("symmetric:", np.allclose(k, k.T, rtol=1e-12) and np.allclose(m, m.T, rtol=1e-12))

# 1 N down (component 2 is y) on the ring's node 54 of 72, at 270 degrees: what the sensors do, statically, without the ring's own stiffness
force = np.zeros(len(k))
force[np.flatnonzero((dofs == [54, 2]).all(axis=1))] = -1.0
displacement = np.linalg.lstsq(k, force, rcond=1e-12)[0]  # a motion of nothing, if there is one, stays out
for name, row in zip(s["sensor_names"], s["sensors"]):
    print(f"{name}: {row @ displacement * 1e9:.3f} nm")

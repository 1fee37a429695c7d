# %% [markdown]
# # A rotor of ROSS on a condensed housing
#
# `plummer` condenses a frame onto the centre nodes of its two bores. ROSS has the shaft, SciPy solves both together.
# Needs ross-rotordynamics 2.3.0, "plotly<6", SciPy, pandas.

# %%
import os
from pathlib import Path

import numpy as np
import ross
import scipy.linalg

import plummer

# the folder of the repository, from whichever folder of it the cells run
os.chdir(next(folder for folder in (Path.cwd(), *Path.cwd().parents) if (folder / "examples").is_dir()))

# %% [markdown]
# ## The superelement

# %%
case = plummer.Case.load("examples/housings/rotor_frame.toml")
frame = case.condense()
print(frame, f"estimated error up to {case['accuracy.band_hz'][1]} Hz: {frame.error_estimate:.1e}")
frame.to_dataframe()

# %% [markdown]
# SciPy's symmetric solver takes the pair. Rigid bores stiffen the frame: `case.modes()` has them free.

# %%
hz = np.sqrt(scipy.linalg.eigh(frame.stiffness, frame.mass, eigvals_only=True)) / (2 * np.pi)
hz = hz[hz < case["accuracy.band_hz"][1]]
free = case.modes().frequencies_hz[: len(hz)]
print("rigid bores: ", np.round(hz, 2), "Hz")
print("free bores:  ", np.round(free, 2), "Hz")
assert np.allclose(hz, frame.summary["frequencies_hz"], rtol=1e-9)
assert (hz > free).all() and (hz < 1.01 * free).all()

# %% [markdown]
# ## The shaft
# It is example 5.9.1 of Friswell, Penny, Garvey and Lees, *Dynamics of Rotating Machines* (2010): 1.5 m of steel with
# two disks. Of ROSS's six coordinates a node the four across the axis are kept.

# %%
steel = ross.Material("steel", rho=7810, E=211e9, G_s=81.2e9)
shaft = ross.Rotor(
    [ross.ShaftElement(0.25, 0, 0.05, material=steel) for _ in range(6)],
    [ross.DiskElement.from_geometry(node, steel, 0.07, 0.05, width) for node, width in ((2, 0.28), (4, 0.35))],
    [],
)
across = np.flatnonzero(np.isin(np.arange(shaft.ndof) % 6, (0, 1, 3, 4)))  # x, y, turns about x and y
m, k, g = (np.asarray(matrix)[np.ix_(across, across)] for matrix in (shaft.M(), shaft.K(0), shaft.G()))

# %% [markdown]
# ## Together
# Each bearing is a spring of 1e8 N/m across the axis, between an end of the shaft and a centre node.

# %%
SPRING, RPM = 1e8, 4000


def lowest(housing: "plummer.Superelement | None", count: int = 5) -> np.ndarray:
    """Lowest whirl frequencies, rad/s, with the housing or on rigid ground."""
    size = 0 if housing is None else housing.order
    reach = np.zeros((4, size + len(m)))
    for row, (end, direction) in enumerate((end, direction) for end in (0, 1) for direction in ("x", "y")):
        reach[row, size + 4 * (6 * end) + "xy".index(direction)] = 1
        if housing is not None:
            at = [c.body == "centre" and c.node == end and c.direction == direction for c in housing.interface]
            reach[row, at.index(True)] = -1
    none = np.zeros((0, 0))
    mass = scipy.linalg.block_diag(none if housing is None else housing.mass, m)
    stiffness = scipy.linalg.block_diag(none if housing is None else housing.stiffness, k) + SPRING * reach.T @ reach
    turning = scipy.linalg.block_diag(np.zeros((size, size)), g * RPM * 2 * np.pi / 60)
    zero, one = np.zeros_like(mass), np.eye(len(mass))
    values, vectors = scipy.linalg.eig(np.block([[zero, one], [-stiffness, -turning]]), scipy.linalg.block_diag(one, mass))
    x = vectors[: len(mass)]
    share = [(v[size:].conj() @ m @ v[size:]).real / (v.conj() @ mass @ v).real for v in x.T]
    of_rotor = values[(values.imag > 1) & (np.array(share) > 0.5)]
    return np.sort(of_rotor.imag)[:count]


ground, coupled = lowest(None), lowest(frame)
print("rigid ground", np.round(ground, 2), "rad/s")
print("in the frame", np.round(coupled, 2))
print("change, %   ", np.round(100 * (coupled / ground - 1), 2))
assert (coupled < ground).all() and (coupled > 0.97 * ground).all()

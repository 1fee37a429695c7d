# %% [markdown]
# # From a gmsh model to modes in ParaView
#
# A pillow block is drawn in gmsh's Python interface, meshed, and handed over without a file. Needs gmsh, meshio, pandas.

# %%
import os
from pathlib import Path

import gmsh
import meshio
import numpy as np

import plummer

# the folder of the repository, from whichever folder of it the cells run
os.chdir(next(folder for folder in (Path.cwd(), *Path.cwd().parents) if (folder / "examples").is_dir()))
OUT = Path("out/notebooks")
OUT.mkdir(parents=True, exist_ok=True)


# %% [markdown]
# ## The model
# Lengths are millimetres here; `length_unit` says so below. Groups are named in gmsh, and the case refers to their names.


# %%
def draw(size: float) -> None:
    """A block of 60 x 50 x 20 mm with a bore of 30 mm on a foot, meshed with tetrahedra of second order of this size, mm."""
    gmsh.clear()
    gmsh.model.add("pillow block")
    occ = gmsh.model.occ
    foot = occ.addBox(-50, -30, -10, 100, 10, 20)
    block = occ.addBox(-30, -20.5, -10, 60, 50.5, 20)
    (body,), _ = occ.fuse([(3, foot)], [(3, block)])
    (body,), _ = occ.cut([body], [(3, occ.addCylinder(0, 0, -10, 0, 0, 20, 15))])
    occ.synchronize()
    surfaces = gmsh.model.getBoundary([body], oriented=False)
    bore = [tag for _, tag in surfaces if gmsh.model.getType(2, tag) == "Cylinder"]
    below = [tag for _, tag in surfaces if np.isclose(gmsh.model.occ.getCenterOfMass(2, tag)[1], -30)]
    gmsh.model.addPhysicalGroup(3, [body[1]], name="housing")
    gmsh.model.addPhysicalGroup(2, bore, name="bore")
    gmsh.model.addPhysicalGroup(2, below, name="feet")
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)
    gmsh.option.setNumber("Mesh.ElementOrder", 2)
    gmsh.model.mesh.generate(3)


gmsh.initialize()
gmsh.option.setNumber("General.Verbosity", 2)
draw(6.0)
mesh = plummer.Mesh.from_gmsh()
mesh

# %% [markdown]
# ## Modes
# A case is a dict with the keys of a case file. Its mesh is the one at hand.

# %%
case = plummer.Case(
    {
        "housing": {
            "mesh": mesh,
            "length_unit": "mm",
            "parts": [{"group": "housing", "material": "aluminium"}],
            "supports": [{"group": "feet", "fixed": ["x", "y", "z"]}],
        },
        "modes": {"count": 6},
    }
)
modes = case.modes()
modes.to_dataframe()

# %% [markdown]
# ## How much the mesh matters
# The solver's bounds say nothing of the mesh. Half the element size tells: frequencies fall towards the true ones.

# %%
draw(3.0)
finer = case.copy()
finer["housing.mesh"] = plummer.Mesh.from_gmsh()
change = finer.modes().frequencies_hz / modes.frequencies_hz - 1
gmsh.finalize()
print("change by half the size, %:", np.round(100 * change, 2))
assert (change < 1e-6).all() and (change > -0.02).all()
assert (modes.error_bounds_hz < 1e-6 * modes.frequencies_hz).all()

# %% [markdown]
# ## ParaView
# Open the file, then *Filters, Warp By Vector*.

# %%
file = OUT / "pillow_block_modes.vtu"
modes.to_meshio().write(file)
again = meshio.read(file)
assert np.allclose(again.point_data["mode 1"], modes.shapes[0])
print(f"{file}: {len(again.points)} nodes, fields {', '.join(again.point_data)}")

"""A pillow block condensed by Craig-Bampton: plummer beside SciPy with CHOLMOD and Exudyn, in seconds of the processor.

    pip install numpy "scipy>=1.11" scikit-sparse exudyn
    cargo build --release
    python3 benches/condensation.py [--repeats 3] [--programs plummer,scipy,exudyn]

The mesh is tests/data/pedestal_60k.msh (58 794 degrees of freedom), its feet fixed. Interface: 72 nodes of the bore, 216
degrees of freedom; 40 fixed-interface modes. Every figure is of a whole process: plummer reads the mesh, checks the
superelement, counts the modes and writes its report; the others read matrices of `plummer export --to npz`. SciPy
factorises by CHOLMOD, solves for the constraint modes, finds the modes by `eigsh` with that factor and forms the reduced
matrices. Exudyn's `HurtyCraigBampton` forms no reduced matrices. Programs take turns on one thread. CHOLMOD needs OpenBLAS
(libopenblas0-pthread): with the reference BLAS it takes twice as long.
"""

import argparse
import json
import pathlib
import statistics
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent
NODES, MODES, RADIUS = 72, 40, 6e-3
HOUSING = """
[housing]
mesh = "{mesh}"
length_unit = "m"
parts = [{{ group = "housing", material = "aluminium" }}]
supports = [{{ group = "feet", fixed = ["x", "y", "z"] }}]
"""
CONDENSE = """
[accuracy]
band_hz = [0, 40000]
target = 0.5
[condense]
interface = {{ nodes = {nodes} }}
fixed_interface_modes = {modes}
enhanced = false
"""


def matrices(folder):
    """K, M [n x n], and the rows of the interface [216]."""
    import numpy as np
    from scipy.sparse import load_npz

    stiffness, mass = (load_npz(f"{folder}/{name}.npz").tocsc() for name in ("stiffness", "mass"))
    dofs = np.load(f"{folder}/dofs.npz")
    return stiffness, mass, np.flatnonzero(np.isin(dofs["node"], interface(dofs)))


def interface(dofs):
    """Labels of 72 nodes of the bore, at equal distances in the list of all."""
    import numpy as np

    on_bore = abs(np.hypot(dofs["position_m"][:, 0], dofs["position_m"][:, 1]) - RADIUS) < 1e-6
    nodes = np.unique(dofs["node"][on_bore])
    return nodes[np.linspace(0, len(nodes) - 1, NODES).astype(int)]


def by_scipy(folder):
    """Frequencies of the fixed interface, Hz."""
    import numpy as np
    from scipy.sparse.linalg import LinearOperator, eigsh
    from sksparse.cholmod import cholesky

    k, m, held = matrices(folder)
    free = np.setdiff1d(np.arange(k.shape[0]), held)
    k_ii, m_ii = k[free][:, free], m[free][:, free]
    k_ib, m_ib = k[free][:, held].toarray(), m[free][:, held].toarray()
    factor = cholesky(k_ii)
    constraint = -factor(k_ib)
    inverse = LinearOperator(k_ii.shape, matvec=factor)
    values, modes = eigsh(k_ii, MODES, m_ii, sigma=0.0, which="LM", OPinv=inverse)
    _reduced = (
        k[held][:, held].toarray() + k_ib.T @ constraint,
        m[held][:, held].toarray() + constraint.T @ (m_ii @ constraint + m_ib) + m_ib.T @ constraint,
        modes.T @ (m_ii @ constraint + m_ib),
    )
    return np.sqrt(np.sort(values)) / (2 * np.pi)


def by_exudyn(folder):
    """The same."""
    import numpy as np
    from exudyn.FEM import FEMinterface, HCBstaticModeSelection

    k, m, held = matrices(folder)
    dofs = np.load(f"{folder}/dofs.npz")
    fem = FEMinterface()
    fem.nodes = {"Position": dofs["position_m"][::3]}
    fem.stiffnessMatrix, fem.massMatrix = k.tocsr(), m.tocsr()
    fem.ComputeHurtyCraigBamptonModes([list(held[::3] // 3)], MODES, excludeRigidBodyMotion=False,
                                      computationMode=HCBstaticModeSelection.allBoundaryNodes)
    return np.sqrt(np.sort(fem.eigenValues)) / (2 * np.pi)


PEERS = {"scipy": by_scipy, "exudyn": by_exudyn}


def main():
    import numpy as np
    from housings import PROGRAM, process

    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--programs", default="plummer,scipy,exudyn")
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    programs = options.programs.split(",")
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        case = folder / "case.toml"
        housing = HOUSING.format(mesh=ROOT / "tests/data/pedestal_60k.msh")
        case.write_text(housing)
        process([PROGRAM, "export", "--to", "npz", case, "--out", "matrices", "--quiet"], folder, 1)
        nodes = interface(np.load(folder / "matrices/dofs.npz"))
        case.write_text(housing + CONDENSE.format(nodes=[int(node) for node in nodes], modes=MODES))
        condense = [PROGRAM, "condense", case, "--threads", "1", "--out", "superelement"]
        condense += ["--force", "--no-cache", "--quiet"]
        found = {program: [] for program in programs}
        expected = None
        for _ in range(options.repeats):
            for program in programs:
                peer = [sys.executable, __file__, "--peer", program, "matrices"]
                figures, text = process(condense if program == "plummer" else peer, folder, 1)
                if program == "plummer":
                    hz = np.load(folder / "superelement/superelement.npz")["modal_hz"]
                else:
                    hz = np.array(json.loads(text.splitlines()[-1]))
                expected = hz if expected is None else expected
                found[program].append((figures, abs(hz / expected - 1).max()))
    median = lambda runs, key: statistics.median(run[key] for run, _ in runs)
    middle = {of: {key: median(runs, key) for key in ("cpu", "mib")} for of, runs in found.items()}
    print("| program | CPU, s | median | peak, MiB | CPU of plummer over its | frequencies differ by |")
    print("|---|---|---|---|---|---|")
    for program, of in middle.items():
        runs = ", ".join(f"{run['cpu']:.2f}" for run, _ in found[program])
        ratio = f"{middle['plummer']['cpu'] / of['cpu']:.3f}" if "plummer" in middle and program != "plummer" else ""
        apart = max(apart for _, apart in found[program])
        print(f"| {program} | {runs} | {of['cpu']:.2f} | {of['mib']:.0f} | {ratio} | {apart:.1e} |")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--peer"]:
        print(json.dumps(list(PEERS[sys.argv[2]](sys.argv[3]))))
    else:
        main()

"""A rotor of ROSS on rigid ground, and in the condensed housing of plummer; the same in the housing's full matrices.

    plummer condense examples/housings/rotor_frame.toml --out out/frame
    plummer export examples/housings/rotor_frame.toml --to npz --out out/frame_full
    python3 docs/python/rotor_ross.py examples/housings/rotor_frame.toml out/frame out/frame_full
                                           # needs numpy, scipy, "ross-rotordynamics==2.3.0", "plotly<6"

The rotor is that of Friswell, Penny, Garvey and Lees, Dynamics of Rotating Machines (2010), example 5.9.1. Bearings are springs
and dampers across the axis, between a node of the shaft and a centre node. Axes are those of the mesh, the shaft along z.
"""

import json
import sys
import tomllib

import numpy as np
import ross
import scipy
import scipy.linalg
import scipy.sparse as sparse
from scipy.sparse.linalg import LinearOperator, eigs, splu

PUBLISHED = {0: (86.66, 86.66, 274.31, 274.31, 716.78), 4000: (85.39, 87.80, 251.78, 294.71, 600.18)}  # rad/s
WITHIN = 1e-4  # of the published values, which have four or five digits
SEATS = (0, 6)  # the shaft's nodes in the two bearings
BORE = (45e-3, 20e-3)  # radius and length, m: the bore's nodes in the full model


def rotor(stiffness=None):
    """The shaft with its disks, alone or on springs (N/m) to rigid ground."""
    steel = ross.Material("steel_5_9_1", rho=7810, E=211e9, G_s=81.2e9)
    shaft = [ross.ShaftElement(0.25, 0, 0.05, material=steel) for _ in range(6)]
    disks = [ross.DiskElement.from_geometry(n, steel, 0.07, 0.05, d) for n, d in ((2, 0.28), (4, 0.35))]
    return ross.Rotor(shaft, disks, [ross.BearingElement(n, kxx=stiffness, cxx=0) for n in SEATS] if stiffness else [])


def shaft_matrices():
    """M, K, gyroscopic matrix per rad/s, and the rows of x and y at the seats: motions across the axis alone."""
    alone = rotor()
    across = np.flatnonzero(np.isin(np.arange(alone.ndof) % 6, (0, 1, 3, 4)))  # x, y, turns about x and y; not z, turn about z
    seats = sparse.lil_array((4, len(across)))
    for row, (node, axis) in enumerate((n, axis) for n in SEATS for axis in (0, 1)):
        seats[row, 4 * node + axis] = 1
    m, k, g = (np.asarray(a)[np.ix_(across, across)] for a in (alone.M(), alone.K(0), alone.G()))
    turn = np.zeros((len(alone.nodes_pos), 4, 2))  # right-handed turns about x and y move no spring of the shaft
    turn[:, 1, 0], turn[:, 0, 1], turn[:, 2, 0], turn[:, 3, 1] = -np.array(alone.nodes_pos), alone.nodes_pos, 1, 1
    assert abs(k @ turn.reshape(-1, 2)).max() < 1e-8 * abs(k).max(), "other axes of the shaft than expected"
    return m, k, g, seats


def condensed(folder):
    """M, K of the superelement, and the rows of x and y at its centre nodes."""
    s = np.load(f"{folder}/superelement.npz")
    node, component = s["interface_dofs"].T  # component 1 to 3 along x, y, z; 4 to 6 about them; rows of modes come after
    rows = [np.flatnonzero((node == n) & (component == c)) for n in (0, 1) for c in (1, 2)]
    return s["m"], s["k"], sparse.csr_array(np.eye(len(s["k"]))[np.concatenate(rows)])


def full(folder, centres):
    """M, K of all nodes of the housing, tied here, and the same rows of the centre nodes."""
    m, k = (sparse.csr_array(sparse.load_npz(f"{folder}/{name}.npz")) for name in ("mass", "stiffness"))
    position, axis = (np.load(f"{folder}/dofs.npz")[name] for name in ("position_m", "axis"))
    radius, length = BORE
    driven, motions, means = np.zeros(len(position), bool), [], []
    for centre in centres:
        arm = position - centre["point"]
        bore = (abs(np.hypot(*arm.T[:2]) / radius - 1) < 1e-3) & (abs(arm[:, 2]) < 0.501 * length)
        motion = np.hstack([axis, np.cross(arm, axis)]) * bore[:, None]  # of each row by the centre's six motions
        if centre["tie"] == "rigid":
            driven |= bore
            motions.append(motion)
            means.append(None)
        else:
            means.append(np.linalg.solve(motion.T @ motion, motion.T)[:2])
    free = sparse.eye_array(len(position), format="csc")[:, ~driven]
    tie = sparse.hstack([free, *motions]).tocsr()
    rows, at = [], free.shape[1]
    for mean in means:
        if mean is None:
            rows.append(sparse.eye_array(2, tie.shape[1], k=at))
            at += 6
        else:
            rows.append(sparse.csr_array(mean) @ tie)
    return tie.T @ m @ tie, tie.T @ k @ tie, sparse.vstack(rows)


def eigenvalues(shaft, housing, spring, damper, rpm, count=5):
    """Lowest eigenvalues (rad/s, imaginary part > 0) whose motion is the rotor's by more than half."""
    m, k, g, seats = shaft
    if housing is None:
        mass, stiffness, reach = sparse.csc_array(m), sparse.csc_array(k), -seats
    else:
        mass, stiffness = (sparse.block_diag(pair) for pair in ((housing[0], m), (housing[1], k)))
        reach = sparse.hstack([housing[2], -seats])
    n, first = mass.shape[0], mass.shape[0] - len(m)
    stiffness = (stiffness + spring * reach.T @ reach).tocsc()
    turning = sparse.block_diag([sparse.csr_array((first, first)), g * rpm * 2 * np.pi / 60])
    damping = (damper * reach.T @ reach + turning).tocsc()
    if n < 200:
        a = np.block([[np.zeros((n, n)), np.eye(n)], [-stiffness.toarray(), -damping.toarray()]])
        b = scipy.linalg.block_diag(np.eye(n), mass.toarray())
        values, vectors = scipy.linalg.eig(a, b)
    else:  # the inverse at a shift s takes (u, v) to (x, s x + u) with (s^2 M + s C + K) x = -(M v + (C + s M) u)
        s = 1j * 400.0
        at_shift = (s * s * mass + s * damping + stiffness).tocsc()
        solve = splu(at_shift, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.01, options={"SymmetricMode": True}).solve

        def inverse(w):
            x = solve(-(mass @ w[n:] + damping @ w[:n] + s * (mass @ w[:n])))
            return np.concatenate([x, s * x + w[:n]])

        nu, vectors = eigs(LinearOperator((2 * n, 2 * n), inverse, dtype=complex), k=20, tol=1e-12)
        values = s + 1 / nu
    x = vectors[:n]
    of_rotor = np.einsum("ij,ij->j", x[first:].conj(), m @ x[first:]).real
    share = of_rotor / np.einsum("ij,ij->j", x.conj(), mass @ x).real
    kept = values[(values.imag > 1) & (share > 0.5)]
    return kept[np.argsort(abs(kept))][:count]


def numbers(values, digits=2):
    return " ".join(f"{value:8.{digits}f}" for value in values)


case, small, large = sys.argv[1:]
print(f"ROSS {ross.__version__}, SciPy {scipy.__version__}, NumPy {np.__version__}")
good = True
for rpm, published in PUBLISHED.items():
    left = list(rotor(1e6).run_modal(rpm * 2 * np.pi / 60, num_modes=24).wn)  # those along and about the axis among them
    found = [left.pop(np.argmin(abs(np.array(left) - value))) for value in published]
    good &= np.allclose(found, published, rtol=WITHIN, atol=0)
    print(f"rigid ground, 1e6 N/m, {rpm:4} rpm: ROSS      {numbers(found)} rad/s")
    print(f"                                  published {numbers(published)}")

estimate = json.load(open(f"{small}/condense.json"))
predicted, top = estimate["estimate"]["largest"], estimate["band_hz"]
centres = tomllib.load(open(case, "rb"))["condense"]["interface"]["centres"]
shaft, ours, whole = shaft_matrices(), condensed(small), full(large, centres)
print(f"housing: {len(ours[0])} coordinates for {whole[0].shape[0]}; estimated error {predicted:.1e} up to {top:.0f} Hz")
for spring, damper in ((1e6, 0.0), (1e8, 1e5)):
    for rpm in PUBLISHED:
        ground, coupled, truth = (eigenvalues(shaft, h, spring, damper, rpm) for h in (None, ours, whole))
        error = max(abs(coupled / truth - 1))
        good &= error < predicted
        print(f"{spring:.0e} N/m, {damper:.0f} N s/m, {rpm} rpm")
        print(f"  rigid ground  {numbers(abs(ground))} rad/s")
        print(f"  housing       {numbers(abs(coupled))}")
        print(f"  change, %     {numbers(100 * (abs(coupled) / abs(ground) - 1))}")
        if damper:
            print(f"  damping ratio {numbers(-100 * ground.real / abs(ground), 3)} % on rigid ground")
            print(f"                {numbers(-100 * coupled.real / abs(coupled), 3)} % in the housing")
        print(f"  largest difference from the full matrices {error:.1e}")
print("agreement within what is stated:", good)
sys.exit(0 if good else 1)

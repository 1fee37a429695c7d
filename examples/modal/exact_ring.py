"""Free vibration of an annulus in plane stress, exactly: writes exact_ring.csv, which ring.toml compares with.

Displacement from two potentials, phi = [A J_n(a r) + B Y_n(a r)] cos(n t) and psi = [C J_n(b r) + D Y_n(b r)] sin(n t):

    u_r = phi_r + psi_t / r        a = w / c_L, c_L^2 = E / (rho (1 - nu^2))
    u_t = phi_t / r - psi_r        b = w / c_T, c_T^2 = G / rho

Both edges are free: sigma_rr = tau_rt = 0 at r = inner and r = outer; w where the determinant of these four equations is
zero. Source: Graff, Wave Motion in Elastic Solids (1975), for the potentials. Needs numpy and scipy:

    python3 exact_ring.py > exact_ring.csv
"""

import numpy as np
from scipy.optimize import brentq
from scipy.special import jv, jvp, yv, yvp

YOUNG, POISSON, DENSITY = 72e9, 0.33, 2700.0
INNER, OUTER = 6e-3, 9e-3
HIGHEST_HZ = 160e3
ANGLES = np.radians(np.arange(0, 360, 15))
SHEAR = YOUNG / (2 * (1 + POISSON))
LAME = 2 * SHEAR * POISSON / (1 - POISSON)  # plane stress
LONG = np.sqrt(YOUNG / (DENSITY * (1 - POISSON**2)))
TRANSVERSE = np.sqrt(SHEAR / DENSITY)


def columns(n, w, r):
    """(u_r, u_t, sigma_rr, tau_rt) at r for each of A, B, C, D, without cos(n t) or sin(n t)."""
    found = []
    for speed, of_phi in ((LONG, True), (TRANSVERSE, False)):
        k = w / speed
        for value, slope in ((jv, jvp), (yv, yvp)):
            f, d, dd = value(n, k * r), k * slope(n, k * r, 1), k * k * slope(n, k * r, 2)
            if of_phi:
                u, v, du, dv = d, -n * f / r, dd, -n * (d / r - f / r**2)
            else:
                u, v, du, dv = n * f / r, -d, n * (d / r - f / r**2), -dd
            radial = (LAME + 2 * SHEAR) * du + LAME * (u + n * v) / r
            shear = SHEAR * (-n * u / r + dv - v / r)
            found.append((u, v, radial, shear))
    return np.array(found).T


def edges(n, w):
    matrix = np.vstack([columns(n, w, r)[2:] for r in (INNER, OUTER)])
    return matrix / np.abs(matrix).max(axis=0)


def modes():
    """(Hz, n, coefficients), by frequency."""
    found = []
    w = 2 * np.pi * np.linspace(2e3, HIGHEST_HZ, 2000)
    for n in range(12):
        # of n = 0 the breathing motion alone: A and B, and no shear
        pick = np.ix_([0, 2], [0, 1]) if n == 0 else np.ix_(range(4), range(4))
        value = lambda x: np.linalg.det(edges(n, x)[pick])
        values = [value(x) for x in w]
        for a, b, fa, fb in zip(w, w[1:], values, values[1:]):
            if fa * fb < 0:
                root = brentq(value, a, b, xtol=1e-6, rtol=1e-14)
                raw = np.vstack([columns(n, root, r)[2:] for r in (INNER, OUTER)])
                scale = np.abs(raw).max(axis=0)
                null = np.linalg.svd((raw / scale)[pick])[2][-1]
                coefficients = np.zeros(4)
                coefficients[: len(null)] = null / scale[: len(null)]
                found.append((root / (2 * np.pi), n, coefficients))
    return sorted(found, key=lambda mode: mode[0])


def main():
    print("# annulus 6 to 9 mm in plane stress, free: exact, by exact_ring.py")
    print("mode,frequency_hz,x,y,z,ux,uy,uz")
    number = 0
    for hz, n, coefficients in modes():
        # every n > 0 twice, a quarter of a wave apart
        for turn in [0.0] if n == 0 else [0.0, np.pi / (2 * n)]:
            number += 1
            rows = []
            for r in (INNER, OUTER):
                u, v = columns(n, 2 * np.pi * hz, r)[:2] @ coefficients
                for t in ANGLES:
                    radial, along = u * np.cos(n * (t - turn)), v * np.sin(n * (t - turn))
                    c, s = np.cos(t), np.sin(t)
                    rows.append((r * c, r * s, radial * c - along * s, radial * s + along * c))
            rows = np.array(rows)
            rows[:, 2:] /= np.abs(rows[:, 2:]).max()
            for x, y, ux, uy in rows:
                print(f"{number},{hz:.4f},{x + 0:.7f},{y + 0:.7f},0,{ux + 0:.5f},{uy + 0:.5f},0")


main()

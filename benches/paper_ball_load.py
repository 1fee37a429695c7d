"""Amplitudes of Tadina & Boltezar (2011) by what (15) loads a ball with, in one table.

    pip install numpy
    cargo build --release
    python3 benches/paper_ball_load.py [--plummer PROGRAM] [--beta 1.5e-6]

(15) prints the centrifugal load as `rho omega^2`: without the ball's mass, and with an omega that has no index. plummer
takes `m_b rho omega_c^2` with the cage's speed and has no key for anything else. So this script steps the printed
equations (1) to (19) itself, all rows at once: central differences, no contact damping, the ring's modes below 200 kHz
from `plummer export examples/tadina2011/beam.toml`, Table 1's stiffness on race and dent alike, dents and flat in the
plane with their vertical walls, as (20), (27), (29) and (32) have them. Its row of the cage's speed is the check: plummer
computes the same. The starts differ by where the shaft is let go.

Acceleration at P1 below 45 kHz from 2.2 to 2.8 s, m/s^2: 99.9th percentile of the magnitude for each start (smallest and
largest, medians of the starts).
"""

import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

PROGRAM = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", "target"), "release/plummer")

TAU = 2 * np.pi
OUTER, INNER, BALL, BALL_MASS, COUNT = 4.7565e-3, 2.754e-3, 1e-3, 3.29e-5, 7
K_INNER, K_OUTER, PLAY = 3.828e9, 3.867e9, 2.5e-6
SHAFT_MASS, UNBALANCE, GRAVITY = 0.15, 2e-5, 9.81
GAMMA = 2 * BALL / (OUTER + INNER)
CAGE, SPIN = (1 - GAMMA) / 2, (1 - GAMMA**2) / (2 * GAMMA)
# 10 Hz a second from 0.2 s on
BEGIN, ACCELERATION = 0.2, 20 * np.pi
# What the release makes has died away by 2.2 s: the shaft is braked for 20 ms. 22 steps a vibration of 150 kHz.
START, FROM, END, BRAKED, BRAKE, STEP, EVERY = 2.17, 2.2, 2.8, 0.02, 2000.0, 3e-7, 4
KINDS = ("healthy", "outer", "inner", "flat")
# What a ball is loaded with: factor on m_b rho omega_c^2, weight or none, and the name.
LOADS = (
    (1.0, 1.0, "m_b rho omega_c^2, the cage's speed (plummer's)"),
    (1.0, 0.0, "the same, balls without weight"),
    (1 / CAGE**2, 1.0, "m_b rho omega_s^2, the shaft's speed"),
    (1 / BALL_MASS, 1.0, "rho omega_c^2 as printed, without m_b"),
)
# How much below first contact the shaft is let go; the others begin at the first alone.
STARTS, MANY_STARTS = (3e-7, 1e-7, 5e-7), 2


def ring(program):
    """Radial shapes on 7200 places [place, mode], mean motion [mode, 2], P1's row and angular frequencies."""
    with tempfile.TemporaryDirectory() as folder:
        case = pathlib.Path(__file__).parent.parent / "examples/tadina2011/beam.toml"
        command = [program, "export", case, "--to", "npz", "--out", folder, "--force", "--quiet", "--set", "modes.count=12"]
        subprocess.run([str(word) for word in command], check=True)
        with np.load(f"{folder}/modes.npz") as held:
            frequencies, shapes, nodes = held["frequencies_hz"], held["shapes"][:, :, :2], held["nodes"]
    angle = np.arctan2(nodes[:, 1], nodes[:, 0])
    radial = (shapes * np.column_stack([np.cos(angle), np.sin(angle)])).sum(axis=2)
    radial = radial[:, np.argsort(np.round(np.mod(angle, TAU), 9))]
    places, count = 7200, len(nodes)
    waves = np.zeros((len(frequencies), places // 2 + 1), complex)
    waves[:, : count // 2 + 1] = np.fft.rfft(radial)
    waves[:, count // 2] /= 2
    fine = np.fft.irfft(waves, places) * places / count
    top = shapes[:, np.argmin(abs(angle - TAU / 4)), 1]
    return np.ascontiguousarray(fine.T), shapes.mean(axis=1), top, TAU * frequencies


class Dent:
    """How far a ball can go beyond the round surface, and the cosine of its contact's angle, over the angle from the middle."""

    def __init__(self, angles, radii, roller, rest, along, root):
        """Profile points; the other's radius; the distance of centres when round; signs of its two parts, see below."""
        self.grid = np.linspace(-0.3, 0.3, 3001)
        # |point - centre| is the other's radius where a point touches; the first point that does so holds the ball
        across = radii[:, None] * np.sin(angles[:, None] - self.grid)
        reached = abs(across) < roller
        touching = along * radii[:, None] * np.cos(angles[:, None] - self.grid)
        touching += root * np.sqrt(np.maximum(roller**2 - across**2, 0))
        outside = -1 if (along, root) == (1, 1) else 1
        distance = outside * np.where(reached, outside * touching, np.inf).min(axis=0)
        self.drop = np.maximum(outside * (distance - rest), 0)
        # beside the dent the round surface holds the ball
        self.drop[abs(self.grid) > abs(angles).max()] = 0
        self.cosine = 1 / np.sqrt(1 + (np.gradient(self.drop, self.grid) / rest) ** 2)

    def at(self, angle):
        angle = np.mod(angle + np.pi, TAU) - np.pi
        return np.interp(angle, self.grid, self.drop, 0, 0), np.interp(angle, self.grid, self.cosine, 1, 1)


def dents():
    """In the outer and the inner race, and the flat against the inner and the outer race."""
    turn = np.linspace(-np.pi / 2, np.pi / 2, 2001)

    def ellipse(radius, sense, half, depth):
        return half * np.sin(turn) / radius, radius + sense * depth * np.cos(turn)

    # an arc of 2 mm that takes 10 um off the ball
    flat, centre = np.linspace(-0.3, 0.3, 2001), 2e-3 - BALL + 1e-5
    arc = np.minimum(BALL, np.sqrt(4e-6 - (centre * np.sin(flat)) ** 2) - centre * np.cos(flat))
    return (
        Dent(*ellipse(OUTER, 1, 0.375e-3, 15e-6), BALL, OUTER - BALL, 1, -1),
        Dent(*ellipse(INNER, -1, 0.4e-3, 15e-6), BALL, INNER + BALL, 1, 1),
        Dent(flat, arc, INNER, INNER + BALL, 1, 1),
        Dent(flat, arc, OUTER, OUTER - BALL, -1, 1),
    )


def simulated(rows, structure, beta):
    """Acceleration at P1 [sample, row] of (kind, factor, weight, start), and the sampling rate."""
    fine, mean, top, omega = structure
    kinds = np.array([row[0] for row in rows])
    factor, weight, start = (np.array([row[i] for row in rows])[:, None] for i in (1, 2, 3))
    on = {kind: (kinds == kind)[:, None] for kind in KINDS}
    flat_ball = on["flat"] & (np.arange(COUNT) == 0)
    outer, inner, flat_inner, flat_outer = dents()
    count, places = len(rows), len(fine)
    q, s, x = np.zeros((count, len(omega))), np.zeros((count, COUNT)), np.zeros((count, 2))
    x[:, 1] = -(PLAY + start[:, 0])
    v, s_rate, x_rate = np.zeros_like(q), np.zeros_like(s), np.zeros_like(x)
    damping, stiffness = beta * omega**2, omega**2
    first = TAU * 0.75 + np.arange(COUNT) * TAU / COUNT

    def accelerations(time):
        speed = ACCELERATION * (time - BEGIN)
        shaft = speed * (time - BEGIN) / 2
        angle = first + CAGE * shaft
        cos, sin = np.cos(angle), np.sin(angle)
        shapes = fine[(np.mod(angle, TAU) * (places / TAU) + 0.5).astype(int) % places]
        offset = x - q @ mean
        rho = OUTER - BALL + s
        bx, by = rho * cos - offset[:, :1], rho * sin - offset[:, 1:]
        chi = np.sqrt(bx * bx + by * by)
        nx, ny = bx / chi, by / chi
        outside, inside = s - q @ shapes.T, INNER + BALL - chi
        cos_outer = cos_inner = 1.0
        drop, cosine = outer.at(angle - 0.75 * TAU)
        if drop.any():
            cos_outer = np.where(on["outer"], cosine, 1.0)
            outside = (outside - on["outer"] * drop) * cos_outer
        drop, cosine = inner.at(angle - shaft)
        if drop.any():
            cos_inner = np.where(on["inner"], cosine, 1.0)
            inside = (inside - on["inner"] * drop) * cos_inner
        near = [flat_outer.at(SPIN * shaft), flat_inner.at(SPIN * shaft - np.pi)]
        if near[0][0] or near[1][0]:
            tilts = [np.where(flat_ball, cosine, 1.0) for _, cosine in near]
            outside, inside = (outside - flat_ball * near[0][0]) * tilts[0], (inside - flat_ball * near[1][0]) * tilts[1]
            cos_outer, cos_inner = cos_outer * tilts[0], cos_inner * tilts[1]
        outside, inside = np.maximum(outside, 0), np.maximum(inside, 0)
        force_outer = K_OUTER * outside * np.sqrt(outside) * cos_outer
        force_inner = K_INNER * inside * np.sqrt(inside) * cos_inner
        q_2 = force_outer @ shapes - damping * v - stiffness * q
        centre_2 = q_2 @ mean
        s_2 = (force_inner * (nx * cos + ny * sin) - force_outer) / BALL_MASS + factor * rho * (CAGE * speed) ** 2
        s_2 -= weight * (GRAVITY * sin) + centre_2[:, :1] * cos + centre_2[:, 1:] * sin
        # the unbalance m e (omega^2 - its angular acceleration across)
        c, d = np.cos(shaft), np.sin(shaft)
        x_2 = np.empty_like(x)
        x_2[:, 0] = UNBALANCE * (speed**2 * c + ACCELERATION * d) - (force_inner * nx).sum(axis=1)
        x_2[:, 1] = UNBALANCE * (speed**2 * d - ACCELERATION * c) - (force_inner * ny).sum(axis=1)
        x_2 /= SHAFT_MASS
        x_2[:, 1] -= GRAVITY
        if time < START + BRAKED:
            x_2 -= BRAKE * x_rate
        return q_2, s_2, x_2

    steps, kept = round((END - START) / STEP), []
    now = accelerations(START)
    for step in range(1, steps + 1):
        for place, rate, second in zip((q, s, x), (v, s_rate, x_rate), now):
            rate += STEP / 2 * second
            place += STEP * rate
        now = accelerations(START + step * STEP)
        for rate, second in zip((v, s_rate, x_rate), now):
            rate += STEP / 2 * second
        if step % EVERY == 0 and START + step * STEP >= FROM:
            kept.append(now[0] @ top)
    return np.array(kept), 1 / (STEP * EVERY)


def below(signals, rate, corner):
    lines = np.fft.rfft(signals, axis=0)
    lines[np.fft.rfftfreq(len(signals), 1 / rate) > corner] = 0
    return np.fft.irfft(lines, len(signals), axis=0)


def main():
    as_written = argparse.RawDescriptionHelpFormatter
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=as_written)
    arguments.add_argument("--plummer", type=pathlib.Path, default=PROGRAM)
    arguments.add_argument("--beta", type=float, default=1.5e-6, help="s; C = beta K, (17)")
    asked = arguments.parse_args()
    if not asked.plummer.exists():
        sys.exit(f"no program at {asked.plummer}: cargo build --release, or --plummer")
    begins = [STARTS if i == MANY_STARTS else STARTS[:1] for i in range(len(LOADS))]
    held = np.sqrt(GRAVITY / (OUTER - BALL)) / CAGE / TAU
    print(f"At the top a ball's weight exceeds its load up to {held:.1f} Hz of the shaft; with the shaft's speed in (15) the")
    print(f"load is {1 / CAGE**2:.2f} times as large, and at 20 Hz {(OUTER - BALL) * (20 * TAU) ** 2 / GRAVITY:.1f} weights.\n")
    rows = [(kind, *load[:2], start) for load, starts in zip(LOADS, begins) for start in starts for kind in KINDS]
    signals, rate = simulated(rows, ring(asked.plummer), asked.beta)
    signals = below(signals, rate, 45e3)
    print("| a ball's load | " + " | ".join(KINDS) + " |\n|---|---|---|---|---|")
    for factor, weight, name in LOADS:
        cells = []
        for kind in KINDS:
            own = [signals[:, i] for i, row in enumerate(rows) if row[:3] == (kind, factor, weight)]
            percentiles = ", ".join(f"{np.percentile(abs(x), 99.9):.0f}" for x in own)
            smallest, largest = (np.median([extreme(x) for x in own]) for extreme in (np.min, np.max))
            cells.append(f"{percentiles} ({smallest:.0f}, {largest:.0f})")
        print(f"| {name} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()

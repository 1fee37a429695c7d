"""Writes the files of this folder: python3 make.py (NumPy 2.4.6, SciPy 1.17.1).

Signals are x_k = sin(0.7 k) + k / 8, or the whole numbers nearest to 10 x_k + 2. plain.mat: variables and a time in ms, not packed.
classes.mat: an array of every class, packed. bench.mat: tables, a struct with a rate and a speed, an array of structs, and
what is no signal, packed.
big.mat: high bytes first, doubles stored as narrower whole numbers, packed and not; SciPy has no such writer.
four.mat: version 4.
"""

import struct
import zlib
from pathlib import Path

import numpy as np
import scipy.sparse
from scipy.io import loadmat, savemat

HERE = Path(__file__).parent
k = np.arange(12)
x = np.sin(0.7 * k) + k / 8
whole = np.round(10 * x + 2)


def same_bytes(path):
    """The head has the day on which the file was written."""
    content = bytearray(path.read_bytes())
    content[:116] = b"MATLAB 5.0 MAT-file, written by make.py".ljust(116)
    path.write_bytes(content)


plain = {"x": x, "time_ms": 500 + 4.0 * k, "X105RPM": np.uint16([1797]), "short": x[:5], "load": 2.0}
savemat(HERE / "plain.mat", plain)
same_bytes(HERE / "plain.mat")

classes = {f"{np.dtype(t).name}": whole.astype(t) for t in "bBhHiIqQfd"}
cell = np.empty(2, dtype=object)
cell[:] = [x, "text"]
runs = np.zeros(2, dtype=[("x", object), ("fs", object)])
runs["x"], runs["fs"] = [x, -x[:7]], [100.0, 200.0]
savemat(HERE / "classes.mat", {**classes, "logical": whole > 5}, do_compression=True)
same_bytes(HERE / "classes.mat")
bench = {
    "fs": 1000.0,
    "tall": np.stack([x, 2 * x], axis=1),
    "wide": np.stack([x, 2 * x]),
    "solid": np.ones((2, 3, 4)),
    "spectrum": x * (1 + 2j),
    "empty": np.zeros((0, 3)),
    "sparse": scipy.sparse.csc_matrix(np.diag(x)),
    "words": "a text",
    "cell": cell,
    "bearing": {
        "rate": np.uint8(25), "load": "25", "gs": x.reshape(-1, 1), "sr": np.uint16(48828), "in": {"deep": -x, "RPM": 90.0},
    },
    "run": runs,
}
savemat(HERE / "bench.mat", bench, do_compression=True)
same_bytes(HERE / "bench.mat")

savemat(HERE / "four.mat", {"x": x}, format="4")


def element(kind, data):
    if len(data) <= 4:
        return struct.pack(">HH", len(data), kind) + data.ljust(4, b"\0")
    return struct.pack(">II", kind, len(data)) + data.ljust(-(-len(data) // 8) * 8, b"\0")


def array(name, kind, code, values):
    parts = element(6, struct.pack(">II", 6, 0))
    parts += element(5, struct.pack(">ii", len(values), 1)) + element(1, name.encode())
    parts += element(kind, np.asarray(values).astype(f">{code}").tobytes())
    return struct.pack(">II", 14, len(parts)) + parts


stored = [("i1", 1), ("u1", 2), ("i2", 3), ("u2", 4), ("i4", 5), ("u4", 6), ("f4", 7), ("f8", 9), ("i8", 12), ("u8", 13)]
big = b"MATLAB 5.0 MAT-file, written by make.py".ljust(124) + b"\x01\x00MI"
for code, kind in stored:
    big += array(code, kind, code, whole)
packed = zlib.compress(array("packed", 9, "f8", x))
big += struct.pack(">II", 15, len(packed)) + packed + array("Fs", 4, "u2", [50000])
(HERE / "big.mat").write_bytes(big)

for name, expected in {code: whole for code, _ in stored}.items():
    assert np.array_equal(loadmat(HERE / "big.mat")[name].ravel(), expected), name
assert np.array_equal(loadmat(HERE / "big.mat")["packed"].ravel(), x)

"""Housings of ball bearings in Python: modes, superelements, transfer paths, simulated faults and their diagnosis.

>>> import plummer
>>> case = plummer.Case.load("examples/modal/ring.toml")
>>> modes = case.modes()
>>> print(f"{modes.frequencies_hz[3]:.0f} Hz")
31720 Hz

Everything is in SI units unless a name says otherwise (``_hz``, ``_deg``). Results are those of the command ``plummer``, bit for bit.
"""

from __future__ import annotations

from ._errors import (
    BlewUp,
    CaseError,
    ComputationError,
    Error,
    FileError,
    InputError,
    Interrupted,
    MeshError,
    SignalWarning,
    UntrustedWarning,
)

try:
    from ._plummer import set_threads, threads
except ImportError as error:  # pragma: no cover - a machine without ARPACK
    if "arpack" in str(error) or "lapack" in str(error) or "blas" in str(error):
        raise ImportError(
            f"{error}\nhelp: this build of plummer needs ARPACK of the system: apt-get install libarpack2 (Debian, Ubuntu), "
            "dnf install arpack (Fedora)"
        ) from error
    raise

from ._analysis import Analysis, analyze
from ._case import Case
from ._condense import Coordinate, Superelement
from ._dataset import Dataset, dataset
from ._frf import Frf, TransferPath
from ._mesh import Mesh
from ._modes import Modes
from ._result import Result
from ._run import Run, Signal, Signals



def __getattr__(name: str) -> str:
    if name == "__version__":
        from importlib.metadata import version

        return version(__name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


__all__ = [
    "Analysis",
    "BlewUp",
    "Case",
    "CaseError",
    "ComputationError",
    "Coordinate",
    "Dataset",
    "Error",
    "FileError",
    "Frf",
    "InputError",
    "Interrupted",
    "Mesh",
    "MeshError",
    "Modes",
    "Result",
    "Run",
    "Signal",
    "SignalWarning",
    "Signals",
    "Superelement",
    "TransferPath",
    "UntrustedWarning",
    "analyze",
    "dataset",
    "set_threads",
    "threads",
]

for _name in __all__:
    # what messages and documents call them
    globals()[_name].__module__ = __name__

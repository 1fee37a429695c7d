"""What a user writes, checked by mypy --strict."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

import plummer


def first_elastic(path: str, count: int) -> float:
    case = plummer.Case.load(path, set={"modes.count": count})
    modes: plummer.Modes = case.modes(progress=True)
    frequencies: NDArray[np.float64] = modes.frequencies_hz
    return float(frequencies[modes.rigid])


def levels(path: str) -> dict[str, float]:
    case = plummer.Case.load(path)
    case["bearing.defects.0.depth"] = 2e-5
    run = case.run()
    return {name: float(np.sqrt(np.mean(signal.values**2))) for name, signal in run.items()}


def damaged(values: NDArray[np.float64]) -> list[str]:
    try:
        return plummer.analyze(values, rate_hz=12000, bearing="6205", speed_hz=29.95).indicated
    except plummer.InputError as error:
        return [error.help or error.what]


def superelement(path: str) -> tuple[NDArray[np.float64], list[str]]:
    element = plummer.Case.load(path).condense(compare_full=True)
    return element.stiffness, element.names

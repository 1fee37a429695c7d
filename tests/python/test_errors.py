"""Errors by kind, with the program's words."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest

import plummer

RING = "examples/modal/ring.toml"


def test_a_case_that_is_wrong_says_where_and_what_helps() -> None:
    with pytest.raises(plummer.CaseError) as caught:
        plummer.Case.load(RING, set={"modes.cuont": 3})
    assert caught.value.what == "--set modes.cuont=3: unknown key `modes.cuont`"
    assert caught.value.help and caught.value.help.startswith("did you mean `count`?")
    assert str(caught.value) == f"{caught.value.what}\nhelp: {caught.value.help}"


def test_kinds_are_those_of_python_too() -> None:
    assert issubclass(plummer.CaseError, ValueError) and issubclass(plummer.MeshError, plummer.InputError)
    assert issubclass(plummer.ComputationError, RuntimeError) and issubclass(plummer.FileError, OSError)
    assert issubclass(plummer.Interrupted, KeyboardInterrupt)
    error = pickle.loads(pickle.dumps(plummer.CaseError("wrong", "right")))
    assert (error.what, error.help) == ("wrong", "right")


def test_a_case_without_what_a_computation_needs() -> None:
    with pytest.raises(plummer.CaseError, match=r"`frf` needs \[frf\]"):
        plummer.Case.load(RING).frf()
    with pytest.raises(plummer.CaseError, match="cannot read the case file"):
        plummer.Case.load("nothing.toml")


def test_a_mesh_that_is_not_there_or_lacks_a_group(tmp_path: Path) -> None:
    with pytest.raises(plummer.MeshError, match="cannot read the mesh"):
        plummer.Case.load(RING, set={"housing.mesh": "nothing.msh", "modes": {"count": 3}}).modes()
    with pytest.raises(plummer.InputError, match="nobody"):
        plummer.Case.load(RING, set={"housing.parts.0.group": "nobody"}).modes()


def test_a_signal_that_cannot_be_judged() -> None:
    signal = np.zeros(100)
    with pytest.raises(plummer.InputError, match="expected a bearing of the catalogue"):
        plummer.analyze(signal, rate_hz=1e3, bearing="9999999", speed_hz=10.0)
    with pytest.raises(plummer.InputError, match="expected one of bearing"):
        plummer.analyze(signal, rate_hz=1e3, speed_hz=10.0)
    with pytest.raises(plummer.InputError, match="NaN"):
        plummer.analyze(np.full(100, np.nan), rate_hz=1e3, bearing="6205", speed_hz=10.0)
    with pytest.raises(plummer.InputError):
        plummer.analyze(signal, rate_hz=-1.0, bearing="6205", speed_hz=10.0)


def test_a_rate_of_zero_is_no_panic() -> None:
    for rate in (0.0, float("nan"), float("inf")):
        with pytest.raises(plummer.Error):
            plummer.analyze(np.ones(100), rate_hz=rate, bearing="6205", speed_hz=10.0)

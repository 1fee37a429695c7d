"""Errors by kind, with the program's words."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path
from typing import Any

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
    assert issubclass(plummer.Interrupted, KeyboardInterrupt) and not issubclass(plummer.Interrupted, Exception)
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


def test_what_the_command_calls_bad_is_no_silent_result() -> None:
    case = plummer.Case.load("examples/scenes/impact.toml", set={"transient.method": "exponential", "transient.step": 5e-6})
    with pytest.raises(plummer.BlewUp, match="blew up|grow|finite") as caught:
        case.run()
    assert caught.value.run is not None and len(caught.value.run.time_s) < 9601
    noise = np.random.default_rng(1).standard_normal(24000)
    with pytest.raises(plummer.ComputationError, match="no part could be judged in any window: .* expected a shaft that turns"):
        plummer.analyze(noise, rate_hz=12000, bearing="6205", speed_hz=0)


def test_a_signal_or_a_speed_of_another_kind_is_refused() -> None:
    signal = np.random.default_rng(1).standard_normal(24000)
    asked: dict[str, Any] = {"rate_hz": 12000, "bearing": 6205, "speed_hz": np.float32(29.95)}
    assert plummer.analyze(signal, **asked).indicated == []
    with pytest.raises(plummer.InputError, match="values of type complex128, expected real numbers"):
        plummer.analyze(signal * 1j, **asked)
    for speed in ("1797rpm", [29.95], [[1, 2, 3]]):
        with pytest.raises(plummer.InputError, match="speed_hz: found"):
            plummer.analyze(signal, **{**asked, "speed_hz": speed})
    with pytest.raises(plummer.InputError, match="found b'x', expected text"):
        plummer.Case.load("examples/modal/ring.toml")["title"] = b"x"


def test_a_shaft_that_turns_between_two_samples_is_refused() -> None:
    noise = np.random.default_rng(1).standard_normal(24000)
    for speed in (7000.0, 1e9):
        with pytest.raises(plummer.InputError, match="expected a shaft speed below half of the sampling rate"):
            plummer.analyze(noise, rate_hz=12000, bearing="6205", speed_hz=speed)


def test_what_is_wrong_with_a_signal_is_a_warning() -> None:
    noise = np.random.default_rng(1).standard_normal(24000)
    still = np.concatenate([np.zeros(4000), noise[4000:]])
    asked: dict[str, Any] = {"rate_hz": 12000, "bearing": "6205", "speed_hz": 29.95}
    for signal, words in ((np.clip(noise, -1, 1), "clipping makes lines"), (still, "nothing changes from 0.0000 to 0.33")):
        with pytest.warns(plummer.SignalWarning, match=words):
            found = plummer.analyze(signal, **asked)
        assert len(found.warnings) == 1
    with pytest.warns(plummer.SignalWarning, match="the input itself or a copy of it"):
        plummer.analyze(noise, baseline=noise.copy(), **asked)


def test_a_bearing_is_said_once_and_with_a_speed() -> None:
    noise = np.random.default_rng(1).standard_normal(24000)
    case = plummer.Case.load("examples/tadina2011/outer-dent.toml")
    with pytest.raises(plummer.InputError, match="expected one of bearing"):
        plummer.analyze(noise, rate_hz=12000, bearing=case, balls=9)
    with pytest.raises(plummer.InputError, match="speed_hz: found nothing"):
        plummer.analyze(noise, rate_hz=12000, bearing="6205")
    with pytest.raises(plummer.InputError, match="a case without .bearing. or .shaft."):
        plummer.analyze(noise, rate_hz=12000, bearing=plummer.Case.load("examples/modal/ring.toml"), speed_hz=30.0)


def test_cases_and_meshes_go_through_pickle() -> None:
    case = plummer.Case.load("examples/modal/pedestal.toml", set={"modes.count": 2})
    case["housing.mesh"] = plummer.Mesh.read("meshes/pedestal.msh")
    again = pickle.loads(pickle.dumps(case))
    assert again["modes.count"] == 2 and copy.deepcopy(case).settings == case.settings
    np.testing.assert_array_equal(again.modes().frequencies_hz, case.modes().frequencies_hz)


def test_threads_that_the_memory_does_not_hold_are_an_error() -> None:
    before = plummer.threads()
    plummer.set_threads(10**9)
    try:
        with pytest.raises(plummer.ComputationError, match="threads cannot be started: the memory does not suffice"):
            plummer.threads()
    finally:
        plummer.set_threads(before)

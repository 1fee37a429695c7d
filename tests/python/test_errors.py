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


def test_a_run_that_cannot_be_trusted_warns() -> None:
    # a condensed housing of a few vectors
    few = ["condense.fixed_interface_modes=20", "transient.end=2e-3", "analysis={}"]
    case = plummer.Case.load("examples/housings/pillow_block.toml", set=few)
    with pytest.warns(plummer.UntrustedWarning, match="the signals cannot be trusted"):
        assert case.run().distrust


def test_a_specification_that_is_wrong_is_wrong_input(tmp_path: Path) -> None:
    with pytest.raises(plummer.InputError, match="cannot read the specification nothing.toml"):
        plummer.dataset("nothing.toml", tmp_path)
    with pytest.raises(plummer.InputError, match="set: found 'seed=2'"):
        plummer.dataset("examples/datasets/two_machines.toml", tmp_path, set="seed=2")  # type: ignore[arg-type]


def test_a_window_of_few_revolutions_is_no_sound_bearing() -> None:
    noise = np.random.default_rng(1).standard_normal(1000)
    with pytest.raises(plummer.ComputationError, match="no part could be judged in any window: The window has 2.5 revolutions"):
        plummer.analyze(noise, rate_hz=12000, bearing="6205", speed_hz=29.95)


def test_the_speed_of_a_verdict_is_that_of_its_orders() -> None:
    asked: dict[str, Any] = {"orders": {"outer": 2.58, "inner": 4.42}, "windows_s": (1, 9)}
    with np.load("examples/measured/nmb_1560kk.npz") as file:
        found = plummer.analyze(file["signal"], rate_hz=file["rate_hz"][0], speed_hz=5.1, **asked)
    assert found[0].given_speed_hz == pytest.approx(5.1) and found[0].speed_source == "lines of both races"
    assert found[0].speed_hz == found.windows[0]["verdict"]["speed_hz"] < 5.08


def test_a_signal_or_a_speed_of_another_kind_is_refused() -> None:
    signal = np.random.default_rng(1).standard_normal(24000)
    asked: dict[str, Any] = {"rate_hz": 12000, "bearing": 6205, "speed_hz": np.float32(29.95)}
    assert pickle.loads(pickle.dumps(plummer.analyze(signal, **asked))).indicated == []
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
        # and that no line confirms the speed
        assert len(found.warnings) == 2
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


@pytest.mark.parametrize(
    ("key", "value", "words"),
    [
        ("windows_s", [(0, 1, 2)], "windows_s: found"),
        ("windows_s", "0:1", "windows_s: found '0:1', expected pairs of from and to, s"),
        ("band_hz", (4000, 2000), "band_hz: found .* expected from below to"),
        ("band_hz", "kurtosis", "band_hz: found 'kurtosis'"),
        ("orders", {}, "orders: found {}, expected a dict of some of outer"),
        ("orders", {"outer": "3.58"}, "orders: outer: found '3.58', expected a number"),
        ("balls", 9.5, "balls: found 9.5, expected a whole number"),
        ("rate_hz", "12000", "rate_hz: found '12000', expected a number"),
        ("rate_hz", True, "rate_hz: found True, expected a number"),
        ("bearing", 6205.0, "bearing: found 6205.0, expected a name"),
    ],
)
def test_arguments_of_another_kind_are_named(key: str, value: Any, words: str) -> None:
    noise = np.random.default_rng(1).standard_normal(24000)
    asked: dict[str, Any] = {"rate_hz": 12000, "bearing": "6205", "speed_hz": 29.95, key: value}
    if key in ("orders", "balls"):
        del asked["bearing"]
    if key == "balls":
        asked.update(ball_diameter=8, pitch_diameter=39)
    with pytest.raises(plummer.InputError, match=words):
        plummer.analyze(noise, **asked)


def test_a_signal_that_is_not_all_there_or_beyond_numbers_is_refused() -> None:
    noise = np.random.default_rng(1).standard_normal(24000)
    asked: dict[str, Any] = {"rate_hz": 12000, "bearing": "6205", "speed_hz": 29.95}
    with pytest.raises(plummer.InputError, match="signal: found masked samples"):
        plummer.analyze(np.ma.masked_greater(noise, 3), **asked)
    for factor in (1e61, 1e-70):
        with pytest.raises(plummer.InputError, match="expected a largest magnitude from 1e-60 to 1e60"):
            plummer.analyze(factor * noise, **asked)
    with pytest.warns(plummer.SignalWarning, match="the speed is given from 100.00 to 200.00 s, and the signal lasts from 0.0000"):
        plummer.analyze(noise, **{**asked, "speed_hz": [(100, 29.95), (200, 29.95)]})


def test_results_are_read_only_and_no_other_is_replaced(tmp_path: Path) -> None:
    case = plummer.Case.load("examples/scenes/impact.toml")
    run = case.run()
    with pytest.raises(ValueError, match="read-only"):
        run["P1"].values *= 1000
    with pytest.raises(TypeError, match="a Run does not go through pickle"):
        copy.deepcopy(run)
    run.save(tmp_path)
    run.save(tmp_path)
    case["shaft.mass"] = 0.3
    with pytest.raises(plummer.InputError, match="run.json is the result of an earlier computation of other values"):
        case.run().save(tmp_path)
    case.run().save(tmp_path, force=True)


def test_a_rate_beside_that_of_a_run_is_told() -> None:
    case = plummer.Case.load("examples/tadina2011/outer-dent.toml", set={"transient.end": 0.5, "analysis": {}})
    signal = case.run()["P1"]
    with pytest.raises(plummer.InputError, match="rate_hz: found '50000', expected a number"):
        plummer.analyze(signal, rate_hz="50000", bearing=case, speed_hz=6.0)  # type: ignore[arg-type]
    with pytest.warns(plummer.SignalWarning, match="rate_hz takes 50000 Hz for what the signal says"):
        plummer.analyze(signal, rate_hz=50000, bearing=case, speed_hz=6.0)


def test_a_list_of_settings_is_no_text() -> None:
    for use in (plummer.Case.load, lambda path, set: plummer.Case.load(path).update(set)):
        with pytest.raises(plummer.InputError, match="set: found 'modes.count=3', expected a dict, or a list"):
            use("examples/modal/ring.toml", set="modes.count=3")


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

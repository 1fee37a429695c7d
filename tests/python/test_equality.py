"""Every shipped case says the same, bit for bit, by Python and by the program."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import plummer

from conftest import ROOT, Program

#: What differs from process to process: times, threads, files.
OWN = {"arrays", "case_digest", "eigen_s", "meshes", "realtime_factor", "reused", "stages_s", "stepping_s", "tables", "threads", "wall_s"}

#: Keys that make long computations short.
SHORT_RUN = ["transient.end=2e-3", "analysis.envelope=[]"]
FEW_VECTORS = ["condense.fixed_interface_modes=20"]
KEYS: dict[tuple[str, str], list[str]] = {
    ("run", "scenes/impact"): [],
    ("run", "scenes/smooth"): [],
    ("run", "scenes/pedestal"): [*SHORT_RUN, *FEW_VECTORS],
    ("run", "housings/end_shield"): [*SHORT_RUN, *FEW_VECTORS],
    ("run", "housings/pillow_block"): [*SHORT_RUN, *FEW_VECTORS],
    ("run", "machines/motor"): ["transient.end=2e-4", "analysis.envelope=[]", *FEW_VECTORS, "transient.modes=12"],
    ("run", "machines/spindle"): ["transient.end=2e-4", "analysis.envelope=[]", *FEW_VECTORS, "transient.modes=12"],
    ("run", "tadina2011/outer-dent"): ["transient.end=0.3", "analysis.envelope=[{from=0.1,to=0.3}]"],
    ("condense", "machines/motor"): FEW_VECTORS,
    ("condense", "machines/spindle"): FEW_VECTORS,
    ("frf", "transfer/pedestal"): [*FEW_VECTORS, "frf.band_hz=[5000, 6000]"],
    ("condense", "housings/end_shield"): FEW_VECTORS,
    ("frf", "housings/spindle_block"): [*FEW_VECTORS, "frf.band_hz=[5000, 6000]"],
}


#: All cases; specifications of data sets and their cases, which are drawn from, are none of these.
CASES = sorted(path for path in (ROOT / "examples").glob("*/*.toml") if path.parent.name != "datasets")


def jobs() -> list[tuple[str, str]]:
    """Command and case, of all that the cases are ready for."""
    found = []
    for path in CASES:
        name = f"{path.parent.name}/{path.stem}"
        case = plummer.Case.load(path)
        interface = any("tie" in ring for ring in rings(case)) or case["condense.interface"] != "ring"
        ready = {
            "modes": True,
            "condense": "housing" in case and interface,
            "frf": "frf" in case,
            "run": "transient" in case,
        }
        found += [(command, name) for command, asked in ready.items() if asked]
    return found


def rings(case: plummer.Case) -> list[dict[str, Any]]:
    """The rings of a case."""
    values = case.to_dict()
    seats = [values, *values.get("bearings", [])]
    return [seat["ring"] for seat in seats if "ring" in seat]


def same(python: Any, program: Any, at: str) -> None:
    """Equal in all keys but those of a process; numbers to the last bit."""
    if isinstance(program, dict):
        assert python.keys() - OWN == program.keys() - OWN, at
        for key in program.keys() - OWN:
            same(python[key], program[key], f"{at}.{key}")
    elif isinstance(program, list):
        assert len(python) == len(program), at
        for place, (mine, other) in enumerate(zip(python, program)):
            same(mine, other, f"{at}[{place}]")
    else:
        assert python == program and type(python) is type(program), f"{at}: {python!r} and {program!r}"


def test_all_shipped_cases_are_here() -> None:
    assert len({name for _, name in jobs()}) == len(CASES) >= 19
    assert set(KEYS) <= set(jobs())


@pytest.mark.parametrize(("command", "name"), jobs(), ids=[" ".join(job) for job in jobs()])
def test_python_and_program_say_the_same(command: str, name: str, program: Program) -> None:
    case, keys = f"examples/{name}.toml", KEYS.get((command, name), SHORT_RUN if command == "run" else [])
    said, folder = program(command, case, *keys)
    result = getattr(plummer.Case.load(case, set=keys), command)()
    same(result.summary, said, command)
    {"modes": arrays_of_modes, "condense": arrays_of_superelement, "run": arrays_of_run, "frf": responses}[command](result, folder, said)
    saved = result.save(folder / "python")
    for file in ("modes.npz", "superelement.npz", "signals.npz"):
        assert (folder / file).exists() == (saved / file).exists()
        if (folder / file).exists():
            same_arrays(saved / file, folder / file)
    if (folder / "frf.uff").exists():
        assert (saved / "frf.uff").read_bytes() == (folder / "frf.uff").read_bytes()
    for part in ("tables", "figures"):
        assert content(saved / part) == content(folder / part), part


def content(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()} if folder.exists() else {}


def same_arrays(python: Path, program: Path) -> None:
    with np.load(python) as mine, np.load(program) as other:
        assert set(mine.files) == set(other.files)
        for name in other.files:
            np.testing.assert_array_equal(mine[name], other[name], name)


def arrays_of_modes(modes: plummer.Modes, folder: Path, said: dict[str, Any]) -> None:
    with np.load(folder / "modes.npz") as file:
        np.testing.assert_array_equal(modes.frequencies_hz, file["frequencies_hz"])
        np.testing.assert_array_equal(modes.shapes, file["shapes"].reshape(modes.shapes.shape))
        np.testing.assert_array_equal(modes.points_m, file["nodes"])
        if modes.node_tags is not None:
            np.testing.assert_array_equal(modes.node_tags, file["node_tags"])
    np.testing.assert_array_equal(modes.error_bounds_hz, said["error_bounds_hz"])


def arrays_of_superelement(element: plummer.Superelement, folder: Path, said: dict[str, Any]) -> None:
    with np.load(folder / "superelement.npz") as file:
        np.testing.assert_array_equal(element.stiffness, file["k"])
        np.testing.assert_array_equal(element.mass, file["m"])
        assert len(element.names) == len(file["k"])
        np.testing.assert_array_equal([row.position_m for row in element.interface], file["interface_positions"])


def arrays_of_run(run: plummer.Run, folder: Path, said: dict[str, Any]) -> None:
    with np.load(folder / "signals.npz") as file:
        np.testing.assert_array_equal(run.time_s, file["time_s"])
        np.testing.assert_array_equal(run.inner_force_n, file["inner_force"])
        np.testing.assert_array_equal(run.shaft_m[:, 1], file["shaft_y"])
        np.testing.assert_array_equal(run.shaft_speed_hz, file["shaft_speed_hz"])
        np.testing.assert_array_equal(run.shaft_angle_rad, file["shaft_angle_rad"])
        for name, signal in run.items():
            np.testing.assert_array_equal(signal.values, file[name])


def responses(frf: plummer.Frf, folder: Path, said: dict[str, Any]) -> None:
    np.testing.assert_array_equal(frf.frequencies_hz, said["frequency_hz"])
    for values, path in zip(frf.receptance, said["paths"]):
        np.testing.assert_array_equal(values.real, path["re"])
        np.testing.assert_array_equal(values.imag, path["im"])


def test_a_measured_signal_is_judged_as_by_the_program(program: Program) -> None:
    # float32 and 306 rpm as the file and its description have them
    options = ["--balls", "7", "--pitch-diameter", "10.514", "--ball-diameter", "2.770", "--speed", "5.1", "--window", "1:9"]
    said, _ = program("analyze", "examples/measured/nmb_1560kk.npz", result="analysis", options=options)
    with np.load("examples/measured/nmb_1560kk.npz") as file:
        found = plummer.analyze(
            file["signal"],
            rate_hz=file["rate_hz"][0],
            speed_hz=5.1,
            balls=7,
            ball_diameter=2.770,
            pitch_diameter=10.514,
            windows_s=[(1.0, 9.0)],
        )
    same(found.windows, said["windows"], "analyze")


def test_an_earlier_signal_is_compared_as_by_the_program(program: Program) -> None:
    path = "examples/measured/nmb_1560kk.npz"
    options = ["--orders", "outer=2.58,inner=4.42", "--speed", "5.1", "--window", "5:9", "--baseline", path, "--baseline-window", "1:5"]
    said, _ = program("analyze", path, result="analysis", options=options)
    with np.load(path) as file:
        signal, rate_hz = file["signal"], file["rate_hz"][0]
    asked: dict[str, Any] = {"speed_hz": 5.1, "orders": {"outer": 2.58, "inner": 4.42}, "windows_s": [(5.0, 9.0)]}
    found = plummer.analyze(signal, rate_hz=rate_hz, baseline=signal, baseline_window_s=(1.0, 5.0), **asked)
    for part in ("lines", "levels"):
        same(found.windows[0]["changes"][part], said["windows"][0]["changes"][part], part)


@pytest.mark.parametrize("speed_hz", [None, 5.1])
def test_a_case_says_the_bearing_as_for_the_program(program: Program, speed_hz: float | None) -> None:
    path, case = "examples/measured/nmb_1560kk.npz", "examples/tadina2011/outer-dent.toml"
    options = ["--bearing", case, "--window", "1:2.5", *([] if speed_hz is None else ["--speed", str(speed_hz)])]
    said, _ = program("analyze", path, result="analysis", options=options)
    with np.load(path) as file:
        bearing = plummer.Case.load(case)
        found = plummer.analyze(file["signal"], rate_hz=file["rate_hz"][0], bearing=bearing, speed_hz=speed_hz, windows_s=[(1.0, 2.5)])
    same(found.windows, said["windows"], "analyze")

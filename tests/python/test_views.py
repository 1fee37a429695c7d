"""Results as tables, pages and figures; the docstrings; types; how long an import takes."""

from __future__ import annotations

import doctest
import importlib
import pkgutil
import subprocess
import sys
from pathlib import Path

import pytest

import plummer

from conftest import ROOT


@pytest.mark.parametrize("module", ["plummer", *(f"plummer.{found.name}" for found in pkgutil.iter_modules(plummer.__path__))])
def test_docstrings_say_what_is_so(module: str) -> None:
    if module.endswith("._plummer"):
        return
    found = doctest.testmod(importlib.import_module(module), optionflags=doctest.ELLIPSIS)
    assert found.failed == 0


def test_an_import_loads_nothing_that_is_not_needed() -> None:
    program = "import sys, plummer; print([name for name in ('numpy', 'pandas', 'matplotlib', 'tqdm') if name in sys.modules])"
    assert subprocess.run([sys.executable, "-c", program], capture_output=True, text=True).stdout == "[]\n"


def test_a_page_holds_the_report() -> None:
    modes = plummer.Case.load("examples/modal/ring.toml").modes()
    shown = modes._repr_html_()
    assert shown.startswith('<iframe srcdoc="') and "Mode shapes" in shown and "<script" not in shown
    assert "case.modes()" in modes.html


def test_a_run_shows_its_signals_in_the_page(tmp_path: Path) -> None:
    run = plummer.Case.load("examples/scenes/impact.toml").run()
    assert "P1" in run.html and "Signals" in run.html
    names = {path.name for path in run.save(tmp_path / "out").iterdir()}
    assert {"report.html", "report.cbor.gz", "run.json", "signals.npz", "tables", "figures"} <= names


def test_tables_of_pandas() -> None:
    pytest.importorskip("pandas")
    modes = plummer.Case.load("examples/modal/ring.toml").modes()
    assert list(modes.to_dataframe()["frequency_hz"]) == modes.frequencies_hz.tolist()
    element = plummer.Case.load("examples/housings/ring.toml").condense()
    assert len(element.to_dataframe()) == len(element.interface)
    run = plummer.Case.load("examples/scenes/impact.toml").run()
    assert run.to_dataframe()["P1"].to_numpy().tolist() == run["P1"].values.tolist()


def test_figures_of_matplotlib() -> None:
    pytest.importorskip("matplotlib").use("agg")
    modes = plummer.Case.load("examples/modal/ring.toml").modes()
    assert modes.plot().get_ylabel() == "frequency (Hz)"
    assert modes.plot(5).get_title() == f"{modes.frequencies_hz[5]:.1f} Hz"
    run = plummer.Case.load("examples/scenes/impact.toml").run()
    line = run.plot("P1").get_lines()[0]
    assert line.get_ydata().tolist() == run["P1"].values.tolist()


def test_the_script_of_the_documents_runs() -> None:
    done = subprocess.run([sys.executable, "docs/python/import_plummer.py"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    first, second, third = done.stdout.splitlines()
    assert first.startswith("20 modes, the first elastic one at 3767 Hz") and "outer race" in second and third.endswith("indicated: outer race>")


def test_types_are_strict() -> None:
    pytest.importorskip("mypy")
    words = [sys.executable, "-m", "mypy", "--strict", "--config-file", str(ROOT / "pyproject.toml")]
    own = subprocess.run([*words, str(ROOT / "python/plummer")], capture_output=True, text=True)
    assert own.returncode == 0, own.stdout
    # of the installed package, which says that it is typed
    script = subprocess.run([*words, str(ROOT / "tests/python/typed_script.py")], capture_output=True, text=True)
    assert script.returncode == 0, script.stdout
    wrong = subprocess.run([*words, "-c", "import plummer; plummer.Case.load(3)"], capture_output=True, text=True)
    assert "arg-type" in wrong.stdout

"""Each notebook runs from its first cell to its last, where what it imports is installed; their own assertions hold."""

from __future__ import annotations

import importlib.util
import os
import re
import subprocess
import sys
from typing import Any

import pytest

from conftest import ROOT

NOTEBOOKS = sorted((ROOT / "docs" / "notebooks").glob("*.py"))


def test_the_page_shows_all_notebooks() -> None:
    page = (ROOT / "docs" / "notebooks.md").read_text(encoding="utf-8")
    assert re.findall(r"\(notebooks/(\w+)\.py\)", page) == ["gmsh_to_paraview", "rotor_on_superelement", "learning_curve"]
    assert len(NOTEBOOKS) == 3


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=[path.stem for path in NOTEBOOKS])
def test_a_notebook_runs(notebook: "os.PathLike[str]") -> None:
    with open(notebook, encoding="utf-8") as file:
        text = file.read()
    for module in re.findall(r"^(?:import|from) (\w+)", text, re.MULTILINE):
        if importlib.util.find_spec(module) is None:
            pytest.skip(f"{module} is not installed")
    # where Jupyter runs it
    options: dict[str, Any] = {"capture_output": True, "text": True, "env": {**os.environ, "MPLBACKEND": "agg"}}
    done = subprocess.run([sys.executable, notebook], cwd=ROOT / "docs" / "notebooks", **options)
    assert done.returncode == 0, done.stderr[-3000:]

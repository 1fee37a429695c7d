"""Where the tests run, and the program that they compare with."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]

#: What the program says of a command: its JSON file, and the folder of its results.
Program = Callable[..., tuple[dict[str, Any], Path]]


@pytest.fixture(autouse=True)
def in_the_repository(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)


@pytest.fixture
def program(tmp_path: Path) -> Program:
    """Runs the command line program, PLUMMER or the one on the path."""
    path = os.environ.get("PLUMMER") or shutil.which("plummer")
    assert path, "no program: set PLUMMER"

    def run(command: str, case: str, *keys: str, result: str = "", options: Sequence[str] = ()) -> tuple[dict[str, Any], Path]:
        settings = [word for key in keys for word in ("--set", key)]
        words = [path, command, case, *settings, *options, "--out", str(tmp_path), "--quiet", "--no-cache", "--force"]
        # 1: an answer that is bad, as of a target that is missed
        assert subprocess.run(words, capture_output=True).returncode in (0, 1)
        return json.loads((tmp_path / f"{result or command}.json").read_text()), tmp_path

    return run

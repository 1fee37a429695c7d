"""What all results have."""

from __future__ import annotations

import html
import json
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from ._errors import InputError

if TYPE_CHECKING:
    import os

    import pandas


class Computed(Protocol):
    """A result of the extension."""

    def summary(self) -> dict[str, Any]: ...

    def html(self) -> str: ...

    def write_report(self, folder: str | os.PathLike[str]) -> None: ...


def framed(page: str) -> str:
    """A page in a frame of its own, whose scripts and styles stay apart from those of a notebook."""
    return f'<iframe srcdoc="{html.escape(page)}" style="width:100%;height:36em;border:0" sandbox="allow-scripts"></iframe>'


class Result:
    """A result: arrays, the content of the command's JSON file, the report."""

    _computed: Computed

    @cached_property
    def summary(self) -> dict[str, Any]:
        """The content of the command's JSON file, without what only a process has: its wall time, its threads, its files."""
        return self._computed.summary()

    @property
    def warnings(self) -> list[str]:
        """What of the model may be meant otherwise, a sentence each."""
        return list(self.summary["warnings"])

    @cached_property
    def html(self) -> str:
        """The report as one page of HTML."""
        return self._computed.html()

    def _repr_html_(self) -> str:
        return framed(self.html)

    def save(self, folder: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Writes into a folder, and gives it: ``report.html`` with its tables and figures, the summary as ``COMMAND.json``, and the arrays
        as the command names them, ``modes.npz``, ``superelement.npz``, ``signals.npz`` or ``frf.uff``.

        Args:
            folder: made where it is not there.
            force: replaces results of other values.

        Raises:
            InputError: results of other values that are there.
        """
        path = Path(folder)
        earlier = path / f"{self.summary['command']}.json"
        if earlier.exists() and not force and self._digest_in(earlier) != self.summary["case_digest"]:
            raise InputError(f"{earlier} is the result of an earlier computation of other values", "save it elsewhere, or with force=True")
        path.mkdir(parents=True, exist_ok=True)
        self._write(path)
        self._computed.write_report(path)
        (path / f"{self.summary['command']}.json").write_text(json.dumps(self.summary, indent=2) + "\n", encoding="utf-8")
        return path

    @staticmethod
    def _digest_in(earlier: Path) -> object:
        try:
            content = json.loads(earlier.read_bytes())
        except ValueError:
            return None
        return content.get("case_digest") if isinstance(content, dict) else None

    def __reduce__(self) -> Any:
        raise TypeError(f"a {type(self).__name__} does not go through pickle: hand over its arrays or its summary")

    def _write(self, folder: Path) -> None:
        """Writes arrays."""

    def to_dataframe(self) -> pandas.DataFrame:
        """The result as a table of pandas."""
        raise NotImplementedError

"""Data sets of labelled signals."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _plummer
from ._errors import ComputationError, FileError, InputError

if TYPE_CHECKING:
    import numpy as np
    import pandas
    from numpy.typing import NDArray


class Dataset:
    """Labelled signals in a folder, as ``plummer dataset`` writes them.

    Args:
        folder: where they are.

    Raises:
        FileError: a folder without a manifest.
    """

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = Path(folder)
        try:
            text = (self.folder / "manifest.json").read_text(encoding="utf-8")
        except OSError as error:
            raise FileError(f"{self.folder} holds no data set: {error}", "name the folder that `plummer dataset` wrote") from error
        #: What manifest.json says: seed, digests, and every drawn parameter of every signal.
        self.manifest: dict[str, Any] = json.loads(text)

    @cached_property
    def _arrays(self) -> dict[str, NDArray[Any]]:
        import numpy as np

        names = sorted({record["file"] for record in self.manifest["signals"] if record["file"]})
        files = [np.load(self.folder / name) for name in names]
        try:
            if not files:
                reason = next(iter(self.failed.values()), "the data set is empty")
                raise ComputationError(f"no signal could be computed: {reason}", "Dataset.failed has the reason of each")
            single = {"rate_hz", "label_names", "split_names"}
            return {key: files[0][key] if key in single else np.concatenate([file[key] for file in files]) for key in files[0].files}
        finally:
            for file in files:
                file.close()

    def __getitem__(self, key: str) -> NDArray[Any]:
        """An array of all files: ``"speed_hz"``, ``"bpfo_hz"``, ``"specimen"``, ..."""
        return self._arrays[key]

    def __len__(self) -> int:
        return sum(record["file"] is not None for record in self.manifest["signals"])

    @property
    def signals(self) -> NDArray[np.float32]:
        """Samples [signals, samples], m/s^2."""
        return self["signals"]

    @property
    def rate_hz(self) -> float:
        """Sampling rate, Hz."""
        return float(self["rate_hz"][0])

    @property
    def labels(self) -> NDArray[np.str_]:
        """``"none"``, ``"outer"``, ``"inner"``, ``"ball"`` or ``"several"`` [signals]."""
        names: NDArray[np.str_] = self["label_names"][self["label"]]
        return names

    @property
    def splits(self) -> NDArray[np.str_]:
        """``"train"``, ``"validation"`` or ``"test"`` [signals]; no bearing is in two of them."""
        names: NDArray[np.str_] = self["split_names"][self["split"]]
        return names

    @property
    def failed(self) -> dict[int, str]:
        """Why signals are not there, by their number."""
        return {record["signal"]: record["reason"] for record in self.manifest["signals"] if record["file"] is None}

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each signal that is there, in the order of :attr:`signals`: label, split, frequencies, what was drawn."""
        import pandas

        records = [record for record in self.manifest["signals"] if record["file"]]
        flat = [{key: value for key, value in record.items() if key not in ("drawn", "faults")} | record["drawn"] for record in records]
        return pandas.DataFrame(flat).set_index("signal")

    def __repr__(self) -> str:
        return f"<plummer.Dataset {str(self.folder)!r}: {len(self)} signals at {self.manifest['rate_hz']:g} Hz>"


def dataset(
    spec: str | os.PathLike[str],
    out: str | os.PathLike[str],
    *,
    count: int | None = None,
    set: Mapping[str, Any] | list[str] | tuple[str, ...] = (),
    resume: bool = False,
    force: bool = False,
    progress: bool = False,
) -> Dataset:
    """Computes labelled signals by the command ``plummer dataset``, in a process of its own.

    Ctrl-C ends it; with ``resume=True`` the next call goes on.

    Args:
        spec: the specification, a TOML file.
        out: folder for the files.
        count: number of signals; ``None``: that of the specification.
        set: values for keys of the specification.
        resume: goes on with the data set in the folder.
        force: replaces what is in the folder.
        progress: shows the command's bar on standard error.

    Raises:
        InputError: a specification that is not valid, or a folder that is taken.
        ComputationError: no manifest could be written. Signals that cannot be computed are in :attr:`Dataset.failed`.

    >>> import tempfile
    >>> import plummer
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     short = {"machines": [{"case": "../tadina2011/outer-dent.toml"}], "recorder.duration_s": 0.1, "untrusted": "keep"}
    ...     data = plummer.dataset("examples/datasets/two_machines.toml", folder, count=8, set=short)
    ...     data.signals.shape, data.failed
    ((8, 1200), {})
    """
    if isinstance(set, (str, bytes)):
        raise InputError(f"set: found {set!r}, expected a dict, or a list of texts KEY=VALUE")
    settings = [f"{key}={_plummer.toml_value(value)}" for key, value in set.items()] if isinstance(set, Mapping) else list(set)
    words = [sys.executable, "-m", "plummer", "dataset", "--out", os.fspath(out), "--threads", str(_plummer.threads())]
    words += [] if count is None else ["--count", str(count)]
    words += [word for setting in settings for word in ("--set", setting)]
    words += [word for word, asked in (("--resume", resume), ("--force", force), ("--quiet", not progress)) if asked]
    words += ["--", os.fspath(spec)]
    manifest = Path(out) / "manifest.json"
    before = manifest.stat().st_mtime_ns if manifest.exists() else None
    done = subprocess.run(words, stdout=subprocess.DEVNULL, stderr=None if progress else subprocess.PIPE, text=True)
    if done.returncode == 0:
        return Dataset(out)
    said = [line for line in (done.stderr or "the command failed: see its words").splitlines() if line]
    what = next((line[len("error: ") :] for line in said if line.startswith("error: ")), said[-1] if said else "the command failed")
    help = "\n".join(line[len("help: ") :] for line in said if line.startswith("help: ")) or None
    if done.returncode == 2:
        raise InputError(what, help)
    # written last: only single signals are missing
    if manifest.exists() and manifest.stat().st_mtime_ns != before:
        return Dataset(out)
    raise ComputationError(what, help)

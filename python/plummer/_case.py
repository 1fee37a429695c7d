"""Cases."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Union

from . import _plummer
from ._condense import Superelement
from ._errors import BlewUp, CaseError, InputError, Interrupted, UntrustedWarning
from ._frf import Frf
from ._mesh import named
from ._modes import Modes
from ._progress import Progress, Stages
from ._run import Run, Signals

Settings = Union[Mapping[str, Any], "list[str]", "tuple[str, ...]"]


def _arguments(settings: Settings) -> tuple[list[str], list[tuple[str, _plummer.Mesh]]]:
    meshes: dict[str, _plummer.Mesh] = {}
    if isinstance(settings, Mapping):
        values = {key: named(value, meshes) for key, value in settings.items()}
        return [f"{key}={_plummer.toml_value(value)}" for key, value in values.items()], list(meshes.items())
    if isinstance(settings, (str, bytes)):
        raise InputError(f"set: found {settings!r}, expected a dict, or a list of texts KEY=VALUE")
    return list(settings), []


class Case:
    """A case: what a case file of ``plummer`` says, checked.

    Args:
        table: the tables and keys of a case file as nested dicts; where it names a mesh, a :class:`Mesh` may stand.
        folder: where the files are that it names.

    Raises:
        CaseError: an unknown key, a value out of range, values that contradict each other.

    >>> import plummer
    >>> case = plummer.Case.load("examples/tadina2011/outer-dent.toml")
    >>> case["bearing.defects.0.depth"]
    1.5e-05
    >>> case["bearing.defects.0.depth"] = 2e-5
    >>> case["bearing.defects.0.depth"]
    2e-05
    """

    _case: _plummer.Case

    def __init__(self, table: Mapping[str, Any], folder: str | os.PathLike[str] = ".") -> None:
        meshes: dict[str, _plummer.Mesh] = {}
        self._case = _plummer.Case.of_dict(named(table, meshes), os.path.join(os.fspath(folder), "case"), list(meshes.items()))

    @classmethod
    def load(cls, path: str | os.PathLike[str], set: Settings = ()) -> Case:
        """Reads a case file.

        Args:
            path: the file.
            set: values for keys, as a dict, or as the command has them after ``--set``: ``["modes.count=4"]``.

        Raises:
            CaseError: a file that cannot be read, or is not valid.
        """
        self = cls.__new__(cls)
        self._case = _plummer.Case.load(os.fspath(path), *_arguments(set))
        return self

    def update(self, settings: Settings) -> None:
        """Sets several keys at once; the case is checked after the last.

        >>> import plummer
        >>> case = plummer.Case.load("examples/tadina2011/outer-dent.toml")
        >>> case.update({"transient.end": 0.2, "analysis.envelope": [{"from": 0.05, "to": 0.2}]})
        >>> case["transient.end"]
        0.2
        """
        self._case = self._case.with_arguments(*_arguments(settings))

    def copy(self) -> Case:
        """A case of its own with the same values."""
        other = type(self).__new__(type(self))
        other._case = self._case
        return other

    def __reduce__(self) -> tuple[Any, ...]:
        meshes = [(name, mesh.content()) for name, mesh in self._case.meshes()]
        return _unpickled, (self._case.path, self._case.text, self._case.set, meshes)

    def __setitem__(self, key: str, value: Any) -> None:
        self.update({key: value})

    def __getitem__(self, key: str) -> Any:
        try:
            return self._case.value(key)
        except CaseError as error:
            raise KeyError(str(error)) from None

    def __contains__(self, key: object) -> bool:
        try:
            self[str(key)]
        except KeyError:
            return False
        return True

    def __iter__(self) -> Iterator[str]:
        return iter(self._case.values())

    def to_dict(self) -> dict[str, Any]:
        """All values as nested dicts, defaults filled in, in SI units."""
        return self._case.values()

    @property
    def path(self) -> Path:
        """The case file."""
        return Path(self._case.path)

    @property
    def title(self) -> str:
        """What the case is about."""
        return self._case.title

    @property
    def settings(self) -> list[str]:
        """What was set after the file was read, as the command has it after ``--set``."""
        return self._case.set

    def __repr__(self) -> str:
        return f"<plummer.Case {str(self.path)!r}: {self.title}>"

    def modes(self, *, progress: Progress = None) -> Modes:
        """Eigenfrequencies and shapes, as ``plummer modes`` computes them.

        Args:
            progress: ``True`` for a bar; or what is called as tqdm is.

        Raises:
            InputError: a case or mesh of which no modes can be computed.
            ComputationError: a solver that does not find them.

        >>> import plummer
        >>> modes = plummer.Case.load("examples/modal/ring.toml").modes()
        >>> modes.shapes.shape  # modes, nodes, x y z
        (12, 792, 3)
        """
        with Stages(progress) as stages:
            return Modes(self._case.modes(stages.told))

    def condense(self, *, compare_full: bool = False, progress: Progress = None) -> Superelement:
        """The housing condensed onto its interface (Craig-Bampton), as by ``plummer condense``.

        Args:
            compare_full: computes the full model's frequencies beside.

        >>> import plummer
        >>> element = plummer.Case.load("examples/housings/ring.toml").condense()
        >>> element.stiffness.shape == element.mass.shape
        True
        """
        with Stages(progress) as stages:
            return Superelement(self._case.condense(compare_full, stages.told))

    def frf(self, *, progress: Progress = None) -> Frf:
        """Transfer paths from forces to sensors, as by ``plummer frf``.

        >>> import plummer
        >>> frf = plummer.Case.load("examples/transfer/pedestal.toml").frf()
        >>> frf.receptance.shape == (len(frf.paths), len(frf.frequencies_hz))
        True
        """
        with Stages(progress) as stages:
            return Frf(self._case.frf(stages.told))

    def run(self, *, progress: Progress = None) -> Run:
        """The simulation in time, as by ``plummer run``, with its signals in memory.

        Raises:
            Interrupted: by Ctrl-C; its ``signals`` are those until then.
            BlewUp: a solution that does not stay finite; its ``run`` has what came before.

        Warns:
            UntrustedWarning: signals that cannot be trusted, where the command ends with exit code 1.

        >>> import plummer
        >>> run = plummer.Case.load("examples/scenes/impact.toml").run()
        >>> run["P1"].unit
        'm/s^2'
        """
        with Stages(progress) as stages:
            try:
                run = Run(self._case.run(stages.told))
            except Interrupted as error:
                if isinstance(error.signals, _plummer.Record):
                    error.signals = Signals(error.signals)
                raise
        if run.blew_up:
            raise BlewUp(run.blew_up, run)
        if run.distrust:
            warnings.warn(f"the signals cannot be trusted: {run.distrust}; run.warnings says by how much", UntrustedWarning, stacklevel=2)
        return run


def _unpickled(path: str, text: str, set: list[str], meshes: list[tuple[str, bytes]]) -> Case:
    case = Case.__new__(Case)
    case._case = _plummer.Case.of_text(path, text, set, [(name, _plummer.Mesh.of_bytes(content, name)) for name, content in meshes])
    return case

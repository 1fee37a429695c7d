"""What can go wrong, by kind. The words are those of the command ``plummer``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ._run import Run, Signals


class Error(Exception):
    """Any failure of plummer.

    Attributes:
        what: what is wrong, and where.
        help: what to do about it, a line for each thing; ``None`` where the message says it.
    """

    def __init__(self, what: str, help: str | None = None) -> None:
        super().__init__(what, help)
        self.what = what
        self.help = help

    def __str__(self) -> str:
        return "\n".join([self.what, *(f"help: {line}" for line in (self.help or "").splitlines())])

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.what, self.help)


class InputError(Error, ValueError):
    """Wrong input: the command ends with exit code 2."""


class CaseError(InputError):
    """A case that is not valid: the key, what was found, what was expected.

    >>> import plummer
    >>> try:
    ...     plummer.Case.load("examples/modal/ring.toml", set={"modes.cuont": 3})
    ... except plummer.CaseError as error:
    ...     print(error)
    --set modes.cuont=3: unknown key `modes.cuont`
    help: did you mean `count`? keys here: count, up_to_hz, band_hz, expected, linearise, variants, compare, convergence, ball_pass
    """


class MeshError(InputError):
    """A mesh that cannot be read, or lacks what the case names."""


class ComputationError(Error, RuntimeError):
    """A computation that failed: exit code 1."""


class BlewUp(ComputationError):
    """A solution that does not stay finite.

    Attributes:
        run: the run up to the instant before.
    """

    def __init__(self, what: str, run: Run | None = None) -> None:
        super().__init__(what)
        self.run = run

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.what,)


class UntrustedWarning(UserWarning):
    """Signals that cannot be trusted, with the reason."""


class SignalWarning(UserWarning):
    """What is wrong with an analysed signal: clipped samples, stretches that stand still, a doubtful baseline."""


class FileError(Error, OSError):
    """A file that the system does not let read or write."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C ended a computation. As any interrupt it is no ``Exception``, which a loop over cases might pass over.

    Attributes:
        signals: of a run what it had until then, else ``None``.
    """

    signals: Signals | None = None

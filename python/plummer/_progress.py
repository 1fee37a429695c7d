"""Progress by the convention of tqdm."""

from __future__ import annotations

import sys
import time
from typing import Any, Callable, Optional, Protocol, Union


class Bar(Protocol):
    """What tqdm makes, as far as it is used here."""

    def update(self, n: float) -> Any: ...

    def set_description(self, desc: str) -> Any: ...

    def close(self) -> Any: ...


#: ``True``: a bar of tqdm where it is installed, else lines; a class or function that is called as tqdm is, ``progress(total=1.0,
#: desc="step")``, and gives an object with ``update``, ``set_description`` and ``close``.
Progress = Union[bool, Callable[..., Bar], None]

#: What the extension calls: stage, and the part of it that is done.
Told = Callable[[str, Optional[float]], None]


class Lines:
    """Lines on standard error, a stage each, for where tqdm is not installed."""

    def __init__(self, total: float = 1.0, desc: str = "") -> None:
        self.begun = time.monotonic()
        self.desc = desc

    def update(self, n: float) -> None:
        """A bar would move here."""

    def set_description(self, desc: str) -> None:
        self.desc = desc

    def close(self) -> None:
        print(f"{self.desc}: {time.monotonic() - self.begun:.1f} s", file=sys.stderr)


def bars() -> Callable[..., Bar]:
    """The class of tqdm for a terminal or a notebook, else :class:`Lines`."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return Lines

    def bar(total: float, desc: str) -> Bar:
        made: Bar = tqdm(total=total, desc=desc, bar_format="{desc} {percentage:3.0f}%|{bar}| {elapsed}<{remaining}", leave=False)
        return made

    return bar


class Stages:
    """A bar for each stage, from the first call to :meth:`close`."""

    def __init__(self, progress: Progress) -> None:
        self.make = bars() if progress is True else progress or None
        self.bar: Bar | None = None
        self.stage = ""
        self.done = 0.0

    @property
    def told(self) -> Told | None:
        """What the extension calls; ``None`` where nothing is to be shown."""
        return self._told if self.make else None

    def _told(self, stage: str, part: float | None) -> None:
        if stage != self.stage:
            self.close()
            assert self.make
            self.bar, self.stage, self.done = self.make(total=1.0, desc=stage), stage, 0.0
        if self.bar and part is not None and part > self.done:
            self.bar.update(part - self.done)
            self.done = part

    def close(self) -> None:
        """Ends the bar of the last stage."""
        if self.bar:
            self.bar.close()
        self.bar = None

    def __enter__(self) -> Stages:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

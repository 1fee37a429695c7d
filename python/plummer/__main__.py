"""The command ``plummer``, also as ``python -m plummer``."""

from __future__ import annotations

import sys

from . import _plummer


def main() -> int:
    """Runs the command on the process's arguments; gives its exit code."""
    assert _plummer.__file__
    return _plummer.main(_plummer.__file__, [sys.executable, "-m", "plummer"], sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())

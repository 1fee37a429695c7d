#!/usr/bin/env python3
"""How long a command shows nothing on a terminal: scripts/silences.py SECONDS COMMAND...

Runs the command in a pseudo-terminal and prints its longest silences, with what stood there. Exit code 1 if one of them is
longer than SECONDS. Progress moves four times a second, so that 0.6 holds on a machine that is not overloaded.
"""
import os
import pty
import re
import select
import sys
import time


def main(limit, command):
    child, terminal = pty.fork()
    if child == 0:
        os.execvp(command[0], command)
    begun = last = time.monotonic()
    silences, shown = [], ""
    while True:
        select.select([terminal], [], [])
        now = time.monotonic()
        try:
            text = os.read(terminal, 1 << 16)
        except OSError:  # how Linux says that the other end is closed
            break
        if not text:
            break
        silences.append((now - last, last - begun, shown))
        last = now
        lines = re.sub(rb"\x1b\[[0-9;?]*[A-Za-z]", b"", text).decode(errors="replace")
        shown = ([line.strip() for line in re.split("[\r\n]", lines) if line.strip()] or [shown])[-1]
    _, status = os.waitpid(child, 0)
    for length, at, text in sorted(silences, reverse=True)[:5]:
        print(f"{length:6.2f} s of silence {at:7.1f} s after the begin: {text[:70]}")
    print(f"{time.monotonic() - begun:6.1f} s, exit code {os.waitstatus_to_exitcode(status)}")
    return max(silences, default=(0.0,))[0] > limit


if __name__ == "__main__":
    sys.exit(main(float(sys.argv[1]), sys.argv[2:]))

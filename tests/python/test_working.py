"""While it computes: Ctrl-C, progress, other threads, forks."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time

import pytest

import plummer

#: A run of minutes.
LONG = {"transient.end": 2.6, "analysis.envelope": []}
DENT = "examples/tadina2011/outer-dent.toml"


def interrupt_after(seconds: float) -> None:
    threading.Timer(seconds, os.kill, (os.getpid(), signal.SIGINT)).start()


@pytest.mark.parametrize("seconds", [0.1, 1.0])
def test_ctrl_c_ends_a_run_at_once(seconds: float) -> None:
    case = plummer.Case.load(DENT, set=LONG)
    interrupt_after(seconds)
    begun = time.monotonic()
    with pytest.raises(plummer.Interrupted, match="interrupted"):
        case.run()
    assert time.monotonic() - begun < seconds + 1.5
    # what comes after computes as before
    assert plummer.Case.load("examples/modal/ring.toml").modes().count == 12


def test_a_run_that_ctrl_c_ends_leaves_its_signals() -> None:
    case = plummer.Case.load(DENT, set=LONG)
    stepping = threading.Event()

    def interrupt(total: float, desc: str) -> Bar:
        if desc == "step" and not stepping.is_set():
            stepping.set()
            interrupt_after(0.5)
        return Bar(total, desc)

    with pytest.raises(plummer.Interrupted, match='during "step"') as caught:
        case.run(progress=interrupt)
    signals = caught.value.signals
    assert signals is not None and list(signals) == ["P1"]
    count = len(signals.time_s)
    assert 100 < count < 260000 and len(signals["P1"]) == count and len(signals.inner_force_n) == count


class Bar:
    """What tqdm makes, written down."""

    made: list[Bar] = []

    def __init__(self, total: float, desc: str) -> None:
        self.total, self.desc, self.done, self.closed = total, desc, 0.0, False
        self.made.append(self)

    def update(self, n: float) -> None:
        assert n > 0
        self.done += n

    def set_description(self, desc: str) -> None:
        self.desc = desc

    def close(self) -> None:
        self.closed = True


def test_progress_is_told_by_the_convention_of_tqdm() -> None:
    Bar.made = []
    plummer.Case.load(DENT, set={"transient.end": 0.5, "analysis.envelope": []}).run(progress=Bar)
    step = next(bar for bar in Bar.made if bar.desc == "step")
    assert 0.3 < step.done <= 1.0 and all(bar.closed and bar.total == 1.0 for bar in Bar.made)


def test_an_error_in_progress_ends_the_computation() -> None:
    def refuse(total: float, desc: str) -> Bar:
        raise ZeroDivisionError(desc)

    begun = time.monotonic()
    with pytest.raises(ZeroDivisionError):
        plummer.Case.load(DENT, set=LONG).run(progress=refuse)
    assert time.monotonic() - begun < 2.0


def test_other_threads_go_on_while_it_computes() -> None:
    ticks = []
    ended = threading.Event()

    def tick() -> None:
        while not ended.wait(0.005):
            ticks.append(time.monotonic())

    ticking = threading.Thread(target=tick)
    ticking.start()
    begun = time.monotonic()
    plummer.Case.load(DENT, set={"transient.end": 0.3, "analysis.envelope": []}).run()
    took = time.monotonic() - begun
    ended.set()
    ticking.join()
    # a lock that is held lets none through
    assert len(ticks) > 5 * took


def test_a_forked_process_computes_with_threads_of_its_own() -> None:
    program = """
import os, plummer
case = plummer.Case.load("examples/modal/ring.toml")
first = case.modes().frequencies_hz.tolist()
child = os.fork()
if child == 0:
    os._exit(0 if case.modes().frequencies_hz.tolist() == first else 1)
raise SystemExit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""
    assert subprocess.run([sys.executable, "-c", program], timeout=60).returncode == 0


def test_results_do_not_depend_on_the_number_of_threads() -> None:
    case = plummer.Case.load("examples/modal/ring.toml")
    found = []
    for count in (1, 2, None):
        plummer.set_threads(count)
        found.append(case.modes().shapes.tobytes())
    assert plummer.threads() >= 1 and found[0] == found[1] == found[2]

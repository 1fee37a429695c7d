"""What a call from Python costs beside the command: python3 benches/python.py [PROGRAM], with plummer installed.

Both compute the same case, the command with its start, its files and its report. Medians of nine, in ms.
"""

import json
import statistics
import subprocess
import sys
import tempfile
import time

import plummer

PROGRAM = sys.argv[1] if len(sys.argv) > 1 else "plummer"
CASES = [("modes", "examples/modal/ring.toml"), ("modes", "examples/housings/ring.toml"), ("run", "examples/scenes/impact.toml")]


def timed(work) -> float:
    began = time.perf_counter()
    work()
    return 1e3 * (time.perf_counter() - began)


def imported() -> float:
    return timed(lambda: subprocess.run([sys.executable, "-c", "import plummer"], check=True)) - timed(
        lambda: subprocess.run([sys.executable, "-c", ""], check=True)
    )


print(f"import plummer: {statistics.median(imported() for _ in range(9)):.0f}")
with tempfile.TemporaryDirectory() as out:
    for command, case in CASES:
        words = [PROGRAM, command, case, "--out", out, "--quiet", "--no-cache", "--force"]

        def computing() -> float:
            """What the command itself says of its computation: all stages but the writing."""
            subprocess.run(words, check=True)
            stages = json.load(open(f"{out}/{command}.json"))["stages_s"]
            return 1e3 * sum(took for stage, took in stages.items() if stage != "write")

        def called() -> float:
            return timed(lambda: getattr(plummer.Case.load(case), command)())

        whole = statistics.median(timed(lambda: subprocess.run(words, check=True)) for _ in range(9))
        own = statistics.median(computing() for _ in range(9))
        call = statistics.median(called() for _ in range(9))
        print(f"{command} {case}: command {whole:.0f}, of which computing {own:.0f}; Python {call:.0f}, overhead {call - own:.0f}")

#!/usr/bin/env python3
"""What the live page costs a run: the same run without it, with it, and with a browser that leaves.

    bench/watch_overhead.py [--program build/release/bin/crosswalk] [--scenario v2370]
                            [--mode multibody] [--until-ms MS] [--rounds 5]

Runs are interleaved, every round in another order, so that a machine that speeds up or slows down
meets all kinds alike. Compared is the time from the first to the last message of the run
(`timing.wall_s` of summary.json): starting the processes and writing the report are not part of it.
Prints medians and the median of the ratios round by round; the limit is 2 per cent. Meaningful only
on a machine that does nothing else. Beside it stands the processor time of all processes of a run,
start and report included, which tells how much more work a run with the page is on a busy machine
too.
"""

import argparse
import json
import pathlib
import re
import resource
import shutil
import statistics
import subprocess
import tempfile
import threading
import urllib.request

KINDS = ("plain", "watched", "browser left")
FEW_BYTES = 20000  # after which the browser leaves


def visit_and_leave(lines):
    """Opens the page's event stream once its address is printed, reads a little, closes it."""
    for line in lines:
        found = re.search(r"http://127\.0\.0\.1:\d+/", line)
        if not found:
            continue
        try:
            with urllib.request.urlopen(found.group() + "events", timeout=30) as stream:
                stream.read(FEW_BYTES)
        except OSError:
            pass  # the run ended first
        break
    for _ in lines:  # keeps the pipe empty
        pass


def run_once(kind, options, folder):
    shutil.rmtree(folder, ignore_errors=True)
    command = [options.program, "run", options.scenario, "--mode", options.mode, "--out", str(folder)]
    if options.until_ms:
        command += ["--until-ms", str(options.until_ms)]
    if kind != "plain":
        command.append("--watch")
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    reader = visit_and_leave if kind == "browser left" else lambda lines: [None for _ in lines]
    thread = threading.Thread(target=reader, args=(process.stdout,))
    thread.start()
    code = process.wait()
    thread.join()
    if code != 0:
        raise SystemExit(f"{' '.join(command)} ended with {code}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    work = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return json.loads((folder / "summary.json").read_text())["timing"]["wall_s"], work


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    root = pathlib.Path(__file__).resolve().parent.parent
    parser.add_argument("--program", default=str(root / "build/release/bin/crosswalk"))
    parser.add_argument("--scenario", default="v2370")
    parser.add_argument("--mode", default="multibody")
    parser.add_argument("--until-ms", type=float)
    parser.add_argument("--rounds", type=int, default=5)
    options = parser.parse_args()
    times, works = ({kind: [] for kind in KINDS} for _ in range(2))
    with tempfile.TemporaryDirectory(prefix="cw_watch_") as folder:
        for i in range(options.rounds):
            for kind in KINDS[i % 3:] + KINDS[:i % 3]:
                time, work = run_once(kind, options, pathlib.Path(folder) / "run")
                times[kind].append(time)
                works[kind].append(work)
            print("  ".join(f"{kind} {times[kind][-1]:.3f} s" for kind in KINDS), flush=True)
    for what, values in (("time of the run", times), ("processor time", works)):
        print(f"\n{what:<18}{'median':>9}{'fastest':>9}   against plain, round by round")
        for kind in KINDS:
            ratios = [b / a - 1 for a, b in zip(values["plain"], values[kind])]
            print(f"{kind:<18}{statistics.median(values[kind]):>7.3f} s{min(values[kind]):>7.3f} s"
                  f"   {100 * statistics.median(ratios):+.2f} %")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""`mpirun -n N temper optimize`: the bytes of one process, and what happens when a rank fails.

    ranks.py PROGRAM MPIRUN         a sample: some seconds
    ranks.py PROGRAM MPIRUN --all   threads 1, 2, 3, 8 × ranks 1, 2, 3, 5, 8 × spaces × methods, and twenty kills: half an hour

All ranks run on this machine, so nothing here is about speed. Prints a row for each comparison and each fault.
"""

import argparse
import itertools
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

OLD = b"what was there before\n"
SPACES = {"plane": "random", "sphere": "random-sphere", "periodic": "random-periodic"}  # the examples of each
PARTS = 16384  # vertices of a part of a sweep
METHODS = {
    "default": [],
    "accuracy": ["--for", "stars"],
    "repair": ["--set", "repair=vertices", "--set", "max_sweeps=40"],
    "paper": ["--for", "paper", "--set", "max_sweeps=3"],
}
LONGEST = 600  # seconds of one command: ranks that wait for each other for ever are a failure


class Runner:
    def __init__(self, program, mpirun, folder):
        self.program, self.mpirun, self.folder = program, mpirun, folder
        self.environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                                OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_btl_base_warn_component_unused="0",
                                OMPI_MCA_odls_base_sigkill_timeout="0")  # twice as many seconds pass after each failure
        self.problems, self.rows = [], 0

    def expect(self, holds, what):
        self.rows += 1
        print(("" if holds else "FAILED: ") + what, flush=True)
        if not holds:
            self.problems.append(what)

    def one(self, *arguments):
        return subprocess.run([self.program, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=LONGEST)

    def command(self, *groups):
        """groups: (ranks, arguments) each."""
        words = [self.mpirun]
        for i, (ranks, arguments) in enumerate(groups):
            words += ([":"] if i > 0 else []) + ["-n", str(ranks), self.program, *arguments]
        return words

    def start(self, *groups):
        return subprocess.Popen(self.command(*groups), cwd=self.folder, env=self.environment, text=True, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)

    def ranks(self, *groups):
        process = self.start(*groups)
        try:
            text, _ = process.communicate(timeout=LONGEST)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            text, _ = process.communicate()
            self.expect(False, f"{' '.join(process.args)}: did not end")
        return process.returncode, text

    def bytes(self, name):
        path = self.folder / name
        return path.read_bytes() if path.exists() else None


def same_bytes(runner, whole):
    n = (4 if whole else 1) * PARTS + 1000
    for space, example in SPACES.items():
        runner.one("example", example, "--vertices", str(n), "--seed", "4", "-o", f"{space}.vtu")
    methods = METHODS if whole else {"default": METHODS["default"]}
    for (space, _), (method, options) in itertools.product(SPACES.items(), methods.items()):
        if (space, method) == ("periodic", "repair") or (space != "plane" and method == "paper"):
            continue  # which there is not, and what leaves nothing of a globe
        options = [*options, *([] if whole else ["--set", "max_sweeps=2"]), "--quiet"]
        alone = runner.one("optimize", f"{space}.vtu", "-o", "alone.vtu", *options, "--threads", "1")
        expected = runner.bytes("alone.vtu")
        runner.expect(alone.returncode in (0, 4) and expected is not None, f"{space} {method}, one process: {alone.returncode}")
        if expected is None:
            continue
        ways = itertools.product((1, 2, 3, 8), (1, 2, 3, 5, 8)) if whole else [(1, 2), (2, 3)]
        for threads, ranks in ways:
            (runner.folder / "ranks.vtu").unlink(missing_ok=True)
            code, text = runner.ranks(
                (ranks, ["optimize", f"{space}.vtu", "-o", "ranks.vtu", *options, "--threads", str(threads)]))
            runner.expect(code == alone.returncode and runner.bytes("ranks.vtu") == expected,
                          f"{space} {method}: {threads} threads × {ranks} ranks{'' if code in (0, 4) else ': ' + text}")


def small(runner):
    runner.one("example", "random", "--vertices", "300", "-o", "small.vtu")
    runner.one("optimize", "small.vtu", "-o", "alone.vtu", "--quiet")
    for ranks in (1, 3):
        runner.ranks((ranks, ["optimize", "small.vtu", "-o", "ranks.vtu", "--quiet", "--threads", "1"]))
        runner.expect(runner.bytes("ranks.vtu") == runner.bytes("alone.vtu"), f"one part, {ranks} ranks")


def say(runner):
    """The first rank prints, once."""
    good = ["optimize", "small.vtu", "-o", "out.vtu"]
    code, text = runner.ranks((2, good))
    runner.expect(code == 0 and text.count("wrote out.vtu") == 1 and text.count("2 ranks share this machine") == 1,
                  f"what is printed: exit {code}")
    code, text = runner.ranks((2, ["optimize", "--help"]))
    runner.expect(code == 0 and text.count("Usage") == 1, f"--help of all: exit {code}")
    (runner.folder / "out.vtu").write_bytes(OLD)
    code, text = runner.ranks((2, good), (1, ["optimize", "--help"]))
    runner.expect(code == 2 and "rank 2: optimize: has only shown its help" in text and runner.bytes("out.vtu") == OLD,
                  f"--help of one rank: exit {code}")
    words = ["sh", "-c", f"exec '{runner.program}' \"$@\" > /dev/full", "sh", *good]
    done = subprocess.run([runner.mpirun, "-n", "2", *words], cwd=runner.folder, env=runner.environment, capture_output=True,
                          text=True, timeout=LONGEST)
    runner.expect(done.returncode != 0 and "No space left" in done.stderr, f"no room for what is printed: {done.returncode}")


def refuse(runner):
    """What one rank finds ends all of them: a message, an exit code, and the output as it was."""
    good = ["optimize", "small.vtu", "-o", "out.vtu", "--threads", "1"]
    runner.one("example", "random", "--vertices", "300", "--seed", "9", "-o", "other.vtu")
    (runner.folder / "bad.vtu").write_bytes(b"<VTKFile")
    cases = {
        "other options": (good + ["--set", "max_sweeps=7"], "rank 2 has another mesh, other options"),
        "another mesh": (["optimize", "other.vtu", *good[2:]], "rank 2 has another mesh, other options"),
        "no file": (["optimize", "none.vtu", *good[2:]], "rank 2: none.vtu: cannot be read"),
        "a damaged file": (["optimize", "bad.vtu", *good[2:]], "rank 2: bad.vtu"),
        "an unknown option": (good + ["--sweep", "7"], "rank 2: optimize: unknown option --sweep"),
    }
    for name, (arguments, message) in cases.items():
        (runner.folder / "out.vtu").write_bytes(OLD)
        code, text = runner.ranks((2, good), (1, arguments))
        runner.expect(code != 0 and message in text and runner.bytes("out.vtu") == OLD,
                      f"{name} on one rank: exit {code}" + ("" if message in text else f": {text}"))
    code, text = runner.ranks((3, ["optimize", "none.vtu", "-o", "out.vtu"]))
    runner.expect(code == 1 and text.count("none.vtu: cannot be read") == 1 and "rank " not in text.split("\n")[0],
                  f"what all find is said once: exit {code}")
    full = ["-c", f"ulimit -f 1; exec '{runner.program}' optimize small.vtu -o out.vtu --threads 1 --quiet"]
    words = [runner.mpirun, "-n", "1", "sh", *full, ":", "-n", "1", runner.program, *good, "--quiet"]
    done = subprocess.run(words, cwd=runner.folder, env=runner.environment, capture_output=True, text=True, timeout=LONGEST)
    text = done.stdout + done.stderr
    runner.expect(done.returncode != 0 and "out.vtu" in text and runner.bytes("out.vtu") == OLD,
                  f"no room for the output: exit {done.returncode}" + ("" if "out.vtu" in text else f": {text}"))


def processes_of(runner, name):
    """Those of the program that have this word on their command line."""
    found = []
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (folder / "cmdline").read_bytes().split(b"\0")
        except OSError:
            continue
        if words[0] == runner.program.encode() and name.encode() in words:
            found.append(int(folder.name))
    return sorted(found)


def stop(runner, kills, rng):
    """Killed, a run leaves its output as it was, or the best mesh so far; asked to stop, it writes its best mesh."""
    del runner.environment["OMPI_MCA_odls_base_sigkill_timeout"]  # as users have it
    runner.one("example", "random", "--vertices", str(PARTS + 2000 if kills == 1 else 6 * PARTS), "-o", "large.vtu")
    words = ["optimize", "large.vtu", "--threads", "1", "--quiet"]
    started = time.monotonic()
    runner.ranks((3, [*words, "-o", "whole.vtu"]))
    seconds = time.monotonic() - started
    expected = runner.bytes("whole.vtu")
    for i in range(kills):
        (runner.folder / "killed.vtu").write_bytes(OLD)
        saves = ["--save-every", "0"] if i % 2 == 0 else []  # which make it last longer
        process = runner.start((3, [*words, "-o", "killed.vtu", *saves]))
        time.sleep(rng.uniform(0.1, 0.9) * seconds)
        victims = processes_of(runner, "killed.vtu")
        if victims:
            os.kill(rng.choice(victims), signal.SIGKILL)
        text, _ = process.communicate(timeout=LONGEST)
        if process.returncode == 0:  # it was done, or had not begun
            runner.expect(runner.bytes("killed.vtu") == expected, f"kill {i}: too late")
            continue
        whole = runner.bytes("killed.vtu") in (OLD, expected) or (saves and runner.one("check", "killed.vtu").returncode == 0)
        runner.expect(whole and "signal 9" in text, f"kill {i} of {len(victims)}: exit {process.returncode}")
    for share in (0.6, 0.4, 0.3):  # other work on this machine makes runs longer or shorter
        (runner.folder / "stopped.vtu").write_bytes(OLD)
        process = runner.start((3, [*words, "-o", "stopped.vtu"]))
        time.sleep(share * seconds)
        process.send_signal(signal.SIGUSR1)
        text, _ = process.communicate(timeout=LONGEST)
        if process.returncode != 0:
            break
    checked = runner.one("check", "stopped.vtu")
    runner.expect(process.returncode == 4 and checked.returncode == 0, f"SIGUSR1: exit {process.returncode}: {text[-300:]}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("mpirun")
    parser.add_argument("--all", action="store_true")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        runner = Runner(os.path.abspath(given.program), given.mpirun, pathlib.Path(scratch))
        same_bytes(runner, given.all)
        small(runner)
        say(runner)
        refuse(runner)
        stop(runner, 20 if given.all else 1, random.Random(1))
    print(f"{runner.rows} checks, {len(runner.problems)} problems")
    return 1 if runner.problems or runner.rows == 0 else 0


if __name__ == "__main__":
    sys.exit(main())

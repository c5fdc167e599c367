#!/usr/bin/env python3
"""`mpirun -n N temper optimize`: the bytes of one process, and what happens when a rank fails.

    ranks.py PROGRAM MPIRUN MACHINES         a sample: some seconds
    ranks.py PROGRAM MPIRUN MACHINES --all   threads 1, 2, 3, 8 × ranks 1, 2, 3, 5, 8 × spaces × methods, twenty kills, and how
                                             much memory a rank takes: half an hour

MACHINES is the library of imitated_machines.cpp.
Ranks share the processors of this machine, however few there are: nothing here is about speed. Prints a row for each
comparison and each fault, with --all also the hash of each result.
"""

import argparse
import hashlib
import itertools
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

APART, MERGED = ["--ranks", "process"], ["--ranks", "machine"]  # each process a rank; one rank for all of this machine
OLD = b"what was there before\n"
SPACES = {"plane": "random", "sphere": "random-sphere", "periodic": "random-periodic"}  # the examples of each
PARTS = 16384  # vertices of a part of a sweep
METHODS = {
    "default": [],
    "accuracy": ["--for", "stars"],
    "repair": ["--repair", "vertices", "--max-sweeps", "40"],
    "paper": ["--method", "paper", "--max-sweeps", "3"],
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
        """groups: (processes, arguments) each. Each process is a rank unless the arguments say otherwise."""
        words = [self.mpirun]
        for i, (processes, arguments) in enumerate(groups):
            words += ([":"] if i > 0 else []) + ["-n", str(processes), self.program, *arguments]
            words += [] if "--ranks" in arguments else APART
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
        options = [*options, *([] if whole else ["--max-sweeps", "2"]), "--quiet"]
        alone = runner.one("optimize", f"{space}.vtu", "-o", "alone.vtu", *options, "--threads", "1")
        expected = runner.bytes("alone.vtu")
        runner.expect(alone.returncode in (0, 4) and expected is not None, f"{space} {method}, one process: {alone.returncode}")
        if expected is None:
            continue
        if whole:
            print(hashlib.sha256(expected).hexdigest())
        ways = [(threads, ranks, APART) for threads, ranks in itertools.product((1, 2, 3, 8), (1, 2, 3, 5, 8))] if whole else [
            (1, 2, APART), (2, 3, APART)]
        for threads, ranks, unit in [*ways, (1, 3, MERGED)]:
            (runner.folder / "ranks.vtu").unlink(missing_ok=True)
            code, text = runner.ranks(
                (ranks, ["optimize", f"{space}.vtu", "-o", "ranks.vtu", *options, *unit, "--threads", str(threads)]))
            runner.expect(code == alone.returncode and runner.bytes("ranks.vtu") == expected,
                          f"{space} {method}: {threads} threads × {ranks} {unit[1]} ranks{'' if code in (0, 4) else ': ' + text}")


def small(runner):
    runner.one("example", "random", "--vertices", "300", "-o", "small.vtu")
    runner.one("optimize", "small.vtu", "-o", "alone.vtu", "--quiet")
    for ranks in (1, 3):
        runner.ranks((ranks, ["optimize", "small.vtu", "-o", "ranks.vtu", "--quiet", "--threads", "1"]))
        runner.expect(runner.bytes("ranks.vtu") == runner.bytes("alone.vtu"), f"one part, {ranks} ranks")


def merge(runner):
    """The processes of a machine are one rank: the bytes, warnings and endings of one process."""
    good = ["optimize", "small.vtu", "-o", "out.vtu", *MERGED]
    code, text = runner.ranks((3, good))
    runner.expect(code == 0 and runner.bytes("out.vtu") == runner.bytes("alone.vtu") and text.count("wrote out.vtu") == 1,
                  f"merged, as many threads as there are: exit {code}")
    cases = {
        "other words": (good + ["--max-sweeps", "7"], 1, "process 2: optimize: was started with other words"),
        "an unknown option": (good + ["--sweep", "7"], 2, "process 2: optimize: unknown option --sweep"),
        "another --ranks": ([*good[:4], *APART], 1, "--ranks, or --help, is not the same"),
        "--help": (["optimize", "--help", *MERGED], 1, "--ranks, or --help, is not the same"),
    }
    for name, (arguments, expected, message) in cases.items():
        (runner.folder / "out.vtu").write_bytes(OLD)
        code, text = runner.ranks((2, good), (1, arguments))
        runner.expect(code == expected and message in text and runner.bytes("out.vtu") == OLD,
                      f"{name} of one process: exit {code}" + ("" if message in text else f": {text}"))
    for unit in (APART, MERGED):
        words = ["sh", "-c", f"exec '{runner.program}' \"$@\" > /dev/full", "sh", *good[:4], *unit]
        done = subprocess.run([runner.mpirun, "-n", "2", *words], cwd=runner.folder, env=runner.environment, capture_output=True,
                              text=True, timeout=LONGEST)
        runner.expect(done.returncode != 0 and "No space left" in done.stderr, f"no room for what is printed, {unit[1]}: {done.returncode}")
    code, text = runner.ranks((2, ["optimize", "--help"]))
    runner.expect(code == 0 and text.count("Usage") == 1, f"--help of all: exit {code}")
    code, text = runner.ranks((3, ["optimize", "none.vtu", "-o", "out.vtu", *MERGED]))
    runner.expect(code == 1 and text.count("none.vtu: cannot be read") == 1 and runner.bytes("out.vtu") == OLD,
                  f"no input for merged processes: exit {code}")


def machines(runner, library):
    """Four processes on two machines, as it seems to them: two ranks, which have their input from two disks."""
    def run(path, **variables):
        there = f"test $OMPI_COMM_WORLD_RANK -ge 2 && in={path} || in=plane.vtu"  # on the second machine
        script = f"{there}; exec env LD_PRELOAD={library} '{runner.program}' optimize $in -o ranks.vtu --max-sweeps 2 --threads 1"
        script = script if path == "plane.vtu" else script + " --quiet"
        done = subprocess.run([runner.mpirun, "-n", "4", "sh", "-c", script], cwd=runner.folder, capture_output=True, text=True,
                              timeout=LONGEST, env=dict(runner.environment, MACHINE_SIZE="2", **variables))
        return done.returncode, done.stdout + done.stderr

    alone = runner.one("optimize", "plane.vtu", "-o", "alone2.vtu", "--max-sweeps", "2")
    for bound in ("-2", "0", "1"):
        (runner.folder / "ranks.vtu").unlink(missing_ok=True)
        code, text = run("plane.vtu", MACHINE_BOUND=bound)
        warned = "the processes of one machine may not run on each other's processors" in text
        runner.expect(code == alone.returncode and runner.bytes("ranks.vtu") == runner.bytes("alone2.vtu") and warned == (bound != "-2")
                      and text.count("wrote ranks.vtu") == 1, f"two machines, bound: {bound}: exit {code}{'' if code == 0 else text}")
    (runner.folder / "ranks.vtu").write_bytes(OLD)
    code, text = run("none.vtu")
    runner.expect(code == 1 and "rank 1: none.vtu: cannot be read" in text and runner.bytes("ranks.vtu") == OLD,
                  f"no file on the second machine: exit {code}")
    code, text = run("sphere.vtu")
    runner.expect(code == 1 and "rank 1 has another mesh" in text and runner.bytes("ranks.vtu") == OLD,
                  f"another file on the second machine: exit {code}")


def refuse(runner):
    """What one rank finds ends all of them: a message, an exit code, and the output as it was."""
    good = ["optimize", "small.vtu", "-o", "out.vtu", "--threads", "1"]
    runner.one("example", "random", "--vertices", "300", "--seed", "9", "-o", "other.vtu")
    (runner.folder / "bad.vtu").write_bytes(b"<VTKFile")
    cases = {
        "other options": (good + ["--max-sweeps", "7"], "rank 2 has another mesh, other options"),
        "another mesh": (["optimize", "other.vtu", *good[2:]], "rank 2 has another mesh, other options"),
        "no file": (["optimize", "none.vtu", *good[2:]], "rank 2: none.vtu: cannot be read"),
        "a damaged file": (["optimize", "bad.vtu", *good[2:]], "rank 2: bad.vtu"),
        "an unknown option": (good + ["--sweep", "7"], "process 2: optimize: unknown option --sweep"),
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
    seconds = {}
    for unit in (APART, MERGED):
        started = time.monotonic()
        runner.ranks((3, [*words, "-o", "whole.vtu", *unit]))
        seconds[unit[1]] = time.monotonic() - started
    expected = runner.bytes("whole.vtu")
    for i in range(kills):
        unit = MERGED if i % 4 == 3 else APART
        (runner.folder / "killed.vtu").write_bytes(OLD)
        saves = ["--save-every", "0"] if i % 2 == 0 else []  # which make it last longer
        process = runner.start((3, [*words, "-o", "killed.vtu", *saves, *unit]))
        time.sleep(rng.uniform(0.1, 1) * seconds[unit[1]])
        victims = processes_of(runner, "killed.vtu")
        if victims:
            os.kill(rng.choice(victims), signal.SIGKILL)
        text, _ = process.communicate(timeout=LONGEST)
        if process.returncode == 0:  # it was done, or had not begun
            runner.expect(runner.bytes("killed.vtu") == expected, f"kill {i}: too late")
            continue
        whole = runner.bytes("killed.vtu") in (OLD, expected)
        if (saves or unit == MERGED) and not whole:  # one that slept was killed, and mpirun asked the one that worked to stop
            whole = runner.one("check", "killed.vtu").returncode == 0
        runner.expect(whole and "signal 9" in text, f"kill {i} of {len(victims)}: exit {process.returncode}")
    for unit in (APART, MERGED):
        for share in (0.6, 0.4, 0.3):  # other work on this machine makes runs longer or shorter
            (runner.folder / "stopped.vtu").write_bytes(OLD)
            process = runner.start((3, [*words, "-o", "stopped.vtu", *unit]))
            time.sleep(share * seconds[unit[1]])
            process.send_signal(signal.SIGUSR1)
            text, _ = process.communicate(timeout=LONGEST)
            if process.returncode != 0:
                break
        checked = runner.one("check", "stopped.vtu")
        runner.expect(process.returncode == 4 and checked.returncode == 0,
                      f"SIGUSR1, {unit[1]}: exit {process.returncode}: {text[-300:]}")


def memory(runner):
    """Prints the peak of each process, bytes a vertex."""
    n = 1000000
    runner.one("example", "random", "--vertices", str(n), "-o", "million.vtu", "--encoding", "appended")
    for unit, ranks in itertools.product((APART, MERGED), (1, 2, 4, 8)):
        log = runner.folder / f"{ranks}-{unit[1]}.log"
        words = ["-v", "-o", log, "-a", runner.program, "optimize", "million.vtu", "-o", "out.vtu", "--encoding",
                 "appended", "--max-sweeps", "10", "--threads", "1", "--quiet", *unit]
        subprocess.run([runner.mpirun, "-n", str(ranks), "/usr/bin/time", *words], cwd=runner.folder, env=runner.environment,
                       capture_output=True)
        peaks = [1024 * int(line.split(":")[1]) / n for line in log.read_text().split("\n") if "Maximum resident" in line]
        print(f"{ranks} processes, {unit[1]} ranks: {[round(peak) for peak in peaks]}, {sum(peaks):.0f} bytes a vertex")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("mpirun")
    parser.add_argument("machines")
    parser.add_argument("--all", action="store_true")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        runner = Runner(os.path.abspath(given.program), given.mpirun, pathlib.Path(scratch))
        same_bytes(runner, given.all)
        small(runner)
        merge(runner)
        machines(runner, os.path.abspath(given.machines))
        refuse(runner)
        stop(runner, 20 if given.all else 1, random.Random(1))
        if given.all:
            memory(runner)
    print(f"{runner.rows} checks, {len(runner.problems)} problems")
    return 1 if runner.problems or runner.rows == 0 else 0


if __name__ == "__main__":
    sys.exit(main())

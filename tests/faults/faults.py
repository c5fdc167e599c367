#!/usr/bin/env python3
"""Faults in every verb of the program: killed, interrupted, out of memory, files that cannot be written.

    faults.py PROGRAM SHIM              a sample of each kind, with a fixed seed: some seconds
    faults.py PROGRAM SHIM --all        each allocation and each call that writes; many moments
    faults.py PROGRAM SHIM --verb mesh --kind allocate
    faults.py PROGRAM SHIM --vertices 100000 --kind interrupt --kind limit      how soon large runs end

What is run are the examples in the help of each verb, in a folder with the files that they name: a new verb is tested
without a line here. After a fault every output is as it was or whole, the exit code and a message say what happened,
and no temporary file is left, but by a kill, after which the same command removes it. Prints a table of how many faults
were injected, by kind, and what went wrong with which.
"""

import argparse
import collections
import dataclasses
import errno
import json
import os
import pathlib
import random
import re
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile

OLD = b"what was there before\n"
LAKE = """6 2 0 0
1 0 0\n2 1 0\n3 1.2 0.6\n4 0.7 1\n5 0.2 0.9\n6 -0.1 0.5
6 0
1 1 2\n2 2 3\n3 3 4\n4 4 5\n5 5 6\n6 6 1
0
"""
# Seconds of a processor that a program may still use after a signal or the end of --time-limit. What it waits for meanwhile, a
# slow disk or its turn beside other programs, says nothing about it.
LATEST = 1.0
FINE = (0, 3, 6)  # done, a requirement that is not met, no weights: the verb did its work
ERRORS = {"open": (errno.EACCES, errno.ENOSPC), "write": (errno.ENOSPC, errno.EIO), "short": (0,),
          "fsync": (errno.EIO,), "close": (errno.EIO, errno.ENOSPC), "rename": (errno.EIO,)}


@dataclasses.dataclass
class Case:
    """A command, the folder that it is run in, and what it does there when nothing goes wrong."""

    verb: str
    arguments: list
    inputs: dict  # name: bytes
    exit: int = 0
    outputs: dict = dataclasses.field(default_factory=dict)  # name: bytes
    volatile: set = dataclasses.field(default_factory=set)  # outputs that say how long it took
    seconds: float = 0  # of a processor
    counts: dict = dataclasses.field(default_factory=dict)  # calls by kind

    def __str__(self):
        return "temper " + shlex.join(self.arguments)


@dataclasses.dataclass
class Outcome:
    exit: int
    error: str
    files: dict
    seconds: float  # of a processor, after the signal or in all


def seconds_of_children():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def seconds_of(process):
    """What a process has used so far, of which no wait() has told yet (proc(5), fields 14 and 15)."""
    fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def files_in(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


class Runner:
    def __init__(self, program, shim, scratch, vertices):
        self.program, self.shim, self.scratch, self.vertices = program, shim, scratch, str(vertices)

    def fill(self, files):
        folder = self.scratch / "run"
        shutil.rmtree(folder, ignore_errors=True)
        for name, content in files.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_bytes(content)
        folder.mkdir(exist_ok=True)
        return folder

    def start(self, arguments, folder, environment=()):
        return subprocess.Popen([self.program, *arguments], cwd=folder, stdin=subprocess.DEVNULL, text=True,
                                errors="replace", stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                env={**os.environ, **dict(environment)})

    def run(self, arguments, files, environment=(), send=None, after=0.0):
        """One run; `send` is the signal that it gets `after` so many seconds."""
        folder = self.fill(files) if files is not None else self.scratch / "run"
        begin = seconds_of_children()
        process = self.start(arguments, folder, environment)
        if send is not None:
            try:
                process.wait(after)
                begin = seconds_of_children()  # it ended before the signal
            except subprocess.TimeoutExpired:
                begin += seconds_of(process)
                process.send_signal(send)
        error = process.communicate(timeout=120)[1]
        return Outcome(process.returncode, error, files_in(folder), seconds_of_children() - begin)

    def with_fault(self, case, fault, files):
        return self.run(case.arguments, files, {"LD_PRELOAD": self.shim, "TEMPER_FAULT": fault})

    def help(self, verb=None):
        words = [verb, "--help-all"] if verb else ["--help"]
        return subprocess.run([self.program, *words], capture_output=True, text=True, check=True).stdout


def verbs(runner):
    listed = re.search(r"^Verbs:\n((?:  .+\n)+)", runner.help(), re.M).group(1)
    return [line.split()[0] for line in listed.splitlines()]


def examples(text):
    """The commands of the examples, each as a list of words without the program's name."""
    lines = re.search(r"^Examples:\n((?:  .+\n)+)", text, re.M).group(1).splitlines()
    commands = [c.strip() for line in lines if "#" not in line for c in re.split(r"&&|;", line)]
    return [shlex.split(c)[1:] for c in commands if c.startswith("temper ")]


def measured(runner, case):
    """Runs a case twice without a fault. None: it does not write, or needs a file that is not there."""
    counts = runner.scratch / "counts"
    first = runner.run(case.arguments, case.inputs, {"LD_PRELOAD": runner.shim, "TEMPER_FAULT_COUNTS": str(counts)})
    if first.exit not in FINE:
        return None
    second = runner.run(case.arguments, case.inputs)
    case.exit, case.seconds = first.exit, second.seconds
    case.outputs = {n: b for n, b in first.files.items() if case.inputs.get(n) != b}
    case.volatile = {n for n, b in second.files.items() if first.files[n] != b}
    case.counts = {k: int(n) for k, n in (line.split() for line in counts.read_text().splitlines())}
    return case


def cases_of(runner, verb):
    """The examples of a verb, in the folder that those before leave behind."""
    # These, and in.vtu, are what examples read that none of them makes.
    files = {"lake.poly": LAKE.encode(), "layers.csv": b"vertex,top,bottom 1,bottom 2\n*,2,1,0\n"}
    files = runner.run(["example", "random", "--vertices", runner.vertices, "--seed", "7", "-o", "in.vtu"], files).files
    found = []
    for command in examples(runner.help(verb)):
        case = measured(runner, Case(verb, command, files))
        if case is None:
            continue
        files = {**files, **case.outputs}
        if command[0] == verb and "--list" not in command:
            found.append(case)
    return found


class Judge:
    """Counts the faults and what did not survive them."""

    def __init__(self):
        self.injected = collections.Counter()
        self.problems = []

    def expect(self, holds, case, fault, what):
        if not holds:
            self.problems.append(f"{case}: {fault}: {what}")

    def whole(self, case, name, content):
        if content == case.outputs[name]:
            return True
        if name not in case.volatile:
            return False
        try:
            return name.endswith(".json") and json.loads(content) is not None
        except ValueError:
            return False

    def files(self, case, fault, outcome, temporaries=False):
        """Each output old or new, and nothing else."""
        for name, content in outcome.files.items():
            if name in case.outputs:
                known = content == OLD or self.whole(case, name, content)
                self.expect(known, case, fault, f"{name} is neither old nor whole")
            elif name in case.inputs:
                self.expect(content == case.inputs[name], case, fault, f"{name}, an input, has changed")
            else:
                left = temporaries and re.search(r"\.tmp\d+$", name)
                self.expect(left, case, fault, f"{name} is left behind")

    def failure(self, case, fault, outcome, exits):
        self.expect(outcome.exit in exits, case, fault, f"exit code {outcome.exit}, expected one of {exits}: "
                    + outcome.error.strip()[-200:])
        if outcome.exit not in (*FINE, 4):
            self.expect("temper: " in outcome.error, case, fault, "no message")
            self.expect("internal error" not in outcome.error, case, fault, outcome.error.strip())

    def all_new(self, case, fault, outcome):
        for name in case.outputs:
            content = outcome.files.get(name)
            new = content is not None and self.whole(case, name, content)
            self.expect(new, case, fault, f"{name} is not the new file, exit code {outcome.exit}")


def with_old_outputs(case):
    return {**case.inputs, **{name: OLD for name in case.outputs}}


def numbers(n, wanted, rng):
    """Of 1 … n all, or as many as wanted, the first and the last among them."""
    if wanted is None or n <= wanted:
        return list(range(1, n + 1))
    return sorted({1, n, *(rng.randint(1, n) for _ in range(wanted - 2))})


def fail_allocations(runner, case, judge, wanted, rng):
    for kind in ("allocate", "allocate+"):
        for n in numbers(case.counts["allocate"], wanted, rng):
            fault = f"{kind}:{n}"
            outcome = runner.with_fault(case, fault, with_old_outputs(case))
            judge.injected[kind] += 1
            judge.failure(case, fault, outcome, (case.exit, 1, 5))
            judge.files(case, fault, outcome)
            if outcome.exit == case.exit:
                judge.all_new(case, fault, outcome)


def fail_writes(runner, case, judge, wanted, rng):
    for kind, codes in ERRORS.items():
        for n in numbers(case.counts[kind], wanted, rng):
            for code in codes:
                fault = f"{kind}:{n}:{code}"
                outcome = runner.with_fault(case, fault, with_old_outputs(case))
                judge.injected[kind] += 1
                judge.files(case, fault, outcome)
                # A lock that is let go after its file is in place has nothing left to lose.
                fails = {"short": (case.exit,), "close": (case.exit, 1)}.get(kind, (1,))
                judge.failure(case, fault, outcome, fails)
                if outcome.exit == case.exit:
                    judge.all_new(case, fault, outcome)
                if outcome.exit != case.exit:
                    judge.expect(os.strerror(code) in outcome.error, case, fault, "the error is not named")


def kill(runner, case, judge, wanted, rng):
    """Killed, and then run again: nothing may be in the way."""
    for _ in range(wanted or 100):
        after = rng.uniform(0, 1.1 * case.seconds)
        fault = f"killed after {after:.4f} s"
        outcome = runner.run(case.arguments, with_old_outputs(case), send=signal.SIGKILL, after=after)
        judge.injected["kill -9"] += 1
        judge.files(case, fault, outcome, temporaries=True)
        again = runner.run(case.arguments, None)
        judge.failure(case, fault + ", run again", again, (case.exit,))
        judge.files(case, fault + ", run again", again)
        judge.all_new(case, fault + ", run again", again)


def interrupt(runner, case, judge, wanted, rng):
    for i in range(wanted or 100):
        sent = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)[i % 3]
        after = rng.uniform(0.01, 1.1 * case.seconds)
        fault = f"{sent.name} after {after:.4f} s"
        outcome = runner.run(case.arguments, with_old_outputs(case), send=sent, after=after)
        judge.injected["interrupted"] += 1
        before_main = outcome.exit == -sent and outcome.error == ""
        if not before_main:
            judge.failure(case, fault, outcome, (case.exit, 4, -sent))
        judge.expect(outcome.seconds <= LATEST, case, fault, f"worked on for {outcome.seconds:.2f} s")
        # Stopped early, a verb writes another mesh.
        if outcome.exit != 4:
            judge.files(case, fault, outcome)
        if outcome.exit == case.exit:
            judge.all_new(case, fault, outcome)


def limit_time(runner, case, judge, wanted, rng):
    if {"--zero", "--check-certificate", "--time-limit"} & set(case.arguments):
        return
    if "--time-limit" not in runner.help(case.verb):
        return
    for _ in range(wanted or 5):
        limit = rng.uniform(0.5, 1.0) * case.seconds
        fault = f"--time-limit {limit:.4f}"
        outcome = runner.run([*case.arguments, "--time-limit", f"{limit:.4f}"], with_old_outputs(case))
        judge.injected["--time-limit"] += 1
        judge.failure(case, fault, outcome, (case.exit, 4))
        late = outcome.seconds - limit * os.cpu_count()
        judge.expect(late <= max(LATEST, 0.05 * limit), case, fault, f"worked on for {late:.2f} s")


# How many of each kind a sample has: of the calls of each kind, or moments.
KINDS = {"allocate": (fail_allocations, 3), "write": (fail_writes, 2), "kill": (kill, 1), "interrupt": (interrupt, 3),
         "limit": (limit_time, 1)}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("shim")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--verb", action="append")
    parser.add_argument("--kind", action="append", choices=KINDS)
    parser.add_argument("--vertices", type=int, default=60, help="of the mesh that examples read")
    given = parser.parse_args()
    judge, rng = Judge(), random.Random(1)
    with tempfile.TemporaryDirectory() as scratch:
        runner = Runner(os.path.abspath(given.program), os.path.abspath(given.shim), pathlib.Path(scratch), given.vertices)
        for verb in given.verb or verbs(runner):
            cases = cases_of(runner, verb)
            if not cases:
                judge.problems.append(f"{verb}: no example in its help could be run")
            for case in cases if given.all else cases[:1]:
                for kind in given.kind or KINDS:
                    function, sample = KINDS[kind]
                    function(runner, case, judge, None if given.all else sample, rng)
    for kind, n in judge.injected.items():
        print(f"| {kind} | {n} |")
    for problem in judge.problems[:50]:
        print(problem)
    print(f"{sum(judge.injected.values())} faults, {len(judge.problems)} problems")
    return 1 if judge.problems or not judge.injected else 0


if __name__ == "__main__":
    sys.exit(main())

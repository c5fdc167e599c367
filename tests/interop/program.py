"""The program that a test of this folder is given as its first argument."""

import subprocess
import sys

from checks import check


def run(*words):
    return subprocess.run([sys.argv[1], *words], capture_output=True, text=True)


def convert(source, target):
    done = run("convert", source, "-o", target)
    check(done.returncode == 0, f"convert {source}: {done.stderr}")
    return done.stderr

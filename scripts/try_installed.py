#!/usr/bin/env python3
"""Tries an installed temper: the module, the program beside it, and `python -m temper`. Writes into the current folder.

    python scripts/try_installed.py [--module]      --module: without starting programs

Prints the seconds of `import temper`, without the start of Python and of NumPy.
"""

import importlib.resources
import subprocess
import sys
import time

import numpy  # noqa: F401: its import is not counted

start = time.perf_counter()
import temper  # noqa: E402

seconds = time.perf_counter() - start


def main() -> None:
    mesh = temper.generate.annulus()
    temper.optimize(mesh)
    assert temper.quality(mesh).well_centered_fraction == 1
    temper.write("ring.vtu", mesh)
    assert temper.read("ring.vtu").n_triangles == mesh.n_triangles
    assert temper.build_info()["version"] == temper.__version__
    files = importlib.resources.files("temper")
    assert (files / "py.typed").is_file() and (files / "_temper.pyi").is_file() and (files / "_options.pyi").is_file()
    assert "Algorithm 1" in temper.optimize.__doc__
    if "--module" not in sys.argv[1:]:
        for command in (["temper"], [sys.executable, "-m", "temper"]):
            done = subprocess.run([*command, "check", "ring.vtu", "--require", "outside=0"], capture_output=True, text=True)
            assert done.returncode == 0 and "ring.vtu" in done.stdout, done
            done = subprocess.run([*command, "check", "nowhere.vtu"], capture_output=True, text=True)
            assert done.returncode == 1 and "nowhere.vtu" in done.stderr, done
    print(f"{seconds:.3f} s")


main()

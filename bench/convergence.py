#!/usr/bin/env python3
"""Draws the energy of the accuracy objective against time, for two programs and several meshes.

    bench/convergence.py OLD NEW OUT.svg MESH...

OLD and NEW are two builds of temper. Each one optimizes each mesh on one thread, five times in turn. The quickest run
of each is drawn. The energy is a ratio to the least one of both, minus 1. The sweeps before the first one of this
objective lower another energy: there the line starts late.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as pyplot  # noqa: E402: after the choice of the backend

ROUNDS = 5


def sweeps(program, mesh, folder):
    """Seconds and energies of the sweeps for accuracy, in one run."""
    report = folder / "report.json"
    command = [program, "optimize", mesh, "-o", folder / "out.vtu", "--threads", "1", "--quiet", "--write", report]
    if mesh.suffix == ".14":
        command += ["--projection", "stereographic"]
    subprocess.run([*map(str, command)], check=True)
    history = json.loads(report.read_text())["history"]
    return [(row["seconds"], row["energy"]) for row in history if row.get("objective") == "accuracy"]


def main(programs, out, meshes):
    matplotlib.rcParams.update({"svg.hashsalt": "temper", "svg.fonttype": "none", "font.size": 9})
    figure, axes = pyplot.subplots(1, len(meshes), figsize=(3 * len(meshes), 2.6), squeeze=False)
    with tempfile.TemporaryDirectory() as name:
        for plot, mesh in zip(axes[0], meshes):
            runs = [[sweeps(program, mesh, pathlib.Path(name)) for program in programs] for _ in range(ROUNDS)]
            best = [min(of_one, key=lambda run: run[-1][0]) for of_one in zip(*runs)]
            least = min(energy for run in best for _, energy in run)
            for run, label, color in zip(best, ("before", "now"), ("#d55e00", "#0072b2")):
                plot.semilogy([t for t, _ in run], [max(e / least - 1, 1e-9) for _, e in run], label=label, color=color)
            plot.set_ylim(bottom=1e-5)
            plot.set_title(mesh.stem)
            plot.set_xlabel("seconds, one thread")
    axes[0, 0].set_ylabel("energy over the least, minus 1")
    axes[0, 0].legend(frameon=False)
    figure.savefig(out, metadata={"Date": None, "Creator": None}, bbox_inches="tight")


if __name__ == "__main__":
    if len(sys.argv) < 5:
        sys.exit(__doc__)
    main(sys.argv[1:3], sys.argv[3], [pathlib.Path(path) for path in sys.argv[4:]])

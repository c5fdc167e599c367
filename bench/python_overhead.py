#!/usr/bin/env python3
"""What Python adds to a run: arrays in, some sweeps, arrays out, against the C++ of the same in the same process.

    PYTHONPATH=build/python/python bench/python_overhead.py [VERTICES [SWEEPS [REPEATS]]]   default: 1000000 4 5

C++ is timed by the compiled half's own clock around Mesh::build, optimize and a loop that copies points, weights and
corners to vectors (bench/cpp_run.cpp, built beside the module with TEMPER_BUILD_BENCH); Python is everything that a user calls: temper.Mesh(points, triangles),
temper.optimize, and packed copies of mesh.points, mesh.weights and mesh.triangles. Both get the same arrays and
threads; runs take turns. Results must be the same bits. Printed are the ratios of neighbors, of wall-clock time and
of the processors' time, which other programs on the machine disturb less, and their medians. Exit code 1 when that of
the processors' time is 1.1 or more.
"""

import statistics
import sys
import time

import numpy as np

import cpp_run
import temper


def python_run(points, triangles, sweeps):
    start, cpu = time.perf_counter(), time.process_time()
    mesh = temper.Mesh(points, triangles)
    temper.optimize(mesh, options={"max_sweeps": sweeps, "repair": "none"})
    arrays = tuple(np.ascontiguousarray(a) for a in (mesh.points, mesh.weights, mesh.triangles))
    return (time.perf_counter() - start, time.process_time() - cpu), arrays


def plain_run(points, triangles, sweeps):
    cpu = time.process_time()
    seconds, arrays = cpp_run.run(points, triangles, sweeps)
    return (seconds, time.process_time() - cpu), arrays


def main(vertices=1_000_000, sweeps=4, repeats=5):
    mesh = temper.generate.random_mesh(vertices)
    points, triangles = np.array(mesh.points), np.array(mesh.triangles)
    del mesh
    ratios = []
    for turn in range(repeats):
        runs = {}
        for which in (python_run, plain_run) if turn % 2 else (plain_run, python_run):
            runs[which] = which(points, triangles, sweeps)
        (python, ours), (cpp, theirs) = runs[python_run], runs[plain_run]
        if not all(np.array_equal(a, b) for a, b in zip(ours, theirs)):
            raise SystemExit("not the same mesh")
        ratios.append((python[0] / cpp[0], python[1] / cpp[1]))
        times = f"Python {python[0]:.3f} s ({python[1]:.3f} s of processors), C++ {cpp[0]:.3f} s ({cpp[1]:.3f} s)"
        print(f"{len(points)} vertices, {sweeps} sweeps: {times}, ratios {ratios[-1][0]:.4f}, {ratios[-1][1]:.4f}")
    wall, cpu = (statistics.median(column) for column in zip(*ratios))
    print(f"median ratio {wall:.4f}, of the processors' time {cpu:.4f}")
    return 1 if cpu >= 1.1 else 0


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))

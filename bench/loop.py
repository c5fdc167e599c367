#!/usr/bin/env python3
"""Measures updates of a mesh in a loop: temper.Optimizer against a run over the whole mesh.

    bench/loop.py [--cells tetrahedra] [--target any,vertex,cell] [--vertices 20000] [--steps 100] [--figure loop.svg]
    bench/loop.py --change sizes

In each step one vertex of a hundred, inside the mesh, moves by up to --amount of its local size to any side, and an
update follows. The moves are halved as long as they would turn a tetrahedron over. Each tenth step a whole run takes the same mesh with the same moves. With --change sizes, vertices do not
move. Instead a fine spot with half of the sizes moves on by a fifth of its radius. A row has, over all steps: seconds
of the processor of an update and of a whole run, their ratio, the share of the vertices whose place or weight the update
changed, the rows of a matrix to compute again, and the places that violate the criterion of the target. --check exits
with 1 if a ratio of means is above 0.1, a share above 0.05, or a place violates the criterion. --threads 2 makes each
update twice, on 1 and on 2 threads, and compares bytes.
"""

import argparse
import contextlib
import sys
import time

import numpy as np

import temper

SHARE_OF_MOVES = 0.01
WHOLE_RUN_EVERY = 10
LARGEST_RATIO, LARGEST_SHARE = 0.1, 0.05


def plane(n):
    """n random points in a square."""
    return temper.generate.random_mesh(n, seed=1)


def with_points(mesh, points):
    """The mesh with other places. A whole run refuses weights that hide a vertex, so it begins without weights."""
    if isinstance(mesh, temper.Mesh):
        return temper.Mesh(points, mesh.triangles)
    return temper.TetMesh(points, mesh.tetrahedra)


def cube(n):
    """About n points of a body-centered lattice with noise, as a cube of tetrahedra."""
    side = max(2, round((n / 2) ** (1 / 3)))
    corners = np.stack(np.meshgrid(*3 * [np.arange(side + 1)], indexing="ij"), axis=-1).reshape(-1, 3)
    centers = np.stack(np.meshgrid(*3 * [np.arange(side)], indexing="ij"), axis=-1).reshape(-1, 3)
    corner = lambda p: (p[:, 0] * (side + 1) + p[:, 1]) * (side + 1) + p[:, 2]  # noqa: E731
    center = lambda p: len(corners) + (p[:, 0] * side + p[:, 1]) * side + p[:, 2]  # noqa: E731
    tetrahedra = []
    for axis in range(3):
        first = centers[centers[:, axis] < side - 1]
        along, u, v = (np.eye(3, dtype=int)[(axis + k) % 3] for k in range(3))
        ring = [corner(first + along + a * u + b * v) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        for a, b in zip(ring, ring[1:] + ring[:1]):
            tetrahedra.append(np.stack([a, b, center(first), center(first + along)], axis=1))
    tetrahedra = np.concatenate(tetrahedra)
    points = np.concatenate([corners, centers + 0.5]).astype(float)
    used, numbers = np.unique(tetrahedra, return_inverse=True)
    points, tetrahedra = points[used], numbers.reshape(-1, 4)
    mesh = temper.TetMesh(points, tetrahedra)
    inside = inner_vertices(mesh)
    points[inside] += np.random.default_rng(1).uniform(-0.05, 0.05, (len(inside), 3))
    return temper.TetMesh(points, tetrahedra)


def sizes_of(mesh):
    """The mean length of the edges at each vertex."""
    cells = mesh.triangles if isinstance(mesh, temper.Mesh) else mesh.tetrahedra
    total, count = np.zeros(mesh.n_vertices), np.zeros(mesh.n_vertices)
    k = cells.shape[1]
    for i in range(k):
        for j in range(k):
            if i != j:
                np.add.at(total, cells[:, i], np.linalg.norm(mesh.points[cells[:, i]] - mesh.points[cells[:, j]], axis=1))
                np.add.at(count, cells[:, i], 1)
    return total / count


def inner_vertices(mesh):
    inside = np.ones(mesh.n_vertices, dtype=bool)
    if isinstance(mesh, temper.Mesh):
        inside[mesh.boundary_edges.ravel()] = False
    else:
        t, f = np.nonzero(mesh.neighbors < 0)
        for corner in range(4):
            at = f != corner
            inside[mesh.tetrahedra[t[at], corner]] = False
    return np.flatnonzero(inside)


def deep_vertices(mesh):
    """Vertices with no neighbor on the boundary: a small move does not take them across it."""
    cells = mesh.triangles if isinstance(mesh, temper.Mesh) else mesh.tetrahedra
    outer = np.setdiff1d(np.arange(mesh.n_vertices), inner_vertices(mesh))
    return np.setdiff1d(np.arange(mesh.n_vertices), cells[np.isin(cells, outer).any(axis=1)])


def violations(mesh, target):
    """Places that violate the criterion of the target, by the report of quality()."""
    q = temper.quality(mesh)
    if isinstance(mesh, temper.Mesh):
        if target == "vertex":
            return q.non_regular_edges + q.negative_boundary_duals + q.negative_region_coefficients
        if target == "cell":
            return q.nonpositive_distances + q.nonpositive_boundary_distances
        return q.triangles - round(q.well_centered_fraction * q.triangles)
    if target == "vertex":
        return q.negative_coefficients
    if target == "cell":
        return q.nonpositive_distances
    return q.orthocenters_outside


def seconds_of(call):
    start = time.process_time()
    result = call()
    return time.process_time() - start, result


def moves(mesh, arguments, rng, inside):
    """Some vertices, and their new places."""
    moved = rng.choice(inside, max(1, round(SHARE_OF_MOVES * mesh.n_vertices)), replace=False)
    by = rng.normal(size=(len(moved), mesh.points.shape[1]))
    by *= (rng.uniform(0, arguments.amount, len(moved)) * sizes_of(mesh)[moved] / np.linalg.norm(by, axis=1))[:, None]
    return moved, mesh.points[moved] + by


def spot(mesh, size, step):
    """The field of a fine spot, whose center has gone a part of the way through the mesh."""
    low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
    radius = 0.1 * (high - low).min()
    center = low + (high - low) * (0.3, 0.5) + (0.2 * radius * (step % 20), 0)
    far = np.linalg.norm(mesh.points - center, axis=1)
    return temper.SizeField.from_values(mesh, size * np.clip(far / radius - 0.5, 0.5, 1))


def loop(mesh, target, arguments):
    """One row, and the seconds of each update."""
    temper.optimize(mesh, target=target, threads=1, progress=False)
    optimizer = temper.Optimizer(mesh, target=target, threads=1)
    optimizer.update()
    check = min(seconds_of(optimizer.update)[0] for _ in range(5))
    rng = np.random.default_rng(2)
    inside, size = deep_vertices(mesh), np.median(sizes_of(mesh))
    updates, wholes, shares, rows, bad = [], [], [], [], 0
    for step in range(arguments.steps):
        places, weights = mesh.points.copy(), mesh.weights.copy()
        if arguments.change == "moves":
            moved, to = moves(mesh, arguments, rng, inside)
            places[moved] = to
            change = ("move", moved, to)
        else:
            change = ("resize", spot(mesh, size, step))
        if step % WHOLE_RUN_EVERY == 0:
            with contextlib.suppress(temper.TemperError):  # triangles may turn over, which only an update repairs
                whole = with_points(mesh, places)
                wholes.append(seconds_of(lambda whole=whole: temper.optimize(whole, target=target, threads=1, progress=False))[0])
        copy = mesh.copy()
        while True:
            getattr(optimizer, change[0])(*change[1:])
            try:
                seconds, update = seconds_of(optimizer.update)
                break
            except temper.TemperError:
                optimizer.forget()
                places[moved] = (mesh.points[moved] + places[moved]) / 2
                change = ("move", moved, places[moved])
        if arguments.threads > 1:
            again = temper.Optimizer(copy, target=target, threads=arguments.threads)
            getattr(again, change[0])(*change[1:])
            again.update()
            assert copy == mesh, f"step {step}: other bytes on {arguments.threads} threads"
        updates.append(seconds)
        rows.append(len(update.rows) / mesh.n_vertices)
        was = update.vertices if len(update.vertices) else np.arange(mesh.n_vertices)
        kept = np.flatnonzero(was >= 0)
        differ = (places[was[kept]] != mesh.points[kept]).any(axis=1) | (weights[was[kept]] != mesh.weights[kept])
        shares.append((differ.sum() + 2 * (mesh.n_vertices - len(kept)) + len(places) - mesh.n_vertices) / len(places))
        if len(update.vertices):
            inside = deep_vertices(mesh)
        bad = max(bad, violations(mesh, target))
    return {"check": check, "updates": updates, "wholes": wholes, "shares": shares, "rows": rows, "bad": bad}


def draw(rows, path):
    """The time of each update over that of a whole run, against the step."""
    import matplotlib

    matplotlib.use("svg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(6, 3))
    for target, row in rows.items():
        axes.plot(np.array(row["updates"]) / np.mean(row["wholes"]), label=target, linewidth=0.8)
    axes.axhline(LARGEST_RATIO, color="#aaaaaa", linewidth=0.6)
    axes.set(xlabel="step", ylabel="update over whole run", ylim=(0, None))
    axes.legend(frameon=False)
    figure.savefig(path, metadata={"Date": None, "Creator": None}, bbox_inches="tight")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", choices=["triangles", "tetrahedra"], default="triangles")
    parser.add_argument("--change", choices=["moves", "sizes"], default="moves")
    parser.add_argument("--target", default="any,vertex,cell")
    parser.add_argument("--vertices", type=int, default=20000)
    parser.add_argument("--steps", type=int, default=100)
    parser.add_argument("--amount", type=float, default=0.35)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--figure")
    arguments = parser.parse_args()
    print("| target | whole run [s] | update [s] | ratio | largest | check | changed, mean | largest | rows | bad |")
    print("|-|-|-|-|-|-|-|-|-|-|")
    missed, all_rows = False, {}
    for target in arguments.target.split(","):
        mesh = plane(arguments.vertices) if arguments.cells == "triangles" else cube(arguments.vertices)
        row = all_rows[target] = loop(mesh, target, arguments)
        whole = np.mean(row["wholes"])
        ratio = np.mean(row["updates"]) / whole
        print(
            f"| {target} | {whole:.3f} | {np.mean(row['updates']):.4f} | {ratio:.3f} | {max(row['updates']) / whole:.3f} | "
            f"{row['check'] / whole:.3f} | {np.mean(row['shares']):.4f} | {max(row['shares']):.4f} | {np.mean(row['rows']):.3f} | {row['bad']} |",
            flush=True,
        )
        missed = missed or ratio > LARGEST_RATIO or max(row["shares"]) > LARGEST_SHARE or row["bad"] > 0
    if arguments.figure:
        draw(all_rows, arguments.figure)
    return 1 if arguments.check and missed else 0


if __name__ == "__main__":
    sys.exit(main())

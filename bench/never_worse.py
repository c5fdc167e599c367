#!/usr/bin/env python3
"""Prints a table for each target: how runs change the errors of solvers on structured grids and on public meshes.

    bench/never_worse.py TEMPER [TARGET…]

Each number is an error after a run over the error before it. Numbers above 1 are bold if the target names the measure.
`temper errors` measures on the held-back fields, which no objective has seen. The table takes root mean squares over the
fields, since a grid solves some fields exactly. targets_table.py finds the public meshes.
"""

import json
import math
import pathlib
import sys
import tempfile

from targets_table import public_meshes, run

MEASURES = [(scheme, norm) for scheme in ("poisson", "flux") for norm in ("l2", "max")]
NAMED = {"any": MEASURES, "vertex": MEASURES[:2], "cell": MEASURES[2:]}  # measures that must not become worse
ROUNDING = 1e-6  # larger ratios count as worse


def grid(n, m, place, cut, region=None, line=None):
    """n × m cells between places (i, j), each cut into triangles. Regions and lines are by cells and edges."""
    points, triangles = [place(i, j) for j in range(m + 1) for i in range(n + 1)], []
    for j in range(m):
        for i in range(n):
            a, b, d, c = (i + k + (n + 1) * (j + up) for up in (0, 1) for k in (0, 1))
            kind, tag = cut(i, j), region(i, j) if region else 1
            if kind == "crossed":
                points.append(tuple(sum(points[v][k] for v in (a, b, c, d)) / 4 for k in (0, 1)))
                center = len(points) - 1
                triangles += [(p, q, center, tag) for p, q in ((a, b), (b, c), (c, d), (d, a))]
            else:
                triangles += [(a, b, c, tag), (a, c, d, tag)] if kind == "up" else [(a, b, d, tag), (b, c, d, tag)]
    lines = [(i + (n + 1) * line, i + 1 + (n + 1) * line) for i in range(n)] if line else []
    return points, triangles, lines


def structured(n):
    def unit(i, j):
        return i / n, j / n

    def up(_i, _j):
        return "up"

    def alternating(i, j):
        return "up" if (i + j) % 2 == 0 else "down"

    def ring(i, j):
        angle, radius = math.pi / 2 * i / n, 1 + j / n
        return radius * math.cos(angle), radius * math.sin(angle)

    high = round(n * 2 / math.sqrt(3))
    return {
        "right-angled": grid(n, n, unit, up),
        "right-angled, two directions": grid(n, n, unit, alternating),
        "crossed": grid(n, n, unit, lambda _i, _j: "crossed"),
        "rectangles": grid(n, n, lambda i, j: (i / n, 0.3 * j / n), up),
        "sheared": grid(n, n, lambda i, j: ((i + 0.3 * j) / n, j / n), lambda _i, _j: "down"),
        "equilateral": grid(n, high, lambda i, j: ((i + 0.5 * j) / n, math.sqrt(0.75) * j / n), lambda _i, _j: "down"),
        "ring": grid(2 * n, n, lambda i, j: ring(i / 2, j), up),
        "regions": grid(n, n, unit, up, region=lambda i, _j: 1 if i < n // 2 else 2),
        "line": grid(n, n, unit, alternating, line=n // 2),
    }


def write_medit(mesh, path):
    points, triangles, lines = mesh
    rows = ["MeshVersionFormatted 2", "Dimension 2", f"Vertices {len(points)}", *(f"{x!r} {y!r} 0" for x, y in points)]
    rows += [f"Triangles {len(triangles)}", *(f"{a + 1} {b + 1} {c + 1} {tag}" for a, b, c, tag in triangles)]
    rows += [f"Edges {len(lines)}", *(f"{a + 1} {b + 1} 7" for a, b in lines)] if lines else []
    path.write_text("\n".join([*rows, "End", ""]))


def errors(temper, mesh):
    fields = json.loads(run(temper, "errors", mesh, "--fields", "held-back", "--json"))["errors"]["fields"]
    # null is an infinite error
    values = {m: [math.inf if f[m[0]][m[1]] is None else f[m[0]][m[1]] for f in fields] for m in MEASURES}
    return [math.hypot(*values[m]) for m in MEASURES]


def meshes(folder, n=20):
    for name, mesh in structured(n).items():
        write_medit(mesh, path := folder / f"{name.replace(' ', '-')}.mesh")
        yield name, path
    yield from ((path.stem, path) for path in public_meshes())


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    temper, targets = sys.argv[1], sys.argv[2:] or list(NAMED)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        inputs = [(mesh, path, errors(temper, path)) for mesh, path in meshes(folder)]
        for target in targets:
            print(f"\n--for {target}\n\n| mesh | {' | '.join(' '.join(m) for m in MEASURES)} | notes |\n|-|" + "-:|" * 4 + "-|")
            rows = []
            for mesh, path, before in inputs:
                report = folder / "report.json"
                run(temper, "optimize", path, "-o", out := folder / "out.vtu", "--for", target, "--quiet", "--write", report)
                ratios = [new / old if old else (math.inf if new else 1) for new, old in zip(errors(temper, out), before)]
                notes = [note for note in json.loads(report.read_text())["notes"] if "errors" in note]
                cells = [f"**{r:.3f}**" if r > 1 + ROUNDING and m in NAMED[target] else f"{r:.3f}" for r, m in zip(ratios, MEASURES)]
                print(f"| {mesh} | {' | '.join(cells)} | {'; '.join(notes)} |", flush=True)
                rows.append(ratios)
            means = [math.exp(sum(map(math.log, column)) / len(rows)) for column in zip(*rows)]
            above = [sum(r > 1 + ROUNDING for r in column) for column in zip(*rows)]
            print(f"| geometric mean | {' | '.join(f'{r:.3f}' for r in means)} | |\n| above 1 | {' | '.join(map(str, above))} | |")


if __name__ == "__main__":
    main()

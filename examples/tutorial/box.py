"""Writes box.msh: a box of cubes, each cut in six, with two materials. Inner points are moved at random."""

import itertools
import random

random.seed(1)
n, random_part = 6, 0.25
grid = list(itertools.product(range(n + 1), repeat=3))


def fixed(p):
    return p[0] in (0, n // 2, n) or p[1] in (0, n) or p[2] in (0, n)


points = [p if fixed(p) else [x + random.uniform(-random_part, random_part) for x in p] for p in grid]
number = {p: i + 1 for i, p in enumerate(grid)}
tetrahedra = []
for cube in itertools.product(range(n), repeat=3):
    for axes in itertools.permutations(range(3)):  # six around the diagonal
        corners = [cube]
        for axis in axes:
            corners.append(tuple(c + (k == axis) for k, c in enumerate(corners[-1])))
        if axes in [(0, 2, 1), (1, 0, 2), (2, 1, 0)]:  # positive ones need no warning
            corners[2:] = corners[:1:-1]
        tetrahedra.append((1 if cube[0] < n // 2 else 2, [number[c] for c in corners]))
with open("box.msh", "w", encoding="utf-8") as file:
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "2", '3 1 "rock"', '3 2 "sand"', "$EndPhysicalNames"]
    lines += ["$Nodes", len(points), *(f"{i} {x} {y} {z}" for i, (x, y, z) in enumerate(points, 1)), "$EndNodes"]
    elements = (f"{i} 4 2 {region} {region} {' '.join(map(str, corners))}" for i, (region, corners) in enumerate(tetrahedra, 1))
    print(*lines, "$Elements", len(tetrahedra), *elements, "$EndElements", sep="\n", file=file)

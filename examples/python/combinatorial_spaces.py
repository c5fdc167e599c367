"""Writes files that give CombinatorialSpaces.jl its dual points: mesh, orthocenters and weighted midpoints, as plain CSV.

    python3 combinatorial_spaces.py [IN [FOLDER]]

IN is a mesh of the plane, where z is 0, or a curved surface. docs/howto/decapodes.md has the Julia side. Numbers count
from 1, as Julia's do.
"""

import pathlib
import sys

import numpy as np

import temper

mesh = temper.read(sys.argv[1]) if len(sys.argv) > 1 else temper.generate.annulus()
if len(sys.argv) == 1:
    temper.optimize(mesh)
folder = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else "dual")
folder.mkdir(exist_ok=True)
operators = temper.dec_operators(mesh)


def save(name, header, *columns):
    rows = zip(*(np.asarray(c).tolist() for c in columns))
    lines = [header, *(",".join(map(repr, row)) for row in rows)]  # the shortest text that reads back to the same bits
    (folder / name).write_text("\n".join(lines) + "\n", encoding="utf-8")


def in_space(places):
    return np.pad(places, ((0, 0), (0, 3 - places.shape[1]))).T


save("points.csv", "x,y,z", *in_space(mesh.points))
save("edges.csv", "from,to,x,y,z,dual_length",
     *(operators.edges.vertices + 1).T, *in_space(operators.edges.midpoint), operators.edges.dual_length)  # fmt: skip
save("triangles.csv", "i,j,k,x,y,z", *(mesh.triangles + 1).T, *in_space(operators.orthocenters))
print(f"{folder}: {mesh.n_vertices} points, {len(operators.edges)} edges, {mesh.n_triangles} triangles")

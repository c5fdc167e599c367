"""Takes wells, river and lake of examples/aquifer.geojson to cells of MODFLOW, by their names.

    python3 modflow_by_name.py        needs the program temper; with FloPy it also makes the model

temper mesh keeps the names of the map, temper optimize keeps the wells where they are, and temper operators writes a
table of names and cells beside the grid.
"""

import csv
import importlib.util
import json
import math
import pathlib
import subprocess
import sys

MAP = pathlib.Path(__file__).parent.parent / "aquifer.geojson"


def temper(*arguments):
    subprocess.run([sys.executable, "-m", "temper", *map(str, arguments), "--quiet"], check=True)


temper("mesh", MAP, "-o", "valley.vtu", "--size", 120)
temper("optimize", "valley.vtu", "-o", "better.vtu", "--for", "vertex")
pathlib.Path("layers.csv").write_text("vertex,top,bottom 1\n*,0,-25\n", encoding="utf-8")
subprocess.run([sys.executable, "-m", "temper", "operators", "better.vtu", "-o", "grid", "--layers", "layers.csv", "--format",
                "disv"], check=True, stdout=subprocess.DEVNULL)  # fmt: skip

# The table: a row for each name and cell. Cells count from 1.
with open("grid/mesh.disv.csv", encoding="utf-8", newline="") as table:
    cells_of = {}
    for row in csv.DictReader(table):
        cells_of.setdefault(row["name"], []).append(row)
shapes = {f["properties"]["name"]: f["geometry"]["coordinates"] for f in json.loads(MAP.read_text(encoding="utf-8"))["features"]}

# MODFLOW's packages, in FloPy's form: cells by layer and number from 0.
wells = {name: [((0, int(row["cell"]) - 1), -1500.0) for row in rows] for name, rows in cells_of.items() if name.endswith("well")}
river = [((0, int(row["cell"]) - 1), 2.0, float(row["length"]), 0.0) for row in cells_of["river"]]  # conductance by length
lake = [((0, int(row["cell"]) - 1), 2.0) for row in cells_of["lake"]]

# The checks: each well is the center of its cell, and the cells have the whole river and the whole lake.
for name in wells:
    (row,) = cells_of[name]
    assert [float(row["x"]), float(row["y"])] == shapes[name], name
for name in ("river", "lake"):
    whole = sum(math.dist(a, b) for a, b in zip(shapes[name], shapes[name][1:]))
    assert math.isclose(sum(float(row["length"]) for row in cells_of[name]), whole, rel_tol=1e-12), name
assert {row["kind"] for row in cells_of["lake"]} == {"boundary"}
print(f"{len(wells)} wells, {len(river)} cells of the river, {len(lake)} of the lake")

if importlib.util.find_spec("flopy"):  # its own search finds the same cells
    import numpy as np
    from flopy.discretization import VertexGrid

    rows = [line.split() for line in pathlib.Path("grid/mesh.disv").read_text(encoding="utf-8").splitlines()]

    def block(name):
        return rows[rows.index(["BEGIN", name]) + 1 : rows.index(["END", name])]

    vertices = [[int(i) - 1, float(x), float(y)] for i, x, y in block("VERTICES")]
    cells = [[int(i) - 1, float(x), float(y), int(n), *(int(k) - 1 for k in c)] for i, x, y, n, *c in block("CELL2D")]
    grid = VertexGrid(vertices, cells, top=np.zeros(len(cells)), botm=np.full((1, len(cells)), -25.0))
    for name, packages in wells.items():
        assert grid.intersect(*shapes[name]) == packages[0][0][1], name

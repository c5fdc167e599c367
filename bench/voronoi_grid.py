#!/usr/bin/env python3
"""Grids of FloPy's VoronoiGrid, and of temper's power cells, on the same outlines and with nearly equal numbers of cells.

    bench/voronoi_grid.py [--write]      --write puts the table into docs/howto/modflow.md

Needs FloPy, SciPy, shapely, the program triangle on the PATH, which FloPy runs, and the module temper on PYTHONPATH. FloPy
takes triangles with angles of at least 30 degrees, as its own examples do. The columns are:

    lost area     area that no cell covers, and area of cells outside the domain or in other cells, over the domain's
    without foot  faces that the line between the centers of their cells does not cross
    short         faces whose length is less than 0.01 of the median
    seconds       of the processor for the whole grid, the quickest of three runs
"""

import json
import pathlib
import resource
import tempfile

import numpy as np
import page_table
import shapely
import temper

ROOT = pathlib.Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs/howto/modflow.md"
ROUNDING = 1e-4  # of the lengths of faces: corners are rounded to 1e-8 of the extent
ROUNDS = 3


def valley():
    """The rings, points that are centers of cells, and sizes."""
    features = json.loads((ROOT / "examples/aquifer.geojson").read_text())["features"]
    shapes = {feature["properties"]["name"]: feature["geometry"]["coordinates"] for feature in features}
    corner = np.array([680000, 5240000])
    wells = [np.array(place) - corner for name, place in shapes.items() if name.endswith("well")]
    return [np.array(shapes["valley"][0])[:-1] - corner], np.array(wells), (120, 30)


def harbor():
    """Without the mole and the border of the basin, which are lines."""
    points = np.asarray(temper.read_outline(ROOT / "examples/harbour.poly").outline.points)
    shore, island = [1, 19, 2, 3, 4, 5, 6, 7, 9, 8, 17], [12, 13, 14, 15, 16]
    return [points[np.array(ring) - 1] for ring in (shore, island)], np.empty((0, 2)), (1, 0.25)


def voronoi_grid(rings, wells, size):
    """Polygons and centers, by FloPy."""
    from flopy.utils.triangle import Triangle
    from flopy.utils.voronoi import VoronoiGrid

    with tempfile.TemporaryDirectory() as folder:
        triangle = Triangle(angle=30, maximum_area=0.75 * size**2, nodes=wells if len(wells) else None, model_ws=folder)
        for ring in rings:
            triangle.add_polygon([tuple(point) for point in ring])
        for ring in rings[1:]:
            triangle.add_hole(shapely.Polygon(ring).representative_point().coords[0])
        triangle.build()
        grid = VoronoiGrid(triangle)
    return [grid.verts[corners] for corners in grid.iverts], grid.points


def power_cells(rings, wells, size):
    """Polygons and centers, by temper."""
    points, segments, start = [*rings, wells], [], 0
    for ring in rings:
        number = start + np.arange(len(ring))
        segments += zip(number, np.roll(number, -1))
        start += len(ring)
    holes = [shapely.Polygon(ring).representative_point().coords[0] for ring in rings[1:]] or None
    outline = temper.Outline(np.vstack(points), segments, holes=holes)
    cells = temper.power_cells(temper.mesh_outline(outline, size, target="vertex", threads=1).mesh)
    return cells.polygons(), cells.center


def faces_of(polygons, scale):
    """Pairs of cells, and the ends of their common side. Corners are equal to 1e-8 of the extent."""
    sides = {}
    for cell, corners in enumerate(polygons):
        corner_of = [tuple(corner) for corner in np.round(np.asarray(corners) / scale, 8).tolist()]
        for a, b in zip(corner_of, corner_of[1:] + corner_of[:1]):
            if a != b:
                sides.setdefault((min(a, b), max(a, b)), []).append(cell)
    common = [(cells, side) for side, cells in sides.items() if len(cells) == 2]
    return np.array([cells for cells, _ in common]), np.array([side for _, side in common]) * scale


def cross(a, b):
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def processor():
    """Seconds of this process, and of those that it waited for."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(one.ru_utime + one.ru_stime for one in used)


def row(name, make, rings, wells, size):
    seconds = np.inf
    for _ in range(ROUNDS):
        started = processor()
        polygons, centers = make(rings, wells, size)
        seconds = min(seconds, processor() - started)
    domain = shapely.Polygon(rings[0], rings[1:])
    shapes = [shapely.Polygon(polygon).buffer(0) for polygon in polygons]
    covered = shapely.union_all(shapes).intersection(domain).area
    wrong = domain.area - covered + sum(shape.area for shape in shapes) - covered
    pairs, sides = faces_of(polygons, np.ptp(rings[0], axis=0).max())
    start, along = centers[pairs[:, 0]], centers[pairs[:, 1]] - centers[pairs[:, 0]]
    face, side = sides[:, 1] - sides[:, 0], sides[:, 0] - start
    with np.errstate(divide="ignore"):
        on_line, on_face = cross(side, face) / cross(along, face), cross(side, along) / cross(along, face)
    foot = (np.abs(on_line - 0.5) <= 0.5 + ROUNDING) & (np.abs(on_face - 0.5) <= 0.5 + ROUNDING)
    length = np.linalg.norm(face, axis=1)
    lost = f"{abs(wrong) / domain.area:.2%}" if abs(wrong) > 1e-6 * domain.area else "0"
    return [name, len(polygons), lost, f"{np.sum(~foot)} of {len(foot)}", np.sum(length < 0.01 * np.median(length)), f"{seconds:.2f}"]


def table():
    lines = ["| outline | grid | cells | lost area | faces without foot | short faces | seconds |", "|-|-|-:|-:|-:|-:|-:|"]
    for outline in (valley, harbor):
        rings, wells, sizes = outline()
        for size in sizes:
            for name, make in (("VoronoiGrid", voronoi_grid), ("temper", power_cells)):
                lines.append("| " + " | ".join(map(str, [outline.__name__, *row(name, make, rings, wells, size)])) + " |")
                print(lines[-1], flush=True)
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    page_table.main(__doc__, PAGE, table)

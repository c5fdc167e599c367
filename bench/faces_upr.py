"""The examples in the plane of MRST's module UPR, which bench/faces.py meshes: faults that cells must not cross, and wells that
are centers of cells. All are scaled to a width of about 1000.

R. L. Berge, Ø. S. Klemetsdal, K.-A. Lie: Unstructured Voronoi grids conforming to lower dimensional objects.
Computational Geosciences 23 (2019). The two largest examples are files of MRST, whose folder is given. In one of them lines
cross the border, and are cut there. In the other one, fractures are left out if they meet another one at less than 15
degrees: 5 of 51.
"""

import dataclasses
import pathlib

import numpy as np


@dataclasses.dataclass
class Example:
    name: str
    corners: np.ndarray
    lines: list  # become faces
    rivers: list  # wells along lines: become edges
    size: float


def scaled(name, corners, lines, size, wells=()):
    corners = np.asarray(corners, float)
    low, scale = corners.min(axis=0), 2 ** np.round(np.log2(1000 / np.ptp(corners[:, 0])))  # keeps what is on a line there
    place = lambda points: (np.asarray(points, float) - low) * scale  # noqa: E731
    return Example(name, place(corners), [place(line) for line in lines], [place(well) for well in wells], size * scale)


def box(width, height):
    return [[0, 0], [width, 0], [width, height], [0, height]]


def small():
    x = np.linspace(0.1, 0.8, 10)
    yield scaled("a well and four faults", box(1, 1),
                 [[[0.3, 0.1], [0.1, 0.3]], [[0.3, 0.1], [0.4, 0.7]], [[0.6, 0.2], [0.3, 0.7]], [[0.8, 0.4], [0.5, 0.8]]],
                 1 / 24, [np.c_[x, 0.2 + x**2]])  # fmt: skip
    yield scaled("three faults", box(1, 1.15),
                 [[[0.1, 0.42], [0.4, 0.55], [0.7, 0.65]], [[0.8, 0.13], [0.6, 0.4], [0.55, 0.6]],
                  [[0.42, 1.08], [0.45, 0.9], [0.5, 0.8], [0.58, 0.6]]], 1 / 30)  # fmt: skip
    yield scaled("bend and line", box(1, 1), [[[0.2, 0.8], [0.5, 0.65], [0.8, 0.8]], [[0.5, 0.2], [0.1, 0.5]]], 1 / 10)
    yield scaled("four lines", box(1, 1),
                 [[[0.2, 0.2], [0.7, 0.05]], [[0.2, 0.05], [0.7, 0.2]], [[0.1, 0.4], [0.6, 0.6]], [[0.1, 0.7], [0.45, 0.7], [0.55, 0.3]]],
                 1 / 20)  # fmt: skip
    x = np.linspace(0.2, 0.8, 100)
    yield scaled("curve and two angles", [[-1, -1], [2, -1], [2, 2], [-1, 2]],
                 [np.c_[x, 0.4 + 0.3 * np.sin(np.pi * x)], [[0, 0.65], [0, 0.4], [0.25, 0.4]], [[0.75, 0.4], [1, 0.4], [1, 0.65]]],
                 1 / 10)  # fmt: skip


def cut(line, border):
    """The parts of a line within a border."""
    import shapely

    parts = shapely.LineString(line).intersection(shapely.Polygon(border))
    return [np.array(part.coords) for part in getattr(parts, "geoms", [parts])]


def without_small_angles(lines):
    import shapely

    kept = []
    for line in lines:
        along, whole = line[1] - line[0], shapely.LineString(line)
        close = [np.diff(other, axis=0)[0] for other in kept if whole.distance(shapely.LineString(other)) < 1e-6]
        if all(abs(np.cross(along, other)) > np.tan(np.radians(15)) * abs(along @ other) for other in close):
            kept.append(line)
    return kept


def large(folder):
    import scipy.io

    data = pathlib.Path(folder, "modules/upr/datasets")
    network = scipy.io.loadmat(data / "gridBranets.mat")
    border, faults = network["bdr"], network["fault"].ravel()
    yield scaled("complex fault network", border, [part for fault in faults for part in cut(fault, border)], border.max() / 50)
    ends = scipy.io.loadmat(data / "statistical_fractures.mat")["fl"].astype(float) + 2
    yield scaled("statistical fractures", box(35, 120), without_small_angles(ends.reshape(-1, 2, 2)), 1)


def examples(folder=None):
    yield from small()
    if folder:
        yield from large(folder)

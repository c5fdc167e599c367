"""Meshes of tetrahedra for the pages: cubes, each cut in six around its diagonal."""

import numpy as np


def cubes(n, side=1.0, moved=0.0):
    """Points and tetrahedra of n³ cubes of this side. Inner points are moved at random, by at most `moved` along each axis."""
    line = np.arange(n + 1)
    points = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3) * side
    inner = ((points > 0) & (points < n * side)).all(axis=1)
    points[inner] += np.random.default_rng(1).uniform(-moved, moved, (inner.sum(), 3))
    x, y, z = (n + 1) ** 2, n + 1, 1
    ring = [x, x + y, y, y + z, z, x + z]  # around the diagonal from 0 to x + y + z
    around = np.array([(0, a, b, x + y + z) for a, b in zip(ring, ring[1:] + ring[:1])])
    lower = [x * i + y * j + z * k for i in range(n) for j in range(n) for k in range(n)]
    return points, np.add.outer(lower, around).reshape(-1, 4)

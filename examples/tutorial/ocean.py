"""What docs/tutorial/ocean.md computes with NumPy: a depth of the sea, and how far flow links are from right angles."""

import numpy as np

RADIUS = 6371000.0


def depth(points, coast):
    """An invented depth in meters, at points on the globe: a shelf, a slope, and a deep sea far from the coast."""
    chord = np.array([np.linalg.norm(coast - place, axis=1).min() for place in points])
    way = 2 * RADIUS * np.arcsin(chord / (2 * RADIUS))
    return 100 + 4900 * (1 - np.exp(-way / 800e3))


def flow_centers(mesh):
    """Centers of triangles in D-Flow FM: circumcenters, kept inside of their triangles. Weights play no role."""
    corners = mesh.points[mesh.triangles]
    squares = np.stack([((corners[:, k - 1] - corners[:, k - 2]) ** 2).sum(axis=1) for k in range(3)], axis=1)
    at = squares * (squares.sum(axis=1, keepdims=True) - 2 * squares)
    at /= at.sum(axis=1, keepdims=True)
    with np.errstate(divide="ignore"):
        way = np.where(at < 0, 1 / (1 - 3 * at), 1).min(axis=1, keepdims=True)  # from the centroid to the circumcenter
    return np.einsum("tk,tkx->tx", 1 / 3 + way * (at - 1 / 3), corners)


def orthogonality(mesh):
    """For each triangle the largest |cosine| between an edge and the line that connects the centers on its sides."""
    centers, largest = flow_centers(mesh), np.zeros(mesh.n_triangles)
    for k in range(3):
        other = mesh.neighbors[:, k]
        inner = np.flatnonzero(other >= 0)
        edge = mesh.points[mesh.triangles[inner, (k + 1) % 3]] - mesh.points[mesh.triangles[inner, k]]
        link = centers[other[inner]] - centers[inner]
        cosine = abs((edge * link).sum(axis=1)) / (np.linalg.norm(edge, axis=1) * np.linalg.norm(link, axis=1))
        largest[inner] = np.maximum(largest[inner], cosine)
    return largest

"""Spreads heat over surfaces, by the operators that `temper operators` wrote to the folders that are given."""

import sys

import numpy as np
from scipy.sparse import csr_matrix, diags
from scipy.sparse.linalg import spsolve

for folder in sys.argv[1:]:
    arrays = np.load(f"{folder}/operators.npz")
    star0, star1, places = arrays["star0"], arrays["star1"], arrays["vertices"]
    d0 = csr_matrix((arrays["d0_data"], arrays["d0_indices"], arrays["d0_indptr"]), (len(star1), len(star0)))
    laplacian = d0.T @ diags(star1) @ d0
    # At first, 1 within a fifth of the size of the vertex with the largest x, and 0 elsewhere.
    away = np.linalg.norm(places - places[np.argmax(places[:, 0])], axis=1)
    hot = np.where(away < 0.2 * np.linalg.norm(np.ptp(places, axis=0)), 1.0, 0.0)
    time = 1e-4 * star0.sum()
    heat = spsolve((diags(star0) + time * laplacian).tocsc(), star0 * hot)
    negative = np.count_nonzero(star1 < 0)
    print(f"{folder}: {negative} of {len(star1)} coefficients are negative; heat from {heat.min():.4f} to {heat.max():.4f}")

"""Spreads heat over the surfaces in the files that are given, by exterior calculus."""

import sys

import numpy as np
from scipy.sparse.linalg import spsolve

import temper

for name in sys.argv[1:]:
    mesh = temper.read(name)
    dual, places = temper.dec_operators(mesh), mesh.points
    # At first, 1 within a fifth of the size of the vertex with the largest x, and 0 elsewhere.
    away = np.linalg.norm(places - places[np.argmax(places[:, 0])], axis=1)
    hot = np.where(away < 0.2 * np.linalg.norm(np.ptp(places, axis=0)), 1.0, 0.0)
    time = 1e-4 * dual.star0.sum()
    heat = spsolve((dual.star(0) + time * dual.laplacian()).tocsc(), dual.star0 * hot)
    negative = np.count_nonzero(dual.star1 < 0)
    print(f"{name}: {negative} of {len(dual.star1)} coefficients are negative; heat from {heat.min():.4f} to {heat.max():.4f}")

"""Optimizes a mesh that meshio holds, and plots it before and after.

    python3 optimize_meshio.py [IN [OUT.png]]     any file that meshio reads; without one, an example mesh
"""

import sys

import matplotlib

matplotlib.use("agg")
import meshio
from matplotlib import pyplot

import temper

mesh = meshio.read(sys.argv[1]) if len(sys.argv) > 1 else temper.generate.annulus().to_meshio()
picture = sys.argv[2] if len(sys.argv) > 2 else "before-after.png"

figure, axes = pyplot.subplots(1, 2, figsize=(12, 6), layout="constrained")
temper.plot(mesh, ax=axes[0], title="before")
before = temper.quality(mesh)
report = temper.optimize(mesh)  # in place; weights are mesh.point_data["weight"]
after = temper.quality(mesh)
temper.plot(mesh, ax=axes[1], title="after")
figure.savefig(picture, dpi=100)

mesh.write("optimized.vtu")
print(f"{report.sweeps} sweeps, {report.stopped}; well-centered: "
      f"{100 * before.well_centered_fraction:.1f} % before, {100 * after.well_centered_fraction:.1f} % after")
if after.well_centered_fraction < 1:
    print(temper.explain(mesh))

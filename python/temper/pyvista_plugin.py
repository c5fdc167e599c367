"""The accessor ``temper`` of PyVista's meshes: ``better = grid.temper.optimize(target="vertex")``.

PyVista 0.48 or later finds it by itself if temper is installed by pip. Otherwise ``import temper.pyvista_plugin``.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pyvista

from ._measure import quality, tetrahedron_quality, triangle_quality
from ._optimize import optimize
from ._tets import TetMesh, as_any_mesh

if not hasattr(pyvista, "register_dataset_accessor"):
    raise ImportError(f"the accessor needs PyVista 0.48, found {pyvista.__version__}. Next: temper.optimize(grid) needs no accessor")

_CELL = "temper:cell"


class TemperAccessor:
    """Functions of temper on one mesh of triangles, quadrilaterals or tetrahedra."""

    def __init__(self, dataset: Any) -> None:
        self._dataset = dataset

    def quality(self, **options: Any) -> Any:
        """``temper.quality`` of the mesh."""
        return quality(self._dataset, **options)

    def margins(self) -> Any:
        """A copy with margins as cell data, the same as in VTU files: ``well_centered``, ``min_h_over_l``, and of
        triangles ``min_d_over_l`` and ``min_angle_deg``, of tetrahedra ``min_dihedral_deg``. A quadrilateral has the
        least of its two triangles. Lines, and other cells that are not measured, have NaN, or 0 as ``well_centered``."""
        result = self._dataset.copy()
        marked = self._dataset.copy(deep=False)
        marked.cell_data[_CELL] = np.arange(marked.n_cells)
        mesh = as_any_mesh(marked)
        cell = mesh.cell_data[_CELL]
        measured = tetrahedron_quality(mesh) if isinstance(mesh, TetMesh) else triangle_quality(mesh)
        for name, values in vars(measured).items():
            least = np.full(result.n_cells, np.inf)
            np.minimum.at(least, cell, values)
            least[np.isposinf(least)] = 0 if values.dtype == bool else np.nan
            result.cell_data[name] = least.astype(np.uint8) if values.dtype == bool else least
        return result

    def optimize(self, **options: Any) -> Any:
        """An optimized copy with margins as cell data, and weights [length²] as point data ``weight``. Options are
        those of ``temper.optimize``, which returns a report and changes the mesh in place."""
        result = self._dataset.copy()
        optimize(result, **options)
        return TemperAccessor(result).margins()


pyvista.register_dataset_accessor("temper", pyvista.DataSet)(TemperAccessor)

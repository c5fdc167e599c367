"""temper: primal-dual triangle and tetrahedral meshes that solvers can trust.

A weighted triangulation and its power diagram are optimized until every triangle is well-centered: its orthocenter is
inside, and its dual crosses every edge. Arrays are NumPy arrays, without copies if the memory allows. Every function
that takes a mesh also takes meshes of ``meshio``, ``PyVista``, ``Gmsh``, ``xarray`` and ``xugrid``.

>>> import temper
>>> mesh = temper.generate.annulus()
>>> report = temper.optimize(mesh)
>>> temper.quality(mesh).well_centered_fraction
1.0
>>> operators = temper.dec_operators(mesh)
>>> bool((operators.star1 > 0).all())
True

Conventions: triangles are counter-clockwise. The power of a place p to vertex i is |x_i − p|² − w_i. So weights w are
squared lengths, and a larger weight makes a larger power cell. Vertices and triangles count from 0; −1 means none.

Functions and the classes that they take are here. ``temper.types`` has the classes that they return.
"""



def _not_compiled():
    """Says which Python the compiled module is for, if it is there."""
    import pathlib
    import sysconfig

    found = sorted(path.name for path in pathlib.Path(__path__[0]).glob("_temper.*") if path.suffix in (".so", ".pyd"))
    if not found:
        return f"temper: the compiled module _temper is not in {__path__[0]}: see docs/howto/install.md"
    return (
        f"temper: {__path__[0]} has {', '.join(found)}, and this Python needs _temper{sysconfig.get_config_var('EXT_SUFFIX')}. "
        "Next: use the Python that temper was built for"
    )


try:
    from . import _temper  # noqa: F401
except ImportError as error:
    if "cannot import name '_temper'" not in str(error):
        raise
    raise ImportError(_not_compiled()) from None

from . import energy, generate, geometry, projection, size, topology, types
from ._dec import barriers_of_lines, columns, dec_operators
from ._polygons import power_cells, triangle_cells
from ._draw import draw_svg, grid_svg, html_report
from ._errors import TemperError, TemperWarning
from ._explain import explain, explain_duals
from ._io import formats, read, write
from ._measure import quality, quality_measures, tetrahedron_quality, triangle_quality
from ._mesh import Mesh, as_mesh, from_meshio
from ._optimize import Hooks, optimize, replay
from ._optimizer import Optimizer
from ._options import LengthParameter, OptimizeOptions, options_for
from ._outline import Outline, mesh_outline, mesh_sphere, read_outline
from ._plot import plot, plot_history
from ._space import Space
from ._surfaces import SurfaceMesh
from ._temper import __version__, build_info, instruction_set, instruction_sets, use_instruction_set
from ._tensor import mapped, mapped_back
from ._tets import TetMesh
from ._measure_errors import arithmetic_mean, error_ratios, geometric_mean, measure_diffusion_errors, measure_errors, error_fields, field_frame, error_measures
from ._weights import (
    best_connectivity,
    best_margin,
    check_certificate,
    constraints_table,
    edge_conflict,
    edges_that_must_be_split,
    find_weights,
    weight_change,
    weight_margin,
)
from .size import SizeField

__all__ = sorted(name for name in dir() if not name.startswith("_")) + ["__version__"]

"""temper: primal-dual triangle meshes that solvers can trust.

A weighted triangulation and its power diagram, optimised until every triangle is well-centered: its orthocenter inside,
every edge crossed by its dual. NumPy arrays in and out without copies where memory allows; ``meshio`` meshes are taken
wherever a mesh is.

>>> import temper
>>> mesh = temper.generate.annulus()
>>> report = temper.optimize(mesh)
>>> temper.quality(mesh).well_centered_fraction
1.0
>>> operators = temper.dec(mesh)
>>> bool((operators.star1 > 0).all())
True

Conventions: triangles are counter-clockwise; the power of a place p to vertex i is |x_i − p|² − w_i, so that weights
are squared lengths, and a larger one makes a larger power cell. Vertices and triangles count from 0; −1 is none.
"""

try:
    from . import _temper  # noqa: F401
except ImportError as error:
    if "cannot import name '_temper'" not in str(error):
        raise
    raise ImportError(
        f"temper: the compiled module _temper is not in {__path__[0]}: build it (docs/python.md) or install temper"
    ) from None

from . import generate, geometry, projection, topology
from ._build_info import build_info
from ._columns import Columns, columns
from ._data import DataReport
from ._dec import DecComplex, DecEdges, DecSummary, IncidenceMatrix, PowerCells, dec, power_cells, summarize, write_dec
from ._draw import Svg, draw_before_after_svg, draw_svg, grid_svg
from ._errors import TemperError, TemperWarning
from ._explain import CrossingConflict, CrossingSide, Cure, Explanation, FanCenter, Reason, explain
from ._html import Html, html_report
from ._io import Format, formats, read, write, write_text
from ._measure import (
    EnergyInfo,
    EnergyModel,
    Histogram,
    Quality,
    QualityMeasure,
    TriangleQuality,
    VertexDerivatives,
    WorstTriangle,
    check,
    energies,
    find_energy,
    quality,
    quality_measures,
    total_energy,
    triangle_energy,
    triangle_margins,
    triangle_quality,
    vertex_energy,
    well_centered_triangles,
)
from ._mesh import Mesh, as_mesh, from_meshio, to_meshio
from ._optimize import OptimizeReport, SizeChange, optimize, optimized, replay, replay_with_vertices
from ._optimize_options import OptimizeOptions, cvt_method, odt_method, paper_method
from ._options import Softening
from ._outline import Outline, OutlineFile, OutlineMesh, mesh_outline, mesh_sphere, read_outline
from ._plot import plot, plot_history
from ._progress import Progress, SweepRecord
from ._regularity import (
    Restoration,
    count_non_regular_edges,
    flip_threshold,
    is_regular,
    position_flip_threshold,
    restore_regularity,
    weight_flip_threshold,
)
from ._size import SizeField, SizeReport, Spread, input_size_field, local_size, measure_size, relative_lengths, spread
from ._space import Space
from ._temper import __version__, has_threads, instruction_set, instruction_sets, use_instruction_set
from ._tensor import mapped, mapped_back
from ._trace import Snapshot, TraceEvent
from ._verify import (
    ErrorNorms,
    FieldErrors,
    VerifyErrors,
    VerifyField,
    VerifyFrame,
    VerifyLevel,
    VerifyReport,
    VerifySystem,
    arithmetic_mean,
    error_ratios,
    geometric_mean,
    verify,
    verify_fields,
    verify_frame,
    verify_measures,
)
from ._weights import (
    BestMargin,
    Certificate,
    ConditionsInfo,
    ConnectivityReport,
    ConnectivityStep,
    EdgeConflict,
    Violation,
    WeightConstraint,
    WeightReport,
    best_connectivity,
    best_margin,
    check_certificate,
    conditions_table,
    edge_conflict,
    edges_that_must_be_split,
    find_weights,
    weight_change,
    weight_margin,
)

__all__ = sorted(name for name in dir() if not name.startswith("_")) + ["__version__"]

"""The classes that functions of ``temper`` return and pass to callbacks. Reports show themselves as text, and as tables
in notebooks.

Submodules have such classes of their own, for example ``temper.topology``.
"""

from ._polygons import CellPolygons
from ._faces import LineFaces
from ._dec import Barrier, Columns, DecComplex, DecEdges, IncidenceMatrix, PowerCells, TetDecComplex, TetDecEdges, TetDecFaces
from ._draw import Html, Svg
from ._io import Format
from ._measure import QualityMeasure, TetrahedronQuality, TriangleQuality
from ._optimize import Replay, Snapshot
from ._optimizer import Update
from ._outline import OutlineFile, OutlineMesh
from ._certificate import Certificate, WeightConstraint
from ._reports import ChangeCounts, CrossingConflict, CrossingSide, Cure, DataReport, DecSummary, DiffusionErrors, DiffusionMatrices, EdgeConflict, ErrorMatrices, ErrorNorms, ErrorSystem, Explanation, FaceHeight, FanCenter, FieldFrame, Histogram, Histograms, OptimizeReport, Progress, Quality, Reason, SizeChange, SurfaceExplanation, SurfaceOptimizeReport, SurfaceQuality, SweepRecord, TetDataReport, TetDecSummary, TetExplanation, TetHistograms, TetQuality, TetReason, TraceEvent, WorstTet, WorstTriangle
from ._measure_errors import FieldErrors, OperatorErrors, ErrorField, ErrorLevel, ErrorReport, DiffusionProblem, TetErrorReport
from ._weights import (
    BestMargin,
    ConstraintsInfo,
    ConnectivityProof,
    ConnectivityReport,
    ConnectivityStep,
    IntrinsicMesh,
    Lemma,
    OffsetTerm,
    Optimality,
    Violation,
    WeightReport,
)

__all__ = sorted(name for name in dir() if not name.startswith("_"))

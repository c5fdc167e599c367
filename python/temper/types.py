"""The classes that functions of ``temper`` return and pass to callbacks. Reports show themselves as text, and as tables
in notebooks.

Submodules have such classes of their own, for example ``temper.topology``.
"""

from ._dec import Columns, DecComplex, DecEdges, IncidenceMatrix, PowerCells, TetDecComplex, TetDecEdges, TetDecFaces
from ._draw import Html, Svg
from ._explain import CrossingConflict, CrossingSide, Cure, Explanation, FaceHeight, FanCenter, Reason, TetExplanation, TetReason
from ._io import Format
from ._measure import QualityMeasure, TetrahedronQuality, TriangleQuality
from ._optimize import Replay, Snapshot
from ._outline import OutlineFile, OutlineMesh
from ._reports import DataReport, DecSummary, Histogram, Histograms, OptimizeReport, Progress, Quality, SizeChange, SweepRecord, TetDataReport, TetDecSummary, TetHistograms, TetQuality, TraceEvent, WorstTet, WorstTriangle
from ._measure_errors import ErrorNorms, FieldErrors, OperatorErrors, ErrorField, FieldFrame, ErrorLevel, ErrorReport, ErrorSystem, DiffusionErrors, DiffusionProblem, TetErrorReport
from ._weights import (
    BestMargin,
    Certificate,
    ConstraintsInfo,
    ConnectivityProof,
    ConnectivityReport,
    ConnectivityStep,
    EdgeConflict,
    Lemma,
    OffsetTerm,
    Optimality,
    Violation,
    WeightConstraint,
    WeightReport,
)

__all__ = sorted(name for name in dir() if not name.startswith("_"))

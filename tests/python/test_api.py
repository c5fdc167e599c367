"""The module has what the C++ headers have, under the same names, documented and typed."""

import ast
import dataclasses
import graphlib
import inspect
import os
import pathlib
import re
import shutil
import subprocess
import sys

import pytest
from conftest import ROOT

import temper

HEADERS = ROOT / "include" / "temper"
MODULES = [temper, temper.energy, temper.generate, temper.geometry, temper.projection, temper.size, temper.topology, temper.types]

# What Python has otherwise, or not at all, and why.
ELSEWHERE = {
    **dict.fromkeys(["table_of", "table_for_tetrahedra", "words_of", "report_table", "rows_of_part", "view_of", "owned_value", "field_list",
                     "field_type", "field_value", "list_type"], "temper.types has the classes that follow from the tables"),
    "name": "enums are their names", "energy_info": "energies() lists the rows", "find_energy": "as energy_info",
    "objective_of": "help(OptimizeOptions)", "make_discretization_error": "optimize does it", "squared_solver_errors": "as make_discretization_error", "solvers": "as make_discretization_error", "squared_errors": "as make_discretization_error", "problem_warnings": "optimize warns", "wants_error_model": "as make_discretization_error", "scheme_weights": "as objective_of",
    "targets": "help(optimize)", "with_coefficient": "dec_operators does it", "efforts": "as targets", "keeps": "as targets", "option_groups": "help(OptimizeOptions)", "option_rows": "help(OptimizeOptions)", "find_option": "as option_groups", "check_option": "optimize checks", "check_kept": "optimize checks", "check_cells": "optimize checks", "fits": "as check_cells", "check_target": "optimize checks",
    "check_options": "as check_option", "option_text": "repr", "option_range_text": "as option_groups",
    "tetrahedron_energy": "the gallery draws it", "missing_need": "optimize warns", "spell_options": "texts are spelled", "stopped_early": "OptimizeReport.stopped",
    "nearest": "errors suggest a name", "join": "as nearest", "did_you_mean": "as nearest", "none_of": "as nearest",
    "read_number": "float", "read_by_strtod": "float",
    **dict.fromkeys(["dual_length_sign", "dual_over_length", "is_flat", "doubled_area"], "kernels of surfaces are in C++ alone"),
    "find_intrinsic_weights": "find_weights(flips=…)", "flip_to_regular": "as find_intrinsic_weights", "n_bad_triangles": "IntrinsicMesh.bad_after",
    "make_surface": "as make_mesh", "closest_places": "SurfaceMesh.point_data", "dual_cells": "DecComplex.power_cells", "surface_options": "optimize does it",
    "name_of_mesh": "as check_cells",
    "triangle_values": "NumPy, of mesh and dec", "spread": "NumPy", "orient2d": "geometry.orientation",
    "as_vector": "Mesh.weighted_vectors", "as_point": "arrays have three columns", "expect_plane": "functions do it",
    "expect_no_period": "functions do it",
    "local_sizes": "local_size",
    "dot": "NumPy", "cross": "NumPy", "length": "NumPy", "squared_length": "NumPy",
    "version": "__version__", "compiled_instruction_sets": "build_info says them",
    "depths_of": "optimize takes point data depth",
    "find_solver": "options_for takes names of solvers", "solver_names": "as find_solver", "target_named": "as find_solver",
    "is_stream": "files and streams of Python", "open_file_of": "as is_stream", "is_open_to_write": "as is_stream",
    "netcdf_version": "as compiled_instruction_sets", "hdf5_version": "as compiled_instruction_sets",
    "gdal_version": "as compiled_instruction_sets", "path_of": "pathlib", "utf8": "as path_of",
    "clp_solver": "find_weights, best_margin and explain use it", "interior_point_solver": "find_weights uses it",
    "check_proof": "check_certificate checks proofs, too",
    "certificate_to_json": "Certificate.to_json", "certificate_from_json": "Certificate.from_json", "optimality_to_json": "temper weights writes it", "is_too_deep": "from_json checks",
    "merge_points": "read(merge=…)", "find_crack": "temper check warns", "flip_flat_triangles": "temper convert does it",
    "reason_text": "Reason.text", "reason_words": "as reason_text", "cure_text": "Cure.text",
    "make_mesh": "read and from_meshio make the mesh", "make_tet_mesh": "as make_mesh", "expect_triangles": "read takes both kinds", "update": "write does it", "set_points": "from_meshio does it", "release_geometry": "read does it",
    "parse_data_rules": "Mesh.point_data_rules", "check_data_rules": "as parse_data_rules", "data_rule_words": "as parse_data_rules",
    "overlaps": "Mesh.cell_data_rules", "conserve": "as overlaps",
    "positions_of_vertices": "Mesh.point_data", "sources_of_tetrahedra": "TetMesh.cell_data", "find_tetrahedron": "as sources_of_tetrahedra", "tetrahedron_near": "as sources_of_tetrahedra", "sources_of_triangles": "Mesh.cell_data", "interpolated": "Mesh.point_data",
    "seams_of": "find_weights keeps the equations of interfaces", "with_mesh": "as seams_of", "close_gaps": "as seams_of", "largest_gap": "as seams_of",
    "corner_weights_of": "Mesh.cell_data has corner_weights", "has_corner_weights": "as corner_weights_of", "corners_of": "as corner_weights_of", "largest_gap_of_edges": "as seams_of", "set_corner_weights": "as corner_weights_of",
    "printable": "messages are", "recoded": "bytes.decode", "needs_projection": "TemperError says it", "projection_text": "Projection's fields",
    "from_mesh": "write does it", "from_outline": "mesh_outline does it", "files_to_write": "write does it", "files_to_read": "read does it",
    "discard_unfinished": "a signal ends Python by an exception",
    "free_memory": "mesh_outline(memory=None) takes it",
    "estimate_outline": "mesh_outline refuses what does not fit", "estimate_sphere": "as estimate_outline",
    "summarize": "DecComplex.summarize", "write_dec": "DecComplex.write, Columns.write",
    "dec_file_names": "write_dec returns the paths", "needs_columns": "as dec_file_names", "read_layers": "numpy.genfromtxt",
    "fault_of_surfaces": "columns says it", "layers_of_triangles": "numpy.mean over the corners",
    "keep_faces": "read and mesh_outline do it", "keeps_faces": "optimize asks it", "become_faces": "Outline.faces",
    "faces_of_line": "Mesh.faces_of",
    "cell_polygons": "power_cells and triangle_cells", "cell_formats": "write(cells=…) names them in errors", "cells_of_groups": "Columns.groups", "draw_before_after_svg": "draw_svg(before=…)", "write_text": "Svg.save and Html.save",
    "replay_with_vertices": "replay",
    "distance": "numpy.linalg.norm; the library asks a space for it",
    "hilbert_order": "Python keeps the user's numbers", "restore_order": "as hilbert_order",
    "hilbert_ordered": "as hilbert_order", "quality_in_place": "as hilbert_order", "or_serial": "threads=1",
    "unflip": "flip three times more", "split_edge": "plan_split and insert_vertex, which check",
    "insert_in_triangle": "plan_insertion and insert_vertex, which check",
    "dihedral_angle": "lengths of tetrahedra are for C++", "six_volumes": "as dihedral_angle",
    "boundary_vertices": "TetMesh.boundary_faces",
    "middle_plane": "PyVista cuts meshes", "plane_through": "draw_svg: cut",
    "criteria_table": "explain_duals takes a target", "criterion_of": "as criteria_table", "criterion_of_target": "as criteria_table",
    "violated_edges": "explain_duals lists the worst", "violated_faces": "as violated_edges", "cells_at_violations": "as violated_edges",
    "meets": "DualExplanation.violations is 0", "violations": "sums of counts of Quality",
    "input_size_field_of": "input_size_field: Python's meshes may go before their views",
}  # fmt: skip

# Struct in C++, class in Python, fields that have another name or place there.
STRUCTS = {
    "OptimizeOptions": (temper.OptimizeOptions, {"size_field", "tensor", "triangle_tensors", "tetrahedra_tensors", "corner_weights", "problem", "paper", "accuracy", "solver_error", "guard", "tets", "surfaces"}),
    "PaperSwitches": (temper.OptimizeOptions, set()),
    "OptimizeReport": (temper.types.OptimizeReport, {"corner_weights", "triangle_tensors"}), "RunReport": (temper.types.OptimizeReport, set()),
    "SurfaceReport": (temper.types.SurfaceOptimizeReport, {"before", "after", "history", "turns_before", "turns_after", "violations_before", "violations_after"}),
    "IntrinsicWeights": (temper.types.IntrinsicMesh, {"report"}),
    "SweepRecord": (temper.types.SweepRecord, set()),
    "DataReport": (temper.types.DataReport, set()),
    "Progress": (temper.types.Progress, set()),
    "Quality": (temper.types.Quality, set()),
    "MeasureRow": (temper.types.QualityMeasure, set()),
    "WorstTriangle": (temper.types.WorstTriangle, set()),
    "tets::Quality": (temper.types.TetQuality, set()),
    "tets::WorstTet": (temper.types.WorstTet, set()),
    "TriangleQuality": (temper.types.TriangleQuality, set()),
    "tets::TetrahedronQuality": (temper.types.TetrahedronQuality, set()),
    "DecComplex": (temper.types.DecComplex, {"sphere_orthocenters", "sphere_midpoints"}),
    "DecSummary": (temper.types.DecSummary, set()),
    "tets::DecComplex": (temper.types.TetDecComplex, set()),
    "tets::ErrorReport": (temper.types.TetErrorReport, {"poisson", "flux"}),
    "tets::DecSummary": (temper.types.TetDecSummary, set()),
    "PowerCells": (temper.types.PowerCells, {"sphere_corners", "faces", "regions", "region_shares"}),
    "Columns": (temper.types.Columns, {"plan", "connections"}),
    "Barrier": (temper.types.Barrier, set()),
    "LineFace": (temper.types.LineFaces, {"first", "second", "from", "to"}),
    "IncidenceMatrix": (temper.types.IncidenceMatrix, set()),
    "WeightReport": (temper.types.WeightReport, set()),
    "Optimality": (temper.types.Optimality, set()), "OffsetTerm": (temper.types.OffsetTerm, set()),
    "BestMargin": (temper.types.BestMargin, set()),
    "ConstraintsInfo": (temper.types.ConstraintsInfo, {"constraints"}),
    "ConnectivityReport": (temper.types.ConnectivityReport, set()),
    "ConnectivityStep": (temper.types.ConnectivityStep, set()),
    "Reason": (temper.types.Reason, {"bad", "checked", "at_interface"}),
    "Cure": (temper.types.Cure, {"triangles", "changed"}),
    "Explanation": (temper.types.Explanation, {"changed"}),
    "tets::FaceHeight": (temper.types.FaceHeight, set()),
    "tets::Reason": (temper.types.TetReason, {"why"}),
    "tets::Explanation": (temper.types.TetExplanation, {"quality", "weights", "has_interfaces"}),
    "ErrorReport": (temper.types.ErrorReport, {"poisson", "flux"}),
    "ErrorSystem": (temper.types.ErrorSystem, {"definite"}), "DiffusionErrors": (temper.types.DiffusionErrors, {"vertex_system", "cell_system"}),
    "Restoration": (temper.topology.Restoration, set()),
    "SizeReport": (temper.size.SizeReport, set()),
    "TraceEvent": (temper.types.TraceEvent, set()),
    "EnergyInfo": (temper.energy.EnergyInfo, {"kind"}),
    "OutlineMesh": (temper.types.OutlineMesh, set()),
    "EdgeConflict": (temper.types.EdgeConflict, {"near_u", "near_v", "a", "b"}),
}


def functions_of(header):
    """Names of the free functions that a header declares."""
    text = re.sub(r"/\*.*?\*/|//[^\n]*", "", header.read_text(encoding="utf-8"), flags=re.S)
    names = set()
    for match in re.finditer(r"^(?:\[\[nodiscard\]\] )?(?:(?:inline|constexpr) )*[A-Za-z_][\w:<>,*& ]*? \*?&?(\w+)\(", text, re.M):
        names.add(match[1])
    return names - {"operator", "sqrt", "alignas"}


def fields_of(struct):
    """Names of the members of a struct, in whichever header it is; those of namespace tets are in a folder."""
    tets, struct = struct.startswith("tets::"), struct.removeprefix("tets::")
    for header in (each for each in HEADERS.rglob("*.hpp") if (each.parent.name == "tets") == tets):
        text = re.sub(r"//[^\n]*", "", header.read_text(encoding="utf-8"))
        match = re.search(rf"^struct {struct}(?: : (\w+))? \{{\n(.*?)^\}};", text, re.M | re.S)
        if match is None:
            continue
        body = re.sub(r"^  (?:enum class|struct) .*?^  \};", "", match[2], flags=re.M | re.S)
        body = re.sub(r" = [\w:<>]+\(\);", ";", body)
        body = "\n".join(line for line in body.splitlines() if "(" not in line.split("=")[0] or "std::function" in line)
        found = fields_of("tets::" * tets + match[1]) if match[1] else set()
        for statement in re.findall(r"^  (?!friend|\[\[|static|return|enum|  )([A-Za-z][^;{}()]*(?:\{[^;]*\})?[^;]*);", body, re.M):
            for piece in re.split(r",(?![^<{]*[>}])", statement):
                name = re.search(r"(\w+)\s*(?:=.*)?$", piece.strip(), re.S)
                if name:
                    found.add(name[1])
        return found
    raise AssertionError(f"no struct {struct} in the headers")


def test_every_function_of_the_headers_is_here():
    missing, seen = [], 0
    for header in sorted(HEADERS.rglob("*.hpp")):
        for name in sorted(functions_of(header)):
            seen += 1
            if name not in ELSEWHERE and not any(hasattr(module, name) for module in MODULES):
                missing.append(f"{header.name}: {name}")
    assert not missing and seen > 100, (missing, seen)


def test_the_top_has_few_names_and_each_is_in_one_place():
    assert {name for name in dir(temper) if not name.startswith("_")} | {"__version__"} == set(temper.__all__)
    assert len(temper.__all__) <= 70
    for name, value in public_objects():
        assert not any(getattr(module, other, None) is value for module in MODULES for other in module.__all__
                       if f"{module.__name__}.{other}" != name), name  # fmt: skip


def imports_of(package):
    """Of each module of a package those of the package that it imports, in functions, too."""
    graph = {}
    for file in package.glob("*.py"):
        found = graph[file.stem] = set()
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and node.level == 1:
                found.update([node.module] if node.module else [alias.name for alias in node.names])
            elif isinstance(node, ast.ImportFrom) and node.module.split(".")[0] == package.name:
                found.add(node.module.removeprefix(package.name).strip(".") or "__init__")
            elif isinstance(node, ast.Import) and any(alias.name.split(".")[0] == package.name for alias in node.names):
                found.add("__init__")
    return graph


def circle_of(graph):
    """Modules that import each other in a circle; none where there is no circle."""
    try:
        graphlib.TopologicalSorter(graph).prepare()
    except graphlib.CycleError as error:
        return set(error.args[1])
    return set()


def test_no_modules_import_each_other_in_a_circle(tmp_path):
    graph = imports_of(ROOT / "python" / "temper")
    assert len(graph) > 20 and "_mesh" in graph["_draw"] and circle_of(graph) == set()
    planted = shutil.copytree(ROOT / "python" / "temper", tmp_path / "temper")
    with open(planted / "_mesh.py", "a", encoding="utf-8") as file:
        file.write("\n\ndef planted():\n    from ._draw import html_report\n")
    assert {"_mesh", "_draw"} <= circle_of(imports_of(planted))


def test_what_is_elsewhere_is_still_in_the_headers():
    all_names = set().union(*(functions_of(h) for h in HEADERS.rglob("*.hpp")))
    assert set(ELSEWHERE) <= all_names, set(ELSEWHERE) - all_names


@pytest.mark.parametrize("struct", STRUCTS)
def test_reports_and_options_have_the_fields_of_the_library(struct):
    python, others = STRUCTS[struct]
    names = {f.name for f in dataclasses.fields(python)}
    expected = fields_of(struct)
    assert len(expected) > 2 and expected - others <= names, expected - others - names


def public_objects():
    for module in MODULES:
        for name in getattr(module, "__all__"):
            value = getattr(module, name)
            if callable(value) and not isinstance(value, type(temper)):
                yield f"{module.__name__}.{name}", value


def test_everything_is_documented():
    silent = []
    for name, value in public_objects():
        if not inspect.getdoc(value) or (inspect.isclass(value) and value.__doc__ is None):
            silent.append(name)
        if inspect.isclass(value) and value.__module__.startswith("temper"):
            for attribute, member in vars(value).items():
                if attribute.startswith("_") or not (inspect.isfunction(member) or isinstance(member, property)):
                    continue
                if not inspect.getdoc(member):
                    silent.append(f"{name}.{attribute}")
    assert not silent


def test_everything_is_typed():
    untyped = []
    for name, value in public_objects():
        if inspect.isfunction(value):
            for parameter in inspect.signature(value).parameters.values():
                if parameter.annotation is inspect.Parameter.empty:
                    untyped.append(f"{name}({parameter.name})")
            if inspect.signature(value).return_annotation is inspect.Signature.empty:
                untyped.append(name)
    assert not untyped


def test_help_of_optimize_shows_the_signature_and_what_is_not_an_option():
    text = temper.optimize.__doc__
    signature = inspect.signature(temper.optimize)
    assert len(signature.parameters) <= 12
    for name in signature.parameters:
        assert re.search(rf"^    (?:\w+, )*{name}(?:, \w+)* : ", text, re.M), name
    for kind, words in temper._temper.presets().items():
        assert all(f"- ``{word}``: " in text for word in words), kind
    for word in ("Raises", "Returns", "KeyboardInterrupt", "Algorithm 1", ">>> import temper"):
        assert word in text


def test_stubs_name_what_the_compiled_module_has():
    path = ROOT / "python" / "temper" / "_temper.pyi"
    tree = ast.parse(path.read_text(encoding="utf-8"))
    functions = {n.name: n for n in tree.body if isinstance(n, ast.FunctionDef)}
    classes = {n.name: n for n in tree.body if isinstance(n, ast.ClassDef)}
    values = {n.target.id for n in tree.body if isinstance(n, ast.AnnAssign)}
    module = temper._temper
    there = {n for n in dir(module) if not n.startswith("__")} | {"__version__"}
    if not hasattr(module, "measure_errors"):
        pytest.skip("built without Eigen")
    assert set(functions) | set(classes) | values == there
    for name, node in functions.items():
        promised = len(node.args.posonlyargs) + len(node.args.args)
        lines = getattr(module, name).__doc__.splitlines()
        line = next((each for each in lines if each.startswith("1. ")), lines[0])  # of functions of several kinds of meshes
        assert promised == len(re.findall(r"arg\d+:", line)), (name, line)
    for name, node in classes.items():
        promised = {n.name for n in node.body if isinstance(n, ast.FunctionDef)}
        assert promised == {n for n in vars(getattr(module, name)) if not n.startswith("_")}, name
    assert (ROOT / "python" / "temper" / "py.typed").exists()


def test_the_names_of_energies_are_those_of_the_library():
    from typing import get_args

    assert get_args(temper._options.EnergyName) == tuple(row.name for row in temper.energy.energies())


def test_a_wrong_type_is_told_what_is_expected(ring):
    with pytest.raises(TypeError, match=r"max_sweeps: expected int, found 'ten'"):
        temper.optimize(ring, options={"max_sweeps": "ten"})
    with pytest.raises(temper.TemperError, match=r"repair is True; expected none, perturb or vertices"):
        temper.optimize(ring, options={"repair": True})


def test_a_package_that_is_not_built_says_so(tmp_path):
    shutil.copytree(ROOT / "python" / "temper", tmp_path / "temper")
    run = subprocess.run([sys.executable, "-c", "import temper"], cwd=tmp_path, capture_output=True, text=True, env={"PYTHONPATH": ""})
    assert run.returncode == 1 and f"_temper is not in {tmp_path / 'temper'}: see docs/howto/install.md" in run.stderr


def test_a_numpy_that_arrays_would_be_wrong_with_is_refused(tmp_path):
    if temper._temper.knows_numpy_2:
        pytest.skip("this module knows NumPy 2")
    (tmp_path / "run.py").write_text("import numpy\nnumpy.__version__ = '2.0.0'\nimport temper\n", encoding="utf-8")
    run = subprocess.run([sys.executable, "run.py"], cwd=tmp_path, capture_output=True, text=True)
    assert run.returncode == 1 and 'found NumPy 2.0.0: install "numpy<2"' in run.stderr


def test_errors_can_be_pickled_and_are_value_errors():
    import pickle

    error = temper.TemperError("syntax", "a.vtu:3", "expected a number")
    again = pickle.loads(pickle.dumps(error))
    assert str(again) == "a.vtu:3: expected a number" and again.code == "syntax" and isinstance(again, ValueError)


def test_the_instruction_set_can_be_chosen():
    fastest = temper.instruction_set()
    assert fastest == temper.instruction_sets()[-1]
    assert temper.use_instruction_set("baseline") and temper.instruction_set() == "baseline"
    assert not temper.use_instruction_set("abacus") and temper.use_instruction_set(fastest)


def test_the_version_is_that_of_the_project():
    cmake = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    assert temper.__version__ == re.search(r"project\(temper VERSION ([\d.]+)", cmake)[1]
    pyproject = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    pattern = re.search(r"^regex = '(.*)'$", pyproject, re.M)[1]
    assert re.search(pattern, cmake)["value"] == temper.__version__


def test_build_info_is_what_the_program_says():
    program = pathlib.Path(os.environ["TEMPER_PROGRAM_DIR"]) / "temper"
    printed = subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout
    head, rows = printed.split("\n\n")
    assert head == f"temper {temper.__version__}"
    printed = dict(row.split(maxsplit=1) for row in rows.splitlines())
    info = temper.build_info()
    assert info.pop("version") == temper.__version__
    # What is being built while a file changes may name another commit.
    assert printed.pop("commit") and info.pop("commit")
    printed.pop("MPI", None)  # which the module has no use for
    assert printed == info

#!/usr/bin/env python3
"""test_schema.py PROGRAM SCHEMA: reports of the program are as the schema says, and others are not."""
import copy
import json
import pathlib
import subprocess
import sys
import tempfile

import jsonschema


def other_documents(temper, folder):
    """(kind, document) of every verb except check and optimize."""
    def file(name):
        return json.loads(pathlib.Path(folder, name).read_text(encoding="utf-8"))

    def said(verb, *words, exit=0):
        return json.loads(temper(verb, *words, "--json", "--quiet", exit=exit))

    temper("example", "sparse-horseshoe", "-o", "shoe.vtu")
    pathlib.Path(folder, "square.poly").write_text("4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n", encoding="utf-8")
    temper("mesh", "square.poly", "-o", "square.vtu", "--size", "0.3", "--write", "mesh.json", "--quiet")
    proof = ("weights", said("weights", "shoe.vtu", "--mode", "margin", "--certificate", "why.json", exit=6))
    best = ("weights", said("weights", "square.vtu", "-o", "w.vtu", "--mode", "accuracy", "--certificate", "best.json"))
    return [
        best, ("best_weights", file("best.json")),
        ("mesh_report", file("mesh.json")), ("explain", said("explain", "shoe.vtu")), ("explain", said("explain", "square.vtu")),
        ("explain_tetrahedra", said("explain", "tet.mesh")), ("explain_duals", said("explain", "in.vtu", "--for", "vertex")),
        ("explain_duals", said("explain", "tet.mesh", "--for", "cell")), ("explain_surface", said("explain", "surface.obj")),
        proof, ("weights", said("weights", "in.vtu", "-o", "w.vtu", "--mode", "elastic", "--connectivity", "search", exit=None)),
        ("weights", said("weights", "shoe.vtu", "--mode", "margin", "--connectivity", "search", "--certificate", "all.json", exit=6)),
        ("connectivity_proof", file("all.json")),
        ("certificate_check", said("weights", "shoe.vtu", "--check-certificate", "why.json")), ("certificate", file("why.json")),
        ("errors", said("errors", "square.vtu", "--refine", "1", "--against", "square.vtu")),
        ("errors_tetrahedra", said("errors", "tet.mesh", "--against", "tet.mesh")),
        ("errors_surfaces", said("errors", "surface.obj", "--against", "surface.obj")),
        ("problem", said("errors", "square.vtu", "--dirichlet", "1=0", "--source", "1", "--against", "square.vtu")),
        ("Operators", said("operators", "square.vtu", "-o", "dual", "--format", "npz")),
        ("TetOperators", said("operators", "tet.mesh", "-o", "dual", "--format", "npz")),
    ]  # fmt: skip


def main(program, schema_path):
    schema = json.loads(pathlib.Path(schema_path).read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator.check_schema(schema)
    kinds = [row["$ref"].rsplit("/", 1)[1] for row in schema["oneOf"] if "$ref" in row]
    of_kind = {kind: jsonschema.Draft202012Validator({**schema, "oneOf": [{"$ref": "#/$defs/" + kind}]}) for kind in kinds}
    whole = jsonschema.Draft202012Validator(schema)

    with tempfile.TemporaryDirectory() as folder:
        def temper(*words, exit=0):
            run = subprocess.run([program, *words], cwd=folder, capture_output=True, text=True)
            assert exit is None or run.returncode == exit, (words, run.returncode, run.stderr)
            return run.stdout

        def report(*words, exit=0):
            temper("optimize", "in.vtu", "-o", "out.vtu", "--write", "report.json", "--quiet", *words, exit=exit)
            return json.loads(pathlib.Path(folder, "report.json").read_text(encoding="utf-8"))

        temper("example", "random", "--vertices", "60", "-o", "in.vtu")
        one = json.loads(temper("check", "in.vtu", "--json", "--require", "outside=0,energy.BH.1=1", exit=3))
        pathlib.Path(folder, "tet.mesh").write_text("MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\nTetrahedra\n1\n1 2 3 4 0\nEnd\n", encoding="utf-8")
        tetrahedra = json.loads(temper("check", "tet.mesh", "--json", "--require", "outside=0", exit=3))
        pathlib.Path(folder, "surface.obj").write_text("v 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nv 0.6 0 2\nv 0 0 -2\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nf 2 1 6\nf 3 2 6\nf 4 3 6\nf 1 4 6\n", encoding="utf-8")
        surface = json.loads(temper("check", "surface.obj", "--json", "--require", "outside=0", exit=None))
        two = json.loads(temper("check", "in.vtu", "tet.mesh", "surface.obj", "--json"))
        reports = [report(), report("--set", "objective=accuracy"), report("--require", "regions=2", exit=3),
                   report("--for", "paper", "--set", "max_sweeps=2"), report("--time-limit", "1e-9", exit=4)]
        temper("optimize", "tet.mesh", "-o", "out.mesh", "--write", "tets.json", "--require", "outside")
        of_tetrahedra = json.loads(pathlib.Path(folder, "tets.json").read_text(encoding="utf-8"))
        temper("optimize", "surface.obj", "-o", "out.obj", "--write", "surface.json", "--surface-distance", "0.1", "--quiet")
        of_surface = json.loads(pathlib.Path(folder, "surface.json").read_text(encoding="utf-8"))
        others = other_documents(temper, folder)

    assert len(two) == 3 and one["energy"]["BH"][1] is None and not one["requirements"][1]["met"]
    documents = [("check", one), ("check_tetrahedra", tetrahedra), *(("report", r) for r in reports), ("report_tetrahedra", of_tetrahedra), ("check_surface", surface), ("report_surface", of_surface), *others]
    assert {kind for kind, _ in documents} == set(kinds)
    for found in [two, *(found for _, found in documents)]:
        whole.validate(found)
    for kind, found in documents:
        of_kind[kind].validate(found)
        optional = set(found) - set(schema["$defs"][kind]["required"])
        for key in found:
            if key in optional:
                continue
            less, other = copy.deepcopy(found), copy.deepcopy(found)
            del less[key]
            other[key + "s"] = other.pop(key)
            assert not of_kind[kind].is_valid(less) and not of_kind[kind].is_valid(other), (kind, key)
    print(f"{len(documents) + 1} documents of the program are valid")


if __name__ == "__main__":
    main(*sys.argv[1:])

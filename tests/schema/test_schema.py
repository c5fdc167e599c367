#!/usr/bin/env python3
"""test_schema.py PROGRAM SCHEMA: reports of the program are as the schema says, and others are not."""
import copy
import json
import pathlib
import subprocess
import sys
import tempfile

import jsonschema


def main(program, schema_path):
    schema = json.loads(pathlib.Path(schema_path).read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator.check_schema(schema)
    of_kind = {kind: jsonschema.Draft202012Validator({**schema, "oneOf": [{"$ref": "#/$defs/" + kind}]})
               for kind in ("check", "report")}
    whole = jsonschema.Draft202012Validator(schema)

    with tempfile.TemporaryDirectory() as folder:
        def temper(*words, exit=0):
            run = subprocess.run([program, *words], cwd=folder, capture_output=True, text=True)
            assert run.returncode == exit, (words, run.returncode, run.stderr)
            return run.stdout

        def report(*words, exit=0):
            temper("optimize", "in.vtu", "-o", "out.vtu", "--write", "report.json", "--quiet", *words, exit=exit)
            return json.loads(pathlib.Path(folder, "report.json").read_text(encoding="utf-8"))

        temper("example", "random", "--vertices", "60", "-o", "in.vtu")
        one = json.loads(temper("check", "in.vtu", "--json", "--require", "outside=0,energy.BH.1=1", exit=3))
        two = json.loads(temper("check", "in.vtu", "in.vtu", "--json"))
        reports = [report(), report("--set", "objective=accuracy"), report("--require", "regions=2", exit=3),
                   report("--for", "paper", "--set", "max_sweeps=2"), report("--time-limit", "1e-9", exit=4)]

    assert len(two) == 2 and one["energy"]["BH"][1] is None and not one["requirements"][1]["met"]
    for found in [one, two, *reports]:
        whole.validate(found)
    for kind, found in [("check", one), *(("report", r) for r in reports)]:
        of_kind[kind].validate(found)
        for key in found:
            less, other = copy.deepcopy(found), copy.deepcopy(found)
            del less[key]
            other[key + "s"] = other.pop(key)
            assert not of_kind[kind].is_valid(less) and not of_kind[kind].is_valid(other), (kind, key)
    print(f"{len(reports) + 2} documents of the program are valid")


if __name__ == "__main__":
    main(*sys.argv[1:])

#!/usr/bin/env python3
"""A run has the same result, whoever calls it: the same bytes of the mesh, and the same objective.

callers.py --program FILE [--cpp FILE] [--python FOLDER] [--npm FOLDER]

Each caller that is named is compared with the program; one at least has to be. --cpp: run.cpp as a program; --python:
where the package is; --npm: web/npm, built, in runs whose repairs ask no linear programs, since it has no Clp. A caller
that cannot run is a failure.
"""
import argparse
import hashlib
import json
import pathlib
import subprocess
import sys
import tempfile

EXAMPLES = {"random": ["random", "--vertices", "400"], "annulus": ["annulus"], "horseshoe": ["horseshoe"]}
# Name → options, and the objective of the run. run.cpp has the same.
SETS = {
    "default": ({}, "accuracy"),
    "vertex": ({"for": "vertex"}, "solver_error"),
    "cell": ({"for": "cell"}, "solver_error"),
    "energy": ({"objective": "energy"}, "energy"),
    "positions": ({"unknowns": "positions", "boundary": "slide"}, "accuracy"),
}
NO_PROGRAMS = {"repair-trials": "19"}  # each counts as 20


def output_of(*words):
    run = subprocess.run(words, capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"callers: {' '.join(words)} ended with {run.returncode}\n{run.stderr}")
    return run.stdout.strip()


def by_program(program, given, result, name, options):
    words = [word for key, value in options.items() for word in ("--" + key, value)]
    report = result.with_suffix(".json")
    output_of(program, "optimize", str(given), "-o", str(result), "--quiet", "--report", str(report), *words)
    return json.loads(report.read_text(encoding="utf-8"))["objective"]


def by_cpp(program, given, result, name, options):
    return output_of(program, str(given), str(result), name)


def with_names_of_python(options):
    """Which are those of the npm package, too."""
    numbers = {key: int(value) if value.isdigit() else value for key, value in options.items()}
    return {"target" if key == "for" else key.replace("-", "_"): value for key, value in numbers.items()}


def by_python(folder, given, result, name, options):
    if folder not in sys.path:
        sys.path.insert(0, folder)
    import temper

    mesh = temper.read(given)
    report = temper.optimize(mesh, **with_names_of_python(options))
    temper.write(result, mesh)
    return report.objective


def by_npm(folder, given, result, name, options):
    script = str(pathlib.Path(__file__).with_name("run.mjs"))
    return output_of("node", script, folder, str(given), str(result), json.dumps(with_names_of_python(options)))


CALLERS = {"program": by_program, "cpp": by_cpp, "python": by_python, "npm": by_npm}


def run(caller, path, given, name, options):
    """The hash of the mesh, and the objective."""
    result = given.with_name(f"{given.stem}-{name}-{caller}.vtu")
    objective = CALLERS[caller](path, given, result, name, options)
    return hashlib.sha256(result.read_bytes()).hexdigest()[:16], objective


def compare(callers, given, name, options):
    """Whether all agree, which a line says."""
    found = {caller: run(caller, path, given, name, options) for caller, path in callers.items()}
    digest, objective = found["program"][0], SETS[name][1]
    same = all(each == (digest, objective) for each in found.values())
    verdict = f"{digest} {objective}" if same else f"DIFFER, expected {objective}: {found}"
    print(f"{given.stem:10} {name:10} {verdict:26} {', '.join(callers)}")
    return same


def main():
    parser = argparse.ArgumentParser()
    for caller in CALLERS:
        parser.add_argument("--" + caller, required=caller == "program")
    callers = {caller: path for caller, path in vars(parser.parse_args()).items() if path is not None}
    if len(callers) < 2:
        parser.error("expected one caller at least besides the program")
    npm = {caller: callers[caller] for caller in ("program", "npm") if "npm" in callers}
    native = {caller: path for caller, path in callers.items() if caller != "npm"}

    same = []
    with tempfile.TemporaryDirectory() as folder:
        for example, words in EXAMPLES.items():
            given = pathlib.Path(folder, example + ".vtu")
            output_of(callers["program"], "example", *words, "-o", str(given))
            for name, (options, _) in SETS.items():
                if len(native) > 1:
                    same.append(compare(native, given, name, options))
                if npm:
                    same.append(compare(npm, given, name, {**options, **NO_PROGRAMS}))
    print(f"{sum(same)} of {len(same)} comparisons of {', '.join(callers)} found the same bytes")
    return not all(same)


if __name__ == "__main__":
    sys.exit(main())

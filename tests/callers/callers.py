#!/usr/bin/env python3
"""A run has the same result, whoever calls it: the same bytes of the mesh, and the same objective.

callers.py --program FILE [--cpp FILE] [--python FOLDER] [--npm FOLDER]

Each caller is compared with the program. At least one must be given. --cpp: run.cpp as a program; --python: the folder
of the package; --npm: web/npm, built. Runs of npm have too few trials for linear programs, which npm does not have. A
caller that cannot run is a failure.
"""
import argparse
import hashlib
import json
import pathlib
import subprocess
import sys
import tempfile

EXAMPLES = {"random": ["random", "--vertices", "400"], "annulus": ["annulus"], "horseshoe": ["horseshoe"]}
# Name → arguments of optimize in Python and npm, and the objective of the run. run.cpp has the same sets.
SETS = {
    "default": ({}, "accuracy"),
    "vertex": ({"target": "vertex"}, "solver_error"),
    "cell": ({"target": "cell"}, "solver_error"),
    "energy": ({"options": {"objective": "energy"}}, "energy"),
    "positions": ({"keep": ["weights"], "boundary": "slide"}, "accuracy"),
}
NO_PROGRAMS = {"repair_trials": 19}  # a linear program counts as 20


def output_of(*words):
    run = subprocess.run(words, capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"callers: {' '.join(words)} ended with {run.returncode}\n{run.stderr}")
    return run.stdout.strip()


def words_of(arguments):
    """The arguments as words of the program."""
    words = []
    for name, value in arguments.items():
        if name == "options":
            words += ["--set", ",".join(f"{option}={each}" for option, each in value.items())]
        else:
            words += ["--for" if name == "target" else "--" + name, ",".join(value) if name == "keep" else value]
    return words


def by_program(program, given, result, name, arguments):
    report = result.with_suffix(".json")
    words = words_of(arguments)
    output_of(program, "optimize", str(given), "-o", str(result), "--quiet", *words, "--write", str(report))
    return json.loads(report.read_text(encoding="utf-8"))["objective"]


def by_cpp(program, given, result, name, arguments):
    return output_of(program, str(given), str(result), name)


def by_python(folder, given, result, name, arguments):
    if folder not in sys.path:
        sys.path.insert(0, folder)
    import temper

    mesh = temper.read(given)
    report = temper.optimize(mesh, **arguments)
    temper.write(result, mesh)
    return report.objective


def by_npm(folder, given, result, name, arguments):
    script = str(pathlib.Path(__file__).with_name("run.mjs"))
    return output_of("node", script, folder, str(given), str(result), json.dumps(arguments))


CALLERS = {"program": by_program, "cpp": by_cpp, "python": by_python, "npm": by_npm}


def run(caller, path, given, name, arguments):
    """The hash of the mesh, and the objective."""
    result = given.with_name(f"{given.stem}-{name}-{caller}.vtu")
    objective = CALLERS[caller](path, given, result, name, arguments)
    return hashlib.sha256(result.read_bytes()).hexdigest()[:16], objective


def compare(callers, given, name, arguments):
    """Prints a line, and says if all agree."""
    found = {caller: run(caller, path, given, name, arguments) for caller, path in callers.items()}
    digest, objective = found["program"][0], SETS[name][1]
    same = all(each == (digest, objective) for each in found.values())
    verdict = f"{digest} {objective}" if same else f"DIFFER, expected {objective}: {found}"
    print(f"{given.stem:10} {name:10} {verdict:29} {', '.join(callers)}")
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
            for name, (arguments, _) in SETS.items():
                if len(native) > 1:
                    same.append(compare(native, given, name, arguments))
                if npm:
                    options = {**arguments.get("options", {}), **NO_PROGRAMS}
                    same.append(compare(npm, given, name, {**arguments, "options": options}))
    print(f"{sum(same)} of {len(same)} comparisons of {', '.join(callers)} found the same bytes")
    return not all(same)


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""What each target, effort and part to keep gains and costs: tables of docs/explanation/measured.md, and the results in README.md.

    bench/targets_table.py TEMPER [--write]

The meshes are the public ones of the folder that TEMPER_SHARED names (default: ../shared), and without them examples of
temper. Counts are sums over the meshes. Angles are the worst. Errors are L2 errors of temper errors on the held-back fields,
over those of the input: geometric means over fields and meshes. Only the last table takes the root mean square over the
fields: a grid solves some of them exactly. Times are those of the processor, on one thread. --write puts the tables into the pages.
"""

import json
import math
import os
import pathlib
import re
import resource
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGES = ROOT / "docs" / "explanation" / "measured.md", ROOT / "README.md"
PUBLIC = pathlib.Path(os.environ.get("TEMPER_SHARED", ROOT.parent / "shared")) / "meshes"
# Errors cancel from neighbor to neighbor on the first two.
EXAMPLES = {"sheared grid": ["sheared-grid"], "ring": ["annulus"], "random points": ["random", "--vertices", 400]}
TARGETS = [f"--for {target}" for target in ("any", "valid", "vertex", "cell", "stars", "mpas", "dflowfm", "adcirc", "fem")]
EFFORTS = [f"--for {target} --effort {effort}" for target in ("any", "vertex", "cell") for effort in ("quick", "high")]
KEEPS = [*(f"--keep {part}" for part in ("weights", "positions", "edges", "sizes")), "--for vertex --keep weights", "--boundary split"]
HEAD = ["options", "bad triangles", "angles", "error at vertices", "error in cells", "error of ★1", "time", "obtuse",
        "orthogonality: median, worst", "vertices removed, inserted"]  # fmt: skip
SCHEMES, CHANGES = ("poisson", "flux", "star1"), ("vertices_removed", "vertices_inserted")
RESULTS = [("triangles that are not well-centered", "--for any", 1), ("obtuse triangles, without weights", "--for mpas", 7),  # column
           ("error of a Poisson problem with unknowns at vertices", "--for vertex", 3),
           ("error of a Poisson problem by two-point fluxes", "--for cell", 4), ("error of the Hodge star ★1", "--for stars", 5)]  # fmt: skip


def run(*words):
    done = subprocess.run(words := [*map(str, words)], capture_output=True, text=True)
    return done.stdout if done.returncode == 0 else sys.exit(f"{' '.join(words)}: {done.stderr}")


def used():
    return sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])


def public_meshes():
    return sorted(path for path in PUBLIC.glob("*") if path.is_file() and path.suffix in (".mesh", ".msh", ".vtk", ".vtu"))


class Bench:
    def __init__(self, temper, folder):
        self.temper, self.folder, self.done = temper, folder, {}

    def examples(self):
        return [(run(self.temper, "example", *words, "-o", file := self.folder / f"{name}.vtu"), file)[1] for name, words in EXAMPLES.items()]

    def measured(self, mesh, options):
        """Of one mesh after a run with these options, or of itself."""
        if (mesh, options) not in self.done:
            out, report, before = self.folder / "out.vtu" if options else mesh, self.folder / "report.json", used()
            if options:
                run(self.temper, "optimize", mesh, "-o", out, "--threads", 1, "--quiet", "--write", report, *options.split())
            seconds = used() - before
            check = json.loads(run(self.temper, "check", out, "--json"))
            errors = json.loads(run(self.temper, "errors", out, "--against", mesh, "--fields", "held-back", "--json"))
            ratios, changes = errors["against"]["ratios"]["mean"]["held-back"], json.loads(report.read_text()) if options else {}
            self.done[mesh, options] = {
                **check, "bad": errors["not_well_centered"], "ratios": [ratios[scheme]["l2"] for scheme in SCHEMES],
                "errors": [math.hypot(*(field[scheme]["l2"] for field in errors["errors"]["fields"])) for scheme in SCHEMES],
                "seconds": seconds, **{key: changes.get(key, 0) for key in CHANGES},
            }  # fmt: skip
        return self.done[mesh, options]

    def row(self, meshes, options, unit):
        rows = [self.measured(mesh, options) for mesh in meshes]
        total = {key: sum(row[key] for row in rows) for key in ("bad", "obtuse_triangles", "triangles", "seconds", *CHANGES)}
        angles = min(row["min_angle_deg"] for row in rows), max(row["max_angle_deg"] for row in rows)
        cells = [f"`{options}`" if options else "input", f"{total['bad']} of {total['triangles']}", "{:.0f}° to {:.0f}°".format(*angles)]
        cells += [f"{statistics.geometric_mean(ratios):.2f}" for ratios in zip(*(row["ratios"] for row in rows))]
        cells += [f"{total['seconds'] / unit:.1f}" if options else "", total["obtuse_triangles"]]
        cells += [", ".join(f"{of(row['max_orthogonality'] for row in rows):.2f}" for of in (statistics.median, max))]
        return [*cells, f"{total['vertices_removed']}, {total['vertices_inserted']}" if options else ""]

    def table(self, meshes, runs, columns=len(HEAD)):
        unit = sum(self.measured(mesh, "--for any")["seconds"] for mesh in meshes)
        return markdown(HEAD[:columns], [self.row(meshes, options, unit)[:columns] for options in runs])

    def results(self, meshes):
        rows = [[what, f"`{options}`", *(self.row(meshes, each, 1)[column] for each in ("", options))] for what, options, column in RESULTS]
        return markdown(["count, or error (1: as on the input)", "options", "before", "after"], rows)

    def regular_table(self):
        meshes, rows = self.examples(), []
        for options in [*TARGETS, "--for vertex --keep weights"]:
            pairs = [(self.measured(mesh, options)["errors"], self.measured(mesh, "")["errors"]) for mesh in meshes]
            rows.append([f"`{options}`", *(f"{after[i] / before[i]:.2f}" for after, before in pairs for i in (0, 1))])
        return markdown(["options", *(f"{name}, {place}" for name in EXAMPLES for place in ("vertices", "cells"))], rows)


def markdown(head, rows):
    head, *rows = ("| " + " | ".join(map(str, row)) + " |" for row in [head, *rows])
    return "\n".join([head, "|-|" + "-:|" * (head.count("|") - 2), *rows])


def main():
    if len(sys.argv) < 2 or sys.argv[2:] not in ([], ["--write"]):
        sys.exit(__doc__)
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(sys.argv[1], pathlib.Path(folder))
        meshes = [path for path in public_meshes() if "beam-tri" not in path.name] or bench.examples()  # beam-tri has no vertex inside
        print(f"{len(meshes)} meshes: {', '.join(path.stem for path in meshes)}\n")
        tables = {"targets": bench.table(meshes, ["", *TARGETS]), "efforts": bench.table(meshes, EFFORTS, 7), "keep": bench.table(meshes, KEEPS, 7)}
        tables |= {"regular": bench.regular_table(), "results": bench.results(meshes)}
    print(*(f"{name}\n\n{table}\n" for name, table in tables.items()), sep="\n")
    mark = re.compile(r"(?<=<!-- written by bench/targets_table.py: )((\w+) -->\n).*?(?=<!-- end -->)", re.S)
    for page in PAGES if sys.argv[2:] else ():
        page.write_text(mark.sub(lambda match: match[1] + tables[match[2]] + "\n", page.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()

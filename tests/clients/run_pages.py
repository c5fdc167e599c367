"""Runs the pages of docs/howto against the real clients, and compares what they print with what the pages say.

    run_pages.py                  all pages
    run_pages.py fipy landlab     these
    run_pages.py --write          puts what was printed into the pages, and the table into docs/howto/README.md

Every block of a page runs from top to bottom in an empty folder and a process of its own; the last one asserts what the
page promises, prints its numbers, and leaves them as `results`, by the keys of COLUMNS. scripts/clients.sh installs the clients and calls
this.
"""

import argparse
import importlib.metadata
import io
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests" / "python"))
from pages import blocks_of, lacking  # noqa: E402

HOWTO = ROOT / "docs" / "howto"
README = HOWTO / "README.md"
COLUMNS = ("before", "energy", "default", "accuracy", "for")
# The last digits of iterative solvers depend on BLAS and the machine.
TOLERANCE = 0.02
# What is below this is rounding, which is another number on each machine.
ROUNDING = 1e-9
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
# Distributions of modules with other names.
DISTRIBUTIONS = {"skfem": "scikit-fem"}


def version(tool):
    """Of a module, or of mf6; nothing for what is temper's own."""
    if tool == "program mf6":
        said = subprocess.run(["mf6", "--version"], capture_output=True, text=True).stdout
        return "mf6 " + said.split()[1]
    name = DISTRIBUTIONS.get(tool, tool)
    try:
        return f"{name} {importlib.metadata.version(name)}"
    except importlib.metadata.PackageNotFoundError:
        return ""


def run_blocks(page, result):
    """Runs the page here, in the current folder, and writes to the file `result` what became of it."""
    namespace, printed, missing = {"__name__": "__page__"}, io.StringIO(), []
    namespace["print"] = lambda *words: print(*words, file=printed)  # the page's own lines, without those of the client
    for block in blocks_of(page):
        missing += lacking(block)
        if block.not_run or lacking(block):
            continue
        if block.kind == "sh":
            subprocess.run(["bash", "-euo", "pipefail", "-c", block.text], check=True, stdout=sys.stderr)
            continue
        printed.truncate(printed.seek(0))
        exec(compile(block.text, str(page), "exec"), namespace)
    numbers = {key: float(value) for key, value in namespace.get("results", {}).items()}
    pathlib.Path(result).write_text(json.dumps({"missing": missing, "printed": printed.getvalue(), "results": numbers}))


def differing(expected, printed):
    """The first line of `expected` that was printed otherwise, words and numbers, or nothing."""
    old, new = expected.strip().splitlines(), printed.strip().splitlines()
    for a, b in zip(old, new):
        x, y = [[float(n) for n in NUMBER.findall(line)] for line in (a, b)]
        same_words = NUMBER.sub("#", a).split() == NUMBER.sub("#", b).split()
        if not same_words or any(abs(i - j) > TOLERANCE * abs(i) + ROUNDING for i, j in zip(x, y)):
            return f"the page says '{a.strip()}', printed was '{b.strip()}'"
    return "" if len(old) == len(new) else f"the page has {len(old)} lines, printed were {len(new)}"


def shown(number):
    return "" if number is None else f"{number:.3g}".replace("-", "−")


class Page:
    """One page: run, compared, and its row in the table."""

    def __init__(self, path):
        self.path, self.blocks = path, blocks_of(path)
        self.last = self.blocks[-1]
        self.problem = self.skipped = self.printed = ""
        self.results = {}

    def run(self):
        if self.last.not_run:
            self.skipped = self.last.not_run
            return
        with tempfile.TemporaryDirectory() as folder:
            result = pathlib.Path(folder) / "result.json"
            scratch = pathlib.Path(folder) / "scratch"
            scratch.mkdir()
            command = [sys.executable, "-W", "ignore", __file__, "--one", str(self.path), str(result)]
            ran = subprocess.run(command, cwd=scratch, capture_output=True, text=True, timeout=900)
            if ran.returncode != 0:
                self.problem = "\n".join((ran.stdout + ran.stderr).strip().splitlines()[-12:])
                return
            outcome = json.loads(result.read_text())
        if outcome["missing"]:
            self.skipped = f"{', '.join(dict.fromkeys(outcome['missing']))} is not installed"
            return
        self.printed, self.results = outcome["printed"], outcome["results"]
        if not self.results:
            self.problem = "the last block leaves no `results`"

    def compare(self):
        if self.skipped or self.problem:
            return
        if self.last.prints is None:
            self.problem = "the page does not show what its last block prints"
        else:
            start, end = self.last.prints
            row = self.row()
            in_table = table_in_readme()[3].get(row[0], [])
            self.problem = differing(self.path.read_text(encoding="utf-8")[start:end], self.printed) or differing(
                "\n".join(in_table), "\n".join(row))

    def write(self):
        if self.skipped or self.problem or self.last.prints is None:
            return
        text = self.path.read_text(encoding="utf-8")
        start, end = self.last.prints
        self.path.write_text(text[:start] + self.printed + text[end:], encoding="utf-8")

    def row(self):
        title = self.path.read_text(encoding="utf-8").splitlines()[0].removeprefix("# ")
        versions = ", ".join(filter(None, map(version, self.last.needs)))
        first = f"[{title}]({self.path.name})"
        if self.skipped:
            return [first, "", f"not run: {self.skipped}", *([""] * len(COLUMNS))]
        return [first, versions, self.last.measures, *(shown(self.results.get(column)) for column in COLUMNS)]


def table_of(rows):
    head = ["page", "client", "measured", "before", "energy", "`optimize`", "accuracy", "`--for`"]
    return "\n".join("| " + " | ".join(row) + " |" for row in [head, ["-"] * len(head), *rows]) + "\n"


def table_in_readme():
    """Where the table is in the text, and its rows by their first cells."""
    begin, end = "<!-- written by scripts/clients.sh --write -->\n", "<!-- end -->"
    text = README.read_text(encoding="utf-8")
    start, stop = text.index(begin) + len(begin), text.index(end)
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in text[start:stop].splitlines()[2:]]
    return text, start, stop, {row[0]: row for row in rows}


def write_table(pages):
    """Rows of pages that were not asked for, or could not be run here, stay what they were."""
    text, start, stop, rows = table_in_readme()
    for page in pages:
        row = page.row()
        if not (page.skipped and row[0] in rows):
            rows[row[0]] = row
    README.write_text(text[:start] + table_of(rows.values()) + text[stop:], encoding="utf-8")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--write", action="store_true")
    parser.add_argument("pages", nargs="*", metavar="PAGE")
    arguments = parser.parse_args()
    known = {path.stem: path for path in sorted(HOWTO.glob("*.md")) if path != README}
    unknown = [name for name in arguments.pages if name not in known]
    if unknown:
        parser.error(f"no page '{unknown[0]}'; there are {', '.join(known)}")
    pages = [Page(known[name]) for name in arguments.pages or known]
    for page in pages:
        page.run()
        page.write() if arguments.write else page.compare()
        print(f"{page.path.name}: {page.problem or page.skipped and 'skipped: ' + page.skipped or 'as the page says'}", flush=True)
    print("\n" + table_of([page.row() for page in pages]))
    failed, skipped = sum(bool(p.problem) for p in pages), sum(bool(p.skipped) for p in pages)
    if arguments.write and not failed:
        write_table(pages)
    print(f"{len(pages) - failed - skipped} passed, {failed} failed, {skipped} skipped")
    return failed > 0


if __name__ == "__main__":
    if sys.argv[1:2] == ["--one"]:
        run_blocks(pathlib.Path(sys.argv[2]), os.path.abspath(sys.argv[3]))
        # Clients that end badly after their work (VTK, DEVSIM) are not what is tried here.
        sys.stdout.flush()
        os._exit(0)
    sys.exit(main())

#!/usr/bin/env python3
"""Runs every command of every page, and compares what it prints and draws, and what the prose says of that, with the page.

    pages.py PROGRAM [PAGE …]     all pages, or those with these names or paths; the module of the same build, or on PYTHONPATH
    pages.py --write PROGRAM …    puts what is printed and drawn, and the pages that are made, into docs/
    pages.py --clients PROGRAM …  the pages that need clients, examples/benchmarks, and the table of results: scripts/clients.sh
    pages.py --self-test          plants mistakes and expects each to be found; needs no program

The blocks of a page run from top to bottom in an empty folder with a link `examples` to that of the repository: `bash -euo pipefail` for
sh, one namespace for all blocks of Python. blocks.py has the marks of blocks, prose.py the numbers and options of prose. A
picture docs/figures/NAME is what some page writes as NAME. examples/benchmarks/with_CLIENT.py measures what the row of
docs/howto/CLIENT.md in the table says. Exit 1 and one line a mistake: file:line: what to do.
"""

import argparse
import concurrent.futures
import contextlib
import datetime
import functools
import importlib.metadata
import io
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import warnings

sys.dont_write_bytecode = True
sys.path[:0] = [str(pathlib.Path(__file__).resolve().parent), str(pathlib.Path(__file__).resolve().parent.parent)]
import check_prose  # noqa: E402
import prose  # noqa: E402
import records  # noqa: E402
import verbs  # noqa: E402
from blocks import blocks_in, blocks_of, lacking, runs  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
NUMBERS = ("README.md", "docs/tutorial/", "docs/howto/", "docs/explanation/")  # where numbers of prose are looked up
NOT_RUN = ("docs/internals/",)  # commands of developers
MEASURED = "docs/explanation/measured.md"  # has the table of results
# Pictures that no page can make, and what makes them.
DRAWN_ELSEWHERE = {
    **{f"few-points-{i}.svg": "bench/cgshop.py label, after `temper draw --before`: the outlines are not in the repository" for i in (1, 2, 3)},
    "report.jpg": "Chromium shows a report: scripts/docs/report_picture.py",
    "signs.svg": "drawn by hand: symbols, no numbers",
}
DOTS = {"ring-worst.svg": (429.2, 385.5)}  # where a reader of the page should look, in pixels of the picture
COLUMNS = ("before", "energy", "default", "accuracy", "for")  # of `results`, which a benchmark leaves
HEAD = ["page", "client", "measured", "before", "energy", "`optimize`", "accuracy", "`--for`"]
TABLE = re.compile(r"(?<=<!-- written by scripts/clients.sh --write -->\n)(?:\|.*\n)*(?=<!-- end -->)")
LAST_RUN = re.compile(r"(?<=<!-- last run -->\n).*\n")  # of a page's blocks that scripts/clients.sh alone runs
DISTRIBUTIONS = {"skfem": "scikit-fem"}  # of modules with other names
ORDINARY = {"matplotlib", "meshio", "temper-netcdf"}  # other versions draw otherwise: the run without --clients compares what needs no more than these
TOLERANCE, ROUNDING = 0.02, 1e-9  # the last digits of clients depend on BLAS and the machine
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
# Durations, versions and paths are compared by shape.
SHAPE = re.compile(r"\b\d+(?:\.\d+)? (?:ms|s|min)\b|\b\d+\.\d+\.\d+[\w.+-]*|(?<![\w.])/(?:[\w.+-]+/)+[\w.+-]*")
IMAGE = re.compile(r"!\[[^\]]*\]\(([^()\s]+)\)|<img [^>]*src=\"([^\"]+)\"")

def run_blocks(page, result):
    """Runs the page here, in the current folder, and writes to the file `result` what became of it."""
    namespace, outputs, lacks, error = {"__name__": "__page__", "__file__": page}, [], [], None
    drawn = {}  # file -> what the block that wrote it first needs
    if page.endswith(".md") and any(block.kind == "python" and runs(block) for block in blocks_in(pathlib.Path(page))):
        with contextlib.suppress(ImportError):
            from temper import TemperWarning

            warnings.filterwarnings("error", category=TemperWarning)  # a reader would see it
    sys.path.insert(0, str(pathlib.Path(page).parent))  # as Python does for a script
    for block in blocks_in(pathlib.Path(page)):
        missing = lacking(block) if runs(block) and not error else []
        lacks.append(missing)
        outputs.append(None)
        if not runs(block) or missing or error:
            continue
        printed = io.StringIO()
        # The page's own lines, without those of the client.
        namespace["print"] = lambda *words, printed=printed, **options: print(*words, **{"file": printed, **options})
        try:
            if block.kind == "python":
                exec(compile(block.text, page, "exec"), namespace)
            else:
                run = subprocess.run(["bash", "-euo", "pipefail", "-c", block.text], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                     stderr=subprocess.STDOUT, text=True, errors="replace")  # fmt: skip
                printed.write(run.stdout)
                if run.returncode != 0:
                    error = (block.line, f"exit code {run.returncode}: {run.stdout.strip()[-400:]}")
            outputs[-1] = printed.getvalue()
        except BaseException as problem:  # noqa: BLE001: what a page does must not end the check
            trace, line = problem.__traceback__, block.line
            while trace:
                line = trace.tb_lineno if trace.tb_frame.f_code.co_filename == page else line
                trace = trace.tb_next
            error = (line, f"{type(problem).__name__}: {str(problem)[-400:]}")
        drawn = {**dict.fromkeys(os.listdir(), block.needs), **drawn}
    try:
        results = {key: float(value) for key, value in namespace.get("results", {}).items()}
    except (AttributeError, TypeError, ValueError):
        results = {}
    pathlib.Path(result).write_text(json.dumps({"outputs": outputs, "lacks": lacks, "error": error, "results": results, "drawn": drawn}))


def differing(shown, printed, tolerant=False):
    """The first line of `shown` that was printed otherwise, or nothing."""
    old, new = shown.rstrip().splitlines(), printed.rstrip().splitlines()
    for a, b in zip(old, new):
        a, b = a.rstrip(), b.rstrip()
        x, y = SHAPE.sub("#", a), SHAPE.sub("#", b)
        same = x == y if x == a else x.split() == y.split()
        if not same and tolerant:
            x, y = [[float(n) for n in NUMBER.findall(line)] for line in (a, b)]
            same = NUMBER.sub("#", a).split() == NUMBER.sub("#", b).split() and close(x, y)
        if not same:
            return f"the page has '{a.strip()}', printed is '{b.strip()}'"
    return "" if len(old) == len(new) else f"the page has {len(old)} lines, printed are {len(new)}"


def close(x, y, tolerance=TOLERANCE, rounding=ROUNDING):
    return len(x) == len(y) and all(abs(i - j) <= tolerance * abs(i) + rounding for i, j in zip(x, y))


def same_picture(old, new, suffix):
    """Whether two pictures look the same: SVG to rounding, PNG to slightly other pixels."""
    if old == new:
        return True
    if suffix == ".svg":
        a, b = old.decode(), new.decode()
        return NUMBER.sub("#", a) == NUMBER.sub("#", b) and close(*([float(n) for n in NUMBER.findall(t)] for t in (a, b)), 1e-3, 0.01)
    import matplotlib.image

    a, b = (matplotlib.image.imread(io.BytesIO(picture)) for picture in (old, new))
    return a.shape == b.shape and float(abs(a - b).mean()) < 0.01


def dotted(name, picture):
    """A picture of temper draw, with a dot if a page wants one."""
    if name not in DOTS:
        return picture
    x, y = DOTS[name]
    dot = f'<circle cx="{x}" cy="{y}" r="8" fill="#c83a00" stroke="#ffffff" stroke-width="3"/>\n'
    return picture.replace(b"</svg>", dot.encode() + b"</svg>")


def version(tool):
    """Of a module, or of mf6; nothing for what is temper's own."""
    if tool == "program mf6":
        return "mf6 " + subprocess.run(["mf6", "--version"], capture_output=True, text=True).stdout.split()[1]
    tool = tool.rpartition(" ")[2]
    name = DISTRIBUTIONS.get(tool, tool)
    try:
        return f"{name} {importlib.metadata.version(name)}"
    except importlib.metadata.PackageNotFoundError:
        return ""


class Page:
    def __init__(self, path, root):
        self.path, self.root, self.name = path, root, path.relative_to(root).as_posix()
        self.text = path.read_text(encoding="utf-8")
        self.blocks = [] if self.name.startswith(NOT_RUN) else blocks_in(path)
        self.howto = root / "docs/howto" / f"{path.stem.removeprefix('with_').replace('_', '-')}.md"  # of a benchmark, or itself
        figures = [(path.parent / (match[1] or match[2])).resolve() for match in IMAGE.finditer(self.text)]
        self.figures = [figure.name for figure in figures if figure.parent == root / "docs" / "figures"]
        self.names = {self.name, path.stem, self.howto.stem}
        self.outputs, self.lacks, self.error, self.results = [None] * len(self.blocks), [[]] * len(self.blocks), None, {}
        self.pictures, self.drawn, self.seconds = {}, {}, 0.0  # what it wrote, and what that needs; how long it took

    def run(self, environment, wanted, seconds):
        if not any(map(runs, self.blocks)):
            return
        with tempfile.TemporaryDirectory() as folder:
            scratch, result = pathlib.Path(folder, "page"), pathlib.Path(folder, "result.json")
            scratch.mkdir()
            (scratch / "examples").symlink_to(self.root / "examples")
            command = [sys.executable, "-W", "ignore", __file__, "--one", str(self.path), str(result)]
            start = time.monotonic()
            try:
                run = subprocess.run(command, cwd=scratch, env=environment, capture_output=True, text=True, timeout=seconds)
                said = json.loads(result.read_text()) if result.exists() else {"error": (1, f"ended: {(run.stdout + run.stderr)[-400:]}")}
            except subprocess.TimeoutExpired:
                said = {"error": (1, f"runs for more than {seconds} s")}
            self.__dict__.update(said, seconds=time.monotonic() - start)
            self.pictures = {name: dotted(name, (scratch / name).read_bytes()) for name in wanted if (scratch / name).is_file()}

    def skipped(self):
        return list(dict.fromkeys(name for names in self.lacks for name in names))

    def clients(self):
        """What scripts/clients.sh installs for the page."""
        needs = dict.fromkeys(name for block in self.blocks for name in block.needs)
        return [name for name in needs if name not in ORDINARY] if self.path.suffix == ".md" else []

    def last_run(self, write):
        """What is wrong with the line that says when the clients of the page last ran; or writes it."""
        if not self.clients():
            return
        said = LAST_RUN.search(self.text)
        if write and said and not self.error and not self.skipped():
            versions = ", ".join(f"`{each}`" for each in dict.fromkeys(filter(None, map(version, self.clients()))))
            line = f"`scripts/clients.sh` last ran this page on {datetime.date.today()}, with {versions}.\n"
            self.text = self.text[: said.start()] + line + self.text[said.end() :]
            self.path.write_text(self.text, encoding="utf-8")
            self.blocks = blocks_of(self.text)
        elif not said or not re.search(r"\d{4}-\d\d-\d\d", said[0]):
            yield 1, ("does not say when its blocks with clients last ran: put <!-- last run --> and an empty line at its end, and run "
                      "scripts/clients.sh --write")

    def compare(self, write):
        """What is wrong with the blocks; or writes what they print into the page."""
        found = [(block.line, block.problem) for block in self.blocks if block.problem]
        if self.error:
            found.append(tuple(self.error))
        text = self.text
        for block, printed in reversed(list(zip(self.blocks, self.outputs))):
            if block.prints is None or printed is None or self.error and self.error[0] == block.line:
                continue
            start, end = block.prints
            difference = differing(self.text[start:end], printed, tolerant=bool({*block.needs} - {"temper-netcdf"}))
            if difference and write:
                text = text[:start] + printed.rstrip("\n") + "\n" * bool(printed.strip()) + text[end:]
            elif difference:
                found.append((block.line, f"{difference}: correct the page, or run scripts/docs/pages.py --write"))
        if text != self.text:
            self.path.write_text(text, encoding="utf-8")
            self.text, self.blocks = text, blocks_of(text)
        return found

    def known_numbers(self):
        """Of the commands and of what they print; the page shows what those print that lack a client."""
        commands = [block.text for block in self.blocks if block.kind in ("sh", "python")]
        shown = [self.text[slice(*block.prints)] for block in self.blocks if block.prints and not block.not_run]
        return prose.numbers_in("\n".join([*commands, *shown, *filter(None, self.outputs)]))

    def row(self):
        """Of the table of clients."""
        first = f"[{self.howto.read_text(encoding='utf-8').splitlines()[0].removeprefix('# ')}](../howto/{self.howto.name})"
        last = next(block for block in reversed(self.blocks) if block.needs)
        cells = (self.results.get(column) for column in COLUMNS)
        cells = (0 if number and abs(number) < ROUNDING else number for number in cells)
        versions = ", ".join(filter(None, map(version, last.needs)))
        return [first, versions, last.measures, *("" if number is None else f"{number:.3g}".replace("-", "−") for number in cells)]


class Check:
    """All pages of a repository, as one program runs them."""

    def __init__(self, root, program, write=False, clients=False):
        self.root, self.write, self.clients = root, write, clients
        self.program, self.problems = pathlib.Path(program).resolve(), []
        module = self.program.parents[2] / "python"
        paths = [str(module)] if (module / "temper").is_dir() else []
        paths += filter(None, os.environ.get("PYTHONPATH", "").split(os.pathsep))
        sys.path[1:1] = paths
        folders = [str(self.program.parent), str(pathlib.Path(sys.executable).parent), os.environ["PATH"]]
        self.environment = {
            **os.environ, "PATH": os.pathsep.join(folders), "PYTHONPATH": os.pathsep.join(paths), "PYTHONDONTWRITEBYTECODE": "1",
            "LC_ALL": "C.UTF-8", "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1",
            "MPLBACKEND": "agg", "MATPLOTLIBRC": str(pathlib.Path(__file__).with_name("matplotlibrc")), "SOURCE_DATE_EPOCH": "0",
        }  # fmt: skip
        self.options = self.options_of_verbs()
        if (root / "docs/reference/cli").is_dir():
            self.verb_pages()
        paths = [root / "README.md", *sorted((root / "docs").rglob("*.md"))]
        benchmarks = sorted((root / "examples/benchmarks").glob("with_*.py"))
        scripts = "".join(file.read_text(encoding="utf-8") for file in benchmarks)
        self.drawn_with_clients = set(re.findall(r'"([\w-]+\.(?:svg|png))"', scripts))
        paths += benchmarks if clients else []
        self.pages = [Page(path, root) for path in paths if path.exists()]
        self.table = (root / MEASURED).read_text(encoding="utf-8") if (root / MEASURED).exists() else ""

    def say(self, page, line, why):
        self.problems.append((page, line, " ".join(why.split())))

    def help(self, *arguments):
        return subprocess.run([self.program, *arguments], check=True, capture_output=True, text=True, env=self.environment).stdout

    def options_of_verbs(self):
        """{verb: its options}"""
        def flags(text):
            return {flag for line in re.findall(r"^  -.*?(?=  |$)", text, re.M) for flag in prose.OPTION.findall(line)}

        top = self.help("--help")
        verbs = re.findall(r"^  ([a-z]+(?: [a-z]+)?)  ", re.search(r"^Verbs:\n(.*?)(?:\n\n|\Z)", top, re.M | re.S)[1], re.M)
        return {"": flags(top), **{verb: {"--help-all"} | flags(top) | flags(self.help(*verb.split(), "--help-all")) for verb in verbs}}

    @functools.cache
    def settings(self):
        """Names for --set."""
        return set(re.findall(r"^  ([a-z]\w*)=", self.help("optimize", "--help-all") + self.help("optimize", "--help-paper"), re.M))

    def verb_pages(self):
        """Each verb has a page, with the marks where the site has its help; and the help is plain English."""
        for verb in filter(None, self.options):
            page = self.root / "docs/reference/cli" / f"{verb.replace(' ', '-')}.md"
            if self.write and not page.exists():
                page.write_text(verbs.PAGE.format(verb), encoding="utf-8")
            text = page.read_text(encoding="utf-8") if page.exists() else ""
            for mark in verbs.MARK.finditer(verbs.PAGE.format(verb)):
                if mark[0] + "\n" not in text:
                    self.say(page.relative_to(self.root).as_posix(), 1, f"has no mark {mark[0]}: put it there")
        for sentence in check_prose.wrong_in_help(self.help(*verb.split(), "--help-all") for verb in self.options if verb):
            self.say("docs/reference/cli", 1, f"the help says what must be read twice: {sentence}")

    def fill(self, chosen):
        """What the site takes from the program, below the marks of pages, is there."""
        os.environ["PATH"] = self.environment["PATH"]
        for page in chosen:
            try:
                records.filled(verbs.filled(page.text))
            except (KeyError, subprocess.CalledProcessError) as error:
                self.say(page.name, 1, f"has a mark of something that the program lacks: {error}")

    def run(self, chosen):
        wanted = {name for page in self.pages for name in page.figures}
        jobs = max(1, min(len(chosen), int(os.environ.get("TEMPER_TEST_JOBS", os.cpu_count()))))
        # First what has most to do.
        order = sorted(chosen, key=lambda page: -sum(map(runs, page.blocks)))
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            list(pool.map(lambda page: page.run(self.environment, wanted, 900 if self.clients else 300), order))
        self.fill(chosen)
        if self.clients:
            for page in chosen:
                page.pictures = {name: picture for name, picture in page.pictures.items()
                                 if not (page.drawn.get(name) and ORDINARY.issuperset(page.drawn[name]))}  # fmt: skip
            self.compare_table(chosen)
        for page in chosen:
            if page.name == "docs/reference/names.md":
                self.check_names()
            for line, why in [*page.compare(self.write), *page.last_run(self.write and self.clients)]:
                self.say(page.name, line, why)
            commands = [(block.line, block.text) for block in page.blocks if block.kind == "sh"]
            found = list(prose.wrong_options(page.text, commands, self.options, self.settings))
            if page.name.startswith(NUMBERS):
                row = re.findall(rf"^\| \[[^]]*\]\((?:\.\./howto/)?{page.path.name}\).*", self.table, re.M)  # a page may say what its benchmark measured
                found += prose.wrong_numbers(page.text, page.known_numbers() | prose.numbers_in("\n".join(row)))
            for line, why in found:
                self.say(page.name, line, why)
        self.compare_pictures(chosen)

    def compare_pictures(self, chosen):
        for page in chosen:
            for name in page.figures:
                line = page.text.count("\n", 0, page.text.index(f"figures/{name}")) + 1
                file = self.root / "docs/figures" / name
                made = [other.pictures[name] for other in [page, *chosen] if name in other.pictures]
                elsewhere = name in DRAWN_ELSEWHERE or name in self.drawn_with_clients
                ran = not any(other.skipped() or other.error for other in chosen if name in other.figures)
                if not made and not elsewhere and len(chosen) == len(self.pages) and ran:
                    self.say(page.name, line, f"no page writes {name}: add the command that makes it, or a line to DRAWN_ELSEWHERE")
                elif made and name in DRAWN_ELSEWHERE:
                    self.say(page.name, line, f"a page writes {name}: remove its line in DRAWN_ELSEWHERE")
                elif made and self.write and not (file.exists() and same_picture(file.read_bytes(), made[0], file.suffix)):
                    file.write_bytes(made[0])
                elif made and not (file.exists() and same_picture(file.read_bytes(), made[0], file.suffix)):
                    self.say(page.name, line, f"docs/figures/{name} is not what the page draws: run scripts/docs/pages.py --write")
        shown = {name for page in self.pages for name in page.figures}
        for file in sorted((self.root / "docs/figures").glob("*")) if len(chosen) == len(self.pages) else []:
            if file.name not in shown:
                self.say(f"docs/figures/{file.name}", 1, "no page shows this picture: remove it")

    def check_names(self):
        try:
            import names

            names.check(self.program)
        except Exception as error:  # noqa: BLE001: the tables differ, or the module is missing
            self.say("docs/reference/names.md", 1, f"scripts/docs/names.py: {type(error).__name__}: {error}")

    def compare_table(self, chosen):
        """Compares the rows of pages that were run; all others stay what they are."""
        measured = self.root / MEASURED
        text = measured.read_text(encoding="utf-8")
        table = TABLE.search(text)
        if not table:
            return
        rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in table[0].splitlines()[2:]]
        rows = {row[0].partition("](")[2]: row for row in rows}  # by its page
        for page in chosen:
            if page.skipped() or page.error or not page.results:
                continue
            row = page.row()
            link = row[0].partition("](")[2]
            difference = differing("\n".join(rows.get(link, [])), "\n".join(row), tolerant=True)
            if difference and not self.write:
                self.say(MEASURED, 1, f"row of {page.name}: {difference}")
            rows[link] = row
        made = "\n".join("| " + " | ".join(row) + " |" for row in [HEAD, ["-"] * len(HEAD), *rows.values()]) + "\n"
        if self.write:
            self.table = text[: table.start()] + made + text[table.end() :]
            measured.write_text(self.table, encoding="utf-8")

    def report(self, chosen, start):
        for page, line, why in sorted(self.problems):
            print(f"{page}:{line}: {why}")
        for page in (page for page in chosen if page.skipped()):
            print(f"skipped: {page.name}: {sum(map(bool, page.lacks))} of {len(page.blocks)} blocks need {', '.join(page.skipped())}")
        slowest = max(chosen, key=lambda page: page.seconds)
        blocks = [(block, printed, lacks) for page in chosen for block, printed, lacks in zip(page.blocks, page.outputs, page.lacks)]
        ran = sum(printed is not None for _, printed, _ in blocks)
        skipped = sum(bool(lacks) for _, _, lacks in blocks)
        clients = sorted({name for _, _, lacks in blocks for name in lacks})
        marked = sum(bool(block.not_run) for block, _, _ in blocks)
        print(f"pages: {len(self.problems)} mistakes in {len(chosen)} pages; {ran} blocks ran, {skipped} skipped, {marked} are text, "
              f"{sum(len(page.pictures) for page in chosen)} pictures, {time.monotonic() - start:.0f} s ({slowest.path.stem} {slowest.seconds:.0f})"
              + (f"; not installed: {', '.join(clients)}" if clients else ""))  # fmt: skip
        return len(self.problems) > 0


FAKE = """#!/bin/sh
case "$*" in
  --help) printf 'Verbs:\\n  check  judge a mesh\\n  draw   draw a mesh\\n\\nOptions:\\n  -h, --help  this\\n  --for T  so\\n' ;;
  "check --help"|"check --help-all") printf 'Judges a mesh. Then ends.\\n\\nUsage: temper check IN\\n\\nOptions:\\n  --json  as JSON\\n  --set NAME=VALUE\\n' ;;
  "optimize --help-all"|"optimize --help-paper") echo "  star=N  the star" ;;
  "draw --help"|"draw --help-all") printf 'Draws a mesh.\\n\\nUsage: temper draw IN\\n\\nOptions:\\n  -o, --output FILE  there\\n' ;;
  "check a") echo "12 of 40 triangles are bad, 0.296 is least, in 0.$$ s" ;;
  "draw a -o "*) echo "<svg>1.5</svg>" >"$4" ;;
  *) echo "unknown: $*" >&2; exit 2 ;;
esac
"""
GOOD = """# A mesh

Of 40 triangles, 30 % have 0.3 as their least; 25 is right and so are 3.33 and 3.77. `--json` helps, and `--set star=1`. ![12 bad](../figures/a.svg)

<!-- given: 25 (a reason), 3.33 = 40 / 12 -->

```sh
temper check a
temper draw a -o a.svg
```

```text
12 of 40 triangles are bad, 0.296 is least, in 0.01 s
```
"""
TABLE_OF_CLIENTS = "# All\n\n<!-- written by scripts/clients.sh --write -->\n<!-- end -->\n"
BENCHMARK = """# runs with: json; measures: much
results = {"before": 3.77}
"""


def self_test():
    """Plants each mistake into pages without any, and expects it to be found in its line."""
    mistakes = {
        "a stale number in prose": ("page", "Of 40", "Of 41", 3, "41: no command"),
        "a stale number in a printed block": ("page", "12 of 40 triangles", "13 of 40 triangles", 7, "13 of 40"),
        "a stale picture": ("figure", "1.5", "1.7", 3, "is not what the page draws"),
        "a picture that nothing makes": ("page", "temper draw a -o a.svg", "temper draw a -o b.svg", 3, "no page writes a.svg"),
        "a removed option in a command": ("page", "check a", "check a --fast", 7, "unknown: check a --fast"),
        "the same before it is run": ("page", "check a", "check a --fast", 7, "temper check has no option --fast"),
        "a removed option in prose": ("page", "`--json`", "`--jsn`", 3, "has no option --jsn"),
        "a removed option for --set": ("page", "star=1", "stra=1", 3, "--set stra"),
        "text that nothing prints": ("page", "```text", "so:\n\n```text", 14, "text that no command prints"),
        "a program that is not run": ("page", "```sh", "```console", 7, "a block of console is not run"),
        "a page of a verb without its mark": ("verb", "<!-- options of temper check -->\n", "", 1, "has no mark"),
        "a mark of a verb that is not there": ("page", "```text", "<!-- options of temper chek -->\n\n```text", 1, "the program lacks"),
        "help that is not plain": ("program", "as JSON", "as JSON. The format is the one of the schema.", 1, "read twice"),
        "a number that no benchmark measures": ("page", "and 3.77", "and 3.78", 3, "3.78: no command"),
        "a stale row of the table": ("table", "| 3.77 |", "| 4.77 |", 1, "the page has '4.77'"),
        "a benchmark that fails": ("benchmark", "3.77", "x", 2, "NameError"),
        "a number that is given for nothing": ("page", "25 is right", "it is right", 5, "remove it"),
        "a wrong expression": ("page", "40 / 12", "12 / 40", 5, "which is 0.3"),
        "a page with a client that does not say when": (
            "page", "# A mesh\n", "# A mesh\n\n<!-- runs with: json -->\n```python\n```\n", 1, "last ran"),
    }
    passed = "## 3.2 In 2023\n\n`11`, [12](a), $13$, 64-bit x86-64, C++20, UTF-16, 2D, Section 5.2, d = 14, 1 − d/ℓ, 19 May 2025, 7.\n"
    assert not list(prose.wrong_numbers(passed, set())), list(prose.wrong_numbers(passed, set()))
    looked_up = ["480", "−0.22", "1e-6", "10⁵", "2·10⁸", "100,000", "20–30", "| 71 |", "90°", "in 2000 cells", "12 × faster"]
    assert all(list(prose.wrong_numbers(f"so {number}, and\n", set())) for number in looked_up)
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder).resolve()
        files = {"page": "docs/howto/a.md", "table": MEASURED, "program": "build/apps/temper/temper", "verb": "docs/reference/cli/check.md",
                 "figure": "docs/figures/a.svg", "benchmark": "examples/benchmarks/with_a.py"}  # fmt: skip
        files = {name: root / file for name, file in files.items()}
        program = files["program"]
        for file in (root / "examples/x", *files.values()):
            file.parent.mkdir(parents=True, exist_ok=True)
        program.write_text(FAKE)
        program.chmod(0o755)

        def found(write=False):
            check = Check(root, program, write, clients=True)
            check.run(check.pages)
            return check.problems

        for name, text in (("page", GOOD), ("table", TABLE_OF_CLIENTS), ("benchmark", BENCHMARK)):
            files[name].write_text(text)
        assert not found(write=True) and not found(), found()
        good = {name: file.read_text() for name, file in files.items()}
        for what, (name, old, new, line, why) in mistakes.items():
            assert old in good[name], what
            files[name].write_text(good[name].replace(old, new, 1))
            problems = found()
            assert any(at == line and why in said for _, at, said in problems), f"not found: {what}: {problems}"
            files[name].write_text(good[name])
            print(f"found: {what}: {next(said for _, at, said in problems if why in said)}")
        files["figure"].write_text("")
        files["page"].write_text(GOOD.replace("12 of 40", "13 of 40"))
        assert not found(write=True) and re.sub(r"0\.\d+ s", "0.01 s", files["page"].read_text()) == GOOD
        assert files["figure"].read_text() == good["figure"]
    print(f"pages: {len(mistakes)} mistakes planted and found")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--clients", action="store_true")
    parser.add_argument("program", metavar="PROGRAM")
    parser.add_argument("pages", nargs="*", metavar="PAGE")
    arguments = parser.parse_intermixed_args()
    start = time.monotonic()
    check = Check(ROOT, arguments.program, arguments.write, arguments.clients)
    chosen = [page for page in check.pages if not arguments.clients or any(block.needs for block in page.blocks)]
    for name in arguments.pages:
        if not any(name in page.names for page in chosen):
            parser.error(f"no page '{name}'")
    chosen = [page for page in chosen if not arguments.pages or page.names & set(arguments.pages)]
    check.run(chosen)
    return check.report(chosen, start)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--one"]:
        run_blocks(*sys.argv[2:])
        # Clients that end badly after their work (VTK, DEVSIM) are not what is tried here.
        sys.stdout.flush()
        os._exit(0)
    sys.exit(self_test() if sys.argv[1:] == ["--self-test"] else main())

#!/usr/bin/env python3
"""Checks that every #include keeps to the layers, and that the core stays what it promises to be.

    scripts/check_layers.py [ROOT]       exit 1 and one line a violation: file:line: why
    scripts/check_layers.py --picture    draws the layers anew in docs/internals/architecture.md
    scripts/check_layers.py --self-test  plants violations in a scratch tree and expects each to be found

The table below is the architecture, and docs/internals/architecture.md shows it: the picture there must be that of the
table, and every folder of src/ must be named there. A public header belongs to the layer it speaks for; a file of a
layer may include its own layer and the layers its row names, nothing else. The core includes the standard C++
headers alone, and of those none that prints, opens files, starts threads or needs RTTI.

A subfolder of a layer, of the program or of Python is a room, and the files beside its rooms are one more. No two rooms
may include each other.
"""

import pathlib
import re
import sys
import tempfile

# layer: the layers it may include, besides itself.
_BELOW = ["base", "geometry", "mesh"]
LAYERS = {
    "base": [],
    "geometry": ["base"],
    "mesh": ["base", "geometry"],
    "projection": _BELOW,
    "location": _BELOW,
    "size": _BELOW + ["location"],
    "topology": _BELOW,
    "energy": _BELOW,
    "regularity": _BELOW + ["topology", "energy"],
    "feasibility": _BELOW + ["size", "topology", "energy", "regularity"],
    "optimize": _BELOW + ["location", "size", "topology", "energy", "regularity", "feasibility"],
    # These layers look at meshes. They do not depend on the optimization.
    "quality": _BELOW + ["size", "topology", "energy", "regularity", "feasibility"],
    "explain": _BELOW + ["topology", "energy", "regularity", "feasibility", "quality"],
    "dec": _BELOW + ["topology", "energy", "regularity"],
    "transfer": _BELOW + ["location", "dec"],
    "draw": _BELOW + ["topology", "energy", "regularity", "quality", "dec"],
    "generate": _BELOW + ["topology", "energy", "regularity", "projection"],
    "mesher": _BELOW + ["size", "topology", "energy", "regularity", "feasibility", "optimize", "generate", "projection"],
    # The tables of reports, for JSON, Python, npm and the schema.
    "report": _BELOW + ["size", "energy", "feasibility", "optimize", "quality", "explain", "dec"],
    # A library of its own, with the rules of the core: meshes of tetrahedra, on tables, reports and linear programs.
    "tets": _BELOW + ["regularity", "feasibility", "quality", "explain", "dec", "transfer", "draw", "optimize", "report"],
    # The same for meshes of curved surfaces.
    "surfaces": _BELOW + ["location", "topology", "energy", "regularity", "feasibility", "quality", "explain", "dec", "draw", "optimize", "report"],
    # A library of its own: sees the public headers of the core and of tets, and no other folder of src/.
    "io": _BELOW + ["projection", "location", "size", "feasibility", "quality", "dec", "transfer", "mesher", "tets", "surfaces"],
    "lp": _BELOW + ["feasibility"],
    "tbb": ["base"],
    "mpi": ["base"],
    "errors": _BELOW + ["location", "energy", "regularity", "quality", "dec", "surfaces", "tets"],
    "solvers": _BELOW + ["size", "energy", "regularity", "feasibility", "optimize", "quality", "lp", "errors", "io", "tets", "surfaces"],
    "build_info": ["base", "io"],
}
LIBRARIES = {"tets", "surfaces", "io", "lp", "tbb", "mpi", "errors", "solvers", "build_info"}  # of their own
CORE = set(LAYERS) - LIBRARIES | {"tets", "surfaces"}  # what keeps the rules of the core

# Public headers whose name is not that of their layer.
HEADER_LAYER = {name: "base" for name in ["cell_kinds", "ids", "vec", "space", "error", "progress", "executor", "instruction_set", "outline", "read_number", "report", "suggest", "utf8", "version"]} | {"temper": "solvers", "criterion": "regularity", "trace": "optimize", "optimize_table": "optimize", "surface_errors": "errors", "optimizer": "optimize", "necessity": "feasibility", "connectivity": "feasibility", "convex": "feasibility", "tbb_executor": "tbb", "mpi_communicator": "mpi", "cells": "dec", "columns": "dec", "tensor": "mesh", "discretization_error": "mesh", "solver_measures": "size", "dec_io": "io", "certificate_io": "io", "file_cures": "io", "html": "io", "path": "io", "faces": "mesh"}

STANDARD = set("""
algorithm array atomic bit bitset cassert cctype cerrno cfenv cfloat charconv chrono cinttypes climits cmath
compare complex concepts cstdarg cstddef cstdint cstdio cstdlib cstring ctime cuchar cwchar cwctype deque
forward_list functional initializer_list iterator limits list map memory memory_resource new numbers numeric
optional queue random ranges ratio scoped_allocator set source_location span stack string string_view
tuple type_traits unordered_map unordered_set utility valarray variant vector version
""".split())
# Standard, but not for the core: streams, files, formatting (550 KB in the browser), threads, RTTI.
BARRED = set("""
any barrier condition_variable coroutine exception filesystem format fstream future iomanip ios iosfwd iostream
istream latch locale mutex ostream print regex semaphore shared_mutex sstream stdexcept stop_token streambuf
strstream syncstream system_error thread typeindex typeinfo
""".split())
# The one file that knows of the processor's registers, and the files that may use a compiler's own words.
REGISTERS = ("src/base/compiler.hpp", ("immintrin.h", "intrin.h"))
COMPILERS = (REGISTERS[0], "src/base/pack.hpp")
BUILT_IN = re.compile(r"__builtin_\w+|__attribute__|__declspec|__int128|gnu::vector_size|\b__asm|(=|return|\(|,)\s*\(\{")
# Headers of one operating system: for the rooms `system`.
SYSTEM_HEADER = re.compile(r"^((sys|net|netinet|arpa)/.*|aclapi|direct|dirent|dlfcn|fcntl|io|malloc|poll|process|pthread|shellapi|signal|spawn|"
                           r"strings|termios|unistd|windows)\.h$")
# Calls that print, open files or end the program; snprintf into memory is fine.
BARRED_CALL = re.compile(r"\bstd::(cout|cerr|clog|fopen|printf|fprintf|puts|fputs|fwrite|exit|quick_exit)\b")

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def layer_of_header(header):
    """The layer of "temper/NAME.hpp", or None when there is no such layer."""
    name = pathlib.PurePath(header).stem
    if "/tets/" in header:
        return name if name in ("io", "errors") else "tets"
    return HEADER_LAYER.get(name, name if name in LAYERS else None)


def included_layer(header):
    """The layer that a quoted include reaches, or None when it reaches none."""
    first, _, rest = header.partition("/")
    return layer_of_header(header) if first == "temper" else (first if rest and first in LAYERS else None)


def check_include(layer, quoted, header):
    """Why a file of `layer` may not include `header`, or None. `layer` "app" is the program."""
    if not quoted:
        if layer not in CORE or header in STANDARD:
            return None
        why = "the core must not use it" if header in BARRED else "the core uses standard C++ headers alone"
        return f"<{header}>: {why}"
    if layer == "app":
        private = header.partition("/")[0] in LAYERS and "/" in header
        return f'"{header}": the program sees public headers alone' if private else None
    reached = included_layer(header)
    if reached is None:
        return f'"{header}": neither a public header nor "LAYER/file.hpp"'
    if reached == layer:
        return None
    if reached not in LAYERS[layer]:
        return f'"{header}": {layer} must not see {reached}'
    if layer == "io" and not header.startswith("temper/"):
        return f'"{header}": io sees the public headers of the core alone'
    return None


def check_file(path, layer):
    """(line, why) of every violation in one file."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        why = check_include(layer, match[1] == '"', match[2]) if match else None
        if match and path.as_posix().endswith("/" + REGISTERS[0]) and match[2] in REGISTERS[1]:
            why = None
        if why is None and match and SYSTEM_HEADER.match(match[2]) and path.parent.name != "system":
            why = f"<{match[2]}>: a header of one operating system; only folders called system include such headers"
        if why is None and not path.as_posix().endswith(COMPILERS) and (word := BUILT_IN.search(line.partition("//")[0])):
            why = f"{word[0]}: not every compiler has it; {COMPILERS[0]} has what differs"
        if why is None and layer in CORE and (call := BARRED_CALL.search(line)):
            why = f"{call[0]}: the core neither prints, opens files nor exits"
        if why:
            yield number, why


def sources(root):
    """(file, its layer) of every source; a layer of None means that the file belongs to none."""
    for path in sorted(p for p in root.glob("**/*") if p.suffix in (".hpp", ".cpp", ".h", ".inc")):
        parts = path.relative_to(root).parts
        if parts[0] == "src":
            yield path, parts[1] if parts[1] in LAYERS else None
        elif parts[:2] == ("include", "temper"):
            yield path, layer_of_header("/".join(parts[1:]))
        elif parts[0] == "apps":
            yield path, "app"


# Layers whose rooms still include each other.
NOT_YET = set()


def house_and_room(path):
    """Of src/optimize/step/a.hpp: the house src/optimize, and the room in it, step. A file beside the rooms: ""."""
    parts = path.parts
    depth = 1 if parts[0] == "python" else 2
    return "/".join(parts[:depth]), parts[depth] if len(parts) > depth + 1 else ""


def check_rooms(root):
    """Two rooms of one house that include each other: a line of each side."""
    first = {}  # (house, from, to): the first include that goes that way
    files = [p.relative_to(root) for folder in ("src", "apps", "python") for p in (root / folder).glob("**/*.?pp")]
    for path in sorted(files):
        house, room = house_and_room(path)
        for number, line in enumerate((root / path).read_text(encoding="utf-8").splitlines(), 1):
            match = INCLUDE.match(line)
            if not match or match[1] == "<" or house.removeprefix("src/") in NOT_YET:
                continue
            for base in (path.parent, pathlib.Path("src"), pathlib.Path(house)):
                reached = base / match[2]
                if (root / reached).is_file() and house_and_room(reached)[0] == house:
                    first.setdefault((house, room, house_and_room(reached)[1]), f"{path}:{number}: {line.strip()}")
                    break
    for (house, a, b), line in sorted(first.items()):
        if a < b and (house, b, a) in first:
            yield f"{line}: {house}/{a} and {house}/{b} include each other; see {first[house, b, a]}".replace("/ ", " ")


PAGE = "docs/internals/architecture.md"
PICTURE = re.compile(r"(<!-- layers: drawn by scripts/check_layers.py --picture -->\n)```text\n.*?```\n", re.S)


def picture():
    """The layers as a wall."""
    width = 100  # two more with the edges
    row = {}
    for layer, below in LAYERS.items():  # the table goes upwards
        row[layer] = max((row[b] + 1 for b in below), default=0)
    rows = [["apps/temper", "python", "gallery"]]
    for height in range(max(row.values()), -1, -1):
        rows.append([layer + ("*" if layer in LIBRARIES else "") for layer in LAYERS if row[layer] == height])
    lines = ["+" + "-" * width + "+"]
    for bricks in rows:
        wall = "|".join(brick.center(width // len(bricks)) for brick in bricks)
        lines += ["|" + wall.center(width) + "|", "+" + "-" * width + "+"]
    lines += ["", "* a library of its own; all others are the core"]
    return "\n".join(lines) + "\n"


def check_page(root):
    """What docs/internals/architecture.md does not show as it is."""
    page = (root / PAGE).read_text(encoding="utf-8") if (root / PAGE).exists() else ""
    drawn = PICTURE.search(page)
    if drawn is None or drawn[0] != f"{drawn[1]}```text\n{picture()}```\n":
        yield f"{PAGE}:1: the picture of the layers is not that of scripts/check_layers.py; its --picture draws it anew"
    folders = [*(root / "src").glob("**/"), *(root / "apps").glob("*/**/")]
    for folder in sorted(p for p in folders if p != root / "src"):
        name = folder.relative_to(root).as_posix()
        if f"`{name}`" not in page:
            yield f"{PAGE}:1: does not say what is in `{name}`"


def check(root):
    """All violations, and how many files were read."""
    violations, files = [], 0
    for path, layer in sources(root):
        files += 1
        name = path.relative_to(root)
        if layer is None:
            violations.append(f"{name}:1: belongs to no layer of scripts/check_layers.py")
            continue
        violations += [f"{name}:{number}: {why}" for number, why in check_file(path, layer)]
    return violations + list(check_rooms(root)), files


def self_test():
    """Each planted line must be found, each allowed one must pass."""
    planted = [  # file, line, is it a violation?
        ("src/geometry/a.cpp", '#include "mesh/walk.hpp"', True),
        ("src/geometry/a.cpp", '#include "temper/mesh.hpp"', True),
        ("src/quality/a.cpp", '#include "temper/optimize.hpp"', True),
        ("src/draw/a.cpp", '#include "optimize/stages/driver.hpp"', True),
        ("src/mesh/a.cpp", '#include "temper/io.hpp"', True),
        ("src/energy/a.cpp", '#include "topology/flip.hpp"', True),
        ("src/mesh/a.cpp", "#include <iostream>", True),
        ("src/base/a.cpp", "  #  include <thread>", True),
        ("src/mesh/a.cpp", "#include <pugixml.hpp>", True),
        ("src/mesh/a.cpp", "#include <math.h>", True),
        ("src/optimize/a.cpp", '  std::printf("%d", 1);', True),
        ("src/io/a.cpp", '#include "mesh/walk.hpp"', True),
        ("src/io/a.cpp", '#include "temper/optimize.hpp"', True),
        ("src/elsewhere/a.cpp", "#include <vector>", True),
        ("include/temper/mesh.hpp", '#include "temper/energy.hpp"', True),
        ("include/temper/elsewhere.hpp", "#include <vector>", True),
        ("apps/temper/a.cpp", '#include "mesh/walk.hpp"', True),
        ("src/mesh/a.cpp", '#include "geometry/power.hpp"', False),
        ("src/mesh/a.cpp", '#include "mesh/walk.hpp"', False),
        ("src/optimize/a.cpp", '#include "regularity/restore.hpp"', False),
        ("src/base/a.cpp", "#include <vector>", False),
        ("src/base/a.cpp", "// #include <iostream> would be wrong here", False),
        ("src/io/a.cpp", "#include <pugixml.hpp>", False),
        ("src/io/a.cpp", '#include "temper/mesh.hpp"', False),
        ("include/temper/mesh.hpp", '#include "temper/detail/ids.hpp"', False),
        ("apps/temper/a.cpp", '#include "temper/optimize.hpp"', False),
        ("apps/temper/a.cpp", '#include "commands.hpp"', False),
        ("src/base/compiler.hpp", "#include <immintrin.h>", False),
        ("src/base/compiler.hpp", "  __builtin_prefetch(p);", False),
        ("src/base/rng.hpp", "  return __builtin_popcount(x);", True),
        ("src/io/a.cpp", "__attribute__((weak)) void f();", True),
        ("src/io/a.cpp", "  const int x = ({ f(); });", True),
        ("src/io/disk/a.cpp", "#include <unistd.h>", True),
        ("src/io/system/a.cpp", "#include <unistd.h>", False),
        ("apps/temper/a.cpp", "#include <sys/wait.h>", True),
        ("apps/temper/system/a.cpp", "#include <windows.h>", False),
        ("src/base/other.hpp", "#include <immintrin.h>", True),
    ]
    rooms = [  # two files that include each other, is it a violation?
        ("src/mesh/a/x.hpp", "src/mesh/b/y.hpp", True),
        ("src/mesh/a/x.hpp", "src/mesh/y.hpp", True),
        ("src/mesh/a/x.hpp", "src/mesh/a/y.hpp", False),
        ("apps/temper/a/x.hpp", "apps/temper/b/y.hpp", True),
        ("apps/temper/x.hpp", "apps/temper/b/y.hpp", True),
        ("python/a/x.hpp", "python/b/y.hpp", True),
    ]
    wrong = []
    for *pair, expected in rooms:
        with tempfile.TemporaryDirectory() as scratch:
            for one, other in (pair, pair[::-1]):
                path = pathlib.Path(scratch, one)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(f'#include "{re.sub("^(src|apps/temper|python)/", "", other)}"\n', encoding="utf-8")
            violations, _ = check(pathlib.Path(scratch))
        if bool(violations) != expected or not all(file in violation for violation in violations for file in pair):
            wrong.append(f"self-test: {pair}: expected {'a violation' if expected else 'none'}, got {violations}")
    for file, line, expected in planted:
        with tempfile.TemporaryDirectory() as scratch:
            path = pathlib.Path(scratch, file)
            path.parent.mkdir(parents=True)
            path.write_text(line + "\n", encoding="utf-8")
            violations, files = check(pathlib.Path(scratch))
        if files != 1 or bool(violations) != expected:
            wrong.append(f"self-test: {file}: {line}: expected {'a violation' if expected else 'none'}, got {violations}")
    pages = [  # docs/internals/architecture.md, how many violations of a tree with src/mesh and src/mesh/room
        (f"<!-- layers: drawn by scripts/check_layers.py --picture -->\n```text\n{picture()}```\n`src/mesh` `src/mesh/room`", 0),
        (f"<!-- layers: drawn by scripts/check_layers.py --picture -->\n```text\n{picture()}```\n`src/mesh`", 1),
        ("<!-- layers: drawn by scripts/check_layers.py --picture -->\n```text\n[mesh]\n```\n`src/mesh` `src/mesh/room`", 1),
        ("", 3),
    ]
    for page, expected in pages:
        with tempfile.TemporaryDirectory() as scratch:
            root = pathlib.Path(scratch)
            (root / "src/mesh/room").mkdir(parents=True)
            (root / PAGE).parent.mkdir(parents=True)
            (root / PAGE).write_text(page, encoding="utf-8")
            found = list(check_page(root))
        if len(found) != expected:
            wrong.append(f"self-test: a page with {expected} violations: got {found}")
    return wrong, len(planted) + len(rooms) + len(pages)


def main(arguments):
    here = pathlib.Path(__file__).resolve().parent.parent
    if arguments == ["--self-test"]:
        problems, count = self_test()
        done = f"{count} planted lines, rooms and pages, each judged as expected"
    elif arguments == ["--picture"]:
        page = (here / PAGE).read_text(encoding="utf-8")
        page, count = PICTURE.subn(lambda found: f"{found[1]}```text\n{picture()}```\n", page)
        (here / PAGE).write_text(page, encoding="utf-8")
        problems, done = [] if count == 1 else [f"{PAGE}: has no place for the picture"], f"drew it in {PAGE}"
    else:
        root = pathlib.Path(arguments[0]) if arguments else here
        problems, count = check(root)
        problems += check_page(root)
        done = f"{count} files keep to the layers and rooms"
        if count == 0:
            problems = [f"{root}: no sources here"]
    print("\n".join(problems) if problems else f"check_layers: {done}")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

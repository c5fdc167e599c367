#!/usr/bin/env python3
"""The version of temper: `project(temper VERSION …)` in CMakeLists.txt sets it, and a few files must repeat it.

    scripts/version.py               prints the version
    scripts/version.py --check       compares each repetition with it; one line and exit code 1 for each difference
    scripts/version.py --set 0.2.0   writes it, and every repetition
    scripts/version.py --tag v0.2.0  fails if the tag is not that of the version, or a page still says that there is no release

Everything else takes the version from CMake: libraries, program, Python package, Debian packages. scripts/recipes.sh puts it
into the recipes.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]

SOURCE = ("CMakeLists.txt", r"^project\(temper VERSION (\d+\.\d+\.\d+)")

# File, and the places of the whole version (X.Y.Z) or of the interface (X.Y) in it.
REPETITIONS = [
    ("CHANGELOG.md", r"\A(?:(?!## ).*\n)*## (\d+\.\d+\.\d+),"),  # the first heading
    ("CITATION.cff", r"^version: (\S+)$"),
    ("web/npm/package.json", r'^  "version": "([^"]+)"'),
    ("web/package-lock.json", r'^    "npm": \{\n      "name": "temper-mesh",\n      "version": "([^"]+)"'),
    ("include/temper/detail/version.hpp", r'^/// Returns "([^"]+)"'),
    ("docs/howto/install.md", r"libtemper(\d+\.\d+)_"),
    ("docs/howto/cpp.md", r"find_package\(temper (\d+\.\d+) "),
    ("tests/consumer/find_package/CMakeLists.txt", r"find_package\(temper (\d+\.\d+) "),
]


def find(name, pattern, root=ROOT):
    """The text of a file, and where the pattern's group stands in it."""
    text = (root / name).read_text()
    return text, [match.span(1) for match in re.finditer(pattern, text, re.MULTILINE)]


def version(root=ROOT):
    text, spans = find(*SOURCE, root)
    return text[slice(*spans[0])]


def expected(found, whole):
    """The whole version, or X.Y of it in a place that has X.Y."""
    return whole if found.count(".") == 2 else whole.rsplit(".", 1)[0]


def differences(root=ROOT):
    whole = version(root)
    for name, pattern in REPETITIONS:
        text, spans = find(name, pattern, root)
        if not spans:
            yield f"{name}: expected version {whole}, found none"
        for start, end in spans:
            line, found = text.count("\n", 0, start) + 1, text[start:end]
            if found != expected(found, whole):
                yield f"{name}:{line}: expected version {expected(found, whole)}, found {found}"


# Text that a release needs, or must not have.
RELEASED = [
    ("CHANGELOG.md", r"\A(?:(?!## ).*\n)*## \S+, \d{4}-\d{2}-\d{2}$", True, "expected the date in the first heading"),
    ("CITATION.cff", r"^date-released: ", True, "expected date-released"),
    ("README.md", r"no release yet", False, "says that there is no release"),
    ("docs/howto/install.md", r"no release yet", False, "says that there is no release"),
    ("docs/reference/supported.md", r"have never run", False, "says that the workflows have never run"),
    ("docs/internals/testing.md", r"have never run", False, "says that the workflows have never run"),
]


def unreleased(tag, root=ROOT):
    if tag != f"v{version(root)}":
        yield f"expected tag v{version(root)}, found {tag}"
    for name, pattern, wanted, wrong in RELEASED:
        if bool(re.search(pattern, (root / name).read_text(), re.MULTILINE)) != wanted:
            yield f"{name}: {wrong}"


def write(whole, root=ROOT):
    missing = [name for name, _ in REPETITIONS if not (root / name).exists()]
    if missing:
        sys.exit(f"version: not found: {', '.join(missing)}")
    for name, pattern in [SOURCE, *REPETITIONS]:
        text, spans = find(name, pattern, root)
        for start, end in reversed(spans):
            text = text[:start] + expected(text[start:end], whole) + text[end:]
        (root / name).write_text(text)


def report(wrong, right):
    """Prints each line of `wrong`, or `right` if there is none. Returns the exit code."""
    wrong = list(wrong)
    print("\n".join(wrong) if wrong else right)
    return bool(wrong)


def main(arguments):
    if not arguments:
        print(version())
    elif arguments == ["--check"]:
        return report(differences(), f"version {version()}, repeated in {len(REPETITIONS)} places")
    elif len(arguments) == 2 and arguments[0] == "--tag":
        return report(unreleased(arguments[1]), f"version {version()}, released")
    elif len(arguments) == 2 and arguments[0] == "--set" and re.fullmatch(r"(0|[1-9]\d*)(\.(0|[1-9]\d*)){2}", arguments[1]):
        write(arguments[1])
    else:
        print("usage: scripts/version.py [--check | --set X.Y.Z | --tag vX.Y.Z]", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

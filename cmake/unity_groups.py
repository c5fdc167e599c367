#!/usr/bin/env python3
"""Says which sources can be compiled as one: the groups of a unity build, as CMake commands.

    cmake/unity_groups.py TARGETS ROOT > groups.cmake

TARGETS has a line a target: name;source;source… What keeps two files apart is a name that one defines for itself, in
an unnamed namespace or as a macro, and the other one, or a header of ROOT it includes, so much as mentions: then the
name could be taken for the wrong thing. A file goes to the first group where that is not so. Whatever this simple
reading of C++ overlooks fails to compile; the other builds compile each file alone.
"""

import functools
import pathlib
import re
import sys

MOST_LINES = 3000  # of a group: so that no compiler runs long after the others have ended

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.M)
NOT_CODE = re.compile(r'R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|//[^\n]*', re.S)
WORD = re.compile(r"(?<![.:>\w])[A-Za-z_]\w*(?:[(<](?!=))?")  # not what is named as a member or with its namespace
UNNAMED = re.compile(r"^namespace \{\n(.*?)^\}  // namespace$", re.S | re.M)  # the formatting writes the comment
MACRO = re.compile(r"^#define (\w+)", re.M)
TYPE = re.compile(r"(?:struct|class|enum class|enum) (\w+)|using (\w+) =")
NAMED = re.compile(r"(?<!:)\b(\w+\(|\w+(?=\s*[={;\[]))")  # functions, with their parenthesis, and constants
BROUGHT = {"filesystem": "quoted(", "iomanip": "quoted("}  # that argument-dependent lookup prefers to io's own
KEYWORDS = {"const", "return", "void(", "noexcept", "operator"}
NOT_ITS_OWN = re.compile(r"[ }#)]|$|TEST|TYPED_TEST|INSTANTIATE|using (?!\w+ =)")


@functools.cache
def code(path):
    return NOT_CODE.sub("", path.read_text(encoding="utf-8"))


def own_names(path):
    """What is defined at the outermost level of unnamed namespaces: the formatting puts that at the first column."""
    text = path.read_text(encoding="utf-8")
    brought = {BROUGHT[name] for name in INCLUDE.findall(text) if name in BROUGHT}
    blocks = [NOT_CODE.sub("", block) for block in UNNAMED.findall(text)]
    lines = [line for block in blocks for line in block.split("\n") if not NOT_ITS_OWN.match(line)]
    found = [TYPE.match(line) or NAMED.search(line) for line in lines]
    defined = {next(filter(None, match.groups())) for match in found if match} - KEYWORDS
    return defined | set(MACRO.findall(text)) | brought


@functools.cache
def headers(path, root):
    """The headers of the project that a file includes, directly or not."""
    folders = [path.parent] + [root / name for name in ("include", "src", "gallery", "tests", "apps/temper", "")]
    found = set()
    for name in INCLUDE.findall(path.read_text(encoding="utf-8")):
        header = next((folder / name for folder in folders if (folder / name).is_file()), None)
        if header and header.resolve() not in found:
            found |= {header.resolve()} | headers(header.resolve(), root)
    return frozenset(found)


def mentioned(path, root):
    """Names, and with a parenthesis those that are called: of a function nothing else can be taken for another's."""
    words = {word.replace("<", "(") for file in {path} | headers(path, root) for word in WORD.findall(code(file))}
    return words | {word.rstrip("(") for word in words}


def groups_of(sources, root):
    groups = []
    for path in sources:
        own, seen, lines = own_names(path), mentioned(path, root), code(path).count("\n")
        for group in groups:
            if group["lines"] + lines <= MOST_LINES and not group["own"] & seen and not own & group["seen"]:
                break
        else:
            group = {"own": set(), "seen": set(), "lines": 0, "files": []}
            groups.append(group)
        group["own"] |= own
        group["seen"] |= seen
        group["lines"] += lines
        group["files"].append(path)
    return [group["files"] for group in groups]


def main():
    root = pathlib.Path(sys.argv[2]).resolve()
    for line in pathlib.Path(sys.argv[1]).read_text(encoding="utf-8").splitlines():
        target, *sources = line.split(";")
        for number, files in enumerate(groups_of([pathlib.Path(source).resolve() for source in sources], root)):
            names = " ".join(f'"{file}"' for file in files)
            print(f"set_source_files_properties({names} TARGET_DIRECTORY {target} PROPERTIES UNITY_GROUP {number})")


main()

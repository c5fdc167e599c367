"""The code blocks of a page of documentation, in order, with what their marks say.

A block of kind `text` right below a block of commands is what that one prints. A mark is a comment on the line above a block:

    <!-- not run here: REASON -->                        it is text
    <!-- runs with: NAME[, NAME]; measures: WHAT -->     it needs these; what its numbers are
    <!-- temper ARGUMENTS -->                            of text: what this command prints, which the page does not show

NAME is a program in a block of shell, and a module in one of Python, or `program NAME` or `module NAME`. The first line of a script is its mark.
"""

import importlib.util
import pathlib
import re
import shutil
from dataclasses import dataclass, replace

BLOCK = re.compile(r"(?:^<!-- (?P<mark>(?!given:)[^\n]*) -->\n)?^(?P<indent> *)```(?P<kind>\w*)[^\n]*\n"
                   r"(?P<text>.*?)^ *```[ \t]*$", re.M | re.S)
RUN = ("sh", "python")
DATA = ("json", "xml", "yaml", "csv")  # what is in a file: nothing to run


@dataclass
class Block:
    kind: str  # as the fence says; sh for text below a command in a mark
    text: str  # of Python after as many empty lines as are above it in the page, so that errors name the right line
    line: int
    not_run: str = ""  # the reason, or nothing
    needs: tuple[str, ...] = ()
    measures: str = ""
    prints: tuple[int, int] | None = None  # where the page has its output, from and to
    problem: str = ""


def blocks_of(text: str) -> list[Block]:
    found: list[Block] = []
    end = 0
    for match in BLOCK.finditer(text):
        mark, kind, code = match["mark"] or "", match["kind"], match["text"]
        line = text.count("\n", 0, match.start("kind")) + 1
        below = bool(found) and found[-1].kind in RUN and not found[-1].prints and not text[end : match.start()].strip()
        end = match.end()
        if kind == "text" and mark.startswith("temper "):
            found.append(Block("sh", mark, line, prints=match.span("text")))
            continue
        if kind == "text" and below and not mark:
            found[-1].prints = match.span("text")
            continue
        parts = dict(part.split(": ", 1) for part in mark.split("; ") if ": " in part)
        needs = tuple(parts["runs with"].split(", ")) if "runs with" in parts else ()
        if kind == "python":
            code = "\n" * line + code
        block = Block(kind, code, line, parts.get("not run here", ""), needs, parts.get("measures", ""))
        if mark and (not parts or set(parts) - {"not run here", "runs with", "measures"}):
            block.problem = f"no mark of a block is '{mark}': see scripts/docs/blocks.py"
        elif kind in RUN and match["indent"]:
            block.problem = "put the fence of a block that runs at the start of a line"
        elif kind not in RUN + DATA and not block.not_run:
            block.problem = "text that no command prints" if kind == "text" else f"a block of {kind or 'no kind'} is not run"
            block.problem += ": put it below its command, or put <!-- not run here: REASON --> on the line above"
        if block.problem and kind in RUN:
            block.not_run = block.problem
        found.append(block)
    return found


def blocks_in(path: pathlib.Path) -> list[Block]:
    """The blocks of a page. A script of Python is one block."""
    text = path.read_text(encoding="utf-8")
    if path.suffix != ".py":
        return blocks_of(text)
    mark = text.partition("\n")[0].removeprefix("# ")
    return [replace(block, text=text, line=1) for block in blocks_of(f"<!-- {mark} -->\n```python\n```\n")]


def runs(block: Block) -> bool:
    return block.kind in RUN and not block.not_run


def lacking(block: Block) -> list[str]:
    """What the block needs and is not here."""
    return [name for name in block.needs if not _there(block.kind, name)]


def _there(kind: str, name: str) -> bool:
    if name == "temper-netcdf":
        import temper

        return temper.build_info()["NetCDF"][0].isdigit()
    what, _, plain = name.rpartition(" ")
    if (what or {"sh": "program"}.get(kind)) == "program":
        return shutil.which(plain) is not None
    return importlib.util.find_spec(plain) is not None

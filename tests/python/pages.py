"""The code blocks of a page of documentation, in order, with what their marks say.

A mark is a comment on the line above a block:

    <!-- not run here: REASON -->                        it is text
    <!-- runs with: NAME[, NAME]; measures: WHAT -->     it needs these; what its numbers are

NAME is a program in a block of shell, and a module in one of Python, or `program NAME`.

A block of kind `text` right below a block is what that one prints.
"""

import importlib.util
import pathlib
import re
import shutil
from dataclasses import dataclass

BLOCK = re.compile(r"(?:^<!-- (?P<mark>[^\n]*) -->\n)?^```(?P<kind>\w*)\n(?P<text>.*?)^```$", re.M | re.S)


@dataclass
class Block:
    kind: str  # sh or python
    text: str  # of Python after as many empty lines as are above it in the page, so that errors name the right line
    not_run: str  # the reason, or nothing
    needs: tuple[str, ...]
    measures: str
    prints: tuple[int, int] | None  # where the page has its output, from and to


def blocks_of(page: pathlib.Path) -> list[Block]:
    found: list[Block] = []
    text = page.read_text(encoding="utf-8")
    for match in BLOCK.finditer(text):
        mark = match["mark"] or ""
        if match["kind"] == "text":
            found[-1].prints = match.span("text")
            continue
        assert match["kind"] in ("sh", "python", "julia"), f"{page.name}: a block of {match['kind'] or 'no kind'}"
        parts = dict(part.split(": ", 1) for part in mark.split("; ")) if mark else {}
        unknown = set(parts) - {"not run here", "runs with", "measures"}
        assert not unknown, f"{page.name}: a mark that says {unknown}"
        needs = tuple(parts["runs with"].split(", ")) if "runs with" in parts else ()
        code = match["text"]
        if match["kind"] == "python":
            code = "\n" * text.count("\n", 0, match.start("text")) + code
        block = Block(match["kind"], code, parts.get("not run here", ""), needs, parts.get("measures", ""), None)
        found.append(block)
    return found


def lacking(block: Block) -> list[str]:
    """What the block needs and is not here."""
    return [name for name in block.needs if not _there(block.kind, name)]


def _there(kind: str, name: str) -> bool:
    if name == "temper-netcdf":
        import temper

        return temper.build_info()["NetCDF"][0].isdigit()
    if kind == "sh" or name.startswith("program "):
        return shutil.which(name.removeprefix("program ")) is not None
    return importlib.util.find_spec(name) is not None

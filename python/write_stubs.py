#!/usr/bin/env python3
"""Usage: write_stubs.py FOLDER. It writes the stub of the options for type checkers. FOLDER has the compiled module.

The module itself has the table. NumPy and the package are not needed.
"""
import pathlib
import sys

HEAD = '''"""Made from the table of options when the module was built."""

import dataclasses
from typing import Any, Callable, Literal, Sequence, TypedDict, TypeVar

from typing_extensions import Unpack

from ._measure_errors import DiffusionProblem
from ._records import Record

@dataclasses.dataclass(frozen=True)
class LengthParameter:
    value: float
    scale: Literal["absolute", "relative"] = ...

LengthParameterLike = LengthParameter | float

TABLE: list[dict[str, Any]]
OPTION_NAMES: tuple[str, ...]
EnergyName = {energy}
ObjectiveName = {objective}
TargetName = {target}
EffortName = {effort}
KeepName = {keep}

class OptionChanges(TypedDict, total=False):
'''

PROBLEM = '''
class OptionsAndProblem(OptionChanges, total=False):
    problem: DiffusionProblem
'''

OPTIONS = '''
@dataclasses.dataclass(frozen=True)
class OptimizeOptions(Record):
'''

TAIL = '''    def _plain(self) -> dict[str, Any]: ...

def _length_parameter(name: str, value: LengthParameterLike) -> tuple[float, str]: ...
def settled(
    target: str, effort: str, keep: Any, options: OptimizeOptions | OptionChanges | None
) -> OptimizeOptions: ...
def options_for(
    target: TargetName = ..., effort: EffortName = ..., keep: KeepName | Sequence[KeepName] = ...,
    **changes: Unpack[OptionChanges],
) -> OptimizeOptions: ...

F = TypeVar("F", bound=Callable[..., Any])

def lists_presets(function: F) -> F: ...
'''


def main(folder):
    sys.path.insert(0, str(folder))
    import _temper

    fields = [(row["name"], row["type"]) for row in _temper.option_table()]
    kinds = dict(fields)
    changes = "".join(f"    {name}: {kind}\n" for name, kind in fields)
    options = "".join(f"    {name}: {kind} = ...\n" for name, kind in fields)
    words = {name: f"Literal[{', '.join(map(repr, rows))}]" for name, rows in _temper.presets().items()}
    text = HEAD.format(energy=kinds["energy"], objective=kinds["objective"].removesuffix(" | None"), **words) + changes + PROBLEM + OPTIONS + options + TAIL
    (folder / "_options.pyi").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))

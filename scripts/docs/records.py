#!/usr/bin/env python3
"""Writes what follows from the tables of the program: the schema of JSON, the classes of Python, the types of TypeScript.

    records.py PROGRAM           exit 1 and one line a file that is not what the tables say
    records.py --write PROGRAM   writes the files

`PROGRAM --help=tables` prints the tables. schema.json beside this script has the rest of the schema: "fields" in it
names tables whose fields an object has, besides its own properties. Pages of docs/ have marks, and in the site a table
follows each (hooks.py):

    <!-- keys of NAME -->                  what the schema has under this name, without measures
    <!-- measures of triangles -->         or "of solvers": those that a community names; or "of tetrahedra"
"""

import decimal
import functools
import json
import keyword
import pathlib
import re
import subprocess
import sys
import textwrap

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
WIDTH = 120
VERSION = 1  # of the schema
# Reports on tetrahedra that are of the same class in Python as those on triangles.
SAME_CLASS = {"TetOptimizeReport": "OptimizeReport", "TetFieldFrame": "FieldFrame", "SurfaceErrorCounts": "ErrorCounts"}
# Reports that only the program has, and reports that npm has not.
PROGRAM_ALONE = {"Outcome", "Verdict", "Operators", "TetOperators", "ColumnCounts"}
NOT_IN_NPM = {"SurfaceQuality", "SurfaceErrorCounts", "SurfaceOptimizeReport", "SurfaceExplanation", "TetExplanation", "TetReason", "FaceHeight", "DualExplanation", "DualReason", "DataReport", "DiffusionErrors", "DiffusionMatrices", "ErrorCounts", "ErrorMatrices", "ErrorNorms", "ErrorSystem", "FieldFrame"}
# Fields that Python adds.
DATA = """    data: DataReport | TetDataReport | None = dataclasses.field(default=None, kw_only=True)
    \"\"\"Report on the data of the mesh; None without data.\"\"\"
"""
MORE = {"OptimizeReport": DATA, "SurfaceOptimizeReport": DATA}
NOTE = "Written by scripts/docs/records.py --write from the tables in the library. Do not edit."


def compact(value, indent=""):
    """JSON with as much on a line as fits."""
    line = json.dumps(value, ensure_ascii=False)
    if len(indent) + len(line) <= WIDTH or not isinstance(value, (dict, list)):
        return line
    deeper = indent + "  "
    if isinstance(value, dict):
        items = [f"{json.dumps(key)}: {compact(item, deeper)}" for key, item in value.items()]
    elif all(isinstance(item, str) for item in value):
        items = textwrap.wrap(line[1:-1], WIDTH - len(deeper), break_long_words=False, break_on_hyphens=False)
        return "[\n" + "\n".join(deeper + item for item in items) + f"\n{indent}]"
    else:
        items = [compact(item, deeper) for item in value]
    left, right = "{}" if isinstance(value, dict) else "[]"
    return left + "\n" + ",\n".join(deeper + item for item in items) + f"\n{indent}{right}"


def sentence_of(field):
    """The meaning of a field, as a sentence."""
    text = field["sentence"] + (f" [{field['unit']}]" if field["unit"] else "")
    text = text[:1].upper() + text[1:] if re.match("[a-z]+\\b(?!/)", text) else text
    return text and (text if text.endswith(".") else text + ".")


# --- schema ------------------------------------------------------------------------------------------------------

NUMBERS = {"count": "count", "element": "count", "vertex": "count", "number": "number"}


def schema_of_item(kind):
    if kind["kind"] == "record":
        return {"$ref": f"#/$defs/{kind['record']}"} if "record" in kind else schema_of_fields("", kind["fields"])
    if kind["kind"] in NUMBERS:
        return {"$ref": "#/$defs/" + NUMBERS[kind["kind"]]}
    if kind["kind"] == "text":
        return {"enum": kind["words"]} if kind["words"] else {"type": "string"}
    if kind["kind"] == "certificate":
        return {"anyOf": [{"$ref": "#/$defs/certificate"}, {"type": "null"}]}
    return {"type": {"flag": "boolean", "whole": "integer"}[kind["kind"]]}


def schema_of_type(kind, shown):
    item = schema_of_item(kind)
    for size in reversed(kind["sizes"]):
        item = {"type": "array", "items": item, **({"minItems": size, "maxItems": size} if size else {})}
    return {"anyOf": [item, {"type": "null"}]} if kind["optional"] and shown != "if_any" else item


def schema_of_fields(description, fields, more=None):
    shown = [field for field in fields if field["shown"] != "libraries"]
    own = {f["key"]: {**({"description": sentence_of(f)} if f["sentence"] else {}), **schema_of_type(f["type"], f["shown"])} for f in shown}
    own.update({"schema": {"const": VERSION}} if "schema" in own else {})
    more = more or {}
    return {
        **({"description": description} if description else {}), "type": "object",
        "properties": {**own, **more.get("properties", {})}, "required": [*(f["key"] for f in shown if f["shown"] != "if_any"), *more.get("required", [])],
        "additionalProperties": False,
    }  # fmt: skip


def schema(tables):
    made = json.loads((HERE / "schema.json").read_text(encoding="utf-8"))
    by_name = {table["name"]: table for table in tables}
    for name, definition in made["$defs"].items():
        if "fields" in definition:
            fields = [field for table in definition["fields"] for field in by_name[table]["fields"]]
            made["$defs"][name] = schema_of_fields(definition.get("description"), fields, definition)
    for table in tables:
        made["$defs"].setdefault(table["name"], schema_of_fields(table["sentence"], table["fields"]))
    return compact(made) + "\n"


# --- Python ------------------------------------------------------------------------------------------------------

ARRAYS = {"count": "uint64", "vertex": "int32", "element": "int32", "number": "float64"}
PLAIN = {"certificate": "Certificate", "flag": "bool", "count": "int", "whole": "int", "number": "float", "vertex": "int", "element": "int"}


def python_of_item(kind):
    if kind["kind"] == "record":
        return kind["record"] if "record" in kind else f"dict[str, {python_of_type(kind['fields'][0]['type'])}]"
    if kind["kind"] == "text":
        return f"Literal[{', '.join(map(json.dumps, kind['words']))}]" if kind["words"] else "str"
    return PLAIN[kind["kind"]]


def python_of_type(kind, other_sizes=None):
    """`other_sizes`: those of tetrahedra, if they are of the same class."""
    if kind["sizes"] == [0] and kind["kind"] in ARRAYS:
        made = f"npt.NDArray[np.{ARRAYS[kind['kind']]}]"
    else:
        made = python_of_item(kind)
        for size in reversed(kind["sizes"]):
            made = f"tuple[{', '.join([made] * size)}]" if size else f"list[{made}]"
        if other_sizes not in (None, kind["sizes"]):
            made = f"tuple[{python_of_item(kind)}, ...]"
    return made + (" | None" if kind["optional"] else "")


def docstring(text, indent="    "):
    text = text.replace("|", "\\\\|")  # which is Markdown's otherwise
    lines = textwrap.wrap(f'"""{text}"""', WIDTH - len(indent), break_long_words=False, break_on_hyphens=False)
    return "".join(f"{indent}{line}\n" for line in lines)


def python(tables, looks):
    """`looks`: names of classes in _looks.py, which give a record more than its fields."""
    text = f'"""{NOTE}"""\n\nfrom __future__ import annotations\n\nimport dataclasses\nfrom typing import Literal\n\n'
    text += "import numpy as np\nimport numpy.typing as npt\n\nfrom . import _looks\nfrom ._certificate import Certificate\nfrom ._records import CLASSES, Record\n"
    for table in tables:
        if table["name"] in PROGRAM_ALONE or table["name"] in SAME_CLASS:
            continue
        others = [other for other in tables if SAME_CLASS.get(other["name"]) == table["name"]]
        absent = {f["key"] for other in others for f in other["fields"] if f["type"]["optional"]}
        lengths = {f["key"]: f["type"]["sizes"] for other in others for f in other["fields"]}
        base = f"_looks.{table['name']}" if table["name"] in looks else "Record"
        text += f"\n\n@dataclasses.dataclass(frozen=True, eq=False)\nclass {table['name']}({base}):\n" + docstring(table["sentence"]) + "\n"
        for field in table["fields"]:
            kind = {**field["type"], "optional": field["type"]["optional"] or field["key"] in absent}
            hidden = " = dataclasses.field(repr=False)" if field["shown"] == "by_key" else ""
            text += f"    {field['key']}{'_' * keyword.iskeyword(field['key'])}: {python_of_type(kind, lengths.get(field['key'], kind['sizes']))}{hidden}\n"
            text += docstring(sentence_of(field)) if field["sentence"] else ""
        text += MORE.get(table["name"], "")
    return text + "\n\n" + "".join(f'CLASSES["{other}"] = {name}\n' for other, name in SAME_CLASS.items())


# --- TypeScript --------------------------------------------------------------------------------------------------


def typescript_of_item(kind):
    if kind["kind"] == "record" and "record" not in kind:
        keys = " | ".join(f"'{field['key']}'" for field in kind["fields"])
        return f"Record<{keys}, {typescript_of_type(kind['fields'][0]['type'])}>"
    if kind["kind"] == "record":
        return kind["record"]
    if kind["kind"] == "text":
        return " | ".join(f"'{word}'" for word in kind["words"]) or "string"
    return {"flag": "boolean", "certificate": "Certificate"}.get(kind["kind"], "number")


def typescript_of_type(kind):
    made = typescript_of_item(kind)
    for size in reversed(kind["sizes"]):
        made = f"[{', '.join([made] * size)}]" if size else (f"({made})[]" if " " in made and made[0] != "[" else f"{made}[]")
    return made + (" | null" if kind["optional"] else "")


def typescript(tables):
    text = f"// {NOTE}\nimport type {{ Certificate }} from './types.ts';\n"
    for table in tables:
        if table["name"] in PROGRAM_ALONE or table["name"] in NOT_IN_NPM or table["name"].startswith(("Tet", "WorstTet")):
            continue
        text += f"\n/** {table['sentence'].replace('``', '`')} */\nexport interface {table['name']} {{\n"
        for field in table["fields"]:
            text += f"  /** {sentence_of(field)} */\n" if field["sentence"] else ""
            text += f"  {field['key']}: {typescript_of_type(field['type'])};\n"
        text += "}\n"
    return text


def option_value(text, kind):
    """A value of an option, as JavaScript has it."""
    if kind != "choice":
        return format(decimal.Decimal(text), "f")
    return text if text.isdigit() else json.dumps(text)


def typescript_options(said):
    kinds = {row["name"]: row["kind"] for row in said["options"]}

    def spelled(text):
        return re.sub(r"`(\w+)(?:=([^`]*))?`", lambda m: m[1] + (f": {option_value(m[2], kinds[m[1]]) if kinds[m[1]] == 'choice' else m[2]}" if m[2] else ""), text)

    text = f"// {NOTE}\nimport type {{ LengthParameterLike }} from './types.ts';\n"
    for name, words, title in (
        ("TargetName", "targets", "Use of the mesh"), ("EffortName", "efforts", "Time that the run may take"), ("KeepName", "keeps", "Part of the mesh that stays"),
    ):  # fmt: skip
        meanings = "".join(f"\n * - `{word['name']}`: {word['sentence']}." for word in said[words])
        text += f"\n/** {title}.{meanings} */\nexport type {name} = {' | '.join(json.dumps(word['name']) for word in said[words])};"
    text += "\n\n/** Further options of `optimize`. */\nexport interface OptimizeOptions {\n"
    for row in said["options"]:
        if "triangles" not in row["cells"] and row["cells"] != "all":
            continue
        kind = " | ".join(option_value(choice, "choice") for choice in row["choices"]) or {"length_parameter": "LengthParameterLike"}.get(row["kind"], "number")
        default = "null" if row["optional"] and row["default"] == row["absent_name"] else option_value(row["default"], row["kind"])
        meaning = spelled(row["sentence"]) + (f"; {row['range']}" if row["range"] and not row["choices"] else "")
        meaning += f". null: {spelled(row['absent'])}" if row["optional"] and row["absent"] else ""
        text += f"  /** {meaning}. Default: {default}. */\n  {row['name']}?: {kind}{' | null' * row['optional']};\n"
    return text + "}\n"


# --- pages -------------------------------------------------------------------------------------------------------

MARK = re.compile(r"^<!-- (keys|measures) of (\w+) -->\n", re.M)
MOST_KEYS = 8  # of an object in the row of another key


def inner(item, made):
    """What the values of a key are: words, or keys."""
    item = item.get("items", item.get("anyOf", [item])[0])
    item = item.get("items", item)
    keys = item.get("enum") or list(made["$defs"].get(item.get("$ref", "").rpartition("/")[2], {}).get("properties", ()))
    return ": " + ", ".join(f"`{key}`" for key in keys) if 0 < len(keys) <= MOST_KEYS else ""


def table_of_keys(name, made, said):
    measures = {row["key"] for rows in said["measures"] for row in rows}
    rows = [(f"`{key}`", item.get("description", "").rstrip(".") + inner(item, made)) for key, item in made["$defs"][name]["properties"].items() if key not in measures]
    return [("key", "value"), *rows]


def table_of_measures(whose, said):
    rows = [row for row in said["measures"][whose == "tetrahedra"] if whose == "tetrahedra" or bool(row["community"]) == (whose == "solvers")]
    made = [("`--require`, JSON", "short", "code", "what", "wanted")]
    for row in rows:
        wanted = "–" if row["wanted"] is None else f"{row['sign']} {row['wanted']:g}"
        made.append((f"`{row['key']}`", f"`{row['alias']}`" * bool(row["alias"]), row["community"], row["definition"], wanted))
    return made if whose == "solvers" else [cells[:2] + cells[3:] for cells in made]


def tables_of(program):
    return json.loads(subprocess.run([program, "--help=tables"], check=True, capture_output=True, text=True, encoding="utf-8").stdout)


@functools.cache
def table(kind, name):
    """Of a mark, from the program on PATH."""
    said = tables_of("temper")
    rows = table_of_keys(name, json.loads(schema(said["reports"])), said) if kind == "keys" else table_of_measures(name, said)
    lines = [f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in row)} |" for row in rows]
    return "\n".join([lines[0], "|" + "-|" * len(rows[0]), *lines[1:]]) + "\n"


def filled(page):
    """The page with a table below each mark."""
    return MARK.sub(lambda mark: f"{mark[0]}\n{table(mark[1], mark[2])}", page)


def main(program, write=False):
    said = tables_of(program)
    tables = said["reports"]
    looks = set(re.findall(r"^class (\w+)", (ROOT / "python/temper/_looks.py").read_text(encoding="utf-8"), re.M))
    files = {
        f"docs/schema/temper-{VERSION}.schema.json": schema(tables),
        "python/temper/_reports.py": python(tables, looks),
        "web/npm/src/records.ts": typescript(tables),
        "web/npm/src/options.ts": typescript_options(said),
    }
    stale = [name for name, text in files.items() if not (ROOT / name).exists() or (ROOT / name).read_text(encoding="utf-8") != text]
    for name in stale:
        if write:
            (ROOT / name).write_text(files[name], encoding="utf-8")
        else:
            print(f"{name}: is not what the tables of the program say: run scripts/docs/records.py --write PROGRAM")
    return int(bool(stale) and not write)


if __name__ == "__main__":
    words = [word for word in sys.argv[1:] if word != "--write"]
    sys.exit(main(words[0], "--write" in sys.argv) if len(words) == 1 else __doc__)

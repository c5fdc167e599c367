"""Makes the tables of docs/reference/names.md, the names of the program, Python and C++ side by side, and the fields of errors.md: hooks.py
puts them into the site.

Names come from where they are declared: the help of the program, the module's tables and signatures, the headers. By hand are only
the rows below, where the three differ.
"""

import inspect
import pathlib
import re
import subprocess
import textwrap

import temper
from temper._options import TABLE

ROOT = pathlib.Path(__file__).resolve().parents[2]
HEADERS = ROOT / "include" / "temper"

# What a verb is in Python (also the functions whose keywords are its options) and in C++.
VERBS = {
    "mesh": (["read_outline", "mesh_outline", "mesh_sphere"], ["io::read_outline", "mesh_outline", "mesh_sphere"]),
    "optimize": (["optimize"], ["optimize"]),
    "weights": (["find_weights", "best_margin", "best_connectivity", "check_certificate"], ["find_weights", "best_margin", "best_connectivity", "check_certificate"]),
    "explain": (["explain"], ["explain"]),
    "check": (["quality"], ["quality"]),
    "errors": (["measure_errors"], ["measure_errors"]),
    "operators": (["dec_operators", "columns"], ["dec_operators", "columns", "io::write_dec"]),
    "draw": (["draw_svg"], ["draw_svg", "draw_before_after_svg"]),
    "convert": (["read", "write"], ["io::read", "io::write"]),
    "example": (["generate"], ["horseshoe", "random_mesh", "…"]),
    "paper": (["replay"], ["replay"]),
}  # fmt: skip

# Options that are no field of OptimizeOptions and no keyword of that name, of all verbs or of one: Python, C++.
OTHERS = {
    "--check-certificate": ("`check_certificate`", ""),
    "--certificate": ("`WeightReport.certificate`", ""),
    "--connectivity": ("`best_connectivity`", ""),
    "--encoding": ("`write(encoding=…)`", "`io::WriteOptions::encoding`"),
    "operators --format": ("`dec_operators(…).write(formats=…)`", "`io::DecWriteOptions::formats`"),
    "--layers": ("`columns(surfaces=…, active=…)`", "`io::read_layers`, `Layers`"),
    "--fix": ("`read(fixed_tags=…)`", "`io::make_mesh(file, fixed_tags)`"),
    "--format": ("`write(format=…)`", "`io::WriteOptions::format`"),
    "--gamma-rel": ("`quality(gamma=LengthParameter(…, 'relative'))`", "`LengthParameter`"),
    "--h0-rel": ("`quality(h0=LengthParameter(…, 'relative'))`", "`LengthParameter`"),
    "--for": ("`optimize(target=…)`", "`options_for`"),
    "--effort": ("`optimize(effort=…)`", "`options_for`"),
    "--keep": ("`optimize(keep=…)`", "`options_for`"),
    "--options": ("`optimize(options=…)`", "`OptimizeOptions`"),
    "weights --flips": ("", "`surfaces::find_intrinsic_weights`"),
    "optimize --set": ("`optimize(options={…})`", "`OptimizeOptions`"),
    "--size-data": ("`optimize(size_field=…)`", "`OptimizeOptions::size_field`"),
    "optimize --size": ("`optimize(size_field=…)`", "`OptimizeOptions::size_field`"),
    "--write": ("`html_report`, `draw_svg`, `Hooks(tracer=…)`", "`io::html_report`, `OptimizeHooks::tracer`"),
    "--no-rings": ("`draw_svg(near_coincident=False)`", ""),
    "--numbers": ("`draw_svg(vertex_numbers=True)`", ""),
    "--region-size": ("`mesh_outline(region_sizes=…)`", ""),
    "--faces": ("`Outline.faces`", "`become_faces`"),
    "--sphere": ("`mesh_sphere`", "`mesh_sphere`"),
    "--coast": ("`mesh_sphere(coasts=…)`", "`SphereOutline::coasts`"),
    "--lines": ("`mesh_sphere(lines=…)`", "`SphereOutline::lines`"),
    "--no-triangle-quality": ("`write(triangle_quality=False)`", "`io::WriteOptions::triangle_quality`"),
    "--point-data": ("`Mesh.point_data_rules`", "`io::UpdateOptions::rules`"),
    "--cell-data": ("", "`io::UpdateOptions::cell_rules`"),
    "--positive": ("`read(positive=…)`", "`io::ReadOptions::positive`"),
    "--projection": ("`read(projection=…)`", "`io::project`"),
    "--tensor": ("`optimize(tensor=…)`, `dec_operators(tensor=…)`, `mapped`, `mapped_back`", "`Metric`, `mapped`, `mapped_back`"),
    "--threads": ("`threads=…`", "`Executor`, `TbbExecutor`"),
}  # fmt: skip


def printed(program, *arguments):
    return subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout


def options_of(program, verb):
    return re.findall(r"^  (?:-\w,)?(--[\w-]+)", printed(program, verb, "--help-all"), re.M)


def members_of(struct):
    """Names that a struct of optimize.hpp declares."""
    text = re.sub(r"//[^\n]*", "", (HEADERS / "optimize.hpp").read_text(encoding="utf-8"))
    body = re.search(rf"^struct {struct} \{{\n(.*?)^\}};", text, re.M | re.S)[1]
    return set(re.findall(r"(\w+)(?: =[^;]*)?;", body))


def options_table(program):
    """Options of optimize() that have another name in C++: the struct, and its members by their names in Python."""
    structs = {}
    for name in (row["name"] for row in TABLE):
        struct, _, member = member_for(name).rpartition(".")
        if struct:
            structs.setdefault(struct, []).append(f"`{name}`" if member == name else f"`{name}` (`{member}`)")
    return ["| member of `OptimizeOptions` | options in it, and their names there if they differ |", "|-|-|",
            *(f"| `{struct}` | {', '.join(names)} |" for struct, names in structs.items())]  # fmt: skip


def member_for(name):
    """The member of OptimizeOptions: accuracy_sweeps is AccuracyOptions::sweeps, surface_distance CurvedSurfaceOptions::distance."""
    groups = [("OptimizeOptions", ""), ("PaperSwitches", "paper."), ("AccuracyOptions", "accuracy."), ("SolverErrorOptions", "solver_error."), ("GuardOptions", "guard."), ("TetrahedraOptions", "tets."), ("CurvedSurfaceOptions", "surfaces.")]
    for struct, place in groups:
        short = name.removeprefix(place.replace(".", "_")).removeprefix(place.replace("s.", "_")) if place else name
        for member in (name, short, "most_" + short):
            if member in members_of(struct):
                return place + member
    raise KeyError(f"no member of OptimizeOptions is called {name}")


def other_options(program):
    """Options of all other kinds: with their keyword where a function of the verb has it."""
    rows = {}
    for verb, (functions, _) in VERBS.items():
        keywords = {}
        for function in functions:
            if callable(getattr(temper, function)):
                keywords = {name: function for name in inspect.signature(getattr(temper, function)).parameters} | keywords
        of_table = {"--" + row["name"].replace("_", "-") for row in TABLE} if verb == "optimize" else set()
        for flag in options_of(program, verb) if verb != "example" else []:
            if flag in of_table or flag.startswith("--help"):
                continue
            plain = flag.removeprefix("--").replace("-", "_")
            python, cpp = OTHERS.get(f"{verb} {flag}") or OTHERS.get(flag, ("", ""))
            if not python and plain in keywords:
                python = f"`{keywords[plain]}({plain}=…)`"
            elif not python and plain.removeprefix("no_") in keywords:
                name = plain.removeprefix("no_")
                python = f"`{keywords[name]}({name}=False)`"
            rows.setdefault((flag, python, cpp), []).append(verb)
    known = ["| program | verbs | Python | C++, if its name is another |", "|-|-|-|-|"]
    alone = []
    for (flag, python, cpp), verbs in sorted(rows.items()):
        if re.search(rf"\({flag[2:].replace('-', '_')}=…\)`$", python) and not cpp:
            continue  # a keyword of the same name
        if python:
            known.append(f"| `{flag}` | {'several' if len(verbs) > 3 else ', '.join(verbs)} | {python} | {cpp} |")
        elif not any(flag == other for other, given, _ in rows if given):
            alone.append(f"`{flag}`")
    return [*known, "", *textwrap.wrap(f"The program alone has {', '.join(dict.fromkeys(alone))}.", 120, break_on_hyphens=False)]


def fields_table(_program):
    """The fields of docs/reference/errors.md."""
    rows = [f"| `{field.name}` | {field.group} | `{field.formula}` |" for field in temper.error_fields()]
    return ["| name | group | u(x, y) |", "|-|-|-|", *rows]


def verbs_table(program):
    listed = re.search(r"^Verbs:\n(.*?)\n\n", printed(program, "--help"), re.M | re.S)[1]
    verbs = re.findall(r"^  (\w+) ", listed, re.M)
    missing = set(verbs) ^ set(VERBS)
    assert not missing, f"VERBS and the program differ in {sorted(missing)}"
    lines = ["| program | Python | C++ |", "|-|-|-|"]
    for verb in verbs:
        python, cpp = VERBS[verb]
        for name in python:
            assert hasattr(temper, name), f"temper.{name}"
        cells = [", ".join(f"`{name}`" if name != "…" else name for name in names) or "–" for names in (python, cpp)]
        lines.append(f"| `temper {verb}` | {cells[0]} | {cells[1]} |")
    return lines


def check_measures(program):
    """Keys of --require and of JSON are the fields of Quality, in both languages."""
    keys = re.search(r"Keys: (.*?) energy\.", re.sub(r"\s+", " ", printed(program, "check", "--help")))[1]
    fields = set(inspect.signature(temper.types.Quality).parameters)
    missing = {key for key, _, _ in re.findall(r"(\w+)( \((\w+)\))?,", keys)} - fields
    assert not missing, f"Quality lacks {sorted(missing)}"


def check_energies():
    """The energies have the same names in all languages."""
    kinds = re.search(r"enum class EnergyKind \{(.*?)\};", re.sub(r"//[^\n]*", "", (HEADERS / "energy.hpp").read_text(encoding="utf-8")), re.S)[1]
    assert [energy.name for energy in temper.energy.energies()] == re.findall(r"\w+", kinds)


def filled(page):
    """The page with a table below each mark, <!-- names of verbs --> and so on; the program is on PATH."""
    return MARK.sub(lambda mark: "\n".join([mark[0], *TABLES[mark[1]]("temper"), ""]), page)


TABLES = {"verbs": verbs_table, "members": options_table, "other options": other_options, "fields": fields_table}
MARK = re.compile(r"^<!-- names of (verbs|members|other options|fields) -->\n", re.M)


def check(program):
    """Fails if a name has no row, or a row no name."""
    check_measures(program)
    check_energies()
    for table in TABLES.values():
        table(program)

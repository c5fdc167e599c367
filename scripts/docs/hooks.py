"""What MkDocs adds to the pages of docs/: the README as the first page, references, help, and the sources that pages link.

Pages are written for GitHub: their links are relative, and may leave docs/. A link to a page of the site goes there; one to
a folder goes to its README; one to any other file of the repository goes to a page with its text.
"""

import ast
import os
import pathlib
import posixpath
import re
import shutil
import sys

from mkdocs.structure.files import File, InclusionLevel

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import cpp_reference  # noqa: E402
import records  # noqa: E402
import verbs  # noqa: E402

try:
    import names  # needs the module
except ModuleNotFoundError:
    names = None

# Pages of the repository outside of docs/, and where they are in the site.
ELSEWHERE = {"README.md": "index.md", "CONTRIBUTING.md": "contributing.md", "CHANGELOG.md": "changelog.md",
             "web/npm/README.md": "npm.md"}  # fmt: skip
NOT_SEARCHED = ("internals/", "repository/", "source/")
LANGUAGES = {".py": "python", ".cpp": "cpp", ".hpp": "cpp", ".sh": "sh", ".json": "json", ".cff": "yaml", ".txt": "text"}
LINK = re.compile(r"(\]\(\s*)([^()\s#]*)(#[^()\s]*)?(\s*\))")
CODE = re.compile(r"`[^`\n]+`")
FENCE = re.compile(r"^(```.*?^```\s*$)", re.M | re.S)
# Names of pages of the Python reference that are not those of their modules.
TITLES = {"_dec": "Operators", "_draw": "Pictures and reports", "_io": "Files", "_mesh": "Meshes", "_optimize": "Optimizing",
          "_options": "Options of optimize", "_measure": "Measures"}  # fmt: skip


def site_place(file):
    """Where a file of the repository is in the site."""
    if file in ELSEWHERE:
        return ELSEWHERE[file]
    if file.startswith("docs/"):
        return file.removeprefix("docs/")
    return f"repository/{file}" if file.endswith(".md") else f"source/{file}.md"


def repository_place(page):
    """The other way; nothing for pages that are made here."""
    for file, place in ELSEWHERE.items():
        if place == page:
            return file
    if page.startswith("repository/"):
        return page.removeprefix("repository/")
    return f"docs/{page}" if (ROOT / "docs" / page).exists() else None


def target_of(link, origin):
    """The file of the repository that a link of the page `origin` means; a folder's README."""
    file = posixpath.normpath(posixpath.join(posixpath.dirname(origin), link))
    if (ROOT / file).is_dir():
        file = posixpath.join(file, "README.md")
    return file if (ROOT / file).is_file() else None


def relative_links(text, origin):
    for piece in FENCE.split(text):
        if not piece.startswith("```"):
            for match in LINK.finditer(piece):
                if match[2] and not re.match(r"[a-z]+:", match[2]):
                    yield match[2], target_of(match[2], origin)


def source_page(file):
    path = ROOT / file
    language = LANGUAGES.get(path.suffix, "text")
    return f"# {path.name}\n\n`{file}`\n\n````{language}\n{path.read_text(encoding='utf-8').rstrip()}\n````\n"


def python_pages():
    """A page for each module of the package, with the names that temper/__init__.py and temper/types.py take from it."""
    modules = {}
    for source in ("__init__", "types"):
        for node in ast.parse((ROOT / f"python/temper/{source}.py").read_text(encoding="utf-8")).body:
            if isinstance(node, ast.ImportFrom) and node.level == 1:
                for alias in node.names:
                    modules.setdefault(node.module or alias.name, []).append(alias.name)
    del modules["types"]  # what is in it is on the pages of the functions
    for module, names in modules.items():
        file = ROOT / f"python/temper/{module}.py"
        if not file.exists():  # the compiled half
            continue
        words = ast.get_docstring(ast.parse(file.read_text(encoding="utf-8"))) or ""
        title = TITLES.get(module, module.strip("_").replace("_", " ").capitalize())
        if not module.startswith("_"):
            yield f"{module}.md", f"temper.{module}", f"# temper.{module}\n\n::: temper.{module}\n    options: {{show_root_heading: false}}\n"
            continue
        names.sort(key=lambda name: not name[0].islower())  # functions first
        parts = [f"::: temper.{module}.{name}\n" for name in names if name != "OptimizeOptions"]
        if "OptimizeOptions" in names:
            parts.insert(0, options_table())
        yield f"{module.strip('_')}.md", title, f"# {title}\n\n{words.splitlines()[0] if words else ''}\n\n" + "\n".join(parts)


def options_table():
    """The options of optimize, from the table of the module itself."""
    import temper

    lines = ["## OptimizeOptions\n", "All options of `optimize`, which takes each as a keyword, too.\n"]
    group = None
    for row in temper._temper.option_table():
        if row["group"] != group:
            group = row["group"]
            lines += [f"\n### {group}\n", "| option | type | default | |", "|-|-|-|-|"]
        cells = [f"`{row['name']}`", f"`{row['type']}`", f"`{row['default']!r}`", row["sentence"].replace("|", "\\|")]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def gallery_page(folder):
    """The figures that `temper paper reproduce` wrote, or how to make them."""
    text = "# Figures of the paper\n\n`temper paper reproduce -o gallery` makes each figure of the paper again, with its claims; "
    text += "[The paper](explanation/paper.md) discusses them.\n\n"
    if folder is None:
        return text + "This site was built without them.\n"
    text += '<a href="gallery/index.html">All figures, with claims and tables</a>\n\n'
    return text + "\n".join(f'<a href="gallery/index.html"><img src="gallery/{svg.name}" alt="{svg.stem}" width="32%"></a>'
                            for svg in sorted(folder.glob("fig*.svg")))  # fmt: skip


def playground_page(folder):
    text = "# Playground\n\ntemper in the browser: nothing to install, and no mesh leaves the machine.\n\n"
    return text + ('<a href="playground/index.html">Open the playground</a>\n' if folder else "This site was built without it.\n")


def folder_of(variable):
    """A folder with an index.html that the environment names."""
    name = os.environ.get(variable)
    if not name:
        return None
    folder = pathlib.Path(name)
    if not (folder / "index.html").is_file():
        raise SystemExit(f"docs: {variable} is {name}, where no index.html is")
    return folder


def on_config(config):
    """References into the navigation, before MkDocs looks at it."""
    config["generated"] = generated = {}
    config["whole"] = whole = "mkdocstrings" in config.plugins  # links.yml has not what needs a build
    cpp = cpp_reference.pages(ROOT / "include") if whole else {}
    python = list(python_pages()) if whole else []
    generated.update({f"cpp/{name}.md": text for name, text in cpp.items()})
    generated.update({f"python-reference/{name}": text for name, _, text in python})
    generated["gallery.md"] = gallery_page(folder_of("TEMPER_GALLERY"))
    generated["playground.md"] = playground_page(folder_of("TEMPER_PLAYGROUND"))
    reference = next(entry for entry in config["nav"] if "Reference" in entry)
    reference["Reference"][:0] = [
        {"Python API": [{title: f"python-reference/{name}"} for name, title, _ in python]},
        {"C++ API": [{name: f"cpp/{name}.md"} for name in cpp]},
    ]
    return config


def on_files(files, config):
    for page, text in config["generated"].items():
        files.append(File.generated(config, page, content=text))
    for file, page in ELSEWHERE.items():
        files.append(File.generated(config, page, content=(ROOT / file).read_text(encoding="utf-8")))
    pages = [place for place in map(repository_place, (f.src_uri for f in files.documentation_pages())) if place]
    for origin in pages:  # grows: what is linked may link more
        for _, target in relative_links((ROOT / origin).read_text(encoding="utf-8"), origin):
            place = target and site_place(target)
            if not place or not place.startswith(("repository/", "source/")) or files.get_file_from_path(place):
                continue
            text = (ROOT / target).read_text(encoding="utf-8") if target.endswith(".md") else source_page(target)
            file = File.generated(config, place, content=text)
            file.inclusion = InclusionLevel.NOT_IN_NAV
            files.append(file)
            if target.endswith(".md"):
                pages.append(target)
    return files


def on_page_markdown(markdown, page, config, files):
    if page.file.src_uri.startswith(NOT_SEARCHED):
        page.meta["search"] = {"exclude": True}
    origin = repository_place(page.file.src_uri)
    if origin is None:
        return markdown
    here = posixpath.dirname(page.file.src_uri)

    def moved(match):
        if not match[2] or re.match(r"[a-z]+:", match[2]):
            return match[0]
        target = target_of(match[2], origin)
        if target is None:
            return match[0]
        return match[1] + posixpath.relpath(site_place(target), here or ".") + (match[3] or "") + match[4]

    def shown(piece):
        # GitHub wants a bar in code escaped where it is in a table; here it would show.
        return CODE.sub(lambda code: code[0].replace("\\|", "|"), LINK.sub(moved, piece))

    if config["whole"]:
        markdown = names.filled(records.filled(verbs.filled(markdown)))
    return "".join(piece if piece.startswith("```") else shown(piece) for piece in FENCE.split(markdown))


def on_page_content(html, page, config, files):
    """The lists that the module puts into its docstrings when it is imported."""
    if page.file.src_uri.startswith("python-reference/"):
        from temper import _options

        for name, words in _options.PRESETS.items():
            rows = "".join(f"<li><code>{word}</code>: {meaning}.</li>" for word, meaning in words.items())
            html = html.replace(f"<p>[{name}]</p>", f"<ul>{rows}</ul>")
    return html


def on_post_build(config):
    site = pathlib.Path(config["site_dir"])
    for variable, name in (("TEMPER_GALLERY", "gallery"), ("TEMPER_PLAYGROUND", "playground")):
        folder = folder_of(variable)
        if folder:
            shutil.copytree(folder, site / name, dirs_exist_ok=True)

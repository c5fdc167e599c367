"""The C++ reference as Markdown, a page for each public header, from Doxygen's XML.

A page opens with what the first lines of its header say; classes and functions follow in the order of the header.
"""

import pathlib
import re
import subprocess
import tempfile
import xml.etree.ElementTree as ElementTree

DOXYFILE = """
INPUT = {include}/temper
STRIP_FROM_PATH = {include}
GENERATE_HTML = NO
GENERATE_LATEX = NO
GENERATE_XML = YES
XML_PROGRAMLISTING = NO
OUTPUT_DIRECTORY = {output}
EXTRACT_ALL = YES
SORT_MEMBER_DOCS = NO
QUIET = YES
WARN_AS_ERROR = FAIL_ON_WARNINGS
"""


def escaped(text):
    return re.sub(r"([\\*_\[\]|<>])", r"\\\1", text)


def inline(element):
    parts = [escaped(element.text or "")]
    for child in element:
        if child.tag == "computeroutput":
            parts.append(f"`{''.join(child.itertext())}`")
        elif child.tag not in ("verbatim", "itemizedlist", "blockquote", "zwj"):
            parts.append(inline(child))
        parts.append(escaped(child.tail or ""))
    return "".join(parts)


def blocks(description):
    """Paragraphs of a description, as Markdown."""
    if description is None:
        return
    for para in description.findall("para"):
        text = " ".join(inline(para).split())
        if text:
            yield text
        for child in para:
            if child.tag == "verbatim":
                yield f"```text\n{(child.text or '').rstrip()}\n```"
            elif child.tag == "itemizedlist":
                yield "\n".join("- " + " ".join(blocks(item)) for item in child.findall("listitem"))
            elif child.tag == "blockquote":
                yield "> " + " ".join(blocks(child))


def said(member):
    return [*blocks(member.find("briefdescription")), *blocks(member.find("detaileddescription"))]


def text_of(element):
    """Text, with C++ as the house writes it: Doxygen puts spaces around angle brackets and before stars."""
    text = "".join(element.itertext()).strip() if element is not None else ""
    return re.sub(r" (?=[*&]+(?:\W|$))", "", text.replace("< ", "<").replace(" >", ">"))


def template_of(element):
    parameters = element.find("templateparamlist")
    if parameters is None:
        return ""
    names = (" ".join(filter(None, (text_of(p.find("type")), text_of(p.find("declname"))))) for p in parameters)
    return f"template <{', '.join(names)}>\n"


def declaration(member):
    kind, name = member.get("kind"), member.find("name").text
    type_, initializer = text_of(member.find("type")), text_of(member.find("initializer"))
    if kind == "function":
        storage = "static " if member.get("static") == "yes" and "static" not in type_ else ""
        return f"{template_of(member)}{storage}{type_ + ' ' if type_ else ''}{name}{text_of(member.find('argsstring'))};"
    if kind == "typedef":
        return f"{template_of(member)}using {name} = {type_};"
    if kind == "enum":
        values = ", ".join(value.find("name").text for value in member.findall("enumvalue"))
        return f"enum class {name} {{ {values} }};"
    return f"{template_of(member)}{type_} {name}{text_of(member.find('argsstring'))}{' ' + initializer if initializer else ''};"


def entry(member, level):
    lines = [f"{'#' * level} `{member.find('name').text}`", f"```cpp\n{declaration(member)}\n```", *said(member)]
    for value in member.findall("enumvalue"):
        words = " ".join(said(value))
        if words:
            lines.append(f"`{value.find('name').text}`: {words}")
    return "\n\n".join(lines)


def fields(members):
    """Data members as a table."""
    rows = ["| field | type | |", "|-|-|-|"]
    for member in members:
        type_, initializer = text_of(member.find("type")), text_of(member.find("initializer")).lstrip("= ")
        shown = f"`{type_}`" + (f" = `{initializer}`" if initializer and "\n" not in initializer else "")
        words = " ".join(said(member)).replace("\n", " ")
        rows.append(f"| `{member.find('name').text}` | {shown} | {words} |")
    return "\n".join(rows)


def compound(element, level):
    """A class or struct: what it is, its fields, its functions."""
    name = element.find("compoundname").text.removeprefix("temper::")
    lines = [f"{'#' * level} `{name}`", f"```cpp\n{template_of(element)}{element.get('kind')} {name};\n```", *said(element)]
    members = [m for m in element.iter("memberdef") if m.get("prot") == "public"]
    data = [m for m in members if m.get("kind") == "variable"]
    if data:
        lines.append(fields(data))
    for member in members:
        name, rest = member.find("name").text, text_of(member.find("argsstring"))
        if member.get("kind") not in ("variable", "friend") and not name.startswith("~") and not rest.endswith("delete"):
            lines.append(entry(member, level + 1))
    return "\n\n".join(lines)


def opening_of(header):
    """The comment that a header begins with: paragraphs, and drawings, which are indented."""
    lines = []
    for line in header.read_text(encoding="utf-8").splitlines():
        if not line.startswith("//"):
            break
        lines.append(line.removeprefix("//").removeprefix(" "))
    parts = []
    for paragraph in re.split(r"\n\s*\n", "\n".join(lines)):
        drawn = any(line.startswith("  ") for line in paragraph.splitlines())
        parts.append(f"```text\n{paragraph}\n```" if drawn else escaped(" ".join(paragraph.split())))
    return "\n\n".join(parts)


def pages(include):
    """{header below temper/: Markdown}; what users include comes first."""
    found = {}
    with tempfile.TemporaryDirectory() as output:
        doxyfile = DOXYFILE.format(include=include, output=output)
        subprocess.run(["doxygen", "-"], input=doxyfile, text=True, check=True)
        for file in sorted(pathlib.Path(output, "xml").glob("*.xml")):
            for element in ElementTree.parse(file).getroot().findall("compounddef"):
                if element.get("kind") in ("class", "struct") and element.get("prot") != "private":
                    place = element.find("location")
                    text = compound(element, 2)
                    found.setdefault(place.get("file"), []).append((int(place.get("line")), text))
                elif element.get("kind") == "namespace" and element.find("compoundname").text.startswith("temper"):
                    for member in element.iter("memberdef"):
                        place = member.find("location")
                        found.setdefault(place.get("file"), []).append((int(place.get("line")), entry(member, 2)))
    result = {}
    for folder in ("", "tets", "detail"):
        for header in sorted(pathlib.Path(include, "temper", folder).glob("*.hpp")):
            name = header.relative_to(include).as_posix()
            entries = dict.fromkeys(text for _, text in sorted(found.get(name, [])))
            words = [f"# {name}", opening_of(header), f"```cpp\n#include \"{name}\"\n```", *entries]
            result[name.removeprefix("temper/")] = "\n\n".join(words)
    return result

"""The help of the verbs, as the pages of docs/reference/cli have it in the site.

A page has two marks, and hooks.py puts a block of text below each:

    <!-- summary of temper VERB -->     what the verb does, its usage and examples
    <!-- options of temper VERB -->     its options, without those of several verbs
    <!-- options of several verbs -->   these

`temper` is found on PATH.
"""

import functools
import re
import subprocess
import textwrap

MARK = re.compile(r"^<!-- (?P<what>summary|options) of (?:temper (?P<verb>[a-z ]+)|several verbs) -->$", re.M)
PAGE = "# temper {0}\n\n<!-- summary of temper {0} -->\n\n## All options\n\n<!-- options of temper {0} -->\n"


@functools.cache
def helped(*words):
    return subprocess.run(["temper", *words], check=True, capture_output=True, text=True).stdout


def verbs():
    return re.findall(r"^  ([a-z]+(?: [a-z]+)?)  ", re.search(r"^Verbs:\n(.*?)(?:\n\n|\Z)", helped("--help"), re.M | re.S)[1], re.M)


def filled(page):
    """The page with a block of text below each mark."""
    def block(mark):
        text = summary(mark["verb"]) if mark["what"] == "summary" else options(mark["verb"])
        return f"{mark[0]}\n```{{.text .help}}\n{text}```"

    return MARK.sub(block, page)


def summary(verb):
    said = helped(*verb.split(), "--help-all") + "\n"
    parts = [said.partition("\n\nUsage:")[0]]
    parts += re.findall(r"^(?:Usage:.*?|Examples:\n.*?)(?=\n\n)", said, re.M | re.S)
    return "\n\n".join(parts) + "\n"


def rows_of(verb):
    """The sections of the help: title -> rows, each with all its lines."""
    found = {}
    for section in re.split(r"\n\n(?=\S[^\n]*:\n)", helped(*verb.split(), "--help-all").rstrip()):
        title, _, rows = section.partition("\n")
        if title.endswith(":") and not title.startswith(("Usage", "Examples", "Exit codes", "Solvers by name")):  # docs/howto/choose.md has those
            found.setdefault(title, []).extend(re.split(r"\n+(?=  \S)", rows))
    return found


def set_by_flag(row, sections):
    """Whether the row is NAME=VALUE for --set, and there is a flag --NAME, too."""
    name = re.match(r"  ([a-z]\w*)=", row)
    flag = name and "--" + name[1].replace("_", "-") + " "
    return bool(flag) and any(each.lstrip().startswith(flag) for rows in sections.values() for each in rows)


def options(verb):
    """Options of a verb, or without one those with the same words in the help of three verbs or more."""
    every = [row for each in verbs() if " " not in each and each != "example" for rows in rows_of(each).values() for row in rows]
    common = [row for row in dict.fromkeys(every) if every.count(row) > 2 and "--" in row]
    if not verb:
        return "\n".join(row for row in common if "--for TARGET" not in row) + "\n"
    if verb == "example":
        return examples()
    text, also, sections = [], [], rows_of(verb)
    for title, rows in sections.items():
        own = [row for row in rows if row not in common or "--for TARGET" in row and verb == "optimize"]
        also += [re.search(r"--[a-z][\w-]*", row)[0] for row in rows if row not in own]
        own = [row for row in own if not set_by_flag(row, sections)]
        text += ["\n".join([title, *own])] if own else []
    text += [textwrap.fill("Options of several verbs: " + ", ".join(also) + ".", 100, break_on_hyphens=False)] if also else []
    return "\n\n".join(text) + "\n"


def examples():
    """Each example on a line, and below it its options with their defaults."""
    text = "temper example NAME --help says what each option of NAME means. These are the defaults:\n"
    for name, what, rows in re.findall(r"^([a-z-]+): ([^\n]*)((?:\n+  .*)*)", helped("example", "--help-all"), re.M):
        words = []
        for flag, value, meaning in re.findall(r"^  (--[a-z]+)( \S+)?(.*(?:\n {4,}.*)*)", rows, re.M):
            default = re.search(r"\(default:\s+(\S+)\)$", meaning)
            words.append(f"{flag} {default[1]}" if default else flag + value)
        text += "\n".join(["", f"{name}: {what}", *(["  " + " ".join(words)] if words else []), ""])
    return text

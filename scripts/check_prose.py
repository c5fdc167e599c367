#!/usr/bin/env python3
"""Counts sentences that a reader must read twice, and fails if a group of files has too many.

    scripts/check_prose.py                  checks every group of the table GROUPS
    scripts/check_prose.py --list FILE ...  prints each sentence that breaks a rule
    scripts/check_prose.py --self-test      checks that each rule finds a planted sentence

The checker reads prose only: paragraphs of Markdown, comments of C++, comments and docstrings of Python. It skips code, tables,
headings and the targets of links. A code span counts as one word. scripts/docs/pages.py has the help of the program read.
"""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]

# Group: files, and the largest allowed share of sentences that break a rule [%].
GROUPS = {
    "pages": (["README.md", "CONTRIBUTING.md", "docs/*.md"], 8.0),
    "how-tos": (["docs/howto/*.md", "docs/tutorial/*.md"], 8.0),
    "public headers": (["include/*.hpp"], 11.0),
    "src": (["src/*.cpp", "src/*.hpp"], 12.0),
    "apps": (["apps/*.cpp", "apps/*.hpp"], 12.0),
    "Python": (["python/*.py"], 12.0),
}  # fmt: skip

HELP_LIMIT = 8.0  # the same for the help of the program
MOST_WORDS = 30

# Rule: what it forbids, and a sentence that breaks this rule alone.
RULES = {
    "the subject comes first": (
        r"^(What|Who|Whoever|Whatever|Which|Whether|How)\b[^?]*$", "What the band holds in place keeps a weight."),
    "a condition is if or when": (
        r"(?:^|[,;:] )[Ww]here (?:there|it|they|this|that|no|one|all|some|an?|the|these|those) ", "Where the mesh is bad, sweeps go on."),
    "a sentence names its thing": (r"^(Of|That of|Those of|That are|The same)\b", "Of positions only a few are new."),
    "the noun is repeated": (r"\b(that|those) of\b|\bthe (latter|former)\b|\bthe ones? (of|that)\b", "The error equals that of the input."),
    "two semicolons or parentheses": (r";.*;|\(.*\(", "One (or two) vertices (or none) move."),
    "at most, at least, except": (
        r"\bbut for\b|\bso many\b|\ball the same\b|\bas yet\b|\b(?:is|are) (?:not )?so[,.;:]|\bno (?:more than|less)\b",
        "Nothing was written but for one file."),
    "per": (r"\b(?:bytes?|ns|µs|ms|seconds?|one|tuple|row) an? [a-z]+", "It takes 80 bytes a vertex."),
    "only people want and know": (
        r"\b(?:wants?|knows?|hears?|is asked|are asked|tells? (?:the|its)|says? so)\b", "The driver wants two sweeps."),
    "words of the field": (
        r"\b(?:mend(?:s|ed)?|kick(?:s|ed)?|whoever|anew|programmes?|middles|passed over|weighed)\b", "Repairs kick a vertex first."),
    "no diary": (r"Since then|before the (?:last )?changes?|was (?:measured|tried)\b|another day", "Since then two sweeps are enough."),
    "American spelling": (r"[Oo]ptimis|[Cc]olour|[Nn]eighbour", "The neighbours of a vertex move."),
}  # fmt: skip


def paragraphs(path, text):
    if path.suffix == ".md":
        text = re.sub(r"```.*?```|<!--.*?-->", "\n\n", text, flags=re.S)
        lines = [re.sub(r"^\s*([-*]|\d+\.)\s+", "\n", line) for line in text.split("\n")]
        text = "\n".join("" if re.match(r"\s*(\||#|!\[)", line) else line for line in lines)
    elif path.suffix in (".hpp", ".cpp"):
        text = "\n".join(comment(line) for line in text.split("\n"))
    else:
        text = "\n\n".join(re.findall(r'"""(.*?)"""', text, flags=re.S) + re.findall(r"(?:^|\s)#\s(.*)", text))
    text = re.sub(r"`[^`]*`", "CODE", text)
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"[*_]{1,2}([^*_]+)[*_]{1,2}", r"\1", text)
    return [" ".join(part.split()) for part in re.split(r"\n\s*\n", text)]


def paragraphs_of_help(text):
    """The sentences of a help: those above the usage, and the right column of each list."""
    help_text = re.sub(r"^(?:Usage|Examples):.*?(?=^\S|\Z)", "", text, flags=re.S | re.M)
    rows = re.sub(r"^ {2,6}\S.*?(?:  +|$)", "\n\n", help_text, flags=re.M)
    found = [" ".join(part.split()) for part in re.split(r"\n\s*\n|^\S.*:$", rows, flags=re.M)]
    return [re.sub(r" \(default: .*\)$", "", part) for part in found]


def comment(line):
    """The comment of a line of C++. A comment behind code is a paragraph of its own."""
    found = re.search(r"//[/<]*\s?(.*)", line)
    if not found:
        return ""
    return found[1] if line.lstrip().startswith("//") else f"\n\n{found[1]}\n"


def sentences(found):
    for paragraph in found:
        for sentence in re.split(r"(?<=[.!?])\s+(?=[A-Z0-9\"'(])", paragraph):
            if len(sentence.split()) >= 4:
                yield sentence


def broken_rules(sentence):
    rules = [rule for rule, (pattern, _) in RULES.items() if re.search(pattern, sentence)]
    return rules + (["at most 30 words"] if len(sentence.split()) > MOST_WORDS else [])


def read(name):
    path = ROOT / name
    return list(sentences(paragraphs(path, path.read_text(encoding="utf-8"))))


def wrong_in_help(texts):
    """The sentences that break a rule, if they are more than the limit allows."""
    found = [sentence for text in texts for sentence in sentences(paragraphs_of_help(text))]
    wrong = [sentence for sentence in found if broken_rules(sentence)]
    return wrong if 100 * len(wrong) > HELP_LIMIT * len(found) else []


def check():
    failures = 0
    for group, (patterns, limit) in GROUPS.items():
        names = subprocess.run(["git", "ls-files", *patterns], cwd=ROOT, check=True, capture_output=True, text=True).stdout.split()
        if group == "pages":
            names = [name for name in names if not name.startswith(("docs/howto/", "docs/tutorial/"))]
        found = [broken_rules(sentence) for name in names for sentence in read(name)]
        share = 100 * sum(map(bool, found)) / max(1, len(found))
        failed = not found or share > limit
        failures += failed
        print(f"{group}: {share:.1f} % of {len(found)} sentences break a rule, at most {limit:.0f} %{' FAILED' if failed else ''}")
    return failures > 0


def self_test():
    wrong = [rule for rule, (_, planted) in RULES.items() if broken_rules(planted) != [rule]]
    long = " ".join(["word"] * (MOST_WORDS + 1))
    wrong += ["at most 30 words"] if broken_rules(long) != ["at most 30 words"] else []
    cpp = list(sentences(paragraphs(pathlib.Path("x.cpp"), "int x = 0;  // The first one is here.\n// The second\n// one is there.\n")))
    wrong += ["comments"] if cpp != ["The first one is here.", "The second one is there."] else []
    page = list(sentences(paragraphs(pathlib.Path("x.md"), "# A title is no sentence\n\n```\nno code is read here.\n```\nSee [the other page](x.md).\n")))
    wrong += ["pages"] if page != ["See the other page."] else []
    row = "Says a lot to you.\n\nUsage: temper x\n\nGroup:\n  -a, --all N       The row of one option\n                    has two lines. (default: 2)\n"
    told = list(sentences(paragraphs_of_help(row)))
    wrong += ["help"] if told != ["Says a lot to you.", "The row of one option has two lines."] else []
    print(f"check_prose: {len(RULES) + 4 - len(wrong)} of {len(RULES) + 4} cases of the self-test pass", *wrong, sep="\n  ")
    return bool(wrong)


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    if arguments[:1] == ["--list"]:
        for name in arguments[1:]:
            for sentence in read(pathlib.Path(name).resolve().relative_to(ROOT)):
                for rule in broken_rules(sentence):
                    print(f"{name}: {rule}: {sentence}")
        return False
    return check()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

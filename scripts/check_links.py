#!/usr/bin/env python3
"""Checks that no link in the repository's Markdown is dead, as GitHub shows it, or in a built site.

    scripts/check_links.py               every *.md that git knows: files, folders and anchors
    scripts/check_links.py --site DIR    every page of the site in DIR: files and anchors
    scripts/check_links.py --self-test   plants dead links and expects each to be found

Nothing outside is asked: links with a scheme are passed over. Exit 1 and one line a dead link: file:line: why.
"""

import html.parser
import pathlib
import re
import subprocess
import sys
import tempfile
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parent.parent
FENCE = re.compile(r"^ {0,3}(```+|~~~+)")
HEADING = re.compile(r"^ {0,3}#{1,6}\s+(.*?)\s*#*\s*$")
CODE = re.compile(r"(`+)(?:.(?!\1))*.?\1")
LINK = re.compile(r"!?\[(?:[^\[\]]|\[[^\]]*\])*\]\(\s*<?([^()\s<>]*(?:\([^()\s]*\)[^()\s<>]*)*)>?(?:\s+\"[^\"]*\")?\s*\)")
REFERENCE = re.compile(r"^ {0,3}\[[^\]]+\]:\s*<?(\S+?)>?(?:\s+\"[^\"]*\")?\s*$")


def prose_of(text):
    """(number, line) without fenced code; inline code is cut out of the lines that are looked through for links."""
    fence = None
    for number, line in enumerate(text.splitlines(), 1):
        mark = FENCE.match(line)
        if mark and fence is None:
            fence = mark[1]
        elif mark and mark[1].startswith(fence):
            fence = None
        elif fence is None:
            yield number, line


def slug(heading):
    """The anchor that GitHub makes of a heading: words, hyphens for spaces, nothing else."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    text = re.sub(r"[*`]|(?<!\w)_|_(?!\w)", "", text).lower()
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


def anchors_of(text):
    anchors, seen = set(), {}
    for _, line in prose_of(text):
        heading = HEADING.match(line)
        if heading:
            base = slug(heading[1])
            count = seen.get(base, 0)
            seen[base] = count + 1
            anchors.add(base if count == 0 else f"{base}-{count}")
        anchors.update(re.findall(r"<a (?:id|name)=\"([^\"]+)\"", line))
    return anchors


def split(target):
    path, _, anchor = target.partition("#")
    return urllib.parse.unquote(path), urllib.parse.unquote(anchor)


def outside(target):
    return re.match(r"[a-z][a-z0-9+.-]*:|//", target, re.I)


def dead_in_markdown(root, pages):
    texts = {page: page.read_text(encoding="utf-8") for page in pages}
    anchors = {page: anchors_of(text) for page, text in texts.items()}
    for page, text in texts.items():
        for number, line in prose_of(text):
            bare = CODE.sub("", line)
            for target in LINK.findall(bare) + REFERENCE.findall(bare):
                if outside(target):
                    continue
                path, anchor = split(target)
                file = (root / path.lstrip("/") if path.startswith("/") else page.parent / path).resolve() if path else page
                where = f"{page.relative_to(root)}:{number}"
                if not file.exists() or not file.is_relative_to(root):
                    yield f"{where}: no file {path}"
                elif anchor and file in anchors and anchor not in anchors[file]:
                    yield f"{where}: no heading #{anchor} in {path or page.name}"


class PageLinks(html.parser.HTMLParser):
    """Links and anchors of a page of HTML."""

    def __init__(self, text):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("href", "src") and value is not None and not (tag == "link" and ("rel", "canonical") in attributes):
                self.links.append((self.getpos()[0], value))
            elif name in ("id", "name") and value:
                self.anchors.add(value)


def dead_in_site(site):
    pages = {page: PageLinks(page.read_text(encoding="utf-8", errors="replace")) for page in sorted(site.rglob("*.html"))}
    for page, found in pages.items():
        base = site if page.name == "404.html" else page.parent
        for number, target in found.links:
            if outside(target):
                continue
            path, anchor = split(target)
            path = path.partition("?")[0]
            file = (site / path.lstrip("/") if path.startswith("/") else base / path).resolve() if path else page
            file = file / "index.html" if file.is_dir() else file
            where = f"{page.relative_to(site)}:{number}"
            if not file.exists():
                yield f"{where}: no file {path}"
            elif anchor and not anchor.startswith("__") and file in pages and anchor not in pages[file].anchors:
                yield f"{where}: no anchor #{anchor} in {path or page.name}"


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder).resolve()
        (root / "a.md").write_text(
            "# A *b*, `c_d` (e)\n[1](b.md) [2](#a-b-c_d-e) [3](b.md#h-1)\n`[no](x.md)`\n```\n[no](y.md)\n```\n"
            "[4](c.md)\n[5](b.md#g)\n[6](#h)\n![7](p(1).svg)\n[8]: d.md\n[9](https://e.org/f.md)\n[10](../up.md)\n")
        (root / "b.md").write_text("# H\n\n# H\n")
        dead = list(dead_in_markdown(root, [root / "a.md", root / "b.md"]))
        lines = [int(message.split(":")[1]) for message in dead]
        assert lines == [7, 8, 9, 10, 11, 13], dead
        site = root / "site"
        site.mkdir()
        (site / "index.html").write_text('<p id="x"></p>\n<a href="#x"></a>\n<a href="#y"></a>\n<img src="z.png">\n<a href=".">')
        dead = list(dead_in_site(site))
        assert [int(message.split(":")[1]) for message in dead] == [3, 4], dead


def main():
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        return 0
    if sys.argv[1:2] == ["--site"] and len(sys.argv) == 3:
        site = pathlib.Path(sys.argv[2]).resolve()
        dead, what = list(dead_in_site(site)), f"{len(list(site.rglob('*.html')))} pages"
    elif len(sys.argv) == 1:
        names = subprocess.run(["git", "ls-files", "-z", "*.md"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
        pages = [ROOT / name for name in names.split("\0") if name and (ROOT / name).exists()]
        dead, what = list(dead_in_markdown(ROOT, pages)), f"{len(pages)} files"
    else:
        print(__doc__, file=sys.stderr)
        return 2
    print("\n".join(dead) or f"check_links: no dead link in {what}")
    return len(dead) > 0


if __name__ == "__main__":
    sys.exit(main())

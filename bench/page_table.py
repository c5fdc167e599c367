"""The table of a page that a benchmark writes: between `<!-- written by bench/NAME.py -->` and `<!-- end -->`."""

import argparse
import pathlib
import re
import sys


def main(doc, page, table):
    """The command line of such a benchmark. `table` measures, and returns the lines; with --write they go into the page."""
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true")
    write = parser.parse_args().write
    made = table()
    if write:
        place = re.compile(rf"(?<=<!-- written by bench/{pathlib.Path(sys.argv[0]).name} -->\n)(?:\|.*\n)*(?=<!-- end -->)")
        page.write_text(place.sub(lambda _: made, page.read_text(encoding="utf-8")), encoding="utf-8")

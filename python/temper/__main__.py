"""``python -m temper VERB …``: runs the command line program, like ``temper VERB …``."""

import os
import pathlib
import shutil
import sys


def main() -> None:
    """Replaces this process by the program of the package, or else by the program on the path."""
    bundled = pathlib.Path(__file__).parent / "bin" / "temper"
    program = str(bundled) if bundled.exists() else shutil.which("temper")
    if program is None:
        sys.exit(f"temper: error: the program is neither in {bundled.parent} nor on the path; expected it in one of them")
    os.execv(program, [program, *sys.argv[1:]])


if __name__ == "__main__":
    main()

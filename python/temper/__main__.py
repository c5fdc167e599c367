"""``python -m temper VERB …``: runs the command line program, like ``temper VERB …``."""

import os
import pathlib
import shutil
import signal
import subprocess
import sys
import sysconfig


def main() -> None:
    """Runs the program of the package, of Python's folder of scripts, or of the path: the first that is there."""
    folders = [str(pathlib.Path(__file__).parent / "bin"), sysconfig.get_path("scripts")]
    program = shutil.which("temper", path=os.pathsep.join([*folders, os.environ.get("PATH", os.defpath)]))
    if program is None:
        sys.exit(f"temper: error: the program is neither in {folders[0]} nor on the path; expected it in one of them")
    if os.name == "nt":  # where a process cannot become another one, and the program alone answers Ctrl-C
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        sys.exit(subprocess.call([program, *sys.argv[1:]]))
    os.execv(program, [program, *sys.argv[1:]])


if __name__ == "__main__":
    main()

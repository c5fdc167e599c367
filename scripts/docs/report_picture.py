#!/usr/bin/env python3
"""Makes docs/figures/report.jpg: the HTML report of a run on the ring, as Chromium shows it. Needs Chromium and Pillow.

    /usr/bin/python3 scripts/docs/report_picture.py PROGRAM
"""

import pathlib
import subprocess
import sys
import tempfile

from PIL import Image

FIGURE = pathlib.Path(__file__).resolve().parent.parent.parent / "docs/figures/report.jpg"
SIZE = (1300, 720)  # pixels


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as folder:
        run = lambda *words: subprocess.run(words, cwd=folder, check=True, capture_output=True, timeout=300)  # noqa: E731
        run(program, "example", "annulus", "-o", "ring.vtu")
        run(program, "optimize", "ring.vtu", "-o", "better.vtu", "--write", "report.html")
        page = (pathlib.Path(folder) / "report.html").as_uri()
        # Chromium draws WebGL without a graphics card, and waits for it. The budget is the page's own time until the picture.
        run("chromium", "--headless", "--no-sandbox", "--hide-scrollbars", "--enable-unsafe-swiftshader",
            "--run-all-compositor-stages-before-draw", "--virtual-time-budget=10000",
            f"--window-size={SIZE[0]},{SIZE[1]}", "--screenshot=report.png", page)  # fmt: skip
        Image.open(pathlib.Path(folder) / "report.png").convert("RGB").save(FIGURE, quality=85)


if __name__ == "__main__":
    main()

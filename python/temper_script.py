#!python
"""The script `temper` of a wheel: becomes the program in the package without importing the package, so that it starts
fast."""

import importlib.util
import os
import sys

package = importlib.util.find_spec("temper")
if package is None:
    sys.exit("temper: error: the Python package temper, which has the program, is not installed beside this script")
program = os.path.join(os.path.dirname(package.origin), "bin", "temper")
os.execv(program, [program, *sys.argv[1:]])

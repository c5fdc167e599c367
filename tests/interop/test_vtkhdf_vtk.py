"""VTKHDF both ways between temper and VTK itself: what is in the files, to the last bit. Skipped where Python has no VTK.

test_vtkhdf_vtk.py PROGRAM
"""

import os
import sys
import tempfile

from checks import check, checks_made
from program import convert

SKIPPED = 77  # as CMakeLists.txt has it

try:
    import numpy
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(SKIPPED)

# Weights, regions, a line, a marked point, names ("1 8 coast") and data of several types; arrays are in the order of
# their names, in which VTK writes them.
EVERYTHING = """# vtk DataFile Version 3.0
a square
ASCII
DATASET UNSTRUCTURED_GRID
FIELD fields 2
physical_names 1 10 unsigned_char
49 32 56 32 99 111 97 115 116 10
time 1 1 double
0.1
POINTS 4 double
0 0 0.5 1 0 0.5 1.1 1 0.5 0 0.3 0.5
CELLS 4 13
3 0 1 2 3 0 2 3 2 0 1 1 3
CELL_TYPES 4
5 5 3 1
POINT_DATA 4
SCALARS weight double 1
LOOKUP_TABLE default
0 0.01 -0.02 1e-30
FIELD more 2
count 1 4 long
1 -2 3 4000000000
pair 2 4 short
1 2 3 4 5 6 7 -8
VECTORS velocity float
1 2 3 4 5 6 7 8 9 10 11 12.5
CELL_DATA 4
FIELD more 2
region 1 4 int
3 -4 8 9
byte 1 4 unsigned_char
0 1 254 255
"""


def what_vtk_says(folder):
    """VTK reads what temper writes, and the other way round."""
    start, path, vtu, back = (os.path.join(folder, name) for name in ("s.vtk", "v.vtkhdf", "v.vtu", "w.vtkhdf"))
    with open(start, "w") as file:
        file.write(EVERYTHING)
    convert(start, path)
    convert(path, vtu)
    grids = []
    for reader, name in ((vtk.vtkHDFReader(), path), (vtk.vtkXMLUnstructuredGridReader(), vtu)):
        reader.SetFileName(name)
        reader.Update()
        grids.append(reader.GetOutput())
    mine, other = grids
    same = lambda a, b: numpy.array_equal(vtk_to_numpy(a), vtk_to_numpy(b))
    check(mine.GetNumberOfCells() == 4, "VTK reads triangles, a line and a point")
    check(same(mine.GetPoints().GetData(), other.GetPoints().GetData()), "VTK reads the points of the VTU")
    check(same(mine.GetCells().GetConnectivityArray(), other.GetCells().GetConnectivityArray()), "and its cells")
    for data in ("GetPointData", "GetCellData", "GetFieldData"):
        a, b = getattr(mine, data)(), getattr(other, data)()
        names = sorted(a.GetArrayName(i) for i in range(a.GetNumberOfArrays()))
        check(names == sorted(b.GetArrayName(i) for i in range(b.GetNumberOfArrays())), f"arrays of {data}: {names}")
        check(all(same(a.GetArray(name), b.GetArray(name)) for name in names), f"numbers of {data}")
    if hasattr(vtk, "vtkHDFWriter"):
        writer = vtk.vtkHDFWriter()
        writer.SetFileName(back)
        writer.SetInputData(mine)
        writer.Write()
        again = os.path.join(folder, "again.vtu")
        convert(back, again)
        with open(vtu, "rb") as a, open(again, "rb") as b:
            check(a.read() == b.read(), "through VTK's own file the VTU is the same")


with tempfile.TemporaryDirectory() as temporary:
    what_vtk_says(temporary)
print(f"{checks_made()} checks")

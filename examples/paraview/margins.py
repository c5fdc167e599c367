"""Colors the margins of a mesh in ParaView: red triangles or tetrahedra are bad, blue ones are safe.

    pvpython margins.py better.vtu [margins.png]    a file, and a picture of it
    Tools, Python Shell, Run Script                 in ParaView: the active source

The margin is the cell data min_h_over_l of temper's VTU and VTKHDF files: the least height of the orthocenter over a side,
relative to the side. Bad cells also get thick edges.
"""

import sys

from paraview import simple

MARGIN = "min_h_over_l"


def color_margins(source, view):
    """Shows the cells of the source in the view, with their margins. Returns the least one."""
    simple.UpdatePipeline(proxy=source)
    array = source.CellData.GetArray(MARGIN)
    if array is None:
        found = ", ".join(source.CellData.keys()) or "none"
        raise RuntimeError(f"expected cell data {MARGIN}, found {found}. Next: temper convert IN -o OUT.vtu adds them")
    cells = simple.ExtractCellsByType(Input=source, CellTypes=["Triangle", "Tetrahedron"])  # others carry tags
    simple.UpdatePipeline(proxy=cells)
    least, largest = cells.CellData.GetArray(MARGIN).GetRange()
    largest = max(-least, largest)

    display = simple.Show(cells, view)
    display.Representation = "Surface With Edges"
    display.EdgeColor = [0.4, 0.4, 0.4]
    simple.ColorBy(display, ("CELLS", MARGIN))
    colors = simple.GetColorTransferFunction(MARGIN)
    colors.ApplyPreset("Cool to Warm", True)
    colors.RescaleTransferFunction(-largest, largest)
    colors.InvertTransferFunction()
    display.SetScalarBarVisibility(view, True)
    bar = simple.GetScalarBar(colors, view)
    bar.Title, bar.ComponentTitle = "margin", ""
    bar.AutomaticLabelFormat, bar.LabelFormat, bar.RangeLabelFormat = False, "%.2f", "%.2f"

    if least <= 0:
        bad = simple.Threshold(Input=cells, Scalars=["CELLS", MARGIN])
        bad.LowerThreshold, bad.UpperThreshold = least, 0.0
        edges = simple.Show(simple.ExtractEdges(Input=bad), view)
        edges.ColorArrayName = ["POINTS", ""]  # one color
        edges.AmbientColor = edges.DiffuseColor = [0.6, 0.0, 0.0]
        edges.LineWidth = 3
    return least


def main():
    source = simple.OpenDataFile(sys.argv[1]) if len(sys.argv) > 1 else simple.GetActiveSource()
    if source is None:
        raise RuntimeError("no file, and no active source. Next: pvpython margins.py FILE.vtu, or select a source in ParaView")
    view = simple.GetActiveViewOrCreate("RenderView")
    if len(sys.argv) > 2:
        view.ViewSize = [960, 640]
    least = color_margins(source, view)
    simple.ResetCamera(view)
    view.CameraParallelProjection = 1
    view.CameraParallelScale *= 0.8
    simple.Render(view)
    if len(sys.argv) > 2:
        simple.SaveScreenshot(sys.argv[2], view, OverrideColorPalette="WhiteBackground")
    print(f"least margin {least:.4g}")


main()

"""What docs/tutorial/modflow.md needs from FloPy and matplotlib: a model of one layer, and its pictures. fault.py runs it, too."""

import json
import pathlib

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.tri import Triangulation

plt.rcParams.update({"svg.hashsalt": "temper", "image.cmap": "cividis", "font.size": 11, "figure.figsize": (7, 4)})
shapes = {}  # name of a feature of the outline -> its points
for feature in json.loads((pathlib.Path(__file__).parent.parent / "aquifer.geojson").read_text(encoding="utf-8"))["features"]:
    shapes[feature["properties"]["name"]] = np.array(feature["geometry"]["coordinates"], float).reshape(-1, 2)
names = [name for name in shapes if name.endswith("well")]
wells = np.concatenate([shapes[name] for name in names])
river_line = np.concatenate([np.linspace(a, b, 20) for a, b in zip(shapes["river"], shapes["river"][1:])])


def distance(points, to):
    """Distance of each point to the nearest point of `to`."""
    return np.linalg.norm(np.asarray(points)[:, None] - to, axis=2).min(axis=1)


def save(picture, title):
    """Adds outline, river, lake and wells, and writes the picture."""
    for name, style, width in ("valley", "k-", 1), ("river", "C0-", 1.5), ("lake", "C0-", 4):
        plt.plot(*shapes[name].T, style, linewidth=width)
    plt.plot(*wells.T, "^", color="tab:red", markeredgecolor="white", markersize=8)
    plt.gca().set_aspect("equal")
    plt.axis("off")
    plt.title(title)
    plt.savefig(picture, metadata={"Date": None}, bbox_inches="tight")
    plt.close()


def contours(points, values, picture, title, triangles=None, **options):
    """Colors between the points, on the mesh's triangles or on Delaunay's."""
    plt.tricontourf(Triangulation(*np.asarray(points).T, triangles), values, **{"levels": 15, "extend": "both", **options})
    plt.colorbar(shrink=0.7)
    save(picture, title)


def draw_cells(vertices, cells, river, well, picture, title):
    """The cells within 350 m of the first well. Cells of the river and the wells have colors."""
    corners = np.array(vertices)[:, 1:]
    for cell in cells:
        if distance([cell[1:3]], wells[:1]) < 350:
            color = "tab:red" if cell[0] in well else "tab:cyan" if river[cell[0]] > 0 else "white"
            plt.fill(*corners[cell[4:]].T, facecolor=color, edgecolor="gray", linewidth=0.5)
    plt.axis("equal")
    plt.axis("off")
    plt.title(title)
    plt.savefig(picture, metadata={"Date": None}, bbox_inches="tight")
    plt.close()


def read_disv(path):
    """Vertices and cells of a DISV file as FloPy takes them, counted from 0."""
    rows = [line.split() for line in open(path, encoding="utf-8")]

    def block(name):
        return rows[rows.index(["BEGIN", name]) + 1 : rows.index(["END", name])]

    vertices = [[int(i) - 1, float(x), float(y)] for i, x, y in block("VERTICES")]
    cells = [[int(i) - 1, float(x), float(y), int(n), *(int(k) - 1 for k in corners)]
             for i, x, y, n, *corners in block("CELL2D")]  # fmt: skip
    return vertices, cells


def roles(mesh):
    """Vertices on the lake, meters of river at each vertex, and the vertices of the wells."""
    lines = mesh.to_meshio()
    edges, tags = lines.cells_dict["line"], lines.cell_data_dict["region"]["line"]
    reaches = edges[tags == 2]
    halves = np.linalg.norm(mesh.points[reaches[:, 0]] - mesh.points[reaches[:, 1]], axis=1) / 2
    river = np.bincount(reaches.ravel(), np.repeat(halves, 2), mesh.n_vertices)
    well = np.linalg.norm(wells[:, None] - mesh.points, axis=2).argmin(axis=1)
    return np.unique(edges[tags == 3]), river, well


def triangle_cells(mesh):
    """Triangles as cells, with their centroids as centers: vertices and cells for FloPy."""
    centers = mesh.points[mesh.triangles].mean(axis=1)
    vertices = [[i, *place] for i, place in enumerate(mesh.points.tolist())]
    cells = [[i, *center, 3, *corners[::-1]] for i, (center, corners) in enumerate(zip(centers.tolist(), mesh.triangles.tolist()))]
    return vertices, cells


def run(folder, vertices, cells, heads, *, rain=None, rivers=None, pumped=None, barriers=None):
    """Solves for steady heads. `heads`, `rivers` and `pumped` have values by number of the cell, and `barriers` are those
    of HFB. Returns heads and balance."""
    import flopy

    simulation = flopy.mf6.MFSimulation(sim_ws=folder)
    simulation.simulation_data.float_precision = 15  # northings have seven digits before the point
    flopy.mf6.ModflowTdis(simulation)
    flopy.mf6.ModflowIms(simulation, outer_dvclose=1e-10, inner_dvclose=1e-11, rcloserecord=1e-8, linear_acceleration="bicgstab",
                          inner_maximum=500)  # fmt: skip
    flow = flopy.mf6.ModflowGwf(simulation, modelname="valley", save_flows=True)
    flopy.mf6.ModflowGwfdisv(flow, nlay=1, ncpl=len(cells), nvert=len(vertices), top=0.0, botm=-25.0, vertices=vertices, cell2d=cells)
    flopy.mf6.ModflowGwfnpf(flow, k=15.0)
    flopy.mf6.ModflowGwfic(flow, strt=5.0)
    flopy.mf6.ModflowGwfchd(flow, stress_period_data=[((0, int(cell)), float(head)) for cell, head in heads.items()])
    if rain:
        flopy.mf6.ModflowGwfrcha(flow, recharge=rain)
    if rivers:
        flopy.mf6.ModflowGwfriv(flow, stress_period_data=[((0, int(cell)), *map(float, data)) for cell, data in rivers.items()])
    if pumped:
        flopy.mf6.ModflowGwfwel(flow, stress_period_data=[((0, int(cell)), -rate) for cell, rate in pumped.items()])
    if barriers:
        flopy.mf6.ModflowGwfhfb(flow, maxhfb=len(barriers), stress_period_data=barriers)
    flopy.mf6.ModflowGwfoc(flow, head_filerecord="valley.hds", budget_filerecord="valley.bud",
                           saverecord=[("HEAD", "LAST"), ("BUDGET", "LAST")], printrecord=[("BUDGET", "LAST")])  # fmt: skip
    simulation.write_simulation(silent=True)
    done, messages = simulation.run_simulation(silent=True)
    assert done, messages
    return flow.output.head().get_data().ravel(), flow.output.list().get_incremental()[0]


def plane_error(folder, vertices, cells, edge):
    """Errors of heads that are fixed in the cells `edge` and fall by 1 m per km everywhere else, too."""
    plane = (684000 - np.array([cell[1] for cell in cells])) / 1000
    return run(folder, vertices, cells, {cell: plane[cell] for cell in edge})[0] - plane

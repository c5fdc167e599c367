"""Makes a net of D-Flow FM with bed levels orthogonal, and measures it with MeshKernel.

    python3 dflowfm_orthogonal.py        needs the program temper, and SciPy; with MeshKernel it also measures both nets there

D-Flow FM wants an orthogonality of at most 0.01. It is the cosine of the angle between an edge and the line through the
circumcenters of its two triangles.
"""

import importlib.util
import subprocess
import sys

import numpy as np
from scipy.io import netcdf_file


def temper(*arguments):
    subprocess.run([sys.executable, "-m", "temper", *map(str, arguments), "--quiet"], check=True)


def net_of(file, topology):
    """x, y, links and triangles, which count from 0."""
    with netcdf_file(file, mmap=False) as net:
        kinds = (("node_x", "d"), ("node_y", "d"), ("edge_nodes", "i4"), ("face_nodes", "i4"))
        return [net.variables[f"{topology}_{name}"].data.astype(kind) for name, kind in kinds]


def bed_level(x, y):
    return 0.3 * x - 0.2 * y - 5


def largest_angle(x, y, links, triangles):
    corners = np.stack([x, y], axis=1)[triangles]
    to, back = (np.roll(corners, k, axis=1) - corners for k in (-1, 1))
    return np.degrees(np.arccos((to * back).sum(axis=2) / np.linalg.norm(to, axis=2) / np.linalg.norm(back, axis=2)).max())


# A net of the older kind: nodes, links between them that count from 1, and bed levels.
temper("example", "random", "--vertices", 300, "-o", "plain.ugrid.nc")
before = x, y, links, triangles = net_of("plain.ugrid.nc", "mesh")
with netcdf_file("old_net.nc", "w") as net:
    for name, size in (("nNetNode", len(x)), ("nNetLink", len(links)), ("nNetLinkPts", 2)):
        net.createDimension(name, size)
    for name, data in (("NetNode_x", x), ("NetNode_y", y), ("NetNode_z", bed_level(x, y))):
        net.createVariable(name, "d", ("nNetNode",))[:] = data
        net.variables[name].units = "m"
    net.createVariable("NetLink", "i", ("nNetLink", "nNetLinkPts"))[:] = links + 1

temper("optimize", "old_net.nc", "-o", "new_net.nc", "--format", "ugrid", "--for", "dflowfm")
temper("check", "new_net.nc", "--require", "orthogonality,small_flow_links")
after = net_of("new_net.nc", "mesh2d")
with netcdf_file("new_net.nc", mmap=False) as net:
    assert np.allclose(net.variables["mesh2d_node_z"].data, bed_level(*after[:2]), rtol=1e-12)
angles = [largest_angle(*net) for net in (before, after)]
print(f"largest angle: {angles[0]:.1f}° before, {angles[1]:.1f}° after")
assert angles[1] < 90 + 1e-9 < angles[0]

if importlib.util.find_spec("meshkernel"):
    from meshkernel import Mesh2d, MeshKernel

    def measured(x, y, links, triangles):
        """The largest orthogonality, and the numbers of obtuse triangles and of small flow links."""
        kernel = MeshKernel()
        kernel.mesh2d_set(Mesh2d(node_x=x, node_y=y, edge_nodes=links.ravel()))
        assert kernel.mesh2d_get().face_nodes.size == triangles.size
        largest = kernel.mesh2d_get_orthogonality().values.max()
        obtuse = kernel.mesh2d_get_obtuse_triangles_mass_centers().x_coordinates
        return largest, len(obtuse), len(kernel.mesh2d_get_small_flow_edge_centers(0.1).x_coordinates)

    own = [measured(*net) for net in (before, after)]
    for when, (largest, obtuse, small) in zip(("before", "after"), own):
        print(f"MeshKernel, {when}: orthogonality at most {largest:.1e}, {obtuse} obtuse triangles, {small} small flow links")
    assert own[0][0] > 0.2 and own[1][0] < 0.01 and own[1][2] == 0

# runs with: meshkernel; measures: orthogonality, root mean square (0 is best)
"""A current around a pier, measured by MeshKernel, the library of D-Flow FM's grid editor, and optimized by it for comparison."""

import meshkernel
import numpy as np
from benchmark import variants

import temper


def kernel_of(mesh):
    kernel = meshkernel.MeshKernel()
    x, y = np.array(mesh.points).T.copy()
    edges = temper.dec_operators(mesh).edges.vertices.astype(np.int32).ravel()
    kernel.mesh2d_set(meshkernel.Mesh2d(node_x=x, node_y=y, edge_nodes=edges))
    return kernel


def measured(kernel):
    """Root mean square and maximum of the orthogonality, obtuse triangles, small flow links."""
    cosines = kernel.mesh2d_get_orthogonality().values
    cosines = cosines[cosines >= 0]  # boundary edges have none
    obtuse = len(kernel.mesh2d_get_obtuse_triangles_mass_centers().x_coordinates)
    small = len(kernel.mesh2d_get_small_flow_edge_centers(0.1).x_coordinates)
    return np.sqrt((cosines**2).mean()), cosines.max(), obtuse, small


meshes = variants(temper.generate.airfoil(), "dflowfm", keep="weights")
kernels = {name: kernel_of(mesh) for name, mesh in meshes.items()}
kernels["kernel"] = kernel_of(meshes["before"])
kernels["kernel"].mesh2d_compute_orthogonalization(
    meshkernel.ProjectToLandBoundaryOption.DO_NOT_PROJECT_TO_LANDBOUNDARY,
    meshkernel.OrthogonalizationParameters(), meshkernel.GeometryList(), meshkernel.GeometryList())  # fmt: skip
numbers = {name: measured(kernel) for name, kernel in kernels.items()}
for name, (root, largest, obtuse, small) in numbers.items():
    print(f"{name:8}  orthogonality {root:.1e}, at most {largest:.3f}  obtuse {obtuse:3}  small flow links {small}")
for name, mesh in meshes.items():  # temper measures the same
    says = temper.quality(mesh)
    assert abs(says.max_orthogonality - numbers[name][1]) < 1e-9
    assert (says.obtuse_triangles, says.small_flow_links) == numbers[name][2:]
results = {name: root for name, (root, *_) in numbers.items() if name in meshes}
assert results["for"] < results["before"] / 20 and numbers["for"][3] == 0

"""The PorePy model and the PyVista pictures of docs/tutorial/fracture.md."""

import numpy as np
import porepy
import pyvista
from scipy.sparse.linalg import spsolve

BLOCK = porepy.Domain({"xmin": 0, "xmax": 100, "ymin": 0, "ymax": 60, "zmin": 0, "zmax": 40})  # meters
CONDUCTIVITY = {"rock": 1e-6, "sand": 1e-5}  # m/s
APERTURE = 1e-3  # of the fracture, in meters
OPEN = 9.81 * APERTURE**2 / (12 * 1e-6)  # conductivity between two smooth plates


class Flow(porepy.SinglePhaseFlow):
    """Heads for 10 m in the west and 0 m in the east: with these units PorePy's pressure is the head in meters."""

    def set_geometry(self):
        self.mdg, self.nd, self._domain = self.params["grids"], 3, BLOCK
        self.well_network = porepy.WellNetwork3d(BLOCK)
        porepy.set_local_coordinate_projections(self.mdg)

    def permeability(self, subdomains):
        values = [np.where(g.tags["rock"], *CONDUCTIVITY.values()) if g.dim == 3 else np.full(g.num_cells, OPEN) for g in subdomains]
        return self.isotropic_second_order_tensor(subdomains, porepy.wrap_as_dense_ad_array(np.concatenate([[], *values])))

    def darcy_flux_discretization(self, subdomains):
        return self.params["scheme"](self.darcy_keyword, subdomains)

    def bc_type_darcy_flux(self, grid):
        sides = self.domain_boundary_sides(grid)
        return porepy.BoundaryCondition(grid, sides.west | sides.east, "dir")

    def bc_values_pressure(self, boundary):
        return 10.0 * self.domain_boundary_sides(boundary).west


def solved(grids, scheme):
    """The heads of the cells, and the inflow in liters per second."""
    solid = porepy.SolidConstants(residual_aperture=APERTURE, normal_permeability=OPEN)
    fluid = porepy.FluidComponent(viscosity=1, density=1, compressibility=0)
    model = Flow({"grids": grids, "scheme": scheme, "material_constants": {"solid": solid, "fluid": fluid}})
    model.prepare_simulation()
    model.assemble_linear_system()
    matrix, right = model.linear_system
    model.equation_system.set_variable_values(spsolve(matrix.tocsc(), right), additive=True, iterate_index=0)
    grid = grids.subdomains(dim=3)[0]
    flux = model.darcy_flux([grid]).value(model.equation_system) * np.asarray(grid.cell_faces.sum(axis=1)).ravel()
    return model.pressure([grid]).value(model.equation_system), -1000 * flux[model.domain_boundary_sides(grid).west].sum()


def draw(file, cuts, name, fracture=None, **options):
    """Pictures next to each other: the southern half is cut off, values color the rest, and the fracture of a mesh is orange."""
    plotter = pyvista.Plotter(off_screen=True, shape=(1, len(cuts)), window_size=(480 * len(cuts), 340), border=False)
    for i, (title, points, tetrahedra, values) in enumerate(cuts):
        grid = pyvista.UnstructuredGrid({pyvista.CellType.TETRA: np.array(tetrahedra)}, np.array(points))
        grid.cell_data[name] = values
        plotter.subplot(0, i)
        bar = {"title": name, "vertical": False, "position_x": 0.25, "width": 0.5, "color": "black", "n_labels": 3}
        plotter.add_mesh(grid.clip("-y", crinkle=True), scalars=name, show_edges=True, lighting=False, scalar_bar_args=bar, **options)
        if fracture is not None:
            faces = pyvista.make_tri_mesh(np.array(fracture.points), np.array(fracture.tagged_faces))
            plotter.add_mesh(faces, color="orange", show_edges=True, lighting=False)
        plotter.add_text(title, font_size=10, color="black")
        plotter.camera_position = [(50, -112, 66), (50, 30, 13), (0, 0, 1)]
    plotter.screenshot(file)
    plotter.close()

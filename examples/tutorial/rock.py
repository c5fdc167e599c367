"""The PorePy model and the PyVista pictures of docs/tutorial/fracture.md."""

import numpy as np
import porepy
import pyvista
from PIL import Image
from scipy.sparse.linalg import spsolve

BLOCK = porepy.Domain({"xmin": 0, "xmax": 100, "ymin": 0, "ymax": 60, "zmin": 0, "zmax": 40})  # meters
CONDUCTIVITY = {"rock": 1e-6, "sand": 1e-5}  # m/s
APERTURE = 1e-3  # of the fracture, in meters
OPEN = 9.81 * APERTURE**2 / (12 * 1e-6)  # conductivity between two smooth plates
MARGIN = 13  # pixels of a picture below what is painted


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


def draw(file, cut, name, fracture, **options):
    """The southern half is cut off, values color the rest, and the fracture of a mesh is orange."""
    points, tetrahedra, values = cut
    plotter = pyvista.Plotter(off_screen=True, window_size=(760, 380))
    grid = pyvista.UnstructuredGrid({pyvista.CellType.TETRA: np.array(tetrahedra)}, np.array(points))
    grid.cell_data[name] = values
    bar = {"title": name + "\n", "vertical": False, "position_x": 0.25, "position_y": 0.03, "width": 0.5, "color": "black",
           "n_labels": 3, "fmt": "%.0f", "title_font_size": 18, "label_font_size": 16}  # fmt: skip
    shown = {"show_edges": True, "edge_color": "#6b7280", "line_width": 0.5, "lighting": False}
    plotter.add_mesh(grid.clip("-y", crinkle=True), scalars=name, scalar_bar_args=bar, **shown, **options)
    faces = pyvista.make_tri_mesh(np.array(fracture.points), np.array(fracture.tagged_faces))
    plotter.add_mesh(faces, color="orange", **shown)
    plotter.camera_position = [(50, -96, 56), (50, 30, 10), (0, 0, 1)]
    image = plotter.screenshot(None, return_img=True)
    plotter.close()
    painted = np.flatnonzero((image < 255).any(axis=(1, 2)))
    Image.fromarray(image[: painted[-1] + MARGIN]).save(file)  # without a bar, nothing is painted below

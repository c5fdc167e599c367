# runs with: adcircpy; measures: time steps, over those of the mesh as it was
"""Time steps on a bay in longitude and latitude: in one step, a long wave must not cross a triangle. adcircpy reads the files."""

import numpy as np
from adcircpy import AdcircMesh
from benchmark import variants

import temper


def step_of(file):
    mesh = AdcircMesh.open(file, crs="EPSG:4326")
    triangles = mesh.triangulation.triangles
    degrees = np.array(mesh.coords)[triangles]
    corners = 6371e3 * np.radians(degrees) * [np.cos(np.radians(degrees[..., 1].mean())), 1]
    sides = np.linalg.norm(np.roll(corners, -1, 1) - corners, axis=2)
    u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2
    depth = -np.array(mesh.values).ravel()[triangles].mean(axis=1)  # adcircpy has heights, up
    return (2 * areas / sides.max(axis=1) / np.sqrt(9.81 * depth)).min()


bay = temper.read("examples/bay.14", projection="stereographic")
steps = {}
for name, mesh in variants(bay, "adcirc", keep="weights").items():
    temper.write(f"{name}.14", mesh)
    steps[name] = step_of(f"{name}.14")
    print(f"{name:8}  longest step {steps[name]:5.2f} s")
results = {name: steps["before"] / step for name, step in steps.items()}
assert results["for"] < results["before"]

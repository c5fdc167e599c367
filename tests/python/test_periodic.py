"""Meshes of periodic planes, compared with NumPy."""

import pickle

import numpy as np
import pytest

import temper
from temper import Space


@pytest.fixture
def sea():
    return temper.generate.random_periodic(300, seed=2, period=(2, 1))


def ways(mesh, edges):
    """The shortest way from each edge's first vertex to the second."""
    first, second = np.moveaxis(mesh.points[edges], 1, 0)
    period = np.array(mesh.space.period)
    way = second - first
    return way - period * np.round(way / period)


def test_a_space_says_what_it_is():
    assert Space.periodic(2, 0).kind == "periodic_plane"
    assert Space.periodic(2, 1).is_plane and Space.periodic(2, 1).is_periodic and not Space().is_periodic
    assert repr(Space.periodic(2, 1)) == "Space.periodic(2.0, 1.0)"
    for x, y in ((0, 0), (-1, 1), (np.nan, 1), (np.inf, 1)):
        with pytest.raises(temper.TemperError, match="the periods of a plane are"):
            Space.periodic(x, y)


def test_edges_are_shortest_ways(sea):
    assert sea.space == Space.periodic(2, 1)
    assert sea.n_vertices + sea.n_triangles == sea.n_edges
    assert len(sea.boundary_edges) == 0
    complex = temper.dec_operators(sea)
    lengths = np.linalg.norm(ways(sea, complex.edges.vertices), axis=1)
    np.testing.assert_allclose(complex.edges.length, lengths, rtol=1e-12)
    assert complex.star0.sum() == pytest.approx(2)


def test_any_images_make_the_same_mesh(sea):
    shift = np.array(sea.space.period) * np.random.default_rng(1).integers(-2, 3, size=sea.points.shape)
    again = temper.Mesh(sea.points + shift, sea.triangles, space=sea.space)
    np.testing.assert_allclose(again.points, sea.points, atol=1e-13)
    assert again.n_edges == sea.n_edges
    assert pickle.loads(pickle.dumps(sea)) == sea


def test_points_that_are_assigned_are_in_the_domain(sea):
    sea.points = sea.points + np.array([1.75, -0.5])
    assert np.all((sea.points >= 0) & (sea.points < sea.space.period))


def test_optimized_and_verified(sea, tmp_path):
    before = temper.measure_errors(sea)
    temper.optimize(sea)
    assert temper.quality(sea).well_centered_fraction == 1
    after = temper.measure_errors(sea)
    assert [row.field for row in after.fields] == temper.error_fields(periodic=True)
    assert temper.geometric_mean(temper.error_ratios(after, before)).poisson.l2 < 0.8
    temper.write(tmp_path / "a.vtu", sea)
    assert temper.read(tmp_path / "a.vtu") == sea
    assert "period" in sea._repr_svg_()


def test_hexagons_and_delaunay():
    channel = temper.generate.periodic_hexagons(6, 5, channel=True)
    assert channel.space.period == (6, 0) and len(channel.boundary_edges) == 12
    again = temper.generate.periodic_delaunay(temper.generate.random_periodic(200).points)
    assert temper.quality(again).non_regular_edges == 0


@pytest.mark.parametrize(
    "call",
    [
        temper.explain, temper.Mesh.to_meshio, temper.edges_that_must_be_split, temper.html_report, temper.plot,
    ],
)  # fmt: skip
def test_what_takes_no_periods_says_so(call, sea):
    with pytest.raises(temper.TemperError, match="the mesh is in a periodic plane, but "):
        call(sea)

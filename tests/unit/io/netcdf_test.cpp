// MPAS and UGRID, looked at with NetCDF's own functions: what solvers will find in the files.
#include "support.hpp"

#if TEMPER_NETCDF
#include <netcdf.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "io/containers/netcdf_file.hpp"
#include "support/lattice.hpp"
#include "support/spheres.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"

namespace temper::io {
namespace {

/// A file of NetCDF, open while a test looks at it or makes it.
class Nc {
 public:
  static Nc open(const std::string& path) {
    Nc nc;
    EXPECT_EQ(nc_open(path.c_str(), NC_NOWRITE, &nc.id), NC_NOERR) << path;
    return nc;
  }
  static Nc create(const std::string& path, int mode = 0) {
    Nc nc;
    EXPECT_EQ(nc_create(path.c_str(), NC_CLOBBER | mode, &nc.id), NC_NOERR) << path;
    return nc;
  }
  ~Nc() {
    if (id >= 0) nc_close(id);
  }
  Nc(Nc&& other) noexcept : id(std::exchange(other.id, -1)) {}
  Nc(const Nc&) = delete;
  Nc& operator=(const Nc&) = delete;

  [[nodiscard]] std::size_t dimension(const char* name) const {
    int d = -1;
    std::size_t n = 0;
    EXPECT_EQ(nc_inq_dimid(id, name, &d), NC_NOERR) << name;
    EXPECT_EQ(nc_inq_dimlen(id, d, &n), NC_NOERR) << name;
    return n;
  }
  template <class T>
  [[nodiscard]] std::vector<T> get(const char* name) const {
    int v = -1, n_dims = 0, dims[NC_MAX_VAR_DIMS];
    nc_type type = NC_NAT;
    EXPECT_EQ(nc_inq_varid(id, name, &v), NC_NOERR) << name;
    EXPECT_EQ(nc_inq_var(id, v, nullptr, &type, &n_dims, dims, nullptr), NC_NOERR) << name;
    const nc_type expected = std::is_same_v<T, double> ? NC_DOUBLE : NC_INT;
    EXPECT_EQ(type, expected) << name;
    std::size_t n = 1;
    for (int i = 0; i < n_dims; ++i) {
      std::size_t size = 0;
      nc_inq_dimlen(id, dims[i], &size);
      n *= size;
    }
    std::vector<T> values(n);
    EXPECT_EQ(nc_get_var(id, v, values.data()), NC_NOERR) << name;
    return values;
  }
  [[nodiscard]] std::string text(const char* variable, const char* name) const {
    int v = NC_GLOBAL;
    if (variable != nullptr) nc_inq_varid(id, variable, &v);
    std::size_t n = 0;
    if (nc_inq_attlen(id, v, name, &n) != NC_NOERR) return "";
    std::string value(n, '\0');
    nc_get_att_text(id, v, name, value.data());
    return value;
  }
  int add_dimension(const char* name, std::size_t n) {
    int d = -1;
    EXPECT_EQ(nc_def_dim(id, name, n, &d), NC_NOERR);
    return d;
  }
  template <class T>
  int add(const char* name, const std::vector<int>& dims, const std::vector<T>& values,
          const std::map<std::string, int>& numbers = {}) {
    int v = -1;
    nc_redef(id);
    const nc_type type = std::is_same_v<T, double>         ? NC_DOUBLE
                         : std::is_same_v<T, char>         ? NC_CHAR
                         : std::is_same_v<T, std::int64_t> ? NC_INT64
                                                           : NC_INT;
    EXPECT_EQ(nc_def_var(id, name, type, static_cast<int>(dims.size()), dims.data(), &v), NC_NOERR);
    for (const auto& [key, value] : numbers) nc_put_att_int(id, v, key.c_str(), NC_INT, 1, &value);
    nc_enddef(id);
    EXPECT_EQ(nc_put_var(id, v, values.data()), NC_NOERR);
    nc_redef(id);
    return v;
  }
  void say(int variable, const char* name, const std::string& value) {
    nc_redef(id);
    EXPECT_EQ(nc_put_att_text(id, variable, name, value.size(), value.data()), NC_NOERR);
  }

  void say(int variable, const char* name, double value) {
    nc_redef(id);
    EXPECT_EQ(nc_put_att_double(id, variable, name, NC_DOUBLE, 1, &value), NC_NOERR);
  }

  int id = -1;

 private:
  Nc() = default;
};

/// A lattice that is bent a little, with weights that keep it well-centered enough.
MeshFile bent_lattice() {
  constexpr int kColumns = 5, kRows = 4;
  MeshFile f;
  for (int j = 0; j <= kRows; ++j) {
    for (int i = 0; i <= kColumns; ++i) {
      f.points.push_back({i + 0.5 * j + 0.05 * std::sin(3.0 * i + j), 0.9 * j + 0.05 * std::cos(2.0 * j + i)});
      f.weights.push_back(0.04 * std::sin(5.0 * i + 7.0 * j));
    }
  }
  for (int j = 0; j < kRows; ++j) {
    for (int i = 0; i < kColumns; ++i) {
      const int a = j * (kColumns + 1) + i, d = a + kColumns + 1;
      f.triangles.corners.push_back({a, a + 1, d});
      f.triangles.corners.push_back({a + 1, d + 1, d});
    }
  }
  return f;
}

/// A globe with random weights, and one without the north: with a coast.
std::vector<MeshFile> globes() {
  std::vector<MeshFile> files;
  for (const double northernmost : {2.0, 0.5}) {
    Mesh mesh = test::ocean(*icosahedral({.level = 2, .radius = 2}), 2 * northernmost);
    test::Noise noise(3);
    for (const VertexId v : mesh.vertices()) mesh.set_weight(v, 0.02 * noise());
    files.push_back(from_mesh(mesh));
  }
  return files;
}

/// Meshes of planes with two periods and with one, with random weights.
std::vector<MeshFile> periodic_files() {
  std::vector<MeshFile> files;
  for (const bool channel : {false, true}) {
    Mesh mesh = *periodic_hexagons({.nx = 6, .ny = 4, .distance = 0.5, .channel = channel});
    test::Noise noise(4);
    for (const VertexId v : mesh.vertices()) {
      const WeightedPoint p = mesh.point(v);
      const double dx = 0.05 * noise(), dy = 0.05 * noise();
      mesh.set_point(v, mesh.space().in_domain({p.x + dx, p.y + dy, 0.02 * noise()}));
    }
    EXPECT_FALSE(mesh.validate());
    files.push_back(from_mesh(mesh));
  }
  return files;
}

class NetcdfFormats : public FileTest {
 protected:
  /// Writes planar, periodic and spherical meshes in turn, and looks at each.
  template <class Look>
  void for_mpas_files(const Look& look) const {
    std::vector<MeshFile> files = globes();
    files.push_back(bent_lattice());
    for (MeshFile& f : periodic_files()) files.push_back(std::move(f));
    for (const MeshFile& f : files) {
      const auto warnings = write(path("m.mpas.nc"), f);
      ASSERT_TRUE(warnings) << warnings.error().what();
      ASSERT_EQ(warnings->size(), 1u);
      EXPECT_NE((*warnings)[0].find(": with weights, "), std::string::npos) << (*warnings)[0];
      look(f, Nc::open(path("m.mpas.nc")));
    }
  }

  void write_ok(const std::string& name, const MeshFile& f) const {
    const auto warnings = write(path(name), f);
    ASSERT_TRUE(warnings) << warnings.error().what();
    EXPECT_TRUE(warnings->empty()) << (*warnings)[0];
  }
};

TEST_F(NetcdfFormats, MpasCellsAndTrianglesAreTheSumsOfTheirKites) {
  for_mpas_files([](const MeshFile& f, const Nc& nc) {
    EXPECT_EQ(nc.text(nullptr, "on_a_sphere"), f.sphere() != nullptr ? "YES" : "NO");
    const auto kites = nc.get<double>("kiteAreasOnVertex"), cell_areas = nc.get<double>("areaCell"),
               triangle_areas = nc.get<double>("areaTriangle");
    const auto cells = nc.get<std::int32_t>("cellsOnVertex");
    std::vector<double> of_cells(cell_areas.size());
    double area = 0;
    for (std::size_t t = 0; t < triangle_areas.size(); ++t) {
      EXPECT_NEAR(kites[3 * t] + kites[3 * t + 1] + kites[3 * t + 2], triangle_areas[t], 1e-14);
      area += triangle_areas[t];
      for (std::size_t k = 3 * t; k < 3 * t + 3; ++k) {
        EXPECT_EQ(cells[k] - 1, f.triangles[t][k % 3]) << "corners keep their order";
        of_cells[static_cast<std::size_t>(cells[k] - 1)] += kites[k];
      }
    }
    double sum = 0;
    for (std::size_t c = 0; c < cell_areas.size(); ++c) {
      EXPECT_NEAR(of_cells[c], cell_areas[c], 1e-14 * (1 + cell_areas[c]));
      sum += cell_areas[c];
    }
    EXPECT_NEAR(sum, area, 1e-12);
  });
}

TEST_F(NetcdfFormats, MpasEdgesCrossWhereTheFileSaysAndTurnTheRightWay) {
  ASSERT_TRUE(write(path("m.mpas.nc"), bent_lattice()));
  const Nc nc = Nc::open(path("m.mpas.nc"));
  const auto cells = nc.get<std::int32_t>("cellsOnEdge"), vertices = nc.get<std::int32_t>("verticesOnEdge");
  const auto xc = nc.get<double>("xCell"), yc = nc.get<double>("yCell"), xv = nc.get<double>("xVertex"),
             yv = nc.get<double>("yVertex"), xe = nc.get<double>("xEdge"), ye = nc.get<double>("yEdge"),
             dc = nc.get<double>("dcEdge"), dv = nc.get<double>("dvEdge"), angle = nc.get<double>("angleEdge");
  std::size_t boundary = 0;
  for (std::size_t e = 0; e < dc.size(); ++e) {
    const auto cell = [&](std::size_t k) {
      const auto i = static_cast<std::size_t>(cells[2 * e + k] - 1);
      return Vec2{xc[i], yc[i]};
    };
    const auto vertex = [&](std::size_t k) {
      const auto i = static_cast<std::size_t>(vertices[2 * e + k] - 1);
      return Vec2{xv[i], yv[i]};
    };
    ASSERT_GT(cells[2 * e], 0);
    ASSERT_GT(cells[2 * e + 1], 0);
    ASSERT_GT(vertices[2 * e], 0);
    const Vec2 at = {xe[e], ye[e]}, along = cell(1) - cell(0);
    // On the boundary the dual edge ends at the edge.
    const bool inside = vertices[2 * e + 1] > 0;
    boundary += inside ? 0 : 1;
    const Vec2 across = (inside ? vertex(1) : at) - vertex(0);
    EXPECT_NEAR(length(along), dc[e], 1e-14);
    EXPECT_NEAR(length(across), dv[e], 1e-13);
    EXPECT_NEAR(dot(along, across), 0, 1e-13);
    EXPECT_GT(cross(along, across), 0);
    EXPECT_NEAR(cross(along, at - cell(0)), 0, 1e-13) << "on the line of the cells";
    EXPECT_NEAR(dot(along, at - vertex(0)), 0, 1e-13) << "on the line of the vertices";
    EXPECT_NEAR(std::cos(angle[e]) * dc[e], along.x, 1e-13);
    EXPECT_NEAR(std::sin(angle[e]) * dc[e], along.y, 1e-13);
  }
  EXPECT_EQ(boundary, 18u);
}

TEST_F(NetcdfFormats, MpasListsAroundCellsFitEachOther) {
  for_mpas_files([](const MeshFile&, const Nc& nc) {
    const auto n = nc.get<std::int32_t>("nEdgesOnCell"), edges = nc.get<std::int32_t>("edgesOnCell"),
               others = nc.get<std::int32_t>("cellsOnCell"), vertices = nc.get<std::int32_t>("verticesOnCell"),
               cells_of_edge = nc.get<std::int32_t>("cellsOnEdge"),
               vertices_of_edge = nc.get<std::int32_t>("verticesOnEdge"), cull = nc.get<std::int32_t>("cullCell");
    const std::size_t width = nc.dimension("maxEdges");
    const auto has = [](const std::vector<std::int32_t>& pairs, std::int32_t edge, std::int32_t what) {
      const auto at = 2 * static_cast<std::size_t>(edge - 1);
      return pairs[at] == what || pairs[at + 1] == what;
    };
    for (std::size_t c = 0; c < n.size(); ++c) {
      const auto degree = static_cast<std::size_t>(n[c]);
      for (std::size_t i = 0; i < width; ++i) {
        const std::size_t at = c * width + i;
        if (i >= degree) {
          EXPECT_EQ(edges[at], 0);
          EXPECT_EQ(vertices[at], 0);
          continue;
        }
        EXPECT_TRUE(has(cells_of_edge, edges[at], static_cast<std::int32_t>(c) + 1));
        EXPECT_TRUE(has(cells_of_edge, edges[at], others[at]));
        const bool gap = cull[c] == 1 && i + 1 == degree;
        EXPECT_EQ(vertices[at] == 0, gap);
        if (gap) continue;
        EXPECT_TRUE(has(vertices_of_edge, edges[at], vertices[at]));
        EXPECT_TRUE(has(vertices_of_edge, edges[c * width + (i + 1) % degree], vertices[at]));
      }
    }
  });
}

// The two laws that make TRiSK's tangential velocities: they do no work (antisymmetry), and their divergence on a
// triangle is that of the cells around it, weighted by kites. (Thuburn et al. 2009.)
TEST_F(NetcdfFormats, MpasWeightsAreAntisymmetricAndCarryDivergenceToTriangles) {
  for_mpas_files([](const MeshFile&, const Nc& nc) {
    const auto n_on_edge = nc.get<std::int32_t>("nEdgesOnEdge"), edges_on_edge = nc.get<std::int32_t>("edgesOnEdge"),
               cells = nc.get<std::int32_t>("cellsOnEdge"), vertices = nc.get<std::int32_t>("verticesOnEdge"),
               edges_on_vertex = nc.get<std::int32_t>("edgesOnVertex"),
               cells_on_vertex = nc.get<std::int32_t>("cellsOnVertex");
    const auto w = nc.get<double>("weightsOnEdge"), dc = nc.get<double>("dcEdge"), dv = nc.get<double>("dvEdge"),
               kites = nc.get<double>("kiteAreasOnVertex"), areas = nc.get<double>("areaCell");
    const std::size_t width = nc.dimension("maxEdges2"), n = dc.size();

    std::map<std::pair<std::size_t, std::size_t>, double> work;
    std::vector<double> normal(n), tangential(n), divergence(areas.size());
    for (std::size_t e = 0; e < n; ++e) normal[e] = std::sin(1.0 + 17.0 * static_cast<double>(e));
    for (std::size_t e = 0; e < n; ++e) {
      divergence[static_cast<std::size_t>(cells[2 * e] - 1)] += normal[e] * dv[e];
      divergence[static_cast<std::size_t>(cells[2 * e + 1] - 1)] -= normal[e] * dv[e];
      for (std::size_t k = 0; k < static_cast<std::size_t>(n_on_edge[e]); ++k) {
        const auto other = static_cast<std::size_t>(edges_on_edge[e * width + k] - 1);
        tangential[e] += w[e * width + k] * normal[other];
        work[{e, other}] += w[e * width + k] * dc[e] / dv[other];
      }
    }
    ASSERT_GT(work.size(), 4 * n);
    for (const auto& [pair, value] : work) EXPECT_NEAR(value, -work.at({pair.second, pair.first}), 1e-12);
    for (std::size_t t = 0; 3 * t < kites.size(); ++t) {
      double out = 0, expected = 0;
      for (std::size_t k = 3 * t; k < 3 * t + 3; ++k) {
        const auto e = static_cast<std::size_t>(edges_on_vertex[k] - 1),
                   c = static_cast<std::size_t>(cells_on_vertex[k] - 1);
        const bool first = vertices[2 * e] == static_cast<std::int32_t>(t) + 1;
        out += (first ? 1 : -1) * tangential[e] * dc[e];
        expected += kites[k] / areas[c] * divergence[c];
      }
      EXPECT_NEAR(out, expected, 1e-12) << "triangle " << t;
    }
  });
}

TEST_F(NetcdfFormats, MpasEdgesOfTheSphereCrossAtRightAnglesAndKnowTheEast) {
  for (const MeshFile& f : globes()) {
    ASSERT_TRUE(write(path("m.mpas.nc"), f));
    const Nc nc = Nc::open(path("m.mpas.nc"));
    const auto places = [&](const std::string& what) {
      const auto x = nc.get<double>(("x" + what).c_str()), y = nc.get<double>(("y" + what).c_str()),
                 z = nc.get<double>(("z" + what).c_str()), lat = nc.get<double>(("lat" + what).c_str()),
                 lon = nc.get<double>(("lon" + what).c_str());
      std::vector<Vec3> all;
      for (std::size_t i = 0; i < x.size(); ++i) {
        all.push_back({x[i], y[i], z[i]});
        EXPECT_NEAR(x[i], 2 * std::cos(lat[i]) * std::cos(lon[i]), 1e-14);
        EXPECT_NEAR(y[i], 2 * std::cos(lat[i]) * std::sin(lon[i]), 1e-14);
        EXPECT_NEAR(z[i], 2 * std::sin(lat[i]), 1e-14);
        EXPECT_TRUE(lon[i] >= 0 && lon[i] < 2 * std::numbers::pi);
      }
      return all;
    };
    const auto cell = places("Cell"), edge = places("Edge"), vertex = places("Vertex");
    const auto cells = nc.get<std::int32_t>("cellsOnEdge"), vertices = nc.get<std::int32_t>("verticesOnEdge");
    const auto dc = nc.get<double>("dcEdge"), dv = nc.get<double>("dvEdge"), angle = nc.get<double>("angleEdge");
    for (std::size_t e = 0; e < edge.size(); ++e) {
      const auto of = [e](const std::vector<Vec3>& all, const std::vector<std::int32_t>& numbers, std::size_t k) {
        return all[static_cast<std::size_t>(numbers[2 * e + k] - 1)];
      };
      const Vec3 up = 0.5 * edge[e], first = of(cell, cells, 0), second = of(cell, cells, 1);
      const Vec3 start = of(vertex, vertices, 0), end = vertices[2 * e + 1] > 0 ? of(vertex, vertices, 1) : edge[e];
      EXPECT_NEAR(2 * arc_length(first, second), dc[e], 1e-14);
      EXPECT_NEAR(2 * arc_length(start, end), dv[e], 1e-14);
      const Vec3 normal = cross(cross(first, second), up), tangent = cross(cross(start, end), up);
      EXPECT_NEAR(dot(cross(first, second), up), 0, 1e-14) << "on the arc of the cells";
      EXPECT_NEAR(dot(cross(start, end), up), 0, 1e-14) << "on the arc of the vertices";
      EXPECT_NEAR(dot(normal, tangent), 0, 1e-14);
      EXPECT_GT(dot(cross(normal, tangent), up), 0) << "k x n = t";
      const double across = std::hypot(up.x, up.y);
      const Vec3 east = {-up.y / across, up.x / across, 0}, north = cross(up, east);
      const Vec3 turned = std::cos(angle[e]) * east + std::sin(angle[e]) * north;
      EXPECT_NEAR(length((1 / length(normal)) * normal - turned), 0, 1e-13);
    }
  }
}

TEST_F(NetcdfFormats, MpasEdgesOfPeriodicPlanesCrossAtRightAnglesAndAsImages) {
  for (const MeshFile& f : periodic_files()) {
    ASSERT_TRUE(write(path("m.mpas.nc"), f));
    const Nc nc = Nc::open(path("m.mpas.nc"));
    EXPECT_EQ(nc.text(nullptr, "is_periodic"), "YES");
    EXPECT_EQ(nc.text(nullptr, "on_a_sphere"), "NO");
    const auto places = [&](const std::string& what) {
      const auto x = nc.get<double>(("x" + what).c_str()), y = nc.get<double>(("y" + what).c_str());
      std::vector<Vec2> all;
      for (std::size_t i = 0; i < x.size(); ++i) {
        all.push_back({x[i], y[i]});
        EXPECT_TRUE(x[i] >= 0 && x[i] < f.periodic()->period.x);
        EXPECT_TRUE(f.periodic()->period.y == 0 || (y[i] >= 0 && y[i] < f.periodic()->period.y));
      }
      return all;
    };
    const auto to = [&](Vec2 from, Vec2 there) {  // the shortest way
      Vec2 way = there - from;
      way.x -= f.periodic()->period.x * std::round(way.x / f.periodic()->period.x);
      if (f.periodic()->period.y > 0) way.y -= f.periodic()->period.y * std::round(way.y / f.periodic()->period.y);
      return way;
    };
    const auto cell = places("Cell"), edge = places("Edge"), vertex = places("Vertex");
    const auto cells = nc.get<std::int32_t>("cellsOnEdge"), vertices = nc.get<std::int32_t>("verticesOnEdge");
    const auto dc = nc.get<double>("dcEdge"), dv = nc.get<double>("dvEdge"), angle = nc.get<double>("angleEdge");
    for (std::size_t e = 0; e < edge.size(); ++e) {
      const auto of = [e](const std::vector<Vec2>& all, const std::vector<std::int32_t>& numbers, std::size_t k) {
        return all[static_cast<std::size_t>(numbers[2 * e + k] - 1)];
      };
      const Vec2 start = of(vertex, vertices, 0), along = to(of(cell, cells, 0), of(cell, cells, 1));
      const Vec2 across = to(start, vertices[2 * e + 1] > 0 ? of(vertex, vertices, 1) : edge[e]);
      EXPECT_NEAR(length(along), dc[e], 1e-14);
      EXPECT_NEAR(length(across), dv[e], 1e-13);
      EXPECT_NEAR(dot(along, across), 0, 1e-13);
      EXPECT_GT(cross(along, across), 0);
      EXPECT_NEAR(cross(along, to(of(cell, cells, 0), edge[e])), 0, 1e-13) << "on the line of the cells";
      EXPECT_NEAR(dot(along, to(start, edge[e])), 0, 1e-13) << "on the line of the vertices";
      EXPECT_NEAR(std::cos(angle[e]) * dc[e], along.x, 1e-13);
      EXPECT_NEAR(std::sin(angle[e]) * dc[e], along.y, 1e-13);
    }
  }
}

TEST_F(NetcdfFormats, MpasOfPeriodicPlanesIsReadBackBitForBit) {
  for (MeshFile f : periodic_files()) {
    // Others have periods of all bits, and points on the far side of the domain.
    auto& period = std::get<PeriodicPoints>(f.points_in).period;
    period.x = std::nextafter(period.x, 10);
    f.points[3].x = f.points[3].x - period.x;
    ASSERT_TRUE(write(path("m.mpas.nc"), f));
    const auto back = read(path("m.mpas.nc"));
    ASSERT_TRUE(back) << back.error().what();
    EXPECT_EQ(back->periodic()->period, period);
    EXPECT_TRUE(same_bits(back->weights, f.weights));
    EXPECT_EQ(back->triangles.corners, f.triangles.corners);
    ASSERT_TRUE(write(path("again.mpas.nc"), *back));
    EXPECT_EQ(slurp(path("again.mpas.nc")), slurp(path("m.mpas.nc")));
    const auto made = make_mesh(*back);
    ASSERT_TRUE(made) << made.error().what();
    EXPECT_EQ(made->mesh.space(), Space::periodic(period));
  }
}

// The numbers that MPAS-Tools' planar_hex gives such meshes.
TEST_F(NetcdfFormats, MpasOfHexagonsIsThatOfPlanarHex) {
  constexpr double kDistance = 1000;
  const auto mesh = periodic_hexagons({.nx = 10, .ny = 8, .distance = kDistance});
  write_ok("m.mpas.nc", from_mesh(*mesh));
  const Nc nc = Nc::open(path("m.mpas.nc"));
  const auto expect_all = [&](const char* name, double value) {
    for (const double x : nc.get<double>(name)) EXPECT_NEAR(x / value, 1, 1e-12) << name;
  };
  const double root3 = std::sqrt(3.0), square = kDistance * kDistance;
  expect_all("dcEdge", kDistance);
  expect_all("dvEdge", kDistance / root3);
  expect_all("areaCell", root3 / 2 * square);
  expect_all("areaTriangle", root3 / 4 * square);
  expect_all("kiteAreasOnVertex", root3 / 12 * square);
  EXPECT_EQ(nc.dimension("nEdges"), 240U);
  EXPECT_EQ(nc.dimension("maxEdges"), 6U);
  for (const std::int32_t n : nc.get<std::int32_t>("nEdgesOnEdge")) EXPECT_EQ(n, 10);
  for (const double w : nc.get<double>("weightsOnEdge")) {  // a third, a sixth or none of 1/√3, either sign
    const double sixths = 6 * root3 * std::abs(w);
    EXPECT_NEAR(sixths, std::round(sixths), 1e-12);
    EXPECT_LE(sixths, 2 + 1e-12);
  }
}

TEST_F(NetcdfFormats, WhatAFileSaysOfPeriodsMustBeSoAndOtherFormatsHaveNoPlaceForThem) {
  const MeshFile f = periodic_files().front();
  for (const char* name : {"m.vtk", "m.ugrid.nc", "m.off", "m.obj"}) {
    const auto refused = write(path(name), f);
    ASSERT_FALSE(refused) << name;
    EXPECT_NE(refused.error().message.find("the plane is periodic"), std::string::npos) << refused.error().message;
    EXPECT_FALSE(std::filesystem::exists(path(name)));
  }
  const auto message = [&](std::optional<double> x, std::optional<double> y, const char* sphere = "NO") {
    {
      Nc nc = Nc::create(path("o.nc"));
      const int cells = nc.add_dimension("nCells", 3), vertices = nc.add_dimension("nVertices", 1),
                degree = nc.add_dimension("vertexDegree", 3);
      nc.say(NC_GLOBAL, "on_a_sphere", sphere);
      nc.say(NC_GLOBAL, "is_periodic", "YES");
      if (x) nc.say(NC_GLOBAL, "x_period", *x);
      if (y) nc.say(NC_GLOBAL, "y_period", *y);
      nc.add<double>("xCell", {cells}, {1, 0, 0});
      nc.add<double>("yCell", {cells}, {0, 1, 0});
      nc.add<double>("zCell", {cells}, {0, 0, *sphere == 'Y' ? 1.0 : 0.0});
      nc.add<std::int32_t>("cellsOnVertex", {vertices, degree}, {1, 2, 3});
    }
    const auto read_back = read(path("o.nc"));
    return read_back ? std::string() : read_back.error().message;
  };
  EXPECT_EQ(message(5, 6), "");
  EXPECT_EQ(message(5, {}),
            "attribute is_periodic is YES, and y_period is not there; expected the length of the period, or 0");
  EXPECT_EQ(message(-5, 6),
            "attribute is_periodic is YES, and x_period is -5; expected the length of the period, or 0");
  EXPECT_EQ(message(0, 0), "attribute is_periodic is YES, but x_period and y_period are 0");
  EXPECT_EQ(message(5, 6, "YES"), "attributes on_a_sphere and is_periodic are YES; expected one of them");
}

TEST_F(NetcdfFormats, MpasOfTheSphereIsReadBackBitForBit) {
  for (const MeshFile& f : globes()) {
    ASSERT_TRUE(write(path("m.mpas.nc"), f));
    const auto back = read(path("m.mpas.nc"));
    ASSERT_TRUE(back) << back.error().what();
    EXPECT_EQ(back->space().radius(), 2);
    EXPECT_EQ(back->sphere()->places, f.sphere()->places);
    EXPECT_TRUE(same_bits(back->weights, f.weights));
    EXPECT_EQ(back->triangles.corners, f.triangles.corners);
    ASSERT_TRUE(write(path("again.mpas.nc"), *back));
    EXPECT_EQ(slurp(path("again.mpas.nc")), slurp(path("m.mpas.nc")));
  }
}

TEST_F(NetcdfFormats, MpasWithoutWeightsIsCrossedInTheMiddleAndWarnsOfNothing) {
  write_ok("m.mpas.nc", from_mesh(*icosahedral({.level = 2})));
  const Nc nc = Nc::open(path("m.mpas.nc"));
  int weight = -1;
  EXPECT_NE(nc_inq_varid(nc.id, "weight", &weight), NC_NOERR) << "weights of zero are none";
  MeshFile plane = bent_lattice();
  plane.weights.clear();
  write_ok("p.mpas.nc", plane);
}

// What others have computed of a public mesh, with arc cosines: to half of the digits.
TEST_F(NetcdfFormats, MpasOfOthersIsWrittenWithTheNumbersThatItCameWith) {
  const std::string public_mesh = std::string(TEMPER_SHARED) + "/meshes/sphere/mpas_QU1920km.nc";
  if (!std::filesystem::exists(public_mesh)) GTEST_SKIP() << "no " << public_mesh;
  const auto f = read(public_mesh);
  ASSERT_TRUE(f) << f.error().what();
  write_ok("m.mpas.nc", *f);
  const Nc theirs = Nc::open(public_mesh), ours = Nc::open(path("m.mpas.nc"));
  const auto expect_same = [&](const char* name, double tolerance) {
    const auto a = theirs.get<double>(name), b = ours.get<double>(name);
    ASSERT_EQ(a.size(), b.size()) << name;
    double size = 0, most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      size = std::max(size, std::abs(a[i]));
      most = std::max(most, std::abs(a[i] - b[i]));
    }
    EXPECT_LE(most, tolerance * size) << name;
  };
  for (const char* name : {"xCell", "yCell", "zCell"}) expect_same(name, 0);
  for (const char* name : {"latCell", "lonCell"}) expect_same(name, 1e-15);
  for (const char* name : {"xVertex", "yVertex", "zVertex", "latVertex"}) expect_same(name, 1e-13);
  for (const char* name : {"areaCell", "areaTriangle"}) expect_same(name, 1e-7);
}

TEST_F(NetcdfFormats, MpasOfOthersGivesTrianglesWeightsAndData) {
  {
    Nc nc = Nc::create(path("o.nc"));
    const int cells = nc.add_dimension("nCells", 4), vertices = nc.add_dimension("nVertices", 3),
              degree = nc.add_dimension("vertexDegree", 3);
    nc.say(NC_GLOBAL, "on_a_sphere", "NO              ");
    nc.add<double>("xCell", {cells}, {0, 1, 1, 0});
    nc.add<double>("yCell", {cells}, {0, 0, 1, 1});
    nc.add<double>("zCell", {cells}, {3, 3, 3, 3});
    nc.add<double>("bottomDepth", {cells}, {10, 20, 30, 40});
    nc.add<double>("fVertex", {vertices}, {5, 6, 7});
    nc.add<std::int32_t>("cellsOnVertex", {vertices, degree}, {1, 2, 3, 2, 3, 0, 1, 3, 4});
  }
  const auto f = read(path("o.nc"));
  ASSERT_TRUE(f) << f.error().what();
  EXPECT_EQ(f->format, "mpas");
  EXPECT_EQ(f->z(), 3);
  EXPECT_EQ(f->triangles.corners, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
  ASSERT_EQ(f->point_data.size(), 1u);
  EXPECT_EQ(f->point_data[0].name, "bottomDepth");
  ASSERT_EQ(f->triangles.data.size(), 1u);
  EXPECT_EQ(std::get<std::vector<double>>(f->triangles.data[0].values), (std::vector<double>{5, 7}));
  ASSERT_EQ(f->warnings.size(), 1u);
  EXPECT_EQ(plain(f->warnings[0]), "o.nc: 1 vertices of fewer than three cells are no triangles and are left out");
}

TEST_F(NetcdfFormats, UgridOfOthersCountsFromOneFillsUpAndMayLieOnItsSide) {
  for (const bool turned : {false, true}) {
    {
      Nc nc = Nc::create(path("o.nc"));
      const int nodes = nc.add_dimension("nNode", 4), faces = nc.add_dimension("nFace", 2),
                most = nc.add_dimension("nMax", 4);
      nc.add<double>("lon", {nodes}, {0, 1, 1, 0});
      nc.add<double>("lat", {nodes}, {0, 0, 1, 1});
      const int depth = nc.add<double>("depth", {nodes}, {10, 20, 30, -999});
      nc.say(depth, "_FillValue", -999.0);
      nc.add<std::int32_t>("material", {faces}, {7, 8});
      const std::map<std::string, int> attributes = {{"start_index", 1}, {"_FillValue", -999}};
      if (turned) {
        nc.add<std::int32_t>("fn", {most, faces}, {1, 1, 2, 3, 3, 4, -999, -999}, attributes);
      } else {
        nc.add<std::int32_t>("fn", {faces, most}, {1, 2, 3, -999, 1, 3, 4, -999}, attributes);
      }
      const int mesh = nc.add<std::int32_t>("Mesh2", {}, {0}, {{"topology_dimension", 2}});
      nc.say(mesh, "cf_role", "mesh_topology");
      nc.say(mesh, "node_coordinates", "lon lat");
      nc.say(mesh, "face_node_connectivity", "fn");
      if (turned) nc.say(mesh, "face_dimension", "nFace");
    }
    const auto f = read(path("o.nc"));
    ASSERT_TRUE(f) << f.error().what();
    EXPECT_EQ(f->format, "ugrid");
    EXPECT_EQ(f->triangles.corners, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
    ASSERT_EQ(f->point_data.size(), 1u);
    EXPECT_EQ(f->point_data[0].name, "depth");
    const auto& depths = std::get<std::vector<double>>(f->point_data[0].values);
    EXPECT_EQ(depths[2], 30);
    EXPECT_TRUE(std::isnan(depths[3])) << "missing";
    ASSERT_EQ(f->triangles.data.size(), 1u);
    EXPECT_EQ(f->numbering->point(0), "point 1");
  }
}

TEST_F(NetcdfFormats, UgridMayHaveItsTablesInDoublesFilledUpWithNan) {
  const auto with = [&](double last, double fill) {
    {
      Nc nc = Nc::create(path("o.nc"));
      const int nodes = nc.add_dimension("nNode", 4), faces = nc.add_dimension("nFace", 2),
                most = nc.add_dimension("nMax", 4);
      nc.add<double>("x", {nodes}, {0, 1, 1, 0});
      nc.add<double>("y", {nodes}, {0, 0, 1, 1});
      const int table = nc.add<double>("fn", {faces, most}, {1, 2, 3, fill, 1, 3, last, fill}, {{"start_index", 1}});
      nc.say(table, "_FillValue", -999.0);
      const int mesh = nc.add<std::int32_t>("Mesh2", {}, {0}, {{"topology_dimension", 2}});
      nc.say(mesh, "cf_role", "mesh_topology");
      nc.say(mesh, "node_coordinates", "x y");
      nc.say(mesh, "face_node_connectivity", "fn");
    }
    return read(path("o.nc"));
  };
  for (const double fill : {-999.0, std::nan("")}) {
    const auto f = with(4, fill);
    ASSERT_TRUE(f) << f.error().what();
    EXPECT_EQ(f->triangles.corners, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
  }
  EXPECT_EQ(plain(with(3.5, -999).error().what()), "o.nc: variable fn has the value 3.5; expected whole numbers");
  EXPECT_EQ(plain(with(HUGE_VAL, -999).error().what()), "o.nc: variable fn has the value inf; expected whole numbers");
}

/// A square of two triangles, with these names of the topology and of its coordinates.
Nc square(const std::string& path, const std::string& topology, const std::vector<double>& x,
          const std::vector<double>& y, const std::string& axes = "x y", int mode = 0) {
  Nc nc = Nc::create(path, mode);
  const int nodes = nc.add_dimension("node", 4), faces = nc.add_dimension("face", 2),
            three = nc.add_dimension("three", 3);
  nc.add<double>("x", {nodes}, x);
  nc.add<double>("y", {nodes}, y);
  nc.add<std::int32_t>("fn", {faces, three}, {0, 1, 2, 0, 2, 3});
  const int mesh = nc.add<std::int32_t>(topology.c_str(), {}, {0}, {{"topology_dimension", 2}});
  nc.say(mesh, "cf_role", "mesh_topology");
  nc.say(mesh, "node_coordinates", axes);
  nc.say(mesh, "face_node_connectivity", "fn");
  return nc;
}
Nc square(const std::string& path, const std::string& topology = "Mesh2") {
  return square(path, topology, {0, 1, 1, 0}, {0, 0, 1, 1});
}
int id_of(const Nc& nc, const char* name) {
  int v = -1;
  EXPECT_EQ(nc_inq_varid(nc.id, name, &v), NC_NOERR) << name;
  return v;
}

TEST_F(NetcdfFormats, PackedNumbersAreUnpackedAndDeclaredOnesAreMissing) {
  {
    Nc nc = square(path("o.nc"));
    const std::vector<int> node = {0};
    const int packed = nc.add<std::int32_t>("packed", node, {100, 200, -7, 9000}, {{"_FillValue", -7}});
    nc.say(packed, "scale_factor", 0.01);
    nc.say(packed, "add_offset", 5.0);
    nc.say(packed, "valid_max", 10.0);  // of the unpacked numbers, by its type
    nc.say(packed, "units", "m");
    const int level = nc.add<double>("level", node, {1, -999, 3, NC_FILL_DOUBLE});
    nc.say(level, "missing_value", -999.0);
    nc.say(level, "standard_name", "altitude");
    nc.add<std::int32_t>("label", node, {1, -7, 3, 4}, {{"_FillValue", -7}});
  }
  auto f = read(path("o.nc"));
  ASSERT_TRUE(f) << f.error().what();
  ASSERT_TRUE(project(*f, kNoProjection)) << "a level of 3 in a unit square looks like degrees";
  const auto values = [](const MeshFile& file, const char* name) {
    for (const DataArray& a : file.point_data)
      if (a.name == name) return std::get<std::vector<double>>(a.values);
    return std::vector<double>();
  };
  const auto packed = values(*f, "packed"), level = values(*f, "level");
  ASSERT_EQ(packed.size(), 4u);
  EXPECT_EQ(packed[0], 6);
  EXPECT_EQ(packed[1], 7);
  EXPECT_TRUE(std::isnan(packed[2]) && std::isnan(packed[3]));
  EXPECT_TRUE(std::isnan(level[1]) && level[2] == 3);
  write_ok("again.nc", *f);
  const Nc nc = Nc::open(path("again.nc"));
  EXPECT_EQ(nc.text("packed", "units"), "m");
  double number = 0;
  EXPECT_NE(nc_get_att_double(nc.id, id_of(nc, "packed"), "scale_factor", &number), NC_NOERR) << "it is unpacked";
  EXPECT_EQ(nc.get<double>("level")[1], -999) << "as it came";
  EXPECT_EQ(nc.get<std::int32_t>("label"), (std::vector<std::int32_t>{1, -7, 3, 4})) << "a label is no number";
  int fill = 0;
  EXPECT_EQ(nc_get_att_int(nc.id, id_of(nc, "label"), "_FillValue", &fill), NC_NOERR);
  EXPECT_EQ(fill, -7);
  const auto back = read(path("again.nc"));
  ASSERT_TRUE(back);
  EXPECT_TRUE(std::isnan(values(*back, "packed")[2]) && std::isnan(values(*back, "level")[1]));
}

// Through VTU, too, whose field data keep them.
TEST_F(NetcdfFormats, AttributesSystemsNamesAndUnitsComeBack) {
  {
    Nc nc = square(path("o.nc"), "Mesh2", {0, 0, 1, 1}, {0, 1, 1, 0}, "x y");
    nc.say(NC_GLOBAL, "title", "a basin");
    nc.say(NC_GLOBAL, "Conventions", "CF-1.8 UGRID-1.0 Deltares-0.10");
    for (const char* axis : {"x", "y"}) nc.say(id_of(nc, axis), "units", "km");
    nc.say(id_of(nc, "x"), "standard_name", "projection_y_coordinate");  // they are told by what they say
    nc.say(id_of(nc, "y"), "standard_name", "projection_x_coordinate");
    nc.say(id_of(nc, "Mesh2"), "long_name", "the mesh");
    const int map = nc.add<std::int32_t>("projected_coordinate_system", {}, {28992}, {{"epsg", 28992}});
    nc.say(map, "grid_mapping_name", "oblique_stereographic");
    nc.say(nc.add<double>("level", {0}, {1, 2, 3, 4}), "grid_mapping", "projected_coordinate_system");
  }
  auto f = read(path("o.nc"));
  ASSERT_TRUE(f) << f.error().what();
  EXPECT_EQ(f->points[1], (Vec2{1, 0}));
  ASSERT_EQ(f->warnings.size(), 1u);
  EXPECT_EQ(plain(f->warnings[0]), "o.nc: coordinates are in km: so are lengths and sizes");
  ASSERT_TRUE(write(path("m.vtu"), *f));
  f = read(path("m.vtu"));
  ASSERT_TRUE(f);
  ASSERT_TRUE(write(path("again.nc"), *f));
  const Nc nc = Nc::open(path("again.nc"));
  EXPECT_EQ(nc.text(nullptr, "title"), "a basin");
  EXPECT_EQ(nc.text(nullptr, "Conventions"), "CF-1.8 UGRID-1.0 Deltares-0.10");
  EXPECT_EQ(nc.text("Mesh2", "long_name"), "the mesh");
  EXPECT_EQ(nc.text("Mesh2", "node_coordinates"), "y x") << "x first";
  EXPECT_EQ(nc.text("y", "units"), "km");
  EXPECT_EQ(nc.text("Mesh2_face_x", "units"), "km");
  EXPECT_EQ(nc.get<double>("y"), (std::vector<double>{0, 1, 1, 0}));
  EXPECT_EQ(nc.get<std::int32_t>("projected_coordinate_system"), std::vector<std::int32_t>{28992});
  EXPECT_EQ(nc.text("projected_coordinate_system", "grid_mapping_name"), "oblique_stereographic");
  EXPECT_EQ(nc.text("level", "grid_mapping"), "projected_coordinate_system");
  ASSERT_TRUE(write(path("third.nc"), *read(path("again.nc"))));
  EXPECT_EQ(slurp(path("third.nc")), slurp(path("again.nc")));
}

// xarray writes whole numbers of 64 bits, for example of coordinate systems.
TEST_F(NetcdfFormats, SingleNumbersOf64BitsAreKept) {
  {
    Nc nc = square(path("o.nc"), "Mesh2", {0, 1, 1, 0}, {0, 0, 1, 1}, "x y", NC_64BIT_DATA);
    nc.say(nc.add<std::int64_t>("spatial_ref", {}, {-28992}), "grid_mapping_name", "oblique_stereographic");
    nc.add<std::int64_t>("large", {}, {std::int64_t{1} << 40});
  }
  const auto f = read(path("o.nc"));
  ASSERT_TRUE(f) << f.error().what();
  ASSERT_TRUE(write(path("again.nc"), *f));
  const Nc nc = Nc::open(path("again.nc"));
  EXPECT_EQ(nc.get<std::int32_t>("spatial_ref"), std::vector<std::int32_t>{-28992});
  EXPECT_EQ(nc.text("spatial_ref", "grid_mapping_name"), "oblique_stereographic");
  EXPECT_EQ(nc.get<double>("large"), std::vector<double>{0x1p40});
}

TEST_F(NetcdfFormats, RadiansAreDegreesInMemoryAndRadiansAgain) {
  {
    Nc nc = square(path("o.nc"), "grid", {0, 0.1, 0.1, 0}, {0.5, 0.5, 0.6, 0.6});
    for (const char* axis : {"x", "y"}) nc.say(id_of(nc, axis), "units", "radian");
    nc.say(id_of(nc, "x"), "long_name", "longitude");
    nc.say(id_of(nc, "y"), "long_name", "latitude");
  }
  auto f = read(path("o.nc"));
  ASSERT_TRUE(f) << f.error().what();
  ASSERT_TRUE(f->degrees() != nullptr);
  EXPECT_DOUBLE_EQ(f->points[1].x, 18 / std::numbers::pi);
  ASSERT_TRUE(project(*f, "stereographic"));
  ASSERT_TRUE(write(path("again.nc"), *f));
  const Nc nc = Nc::open(path("again.nc"));
  EXPECT_EQ(nc.text("x", "units"), "radian");
  EXPECT_DOUBLE_EQ(nc.get<double>("x")[1], 0.1);
}

// D-Flow FM: mesh2d_node_z, positive up, is the depth of others, positive down.
TEST_F(NetcdfFormats, DepthsAreBedLevelsAndComeBack) {
  MeshFile f = bent_lattice();
  f.weights.clear();
  std::vector<double> depth;
  for (const Vec2 p : f.points) depth.push_back(1 + p.x / 8);
  f.point_data = {{"depth", 1, depth}};
  write_ok("m.nc", f);
  const Nc nc = Nc::open(path("m.nc"));
  EXPECT_EQ(nc.get<double>("mesh2d_node_z")[3], -depth[3]);
  EXPECT_EQ(nc.text("mesh2d_node_z", "standard_name"), "altitude");
  EXPECT_EQ(nc.text("mesh2d_node_z", "positive"), "up");
  const auto back = read(path("m.nc"));
  ASSERT_TRUE(back);
  for (const char* name : {"m.14", "m.2dm"}) {
    ASSERT_TRUE(write(path(name), *back));
    auto again = read(path(name));
    ASSERT_TRUE(again) << again.error().what();
    ASSERT_TRUE(project(*again, kNoProjection)) << "a small lattice looks like degrees";
    const auto& values = std::get<std::vector<double>>(again->point_data.at(0).values);
    EXPECT_EQ(values[3], again->z_is_data ? -depth[3] : depth[3]) << name;
    ASSERT_TRUE(write(path("again.nc"), *again));
    EXPECT_EQ(Nc::open(path("again.nc")).get<double>("mesh2d_node_z")[3], -depth[3]) << name;
  }
}

TEST_F(NetcdfFormats, EdgesAloneEncloseTriangles) {
  const MeshFile lattice = bent_lattice();
  const auto net = [&](bool old, bool whole) {
    Nc nc = Nc::create(path("o.nc"));
    std::vector<double> x, y;
    for (const Vec2 p : lattice.points) x.push_back(p.x), y.push_back(p.y);
    std::set<std::pair<int, int>> edges;
    for (const auto& t : lattice.triangles)
      for (std::size_t k = 0; k < 3; ++k) edges.insert(std::minmax({t[k], t[(k + 1) % 3]}));
    if (!whole) edges.erase(std::minmax({lattice.triangles[4][1], lattice.triangles[4][2]}));
    std::vector<std::int32_t> ends, types(edges.size(), 2);
    for (const auto& [a, b] : edges) ends.insert(ends.end(), {a + old, b + old});
    const int nodes = nc.add_dimension("n", x.size()), links = nc.add_dimension("e", edges.size()),
              two = nc.add_dimension("two", 2);
    nc.add<double>(old ? "NetNode_x" : "x", {nodes}, x);
    nc.add<double>(old ? "NetNode_y" : "y", {nodes}, y);
    nc.add<double>(old ? "NetNode_z" : "level", {nodes}, x);
    nc.add<std::int32_t>(old ? "NetLink" : "en", {links, two}, ends);
    if (old) {
      nc.add<std::int32_t>("NetLinkType", {links}, types);
      const std::vector<std::int32_t> of_another_net = {1, 2, static_cast<std::int32_t>(x.size()) + 1};
      nc.add<std::int32_t>("NetElemNode", {nc.add_dimension("one", 1), nc.add_dimension("three", 3)}, of_another_net);
      return;
    }
    const int mesh = nc.add<std::int32_t>("m", {}, {0}, {{"topology_dimension", 2}});
    nc.say(mesh, "cf_role", "mesh_topology");
    nc.say(mesh, "node_coordinates", "x y");
    nc.say(mesh, "edge_node_connectivity", "en");
  };
  const auto corners = [](MeshFile file) {
    for (auto& t : file.triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    std::sort(file.triangles.begin(), file.triangles.end());
    return file.triangles.corners;
  };
  for (const bool old : {false, true}) {
    net(old, true);
    const auto f = read(path("o.nc"));
    ASSERT_TRUE(f) << f.error().what();
    EXPECT_EQ(corners(*f), corners(lattice));
    EXPECT_EQ(f->point_data.at(0).name, old ? "mesh2d_node_z" : "level");
    net(old, false);
    const auto with_a_square = read(path("o.nc"));
    ASSERT_TRUE(with_a_square) << with_a_square.error().what();
    EXPECT_EQ(with_a_square->triangles.size(), lattice.triangles.size());
    EXPECT_EQ(with_a_square->triangles.data.back().name, "temper:quadrilateral");
  }
}

//   4 ─── 3     A square with a diagonal, and a channel of its own: 5 6 7.
//   │   ╱ │
//   1 ─── 2
TEST_F(NetcdfFormats, LinksOfDFlowFmEncloseTrianglesWhateverTheirTypes) {
  const auto net = [&](const std::vector<std::int32_t>& types, std::int32_t last) {
    Nc nc = Nc::create(path("o.nc"));
    const int nodes = nc.add_dimension("n", 7), links = nc.add_dimension("e", 8), two = nc.add_dimension("two", 2);
    nc.add<double>("NetNode_x", {nodes}, {0, 1, 1, 0, .1, .9, .9});
    nc.add<double>("NetNode_y", {nodes}, {0, 0, 1, 1, .05, .05, .8});
    nc.add<std::int32_t>("NetLink", {links, two}, {1, 2, 2, 3, 3, 4, 4, 1, 1, last, 5, 6, 6, 7, 7, 5});
    if (!types.empty()) nc.add<std::int32_t>("NetLinkType", {links}, types);
  };
  const std::vector<std::vector<std::int32_t>> with_channel = {
      {0, 0, 0, 0, 0, 1, 1, 1}, {2, 2, 2, 2, 3, 1, 1, 1}, {0, 2, 0, 2, 1, 5, 5, 5}};
  for (const auto& types : with_channel) {
    net(types, 3);
    const auto f = read(path("o.nc"));
    ASSERT_TRUE(f) << f.error().what();
    EXPECT_EQ(f->triangles.size(), 2u) << "no triangle of the channel";
  }
  for (const std::int32_t type : {1, 3, 0}) {
    net(std::vector<std::int32_t>(8, type), 3);
    const auto f = read(path("o.nc"));
    ASSERT_TRUE(f) << f.error().what();
    EXPECT_EQ(f->triangles.size(), 3u) << "all links are of the plane";
  }
}

TEST_F(NetcdfFormats, LinksThatEncloseNothingAreNoMesh) {
  {
    Nc nc = Nc::create(path("o.nc"));
    const int nodes = nc.add_dimension("n", 3), links = nc.add_dimension("e", 2), two = nc.add_dimension("two", 2);
    nc.add<double>("NetNode_x", {nodes}, {0, 1, 1});
    nc.add<double>("NetNode_y", {nodes}, {0, 0, 1});
    nc.add<std::int32_t>("NetLink", {links, two}, {1, 2, 2, 3});
    nc.add<std::int32_t>("NetLinkType", {links}, {0, 0});
  }
  const auto f = read(path("o.nc"));
  ASSERT_FALSE(f);
  EXPECT_EQ(plain(f.error().what()),
            "o.nc: its 2 edges (NetLink) enclose no triangle and no quadrilateral. Next: write the mesh with its "
            "faces, or with all their edges");
}

TEST_F(NetcdfFormats, IconIsAMeshOfTheSphereByItsTableOrByItsCorners) {
  const MeshFile globe = from_mesh(*icosahedral({.level = 2, .radius = 6371229}));
  const auto radians = [](double degrees) { return degrees * (std::numbers::pi / 180); };
  for (const bool by_table : {true, false}) {
    {
      Nc nc = Nc::create(path("o.nc"));
      const int cells = nc.add_dimension("cell", globe.triangles.size()), three = nc.add_dimension("nv", 3),
                vertices = nc.add_dimension("vertex", globe.points.size());
      nc.say(NC_GLOBAL, "sphere_radius", 6371229.0);
      std::vector<double> lon, lat;
      std::vector<std::int32_t> table(3 * globe.triangles.size());
      for (std::size_t t = 0; t < globe.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec2 p = globe.points[static_cast<std::size_t>(globe.triangles[t][k])];
          table[k * globe.triangles.size() + t] = globe.triangles[t][k] + 1;
          if (!by_table) lon.push_back(radians(p.x)), lat.push_back(radians(p.y));
        }
      }
      if (by_table) {
        for (const Vec2 p : globe.points) lon.push_back(radians(p.x)), lat.push_back(radians(p.y));
        nc.add<double>("vlon", {vertices}, lon);
        nc.add<double>("vlat", {vertices}, lat);
        nc.add<std::int32_t>("vertex_of_cell", {three, cells}, table);
      } else {
        nc.add<double>("clon_vertices", {cells, three}, lon);
        nc.add<double>("clat_vertices", {cells, three}, lat);
      }
    }
    const auto f = read(path("o.nc"));
    ASSERT_TRUE(f) << f.error().what();
    EXPECT_EQ(f->points.size(), globe.points.size());
    const auto made = make_mesh(*f);
    ASSERT_TRUE(made) << made.error().what();
    EXPECT_EQ(made->mesh.space().radius(), 6371229);
    EXPECT_EQ(made->mesh.n_triangles(), globe.triangles.size());
    EXPECT_FALSE(made->mesh.validate());
    EXPECT_EQ(made->reversed_triangles, 0u);
  }
}

TEST_F(NetcdfFormats, PublicPackedDataStayInTheirRange) {
  const std::string packed = TEMPER_SHARED "/reports/data_packed.nc";
  if (!std::filesystem::exists(packed)) GTEST_SKIP() << "no " << packed;
  const auto f = read(packed);
  ASSERT_TRUE(f) << f.error().what();
  for (const DataArray& a : f->point_data) {
    if (a.name != "depth") continue;
    for (const double d : std::get<std::vector<double>>(a.values))
      EXPECT_TRUE(std::isnan(d) || (d >= 5 && d <= 11)) << d;
  }
  EXPECT_TRUE(read(TEMPER_SHARED "/reports/list_attr.nc"));
}

TEST_F(NetcdfFormats, HeadersOfAnyLengthAreRead) {
  for (std::size_t length = 500; length < 9000; length += 250) {
    {
      Nc nc = Nc::create(path("o.nc"));
      const int nodes = nc.add_dimension("nNode", 3), faces = nc.add_dimension("nFace", 1),
                three = nc.add_dimension("nMax", 3);
      nc.add<double>("x", {nodes}, {0, 1, 0});
      nc.add<double>("y", {nodes}, {0, 0, 1});
      nc.add<std::int32_t>("fn", {faces, three}, {0, 1, 2});
      const int mesh = nc.add<std::int32_t>("Mesh2", {}, {0}, {{"topology_dimension", 2}});
      nc.say(mesh, "cf_role", "mesh_topology");
      nc.say(mesh, "node_coordinates", "x y");
      nc.say(mesh, "face_node_connectivity", "fn");
      nc.say(mesh, "history", std::string(length, 'h').c_str());
    }
    const auto f = read(path("o.nc"));
    ASSERT_TRUE(f) << length << ": " << f.error().what();
    EXPECT_EQ(f->points, (std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}}));
  }
}

TEST_F(NetcdfFormats, UgridSaysWhereOrthocentersAndEdgesAre) {
  const MeshFile f = bent_lattice();
  write_ok("m.nc", f);
  const Nc nc = Nc::open(path("m.nc"));
  EXPECT_EQ(nc.text("mesh", "cf_role"), "mesh_topology");
  EXPECT_EQ(nc.text("mesh", "face_coordinates"), "mesh_face_x mesh_face_y");
  EXPECT_EQ(nc.text("mesh_node_weight", "location"), "node");
  EXPECT_TRUE(same_bits(nc.get<double>("mesh_node_weight"), f.weights));
  const auto x = nc.get<double>("mesh_face_x"), y = nc.get<double>("mesh_face_y");
  for (std::size_t t = 0; t < f.triangles.size(); ++t) {
    const auto power = [&](std::size_t k) {
      const auto p = static_cast<std::size_t>(f.triangles[t][k]);
      const Vec2 d = Vec2{x[t], y[t]} - f.points[p];
      return dot(d, d) - f.weights[p];
    };
    EXPECT_NEAR(power(0), power(1), 1e-13);
    EXPECT_NEAR(power(0), power(2), 1e-13);
  }
  const auto edge_nodes = nc.get<std::int32_t>("mesh_edge_nodes"), edge_faces = nc.get<std::int32_t>("mesh_edge_faces");
  EXPECT_EQ(edge_nodes.size() / 2, f.points.size() + f.triangles.size() - 1) << "Euler";
  EXPECT_EQ(std::count(edge_faces.begin(), edge_faces.end(), -1), 18);
}

// D-Flow FM finds the bed level by the name of the topology: mesh2d_node_z of mesh2d.
TEST_F(NetcdfFormats, UgridNamesItsTopologyAsTheDataDo) {
  MeshFile f = bent_lattice();
  const std::vector<double> depth(f.points.size(), -5.0);
  f.point_data = {{"mesh2d_node_z", 1, depth}};
  write_ok("net.nc", f);
  const Nc nc = Nc::open(path("net.nc"));
  EXPECT_EQ(nc.text("mesh2d", "cf_role"), "mesh_topology");
  EXPECT_EQ(nc.text("mesh2d", "node_coordinates"), "mesh2d_node_x mesh2d_node_y");
  EXPECT_EQ(nc.text("mesh2d_node_z", "mesh"), "mesh2d");
  EXPECT_EQ(nc.get<double>("mesh2d_node_z"), depth);
  const auto again = read(path("net.nc"));
  ASSERT_TRUE(again);
  EXPECT_EQ(again->weights, f.weights);
  ASSERT_EQ(again->point_data.size(), 1u);
  EXPECT_EQ(again->point_data[0].name, "mesh2d_node_z");
  f.point_data = {{"2d_node_z", 1, depth}, {"_node_z", 1, depth}, {"a b_node_z", 1, depth}};
  write_ok("plain.nc", f);
  EXPECT_EQ(Nc::open(path("plain.nc")).text("mesh", "cf_role"), "mesh_topology");
}

TEST_F(NetcdfFormats, MpasHasLatitudesAndLongitudesOfAMeshThatKnowsThem) {
  constexpr double kRadians = std::numbers::pi / 180;
  Mesh mesh = *random_mesh({.vertices = 60, .seed = 2});
  ASSERT_TRUE(optimize(mesh));  // no orthocenter is beyond the mesh
  MeshFile on_map = from_mesh(mesh);
  const Projection about_greenwich = {ProjectionKind::stereographic, {0, 49}};
  for (Vec2& p : on_map.points) p = inverse(about_greenwich, 1e5 * (p - Vec2{2, 2}));
  for (double& w : on_map.weights) w *= 1e10;
  const std::vector<Vec2> degrees = on_map.points;
  ASSERT_TRUE(project(on_map, "stereographic:0,49"));
  const Projection projection = on_map.map()->projection;
  MeshFile with_data = on_map;
  with_data.points_in = PlanePoints{};
  std::vector<double> longitude, latitude;
  for (const Vec2 p : degrees) longitude.push_back(p.x), latitude.push_back(p.y);
  with_data.point_data = {{"longitude", 1, longitude}, {"latitude", 1, latitude}};
  for (const MeshFile* f : {&on_map, &with_data}) {
    ASSERT_TRUE(write(path("m.mpas.nc"), *f));
    const Nc nc = Nc::open(path("m.mpas.nc"));
    const auto lat = nc.get<double>("latCell"), lon = nc.get<double>("lonCell");
    ASSERT_EQ(lat.size(), degrees.size());
    for (std::size_t i = 0; i < lat.size(); ++i) {
      EXPECT_NEAR(lat[i], degrees[i].y * kRadians, 1e-15);
      EXPECT_NEAR(lon[i], (degrees[i].x + (degrees[i].x < 0 ? 360 : 0)) * kRadians, 1e-14);
      EXPECT_TRUE(lon[i] >= 0 && lon[i] < 2 * std::numbers::pi);
    }
    for (const std::string what : {"Vertex", "Edge"}) {
      const auto x = nc.get<double>(("x" + what).c_str()), y = nc.get<double>(("y" + what).c_str());
      const auto lats = nc.get<double>(("lat" + what).c_str()), lons = nc.get<double>(("lon" + what).c_str());
      for (std::size_t i = 0; i < x.size(); ++i) {
        const Vec2 place = inverse(projection, {x[i], y[i]});
        // Linear between the cells, an edge of 1 degree apart, where the map itself is not known.
        const double tolerance = f == &on_map ? 1e-12 : 2e-4;
        EXPECT_NEAR(lats[i], place.y * kRadians, tolerance);
        EXPECT_NEAR(std::remainder(lons[i] - place.x * kRadians, 2 * std::numbers::pi), 0, 2 * tolerance);
      }
      EXPECT_GT(x.size(), 50u);
    }
  }
}

TEST_F(NetcdfFormats, WhatIsNoPlanarMeshOfTrianglesIsNamed) {
  const auto refused = [&](const auto& make_file) {
    {
      Nc nc = Nc::create(path("o.nc"));
      make_file(nc);
    }
    const auto f = read(path("o.nc"));
    EXPECT_FALSE(f);
    return f ? "" : plain(f.error().what());
  };
  EXPECT_EQ(refused([](Nc& nc) {
              nc.add<double>("x", {nc.add_dimension("n", 2)}, {0, 1});
            }),
            "o.nc: is NetCDF without a mesh that temper reads: neither MPAS, ICON nor a two-dimensional topology of "
            "UGRID. Next: "
            "write the mesh as UGRID with its faces");
  EXPECT_EQ(refused([](Nc& nc) {
              const int n = nc.add_dimension("nCells", 3), v = nc.add_dimension("nVertices", 1),
                        d = nc.add_dimension("vertexDegree", 3);
              nc.say(NC_GLOBAL, "on_a_sphere", "YES");
              nc.add<double>("xCell", {n}, {0, 1, 0});
              nc.add<double>("yCell", {n}, {0, 0, 1});
              nc.add<double>("zCell", {n}, {0, 0, 2});
              nc.add<std::int32_t>("cellsOnVertex", {v, d}, {1, 2, 3});
            }),
            "o.nc: point 3 has z = 2, but point 1 has z = 0; expected a mesh in a plane of constant x, y or z, or on a "
            "sphere "
            "around the origin. Next: --flat takes z as data of a mesh of the plane (flat=True in Python)");
  // What MPAS says of its coordinates must be so.
  const auto contradiction = [&](const char* on_a_sphere, double radius, double last_z) {
    return refused([&](Nc& nc) {
      const int n = nc.add_dimension("nCells", 3), v = nc.add_dimension("nVertices", 1),
                d = nc.add_dimension("vertexDegree", 3);
      nc.say(NC_GLOBAL, "on_a_sphere", on_a_sphere);
      nc.say(NC_GLOBAL, "sphere_radius", radius);
      nc.add<double>("xCell", {n}, {1, 0, 0});
      nc.add<double>("yCell", {n}, {0, 1, 0});
      nc.add<double>("zCell", {n}, {0, 0, last_z});
      nc.add<std::int32_t>("cellsOnVertex", {v, d}, {1, 2, 3});
    });
  };
  EXPECT_EQ(
      contradiction("YES", 2, 1),
      "o.nc: attribute sphere_radius is 2, but point 1 is 1 from the origin; expected xCell, yCell and zCell on a "
      "sphere of that radius");
  EXPECT_EQ(
      contradiction("YES", 1, 3),
      "o.nc: attribute sphere_radius is 1, but point 3 is 3 from the origin; expected xCell, yCell and zCell on a "
      "sphere of that radius");
  EXPECT_EQ(contradiction("NO", 0, 1),
            "o.nc: attribute on_a_sphere is NO, but point 3 has z = 1 and point 1 has z = 0; expected a plane of "
            "constant z");
  EXPECT_EQ(refused([](Nc& nc) {
              const int n = nc.add_dimension("n", 4), f = nc.add_dimension("f", 1), d = nc.add_dimension("five", 5);
              nc.add<double>("x", {n}, {0, 1, 1, 0});
              nc.add<double>("y", {n}, {0, 0, 1, 1});
              nc.add<std::int32_t>("fn", {f, d}, {0, 1, 2, 3, 0});
              const int mesh = nc.add<std::int32_t>("mesh", {}, {0});
              nc.say(mesh, "cf_role", "mesh_topology");
              nc.say(mesh, "node_coordinates", "x y");
              nc.say(mesh, "face_node_connectivity", "fn");
            }),
            "o.nc: face 0 has 5 corners; temper reads triangles and quadrilaterals");
}

// Grids, with either order of their axes; the values of places are the same.
TEST_F(NetcdfFormats, GridsAreMeshesWithTheirDataAtPoints) {
  const std::vector<double> lon = {-10, -5, 0, 5}, lat = {50, 48, 46};  // from north to south
  for (const bool turned : {false, true}) {
    const std::string name = path(turned ? "turned.nc" : "grid.nc");
    {
      Nc nc = Nc::create(name);
      const int x = nc.add_dimension("lon", 4), y = nc.add_dimension("lat", 3), time = nc.add_dimension("time", 1);
      nc.say(nc.add("lon", {x}, lon), "units", "degrees_east");
      nc.say(nc.add("lat", {y}, lat), "units", "degrees_north");
      std::vector<double> values;
      for (std::size_t k = 0; k < 12; ++k) {
        const std::size_t i = turned ? k / 3 : k % 4, j = turned ? k % 3 : k / 4;
        values.push_back(i == 3 && j == 0 ? -9999 : lon[i] + 100 * lat[j]);
      }
      nc.say(nc.add("elevation", turned ? std::vector<int>{x, y} : std::vector<int>{time, y, x}, values), "_FillValue",
             -9999.0);
      nc.add("other", {y}, std::vector<double>(3));
    }
    const auto file = read(name);
    ASSERT_TRUE(file) << file.error().what();
    EXPECT_EQ(file->format, "ncgrid");
    EXPECT_NE(file->degrees(), nullptr);
    ASSERT_EQ(file->points.size(), 11u);
    ASSERT_EQ(file->point_data.size(), 1u);
    EXPECT_EQ(file->point_data[0].name, "elevation");
    for (std::size_t i = 0; i < 11; ++i) {
      EXPECT_EQ(std::get<std::vector<double>>(file->point_data[0].values)[i],
                file->points[i].x + 100 * file->points[i].y);
    }
    EXPECT_EQ(file->triangles.size(), 11u);
  }
}

TEST_F(NetcdfFormats, LargeGridsBecomeMeansOfBlocks) {
  constexpr std::size_t kColumns = 2500, kRows = 2000;
  {
    Nc nc = Nc::create(path("large.nc"));
    const int x = nc.add_dimension("x", kColumns), y = nc.add_dimension("y", kRows);
    std::vector<int> ascending(kColumns), values(kColumns * kRows);
    for (std::size_t i = 0; i < kColumns; ++i) ascending[i] = static_cast<int>(i);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = i % 2 == 0 ? 1 : 3;
    nc.add("x", {x}, ascending);
    nc.add("y", {y}, std::vector<int>(ascending.begin(), ascending.begin() + kRows));
    nc.add("z", {y, x}, values);
  }
  const auto file = read(path("large.nc"));
  ASSERT_TRUE(file) << file.error().what();
  EXPECT_EQ(file->points.size(), kColumns * kRows / 4);
  EXPECT_EQ(file->points[0].x, 0.5);
  ASSERT_EQ(file->warnings.size(), 1u);
  EXPECT_TRUE(file->warnings[0].ends_with("the raster has 2500 times 2000 points; means of 2 times 2 are used"));
  const auto& means = std::get<std::vector<double>>(file->point_data[0].values);
  EXPECT_TRUE(std::ranges::all_of(means, [](double v) { return v == 2; }));
}

//   3-----4-----5     block 10 "rock": the quadrilateral; block 20: two triangles; the left side is the side set
//   |     |   / |     "inflow", node 2 the node set "well".
//   |     | /   |
//   0-----1-----2
TEST_F(NetcdfFormats, ExodusHasBlocksSetsNamesAndTheLastValues) {
  const auto write_exodus = [&](std::int32_t side, const std::string& type) {
    Nc nc = Nc::create(path("o.e"));
    const auto size = [&](std::size_t n) {
      const std::string name = "n" + std::to_string(n);
      int d = -1;
      return nc_inq_dimid(nc.id, name.c_str(), &d) == NC_NOERR ? d : nc.add_dimension(name.c_str(), n);
    };
    const auto names = [&](const char* variable, const std::vector<std::string>& all) {
      std::vector<char> bytes;
      for (std::string name : all) {
        name.resize(9);
        bytes.insert(bytes.end(), name.begin(), name.end());
      }
      const int rows = size(all.size()), columns = size(9);
      nc.add<char>(variable, {rows, columns}, bytes);
    };
    nc.add<double>("coordx", {size(6)}, {0, 1, 2, 0, 1, 2});
    nc.add<double>("coordy", {size(6)}, {0, 0, 0, 1, 1, 1});
    nc.say(nc.add<std::int32_t>("connect1", {size(1), size(4)}, {1, 2, 5, 4}), "elem_type", "QUAD4");
    nc.say(nc.add<std::int32_t>("connect2", {size(2), size(3)}, {2, 3, 6, 2, 6, 5}), "elem_type", type);
    nc.add<std::int32_t>("eb_prop1", {size(2)}, {10, 20});
    names("eb_names", {"rock", ""});
    nc.add<std::int32_t>("elem_ss1", {size(1)}, {1});
    nc.add<std::int32_t>("side_ss1", {size(1)}, {side});
    names("ss_names", {"inflow"});
    nc.add<std::int32_t>("node_ns1", {size(1)}, {3});
    nc.add<std::int32_t>("ns_prop1", {size(1)}, {7});
    names("ns_names", {"well"});
    names("name_nod_var", {"head"});
    nc.add<double>("vals_nod_var1", {size(2), size(6)}, {0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 6});
    names("name_elem_var", {"k"});
    nc.add<double>("vals_elem_var1eb2", {size(1), size(2)}, {8, 9});
  };
  write_exodus(4, "TRI3");
  const auto f = read(path("o.e"));
  ASSERT_TRUE(f) << f.error().what();
  EXPECT_EQ(f->triangles.tags, (std::vector<std::int32_t>{10, 10, 20, 20}));
  EXPECT_EQ(f->numbering->triangle(3), "triangle 3") << "the number of the element";
  EXPECT_EQ(f->lines.corners, (std::vector<std::array<std::int32_t, 2>>{{3, 0}}));
  EXPECT_EQ(f->marked_points.corners, (std::vector<std::int32_t>{2}));
  EXPECT_EQ(f->marked_points.tags, (std::vector<std::int32_t>{7}));
  const std::vector<PhysicalName> expected = {{2, 10, "rock"}, {1, 1, "inflow"}, {0, 7, "well"}};
  ASSERT_EQ(f->names.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(f->names[i].dimension, expected[i].dimension);
    EXPECT_EQ(f->names[i].tag, expected[i].tag);
    EXPECT_EQ(f->names[i].name, expected[i].name);
  }
  EXPECT_EQ(std::get<std::vector<double>>(f->point_data.at(0).values), (std::vector<double>{1, 2, 3, 4, 5, 6}));
  const auto& k = std::get<std::vector<double>>(f->triangles.data.at(0).values);
  EXPECT_TRUE(std::isnan(k[0]) && std::isnan(k[1]) && k[2] == 8 && k[3] == 9);
  EXPECT_TRUE(make_mesh(*f));

  write_exodus(5, "TRI3");
  EXPECT_EQ(plain(read(path("o.e")).error().what()),
            "o.e: side set 1 has side 5 of element 1, expected a side of a triangle or quadrilateral");
  write_exodus(4, "WEDGE");
  EXPECT_EQ(plain(read(path("o.e")).error().what()),
            "o.e: element 2 is a cell of type WEDGE with 3 nodes; temper reads linear triangles and quadrilaterals, "
            "with lines "
            "and points as tags");
}

TEST_F(NetcdfFormats, MedIsNamed) {
  int id = -1, group = -1;
  ASSERT_EQ(nc_create(path("o.med").c_str(), NC_NETCDF4, &id), NC_NOERR);
  EXPECT_EQ(nc_def_grp(id, "ENS_MAA", &group), NC_NOERR);
  EXPECT_EQ(nc_close(id), NC_NOERR);
  const auto f = read(path("o.med"));
  ASSERT_FALSE(f);
  EXPECT_EQ(plain(f.error().what()), "o.med: is a MED mesh, which temper does not read; meshio converts it");
}

TEST_F(NetcdfFormats, AMeshWithoutOrthocentersIsRefusedAndNothingIsWritten) {
  MeshFile f = bent_lattice();
  f.points[1] = f.points[0];
  for (const char* name : {"m.mpas.nc", "m.nc"}) {
    const auto result = write(path(name), f);
    ASSERT_FALSE(result);
    EXPECT_NE(result.error().what().find("holds orthocenters and so needs a valid mesh"), std::string::npos);
  }
  EXPECT_TRUE(files().empty());
}

TEST(Netcdf, HasNoLimitToAVariableWhereSixtyFourBitOffsetsHaveOne) {
  constexpr std::size_t kMost = (std::size_t{1} << 29) - 1;  // doubles, in 2³² − 4 bytes
  MeshFile file;
  EXPECT_FALSE(needs_cdf5(file, kMost));
  EXPECT_TRUE(needs_cdf5(file, kMost + 1));
  EXPECT_TRUE(needs_cdf5(file, std::size_t{20} << 31));  // edges on edges of a mesh of 2³¹ half-edges
  file.point_data.push_back({"depth", 1, std::vector<double>(3)});
  file.field_data.push_back({std::string(kNetcdfAttributes), 1, std::vector<std::uint8_t>(3)});  // not written as such
  EXPECT_FALSE(needs_cdf5(file, 3));
  file.point_data.push_back({"number", 1, std::vector<std::int64_t>(3)});
  EXPECT_TRUE(needs_cdf5(file, 3));
}

}  // namespace
}  // namespace temper::io
#endif

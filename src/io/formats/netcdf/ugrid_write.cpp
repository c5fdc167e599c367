// See ugrid_read.cpp for the variables of UGRID.
#include <algorithm>
#include <array>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "io/conversion/globe.hpp"
#include "io/conversion/quadrilaterals.hpp"
#include "io/formats/format.hpp"
#include "io/formats/netcdf/netcdf_extras.hpp"
#include "io/formats/netcdf/ugrid.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {
namespace {

constexpr std::int32_t kUgridNone = -1;  // the _FillValue

/// The name that the data have in front of _node_ or _face_, as in mesh2d_node_z; else "mesh". So names that a solver
/// looks for stay what they are.
std::string name_of_topology(const MeshFile& file) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
  for (const auto& [data, location] :
       {std::pair{&file.point_data, "_node_"}, std::pair{&file.triangles.data, "_face_"}}) {
    for (const DataArray& a : *data) {
      const std::size_t at = a.name.find(location);
      if (at == std::string::npos || at == 0) continue;
      std::string name = a.name.substr(0, at);
      if (name.find_first_not_of(kPlain) == std::string::npos && name[0] > '9') return name;
    }
  }
  return std::string(kUsualTopology);
}

class UgridWriter {
 public:
  explicit UgridWriter(const WriteJob& job)
      : job_(job),
        m_(mesh_for_netcdf(job, "UGRID")),
        kept_(m_.file),
        topology_(kept_.find("cf_role", "mesh_topology")),
        name_(topology_ != nullptr ? topology_->name : name_of_topology(m_.file)),
        out_(job.path, needs_cdf5(m_.file, std::max(2 * m_.complex.edges.size(), 3 * m_.mesh.n_triangles()))) {}

  void write() {
    nodes_ = out_.dimension(named("nodes"), m_.mesh.n_vertices());
    number_faces();
    faces_ = out_.dimension(named("faces"), halves_.size());
    edges_ = out_.dimension(named("edges"), edges_of_faces_.size());
    kept_.copy(nullptr, out_, NetcdfWriter::kFile);
    if (kept_.text_of(nullptr, "Conventions").find("UGRID") == std::string::npos)
      out_.attribute(NetcdfWriter::kFile, "Conventions", kUgridConventions);
    topology();
    coordinates();
    connectivity();
    if (!m_.file.weights.empty()) {
      const int id = out_.variable(named("node_weight"), {nodes_}, m_.file.weights);
      const std::string map =
          m_.file.map() != nullptr      ? text(" on the map ", projection_text(m_.file.map()->projection))
          : m_.file.sphere() != nullptr ? text(" on the sphere of radius ", m_.file.sphere()->radius)
                                        : std::string();
      out_.attribute(id, "long_name", text("weight of the power diagram, a squared length", map));
      out_.attribute(id, "units", text(length_unit(), "2"));
      on(id, "node");
    }
    if (m_.file.sphere() != nullptr && m_.file.sphere()->radius != Projection{}.radius) {
      job_.warn("points are longitude and latitude, without the radius: give --projection sphere:radius=",
                m_.file.sphere()->radius, " where the file is read again");
    }
    write_netcdf_extras(out_, job_, m_.file, {nodes_, faces_, kept_, name_});
    out_.finish([this](std::string_view bytes) { job_.outputs.open(job_.path).put(bytes); });
  }

 private:
  [[nodiscard]] std::string named(std::string_view what) const { return text(name_, "_", what); }
  [[nodiscard]] std::string both(std::string_view what) const { return text(named(what), "_x ", named(what), "_y"); }

  void on(int id, std::string_view location) {
    out_.attribute(id, "mesh", name_);
    out_.attribute(id, "location", location);
  }

  /// A quadrilateral is one face, the first of its two triangles, and its diagonal is no edge.
  void number_faces() {
    const Mesh& mesh = m_.mesh;
    face_.resize(mesh.n_triangles());
    edge_.resize(m_.complex.edges.size());
    for (const TriangleId t : mesh.triangles()) {
      TriangleId other;
      for (int k = 0; k < 3; ++k) {
        const HalfedgeId h = Mesh::halfedge(t, k);
        if (mesh.joins_halves(h))
          other = Mesh::triangle(mesh.twin(h)), edge_[m_.complex.edge_of_halfedge[h]] = kUgridNone;
      }
      const bool is_second = other.valid() && other < t;
      face_[t] = is_second ? face_[other] : static_cast<std::int32_t>(halves_.size());
      if (!is_second) halves_.push_back(t.index);
      has_quadrilaterals_ = has_quadrilaterals_ || is_second;
    }
    for (std::size_t i = 0; i < edge_.size(); ++i) {
      const EdgeId e(i);
      if (edge_[e] == kUgridNone) continue;
      edge_[e] = static_cast<std::int32_t>(edges_of_faces_.size());
      edges_of_faces_.push_back(e);
    }
    if (has_quadrilaterals_) gather_faces(m_.file, halves_);
  }

  void topology() {
    const int id = out_.variable(name_, {}, std::vector<std::int32_t>{0});
    if (const NetcdfVariable* const kept = kept_.find(name_)) kept_.copy(kept, out_, id);
    out_.attribute(id, "cf_role", "mesh_topology");
    out_.attribute(id, "topology_dimension", std::int32_t{2});
    out_.attribute(id, "node_coordinates", text(node_axis(true), " ", node_axis(false)));
    out_.attribute(id, "face_node_connectivity", named("face_nodes"));
    out_.attribute(id, "edge_node_connectivity", named("edge_nodes"));
    out_.attribute(id, "face_edge_connectivity", named("face_edges"));
    out_.attribute(id, "edge_face_connectivity", named("edge_faces"));
    out_.attribute(id, "face_coordinates", both("face"));
    out_.attribute(id, "edge_coordinates", both("edge"));
    out_.attribute(id, "face_dimension", named("faces"));
    out_.attribute(id, "edge_dimension", named("edges"));
  }

  /// The name of a coordinate of nodes: the one that the file came with, or the usual one.
  [[nodiscard]] std::string node_axis(bool is_x) const {
    const std::string both = kept_.text_of(topology_, "node_coordinates");
    const std::size_t blank = both.find(' ');
    if (topology_ == nullptr || blank == std::string::npos) return named(is_x ? "node_x" : "node_y");
    return is_x ? both.substr(0, blank) : both.substr(blank + 1);
  }
  [[nodiscard]] std::string length_unit() const {
    const std::string unit = is_globe() ? "" : kept_.text_of(kept_.find(node_axis(true)), "units");
    return unit.empty() ? "m" : unit;
  }
  [[nodiscard]] bool is_globe() const { return m_.file.map() != nullptr || m_.file.sphere() != nullptr; }

  void places(const std::string& what, int dimension, const std::vector<Vec2>& all, std::string_view long_name) {
    const bool of_nodes = what == "node";
    for (const bool is_x : {true, false}) {
      const NetcdfVariable* const kept = kept_.find(node_axis(is_x));
      const std::string units = kept_.text_of(kept, "units");
      const bool fits = kept != nullptr && (!is_globe() || is_radian(units) || units.starts_with("degree"));
      const double unit = fits && is_globe() && is_radian(units) ? std::numbers::pi / 180 : 1;
      std::vector<double> values(all.size());
      for (std::size_t i = 0; i < all.size(); ++i) values[i] = unit * (is_x ? all[i].x : all[i].y);
      const int id = out_.variable(of_nodes ? node_axis(is_x) : named(text(what, is_x ? "_x" : "_y")), {dimension},
                                   std::move(values));
      out_.attribute(id, "long_name", long_name);
      if (is_globe()) {
        name_degrees(out_, id, is_x ? kLongitude : kLatitude);
      } else {
        out_.attribute(id, "standard_name", is_x ? kProjectedX : kProjectedY);
        out_.attribute(id, "units", "m");
      }
      if (!fits) continue;
      if (of_nodes) kept_.copy(kept, out_, id);
      for (const char* attribute : {"standard_name", "units", "grid_mapping"}) kept_.copy(kept, out_, id, attribute);
    }
  }

  /// Points of the plane in the file's coordinates: on a map as longitude and latitude.
  [[nodiscard]] std::vector<Vec2> unmapped(const std::vector<Vec2>& points) const {
    return m_.file.map() != nullptr ? lon_lat_of_places(m_.file, m_.mesh, points) : points;
  }
  [[nodiscard]] static std::vector<Vec2> degrees_of(const std::vector<Vec3>& points) {
    std::vector<Vec2> all;
    all.reserve(points.size());
    for (const Vec3 p : points) all.push_back(lon_lat_of(p));
    return all;
  }

  /// The middle of the orthocenters of each face.
  template <class Place>
  [[nodiscard]] std::vector<Place> of_faces(const IdVector<TriangleId, Place>& of_triangles) const {
    std::vector<Place> all(halves_.size());
    std::vector<int> n(halves_.size());
    for (const TriangleId t : m_.mesh.triangles()) {
      const auto f = static_cast<std::size_t>(face_[t]);
      all[f] = n[f]++ == 0 ? of_triangles[t] : 0.5 * (all[f] + of_triangles[t]);
    }
    return all;
  }

  void coordinates() {
    const DecComplex& c = m_.complex;
    std::vector<Vec2> midpoints;
    midpoints.reserve(c.edges.size());
    std::vector<Vec3> sphere_midpoints;
    const bool sphere = m_.file.sphere() != nullptr;
    for (const EdgeId e : edges_of_faces_) {
      midpoints.push_back(c.edges[e].midpoint);
      if (sphere) sphere_midpoints.push_back(c.sphere_midpoints[e]);
    }
    places("node", nodes_, m_.file.map() != nullptr ? *lon_lat_of_points(m_.file) : m_.file.points, "vertices");
    places("face", faces_, sphere ? degrees_of(of_faces(c.sphere_orthocenters)) : unmapped(of_faces(c.orthocenters)),
           "orthocenters");
    places("edge", edges_, sphere ? degrees_of(sphere_midpoints) : unmapped(midpoints), "weighted midpoints");
  }

  void connectivity() {
    const DecComplex& c = m_.complex;
    const Mesh& mesh = m_.mesh;
    const auto number = [](VertexId v) { return static_cast<std::int32_t>(v.index); };
    const auto face = [this](TriangleId t) { return t.valid() ? face_[t] : kUgridNone; };
    std::vector<std::int32_t> face_nodes, face_edges, edge_nodes, edge_faces;
    const auto add_side = [&](HalfedgeId h) {
      face_nodes.push_back(number(mesh.origin(h)));
      face_edges.push_back(edge_[c.edge_of_halfedge[h]]);
    };
    const std::size_t most = has_quadrilaterals_ ? 4 : 3;
    for (std::size_t f = 0; f < halves_.size(); ++f) {
      for (int k = 0; k < 3; ++k) {
        const TriangleId t(static_cast<std::size_t>(halves_[static_cast<std::int64_t>(f)]));
        const HalfedgeId h = Mesh::halfedge(t, k);
        if (!mesh.joins_halves(h)) {
          add_side(h);
          continue;
        }
        add_side(Mesh::next(mesh.twin(h)));
        add_side(Mesh::prev(mesh.twin(h)));
      }
      face_nodes.resize(most * (f + 1), kUgridNone);
      face_edges.resize(most * (f + 1), kUgridNone);
    }
    for (const EdgeId edge : edges_of_faces_) {
      const DecEdge& e = c.edges[edge];
      // The triangle that exists comes first.
      const TriangleId first = e.left.valid() ? e.left : e.right, second = e.left.valid() ? e.right : e.left;
      edge_nodes.insert(edge_nodes.end(), {number(e.from), number(e.to)});
      edge_faces.insert(edge_faces.end(), {face(first), face(second)});
    }
    const int two = out_.dimension("TWO", 2), sides = out_.dimension(most == 3 ? "THREE" : "FOUR", most);
    const std::array of_faces = {
        table(named("face_nodes"), "face_node_connectivity", {faces_, sides}, std::move(face_nodes)),
        table(named("face_edges"), "face_edge_connectivity", {faces_, sides}, std::move(face_edges))};
    for (const int table_of_faces : of_faces) {
      if (has_quadrilaterals_) out_.attribute(table_of_faces, "_FillValue", kUgridNone);
    }
    table(named("edge_nodes"), "edge_node_connectivity", {edges_, two}, std::move(edge_nodes));
    const int id = table(named("edge_faces"), "edge_face_connectivity", {edges_, two}, std::move(edge_faces));
    out_.attribute(id, "_FillValue", kUgridNone);
  }

  int table(const std::string& name, const char* role, const std::vector<int>& dimensions,
            std::vector<std::int32_t> values) {
    const int id = out_.variable(name, dimensions, std::move(values));
    out_.attribute(id, "cf_role", role);
    out_.attribute(id, "start_index", std::int32_t{0});
    return id;
  }

  const WriteJob& job_;
  NetcdfMesh m_;
  NetcdfKept kept_;
  const NetcdfVariable* const topology_;  // as it was read, or null
  const std::string name_;                // of the topology
  NetcdfWriter out_;
  int nodes_ = -1, faces_ = -1, edges_ = -1;
  RunLength halves_;                         // the first triangle of each face
  IdVector<TriangleId, std::int32_t> face_;  // of each triangle
  std::vector<EdgeId> edges_of_faces_;
  IdVector<EdgeId, std::int32_t> edge_;  // the number of each edge in the file; kUgridNone of a diagonal
  bool has_quadrilaterals_ = false;
};

}  // namespace

void write_ugrid(const WriteJob& job) { UgridWriter(job).write(); }

}  // namespace temper::io

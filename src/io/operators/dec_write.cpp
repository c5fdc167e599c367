// The implementation of write_dec: makes the folder, calls the writer of every format, and puts all files in place at
// the end.
#include <algorithm>
#include <cerrno>
#include <type_traits>

#include "io/disk/files.hpp"
#include "io/operators/volumes.hpp"

namespace temper::io {
namespace {

/// A folder that exists from now on, and is removed if nothing was put into it.
class Folder {
 public:
  explicit Folder(const std::string& path) : path_(path) {
    const OnDisk there = look_at(path_);
    if (there.kind == OnDisk::Kind::folder) return;
    if (there.exists()) fail(ErrorCode::not_writable, path, "is not a folder; expected a folder, or a new name");
    made_ = make_folder(path_);
    if (!made_) fail(ErrorCode::not_writable, path, "cannot be made: ", reason(errno));
  }
  ~Folder() {
    if (made_) remove_folder(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  void keep() { made_ = false; }

 private:
  std::string path_;
  bool made_ = false;
};

bool wants(const DecFolder& folder, DecFormat format) {
  const std::vector<DecFormat>& formats = folder.options.formats;
  return std::find(formats.begin(), formats.end(), format) != formats.end();
}

void write_all(const DecJob& job) {
  if (wants(job, DecFormat::npz)) write_dec_npz(job);
  if (wants(job, DecFormat::mtx)) write_dec_mtx(job, matrices_of(job.complex));
  if (wants(job, DecFormat::vtu)) write_dec_vtu(job);
  if (wants(job, DecFormat::vtu) && job.options.columns != nullptr) write_columns_vtu(job);
  if (wants(job, DecFormat::disv)) write_columns_disv(job);
  if (wants(job, DecFormat::disu)) write_columns_disu(job);
  if (wants(job, DecFormat::tough)) write_volumes_tough(job, volumes_of(job));
  if (wants(job, DecFormat::tough)) write_groups(job, "MESH.csv", tough_name);
  if (wants(job, DecFormat::uge)) write_volumes_pflotran(job, volumes_of(job));
}

void write_all(const IntrinsicDecJob& job) { write_dec_npz(job); }

void write_all(const TetDecJob& job) {
  if (wants(job, DecFormat::npz)) write_dec_npz(job);
  if (wants(job, DecFormat::mtx)) write_dec_mtx(job, matrices_of(job.complex));
  if (wants(job, DecFormat::vtu)) write_dec_vtu(job);
  if (wants(job, DecFormat::tough)) write_volumes_tough(job, volumes_of(job));
  if (wants(job, DecFormat::uge)) write_volumes_pflotran(job, volumes_of(job));
}

/// `parts` are a mesh, its operators and its cells, which complete a job.
template <class Job, class... Parts>
std::vector<std::string> write_dec_or_throw(const std::string& name, const DecWriteOptions& options,
                                            const Parts&... parts) {
  constexpr bool is_of_tetrahedra = std::is_same_v<Job, TetDecJob>;
  const DecKind kind = is_of_tetrahedra ? DecKind::tetrahedra : DecKind::triangles;
  for (const DecFormat format : options.formats) {
    if (needs_columns(format, kind) && options.columns == nullptr)
      fail(ErrorCode::invalid_option, "",
           is_of_tetrahedra ? "formats disv and disu are for triangles with layers"
                            : "formats disv, disu, tough and uge need layers");
  }
  Folder folder(name);
  std::vector<std::string> written;
  OutputSet outputs;  // after the folder: its temporary files go first
  write_all(Job{{name, options, outputs, written}, parts...});
  outputs.commit();
  folder.keep();
  return written;
}

/// n places of the plane, or those of the sphere if there are any.
template <class At>
DecPositions positions_in(std::size_t n, At plane, const std::vector<Vec3>& sphere) {
  if (!sphere.empty()) return {3, sphere.size(), [&sphere](std::size_t i) { return sphere[i]; }};
  return {2, n, [plane](std::size_t i) {
            const Vec2 p = plane(i);
            return Vec3{p.x, p.y, 0};
          }};
}

}  // namespace

bool needs_columns(DecFormat format, DecKind kind) {
  const bool is_of_cells = format == DecFormat::tough || format == DecFormat::uge;
  return format == DecFormat::disv || format == DecFormat::disu || (is_of_cells && kind != DecKind::tetrahedra);
}

std::span<const std::string_view> dec_file_names(DecFormat format, DecKind kind) {
  // Those of tetrahedra alone are at the end.
  static constexpr std::string_view kNpz[] = {"operators.npz", "d0.npz",    "d1.npz", "star0.npz",
                                              "star1.npz",     "star2.npz", "d2.npz", "star3.npz"};
  static constexpr std::string_view kMtx[] = {"d0.mtx",
                                              "d1.mtx",
                                              "star0.mtx",
                                              "star1.mtx",
                                              "star2.mtx",
                                              "transmissibility.mtx",
                                              "orthocenters.mtx",
                                              "edge_midpoints.mtx",
                                              "d2.mtx",
                                              "star3.mtx",
                                              "face_orthocenters.mtx"};
  static constexpr std::string_view kVtu[] = {"dual.vtu", "dual_edges.vtu", "columns.vtu"};
  const bool tetrahedra = kind == DecKind::tetrahedra;
  static constexpr std::string_view kDisv[] = {"mesh.disv", "mesh.disv.csv", "mesh.disv.hfb"},
                                    kDisu[] = {"mesh.disu", "mesh.disu.csv", "mesh.disu.hfb"},
                                    kTough[] = {"MESH", "MESH.csv"}, kUge[] = {"mesh.uge"};
  switch (format) {
    case DecFormat::npz:
      return std::span(kNpz).first(tetrahedra ? 8 : 6);
    case DecFormat::mtx:
      return std::span(kMtx).first(tetrahedra ? 11 : 8);
    case DecFormat::disv:
      return kDisv;
    case DecFormat::disu:
      return kDisu;
    case DecFormat::tough:
      return std::span(kTough).first(tetrahedra ? 1 : 2);
    case DecFormat::uge:
      return kUge;
    default:
      return std::span(kVtu).first(kind == DecKind::columns ? 3 : 2);
  }
}

Output& DecFolder::open(std::string_view name) const {
  const std::string file = path.empty() || path.ends_with('/') ? text(path, name) : text(path, "/", name);
  Output& output = outputs.open(file);
  written.push_back(file);
  return output;
}

Expected<std::vector<std::string>> write_dec(const std::string& folder, const Mesh& mesh, const DecComplex& complex,
                                             const PowerCells& cells, const DecWriteOptions& options) {
  return guarded<std::vector<std::string>>(
      folder, [&] { return write_dec_or_throw<DecJob>(folder, options, mesh, complex, cells); });
}

Expected<std::vector<std::string>> write_dec(const std::string& folder, const surfaces::SurfaceMesh& mesh,
                                             const DecComplex& complex, const PowerCells& cells,
                                             const DecWriteOptions& options) {
  return guarded<std::vector<std::string>>(
      folder, [&] { return write_dec_or_throw<DecJob>(folder, options, mesh.connectivity(), complex, cells, &mesh); });
}

Expected<std::vector<std::string>> write_dec(const std::string& folder, const surfaces::IntrinsicMesh& mesh,
                                             const DecComplex& complex, std::span<const std::size_t> points) {
  DecWriteOptions options;
  options.formats = {DecFormat::npz};
  options.points = points;
  return guarded<std::vector<std::string>>(
      folder, [&] { return write_dec_or_throw<IntrinsicDecJob>(folder, options, mesh, complex); });
}

Expected<std::vector<std::string>> write_dec(const std::string& folder, const tets::TetMesh& mesh,
                                             const tets::DecComplex& complex, const DecWriteOptions& options) {
  return guarded<std::vector<std::string>>(
      folder, [&] { return write_dec_or_throw<TetDecJob>(folder, options, mesh, complex); });
}

DecPositions DecJob::positions() const {
  if (surface != nullptr)
    return {3, surface->n_vertices(), [on = surface](std::size_t i) { return on->position(VertexId(i)); }};
  return {static_cast<std::size_t>(mesh.space().dimension()), mesh.n_vertices(),
          [&on = mesh](std::size_t i) { return on.space().place(on.point(VertexId(i))); }};
}

DecPositions orthocenter_positions(const DecComplex& complex) {
  const std::vector<Vec2>& plane = complex.orthocenters.raw();
  return positions_in(
      plane.size(), [&plane](std::size_t i) { return plane[i]; }, complex.sphere_orthocenters.raw());
}

DecPositions midpoint_positions(const DecComplex& complex) {
  return positions_in(
      complex.edges.size(), [&edges = complex.edges](std::size_t i) { return edges[EdgeId(i)].midpoint; },
      complex.sphere_midpoints.raw());
}

DecPositions corner_positions(const PowerCells& cells) {
  const std::vector<Vec2>& plane = cells.corners;
  return positions_in(
      plane.size(), [&plane](std::size_t i) { return plane[i]; }, cells.sphere_corners);
}

DecPositions vertex_positions(const tets::TetMesh& mesh) {
  return {3, mesh.n_vertices(), [&mesh](std::size_t i) { return mesh.position(VertexId(i)); }};
}

DecPositions orthocenter_positions(const tets::DecComplex& complex) {
  return {3, complex.orthocenters.size(), [&complex](std::size_t i) { return complex.orthocenters[tets::TetId(i)]; }};
}

DecPositions midpoint_positions(const tets::DecComplex& complex) {
  return {3, complex.edges.size(), [&complex](std::size_t i) { return complex.edges[EdgeId(i)].midpoint; }};
}

DecPositions face_orthocenter_positions(const tets::DecComplex& complex) {
  return {3, complex.faces.size(), [&complex](std::size_t i) { return complex.faces[tets::FaceId(i)].orthocenter; }};
}

}  // namespace temper::io

// Faces on lines, and barriers between cells for the package HFB of MODFLOW 6 (its input guide, mf6io, chapter
// GWF-HFB).
#include <algorithm>
#include <cmath>
#include <tuple>

#include "io/operators/dec_files.hpp"
#include "temper/detail/geometry.hpp"

namespace temper::io {
namespace {

/// The tags of the lines with a name, or the tag that the text is.
std::vector<std::int32_t> tags_of_lines(const MeshFile& file, const std::string& name) {
  std::vector<std::int32_t> tags;
  for (const PhysicalName& n : file.names) {
    if (n.dimension == 1 && n.name == name) tags.push_back(n.tag);
  }
  if (!tags.empty()) return tags;
  for (const std::int32_t tag : file.lines.tags) {
    if (text(tag) == name) return {tag};
  }
  return tags;
}

bool have_a_face(const CellPolygons& plan, const Barrier& barrier) {
  const auto [first, second] = std::minmax(barrier.first, barrier.second);
  const auto face = std::ranges::lower_bound(plan.faces, std::pair(first, second), {},
                                             [](const CellFace& f) { return std::pair(f.first, f.second); });
  return face != plan.faces.end() && face->first == first && face->second == second;
}

void check_barrier(const DecJob& job, const Barrier& barrier) {
  const CellPolygons& plan = job.options.columns->plan;
  const InputNames counting;
  const InputNames& names = job.options.names != nullptr ? *job.options.names : counting;
  const auto cell = [&](std::uint32_t i) {
    return plan.of == CellsOf::vertices ? text("the cell of ", names.point(i)) : names.triangle(i);
  };
  const std::string what = barrier.name.empty() ? std::string("a barrier") : text("barrier '", barrier.name, "'");
  if (!std::isfinite(barrier.characteristic))
    fail(ErrorCode::not_finite, "", what, ": expected a finite hydraulic characteristic, found ",
         barrier.characteristic);
  if (have_a_face(plan, barrier)) return;
  fail(ErrorCode::unsupported, "", what, ": ", cell(barrier.first), " and ", cell(barrier.second),
       " have no common face; expected two neighbors");
}

/// How errors call the line, such as "barrier 'fault'", and the cells on its two sides.
struct Wanted {
  std::string what;
  CellsOf of;
};

/// The inner edges of the lines with a name or tag. They are faces of power cells, or edges of triangles, as wanted.
std::vector<HalfedgeId> edges_of_line(const MeshFile& file, const LoadedMesh& loaded, const Mesh& mesh,
                                      const std::string& name, const Wanted& wanted) {
  const bool of_vertices = wanted.of == CellsOf::vertices;
  const auto vertex = [&](std::int32_t p) {
    const std::int32_t v = loaded.vertex_of_point[static_cast<std::size_t>(p)];
    return v < 0 ? VertexId() : VertexId(static_cast<std::size_t>(v));
  };
  const std::vector<std::int32_t> tags = tags_of_lines(file, name);
  std::vector<HalfedgeId> edges;
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    const VertexId a = vertex(file.lines[i][0]), b = vertex(file.lines[i][1]);
    if (std::ranges::find(tags, file.lines.tags[i]) == tags.end() || !a.valid() || !b.valid()) continue;
    const HalfedgeId h = mesh.find_halfedge(a, b);
    if (!h.valid() || mesh.is_boundary(h)) continue;
    if (mesh.is_face(h) != of_vertices)
      fail(ErrorCode::invalid_option, "", wanted.what, ": its line runs ",
           of_vertices ? "through the centers of power cells; expected faces of them. Next: mesh the outline with "
                         "--faces, or take triangles as cells"
                       : "between power cells, whose faces it is. Next: take power cells, not triangles");
    edges.push_back(h);
  }
  if (edges.empty())
    fail(ErrorCode::invalid_option, "", wanted.what, ": no line inside the domain has this name or tag");
  return edges;
}

}  // namespace

Expected<std::vector<Barrier>> barriers_of_lines(const MeshFile& file, const LoadedMesh& loaded, const Mesh& mesh,
                                                 std::span<const std::pair<std::string, double>> characteristics,
                                                 CellsOf of) {
  return guarded<std::vector<Barrier>>(file.path, [&] {
    std::vector<Barrier> barriers;
    for (const auto& [name, value] : characteristics) {
      const std::string what = text("barrier '", name, "'");
      if (!std::isfinite(value))
        fail(ErrorCode::not_finite, "", what, ": expected a finite hydraulic characteristic, found ", value);
      for (const HalfedgeId h : edges_of_line(file, loaded, mesh, name, {what, of})) {
        const bool of_vertices = of == CellsOf::vertices;
        barriers.push_back({name, of_vertices ? mesh.origin(h).index : Mesh::triangle(h).index,
                            of_vertices ? mesh.target(h).index : Mesh::triangle(mesh.twin(h)).index, value});
      }
    }
    return barriers;
  });
}

Expected<std::vector<LineFace>> faces_of_line(const MeshFile& file, const LoadedMesh& loaded, const Mesh& mesh,
                                              const std::string& name) {
  return guarded<std::vector<LineFace>>(file.path, [&] {
    std::vector<LineFace> faces;
    const auto center = [&](HalfedgeId h) {
      const auto [a, b, c] = mesh.points(Mesh::triangle(h));
      return orthocenter(a, b, c);
    };
    for (const HalfedgeId h :
         edges_of_line(file, loaded, mesh, name, {text("faces of '", name, "'"), CellsOf::vertices})) {
      const Vec2 from = center(mesh.twin(h)), to = center(h);
      faces.push_back({mesh.origin(h), mesh.target(h), from, to, length(to - from)});
    }
    return faces;
  });
}

/// Each barrier has a row in each layer in which both cells are active: two cells, and the characteristic.
void write_barriers(const DecJob& job, std::string_view file, const std::function<std::string(std::size_t)>& cell) {
  if (!job.options.barriers) return;
  const Columns& c = *job.options.columns;
  struct Row {
    std::size_t first, second;  // cells of the columns
    const Barrier* barrier;
  };
  std::vector<Row> rows;
  for (const Barrier& barrier : *job.options.barriers) {
    check_barrier(job, barrier);
    for (std::size_t layer = 0; layer < c.n_layers; ++layer) {
      const Row row = {c.cell(barrier.first, layer), c.cell(barrier.second, layer), &barrier};
      if (c.is_active(row.first) && c.is_active(row.second)) rows.push_back(row);
    }
  }
  Output& out = job.open(file);
  out.put("# Horizontal flow barriers: two cells, and the hydraulic characteristic of the barrier between them.\n",
          "BEGIN OPTIONS\nEND OPTIONS\nBEGIN DIMENSIONS\n  MAXHFB ", rows.size(), "\nEND DIMENSIONS\nBEGIN PERIOD 1\n");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string& name = rows[i].barrier->name;
    if (!name.empty() && (i == 0 || rows[i - 1].barrier->name != name)) out.put("# ", name, '\n');
    out.put("  ", cell(rows[i].first), ' ', cell(rows[i].second), ' ', rows[i].barrier->characteristic, '\n');
  }
  out.put("END PERIOD\n");
}

}  // namespace temper::io

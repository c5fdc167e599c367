// A mesh that was read: the file, its mesh, the names of its parts, and the parts that a user names.
#pragma once

#include <cstddef>
#include <fstream>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "exit.hpp"
#include "options/options.hpp"
#include "subject.hpp"
#include "temper/io.hpp"
#include "temper/mesh.hpp"

namespace temper::app {

/// A mesh that was read, of the cells that its Subject says.
template <class Subject>
struct InputOf {
  std::string path;
  io::MeshFile file;
  typename Subject::Loaded loaded;
  std::size_t n_vertices = 0;                     ///< of the mesh as it was read
  std::vector<std::size_t> points;                ///< mesh vertex → point of the file, both from 0; empty: the same
  std::shared_ptr<const tets::InputNames> names;  ///< the file's own numbers of the mesh's vertices and elements

  [[nodiscard]] const typename Subject::Mesh& mesh() const { return loaded.mesh; }
  /// The file's own number of a vertex, as text.
  [[nodiscard]] std::string vertex_number(VertexId v) const;
  [[nodiscard]] std::string element_number(typename Subject::Element e) const;
  /// The numbers of several vertices.
  [[nodiscard]] std::string vertex_numbers(std::span<const VertexId> vertices, std::string_view between) const;
  /// Warnings of reading and of building.
  [[nodiscard]] std::vector<std::string> warnings() const;
};
using Input = InputOf<Triangles>;
using TetInput = InputOf<Tetrahedra>;
using SurfaceInput = InputOf<Surfaces>;
using AnyInput = std::variant<Input, TetInput, SurfaceInput>;

/// A text file to be read line by line; Failure if it cannot be read, or is a device such as /dev/zero without an end.
[[nodiscard]] std::ifstream open_text(const std::string& path);

/// Options for reading a file.
struct ReadingOptions {
  std::string projection = {};  ///< of points in degrees: as --projection has it
  std::vector<std::string> fixed_tags = {};
  Executor* executor = nullptr;
  Heights heights = {};  ///< as --flat and --positive have it
  /// Refuses what is for other cells than the file has, before the mesh is built; none: nothing is refused.
  std::function<void(CellKinds cells)> expect = {};
};
/// Reads a file and builds its mesh; Failure when anything is wrong with it.
[[nodiscard]] AnyInput read_any(const std::string& path, const ReadingOptions& options = {});
/// Reads the input of a command, and refuses options that were given for other cells.
[[nodiscard]] inline AnyInput read_any(const Command& command, const std::string& path, ReadingOptions options) {
  options.expect = [&](CellKinds cells) { command.expect_for(cells, path); };
  return read_any(path, options);
}
/// Reads a mesh of triangles, for verbs that take no other cells.
[[nodiscard]] Input read_input(const std::string& path, const ReadingOptions& options = {});
/// Builds the mesh of triangles of a file that was read.
[[nodiscard]] Input make_input(io::MeshFile file, const std::string& path, const ReadingOptions& options);
/// Another mesh of the same kind as `input`; Failure if it is of the other kind.
template <class Subject>
[[nodiscard]] InputOf<Subject> read_like(const InputOf<Subject>& input, const std::string& path,
                                         const ReadingOptions& options);

/// Longitude and latitude, as in the file, of a place on the map of a file in degrees. Other places are unchanged.
[[nodiscard]] Vec2 place_in_file(const io::MeshFile& file, Vec2 place);

/// The numbers of an array.
[[nodiscard]] std::vector<double> as_doubles(const io::DataArray& data);
/// The array of single numbers with this name, or null.
[[nodiscard]] const io::DataArray* find_numbers(const std::vector<io::DataArray>& data, const std::string& name);
/// The numbers of an array of point data at the vertices of the mesh. Points of no triangle are left out.
[[nodiscard]] std::vector<double> at_vertices(const Input& input, const io::DataArray& array);

/// Failure when the mesh is one of the sphere, which `what` does not support.
void expect_plane(const Mesh& mesh, const std::string& path, std::string_view what);

/// The projection of another file onto the same map: with the center that was chosen for this one.
[[nodiscard]] std::string same_projection(const io::MeshFile& file, const std::string& projection);

/// The text with another name for each vertex number in it ("vertex 3", "edge 3-9", "face 3-9-12").
[[nodiscard]] std::string renumber(const std::string& text, const std::function<std::string(VertexId)>& name);

/// The file's own numbers for the vertices of a mesh, if points of the file that no element uses were dropped. Also
/// names for vertices that the file does not have.
class VertexNames final : public tets::InputNames {
 public:
  /// `points`: mesh vertex → point of the file; empty: equal numbers. `n_vertices`: of the file's mesh; later ones are
  /// new.
  VertexNames(std::shared_ptr<const tets::InputNames> file, std::vector<std::size_t> points, std::size_t n_vertices);
  [[nodiscard]] std::string point(std::size_t index) const override;
  [[nodiscard]] std::string triangle(std::size_t index) const override;
  [[nodiscard]] std::string tetrahedron(std::size_t index) const override;
  [[nodiscard]] std::string point_where(std::size_t index) const override;
  [[nodiscard]] std::string triangle_where(std::size_t index) const override;
  [[nodiscard]] std::string tetrahedron_where(std::size_t index) const override;

 private:
  [[nodiscard]] std::size_t in_file(std::size_t index) const;
  std::shared_ptr<const tets::InputNames> file_;  // null: numbers from 0
  std::vector<std::size_t> points_;
  std::size_t n_vertices_;
};

/// The library's sentence with the program's name of the option.
[[nodiscard]] std::string spell_projection(std::string message);

/// Failure, with the cure, if the points of an outline should be in degrees and no projection is chosen.
void expect_projection_of_outline(const std::string& path, bool geographic, std::span<const Vec2> points,
                                  const std::string& projection);

/// The points of a mesh on the chosen map or the sphere; unchanged if none is needed. Failure, with the cure, if they
/// are in degrees and none is chosen.
void take_to_map(io::MeshFile& file, const std::string& path, const std::string& projection);

/// Takes a surface that is nearly a sphere to the sphere, if the projection says so, which is cleared then.
void take_to_sphere(io::MeshFile& file, const std::string& path, std::string& projection);

/// Edges that a user names. "all": all inside the mesh; "lines": those on tagged lines and between regions. Otherwise
/// the path of a file with two vertices per line, in the numbers of the mesh file. Failure when the file cannot be
/// read, names something else than edges of the mesh (with its line), or when no edge is inside the mesh.
[[nodiscard]] std::vector<HalfedgeId> prescribed_edges(const std::string& which, const Input& input);

/// io::read(), which reads a file of HDF5 (NetCDF-4, VTKHDF) first in a child process. On a damaged file libhdf5 may
/// loop forever or crash, and then only the child does. Failure when the file cannot be used, or the child exceeds its
/// budget of time and memory. A pipe can be read only once, and is read at once.
[[nodiscard]] io::MeshFile read_tried(const std::string& path, const io::ReadOptions& options = {});

}  // namespace temper::app

#include "files/input.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <span>
#include <string_view>
#include <utility>

#include "exit.hpp"
#include "temper/detail/path.hpp"

namespace temper::app {
namespace {

/// "12" of "triangle 12".
std::string last_word(const std::string& text) { return text.substr(text.rfind(' ') + 1); }

std::string name_of(TriangleId t, const tets::InputNames& names) { return names.triangle(t.index); }
std::string name_of(tets::TetId t, const tets::InputNames& names) { return names.tetrahedron(t.index); }

std::vector<std::string> all_of(std::vector<std::string> some, const std::vector<std::string>& others) {
  some.insert(some.end(), others.begin(), others.end());
  return some;
}

/// Mesh vertex → point; empty when they are the same.
std::vector<std::size_t> invert(const io::VertexOfPoint& vertex_of_point) {
  if (vertex_of_point.size() == vertex_of_point.n_kept()) return {};
  std::vector<std::size_t> points(vertex_of_point.n_kept());
  for (std::size_t point = 0; point < vertex_of_point.size(); ++point) {
    const std::int32_t vertex = vertex_of_point[point];
    if (vertex >= 0) points[static_cast<std::size_t>(vertex)] = point;
  }
  return points;
}

/// The error of a mesh, with the command that cures it if there is one.
InputError with_cure(InputError error, const Input& input) {
  const auto cure = [&](std::string_view what, std::string_view option) {
    error.message += fmt::format(". Next: {} with temper convert {} {} -o OUT", what, input.path, option);
  };
  if (error.code == ErrorCode::duplicate_point) cure("join them", "--merge 0");
  if (input.file.sphere() != nullptr || input.file.periodic() != nullptr) return error;
  if (error.code == ErrorCode::zero_area) cure("flip such triangles away", "--flip-flat");
  if (error.code == ErrorCode::overlap) cure("if rounding has turned a triangle over, flip it away", "--flip-flat");
  return error;
}

}  // namespace

template <class Subject>
std::string InputOf<Subject>::vertex_number(VertexId v) const {
  return last_word(names->point(v.index));
}
template <class Subject>
std::string InputOf<Subject>::element_number(typename Subject::Element e) const {
  return last_word(name_of(e, *names));
}
template <class Subject>
std::string InputOf<Subject>::vertex_numbers(std::span<const VertexId> vertices, std::string_view between) const {
  std::string text;
  for (const VertexId v : vertices) text += (text.empty() ? "" : std::string(between)) + vertex_number(v);
  return text;
}
template <class Subject>
std::vector<std::string> InputOf<Subject>::warnings() const {
  return all_of(file.warnings, loaded.warnings);
}
#define TEMPER_MAKE(S) template struct InputOf<S>;
TEMPER_EACH_SUBJECT(TEMPER_MAKE)
#undef TEMPER_MAKE

namespace {

void load(Input& input, const ReadingOptions& options) {
  take_to_map(input.file, input.path, options.projection);
  Expected<io::LoadedMesh> loaded = io::make_mesh(input.file, options.fixed_tags, options.executor);
  if (!loaded) throw as_failure(with_cure(loaded.error(), input));
  input.loaded = or_fail(std::move(loaded));
}
void load(TetInput& input, const ReadingOptions& options) {
  input.loaded = or_fail(io::make_tet_mesh(input.file, options.executor));
}

void load(SurfaceInput& input, const ReadingOptions& options) {
  Expected<io::LoadedSurface> loaded = io::make_surface(input.file, options.fixed_tags);
  if (!loaded) {
    InputError error = loaded.error();
    if (error.code == ErrorCode::zero_area)
      error.message += ". Next: delete it if it has one corner twice, else join its corners with temper convert " +
                       input.path + " --merge RADIUS -o OUT";
    throw as_failure(error);
  }
  input.loaded = or_fail(std::move(loaded));
}

template <class Subject>
InputOf<Subject> made_of(io::MeshFile&& file, const std::string& path, const ReadingOptions& options) {
  if (options.expect) options.expect(Subject::cells);
  InputOf<Subject> input;
  input.path = path;
  input.file = std::move(file);
  load(input, options);
  input.n_vertices = input.mesh().n_vertices();
  input.points = invert(input.loaded.vertex_of_point);
  input.names = std::make_shared<VertexNames>(input.file.numbering, input.points, input.n_vertices);
  return input;
}

io::MeshFile read_file(const std::string& path, const ReadingOptions& options) {
  return read_tried(path, options.heights.to_read(options.executor));
}

}  // namespace

AnyInput read_any(const std::string& path, const ReadingOptions& options) {
  ReadingOptions rest = options;
  io::MeshFile file = read_file(path, options);
  take_to_sphere(file, path, rest.projection);
  return with_subject(cells_of(file), [&](auto subject) -> AnyInput {
    return made_of<decltype(subject)>(std::move(file), path, rest);
  });
}

Input make_input(io::MeshFile file, const std::string& path, const ReadingOptions& options) {
  return made_of<Triangles>(std::move(file), path, options);
}

Input read_input(const std::string& path, const ReadingOptions& options) {
  ReadingOptions rest = options;
  io::MeshFile file = read_file(path, options);
  take_to_sphere(file, path, rest.projection);
  return make_input(std::move(file), path, rest);
}

template <class Subject>
InputOf<Subject> read_like(const InputOf<Subject>& input, const std::string& path, const ReadingOptions& options) {
  AnyInput other = read_any(path, options);
  if (auto* const same = std::get_if<InputOf<Subject>>(&other)) return std::move(*same);
  const CellKinds found = std::visit([](const auto& read) { return cells_of(read.file); }, other);
  throw Failure(Exit::bad_input, fmt::format("{}: expected {}, as in {}, found {}", path, name_of_mesh(Subject::cells),
                                             input.path, name_of_mesh(found)));
}
#define TEMPER_MAKE(S) template InputOf<S> read_like(const InputOf<S>&, const std::string&, const ReadingOptions&);
TEMPER_EACH_SUBJECT(TEMPER_MAKE)
#undef TEMPER_MAKE

std::ifstream open_text(const std::string& path) {
  std::ifstream file(path_of(path), std::ios::binary);
  if (!file) throw Failure(Exit::bad_input, fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  if (file.peek() == '\0') throw Failure(Exit::bad_input, path + ": is no text");
  file.clear();  // an empty file has no first letter
  return file;
}

std::vector<double> as_doubles(const io::DataArray& data) {
  return std::visit([](const auto& values) { return std::vector<double>(values.begin(), values.end()); }, data.values);
}

const io::DataArray* find_numbers(const std::vector<io::DataArray>& data, const std::string& name) {
  const auto named = std::ranges::find(data, name, &io::DataArray::name);
  return named == data.end() || named->components != 1 ? nullptr : &*named;
}

std::vector<double> at_vertices(const Input& input, const io::DataArray& array) {
  const std::vector<double> at_points = as_doubles(array);
  std::vector<double> values;
  values.reserve(input.mesh().n_vertices());
  for (const VertexId v : input.mesh().vertices())
    values.push_back(at_points[input.points.empty() ? v.index : input.points[v.index]]);
  return values;
}

void expect_plane(const Mesh& mesh, const std::string& path, std::string_view what) {
  const auto error = temper::expect_plane(mesh, what);
  if (!error) return;
  throw Failure(
      Exit::bad_input,
      fmt::format("{}: {}{}", path, error->message,
                  mesh.space().is_plane() ? "" : ". Next: --projection puts longitude and latitude on a map"));
}

Vec2 place_in_file(const io::MeshFile& file, Vec2 place) {
  const io::GeographicMap* const map = file.map();
  return map == nullptr ? place : LongitudeTurn(map->lon_lat)(inverse(map->projection, place));
}

std::string same_projection(const io::MeshFile& file, const std::string& projection) {
  return file.map() != nullptr ? projection_text(file.map()->projection) : projection;
}

std::string renumber(const std::string& text, const std::function<std::string(VertexId)>& name) {
  static constexpr std::array<std::string_view, 3> kBefore = {"vertex ", "edge ", "face "};
  std::string result;
  std::size_t at = 0;
  const auto copy_number = [&] {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), number);
    if (error != std::errc()) return false;
    result += name(VertexId(number));
    at = static_cast<std::size_t>(end - text.data());
    return true;
  };
  while (at < text.size()) {
    bool found = false;
    for (const std::string_view word : kBefore) {
      if (text.compare(at, word.size(), word) != 0) continue;
      result += word;
      at += word.size();
      found = true;
      bool is_number = copy_number();
      while (is_number && at < text.size() && text[at] == '-') {
        result += text[at++];
        is_number = copy_number();
      }
      break;
    }
    if (!found) result += text[at++];
  }
  return result;
}

VertexNames::VertexNames(std::shared_ptr<const tets::InputNames> file, std::vector<std::size_t> points,
                         std::size_t n_vertices)
    : file_(std::move(file)), points_(std::move(points)), n_vertices_(n_vertices) {}

std::size_t VertexNames::in_file(std::size_t index) const { return index < points_.size() ? points_[index] : index; }

/// The file may number its points in any way, so new points count separately, from 1.
std::string VertexNames::point(std::size_t index) const {
  if (index >= n_vertices_) return "new point " + std::to_string(index - n_vertices_ + 1);
  return file_ ? file_->point(in_file(index)) : InputNames::point(in_file(index));
}
std::string VertexNames::triangle(std::size_t index) const {
  return file_ ? file_->triangle(index) : InputNames::triangle(index);
}
std::string VertexNames::tetrahedron(std::size_t index) const {
  return file_ ? file_->tetrahedron(index) : InputNames::tetrahedron(index);
}
std::string VertexNames::point_where(std::size_t index) const {
  return file_ && index < n_vertices_ ? file_->point_where(in_file(index)) : std::string();
}
std::string VertexNames::triangle_where(std::size_t index) const {
  return file_ ? file_->triangle_where(index) : std::string();
}
std::string VertexNames::tetrahedron_where(std::size_t index) const {
  return file_ ? file_->tetrahedron_where(index) : std::string();
}

std::string spell_projection(std::string message) {
  constexpr std::string_view kOption = "`projection`";
  const std::size_t at = message.find(kOption);
  return at == std::string::npos ? message : message.replace(at, kOption.size(), "--projection");
}

namespace {

[[noreturn]] void refuse_degrees(const std::string& path, std::string message) {
  throw Failure(Exit::bad_usage, fmt::format("{}: {}", path, spell_projection(std::move(message))));
}

}  // namespace

void expect_projection_of_outline(const std::string& path, bool geographic, std::span<const Vec2> points,
                                  const std::string& projection) {
  if (!geographic || !projection.empty()) return;
  for (const Vec2 p : points) {
    if (std::abs(p.x) <= 360 && std::abs(p.y) <= 90) continue;
    refuse_degrees(path,
                   fmt::format("the point ({:.9g}, {:.9g}) is no longitude and latitude, which GeoJSON holds unless "
                               "it has a member crs. Next: add \"crs\": {{\"type\": \"name\", \"properties\": "
                               "{{\"name\": \"EPSG:32632\"}}}} with the code of your map, or --projection none",
                               p.x, p.y));
  }
  refuse_degrees(path, io::needs_projection(false, "--sphere"));
}

void take_to_sphere(io::MeshFile& file, const std::string& path, std::string& projection) {
  if (!file.is_surface() || !projection.starts_with(io::kOntoSphere)) return;
  take_to_map(file, path, projection);
  projection.clear();
}

void take_to_map(io::MeshFile& file, const std::string& path, const std::string& projection) {
  if (projection.empty()) {
    if (file.degrees() != nullptr) refuse_degrees(path, io::needs_projection(file.degrees()->is_guessed));
    return;
  }
  or_fail(io::project(file, projection));
}

}  // namespace temper::app

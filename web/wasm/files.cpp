// Mesh files. They lie in the folder that web/npm has in memory, by the functions of WASI.
#include "answer.hpp"
#include "held_mesh.hpp"
#include "temper/io.hpp"

namespace temper::wasm {
namespace {

constexpr std::pair<std::string_view, io::Encoding> kEncodings[] = {
    {"ascii", io::Encoding::ascii}, {"base64", io::Encoding::base64}, {"appended", io::Encoding::appended}};

std::optional<io::Encoding> encoding_from(const std::string& text) {
  if (text.empty()) return std::nullopt;
  for (const auto& [name, encoding] : kEncodings) {
    if (name == text) return encoding;
  }
  fail(ErrorCode::invalid_option, "encoding: expected one of ascii, base64, appended; found '" + text + "'");
}

}  // namespace

TEMPER_EXPORT(formats) void answer_formats() {
  Json rows = Json::array();
  for (const io::Format& f : io::formats()) {
    rows.push_back({{"name", f.name},
                    {"description", f.description},
                    {"suffixes", f.suffixes},
                    {"writes", f.writes},
                    {"holds_weights", f.holds_weights},
                    {"holds_planes", f.holds_planes},
                    {"holds_spheres", f.holds_spheres},
                    {"holds_tetrahedra", f.holds_tetrahedra}});
  }
  answer(rows);
}

/// Options: fixed_tags, projection. The answer is {"warnings", "format"}, or why there is no mesh.
TEMPER_EXPORT(mesh_read)
HeldMesh* mesh_read(const char* path, std::size_t path_size, const char* options, std::size_t options_size) {
  return guarded<HeldMesh*>(nullptr, [&] {
    const Json given = parse({options, options_size});
    std::vector<std::string> fixed_tags, warnings;
    std::string projection;
    take(given, "fixed_tags", fixed_tags);
    take(given, "projection", projection);
    io::MeshFile file = or_fail(io::read(std::string(path, path_size)));
    const std::string format = file.format;
    if (!projection.empty()) or_fail(io::project(file, projection));
    auto held = or_fail(HeldMesh::of_file(std::move(file), fixed_tags, warnings));
    answer(Json{{"warnings", warnings}, {"format", format}});
    return held.release();
  });
}

/// Options: format, encoding, triangle_quality. The answer is {"warnings", "files"}: what was written, the path and
/// what goes beside it.
TEMPER_EXPORT(mesh_write)
int mesh_write(const HeldMesh* held, const char* path, std::size_t path_size, const char* options,
               std::size_t options_size) {
  return done([&] {
    const Json given = parse({options, options_size});
    const std::string to(path, path_size);
    io::WriteOptions how;
    std::string encoding;
    take(given, "format", how.format);
    take(given, "encoding", encoding);
    how.encoding = encoding_from(encoding);
    take(given, "triangle_quality", how.triangle_quality);
    const std::vector<std::string> files = or_fail(io::files_to_write(to, how.format));
    const io::MeshFile file = held->file();
    std::vector<std::string> warnings = file.warnings;
    for (std::string& warning : or_fail(io::write(to, file, how))) warnings.push_back(std::move(warning));
    answer(Json{{"warnings", warnings}, {"files", files}});
  });
}

}  // namespace temper::wasm

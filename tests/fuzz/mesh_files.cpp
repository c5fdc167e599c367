// Readers and writers of meshes, a target for each row of formats(): what is read is a mesh or an error with a message;
// what a mesh was read from can be written in every format, and read again.
#include "target.hpp"
#include "temper/generate.hpp"
#include "temper/surfaces.hpp"
#include "unit/io/support.hpp"

namespace temper::fuzz {
namespace {

// Meshes of these are several files, here one after the other. The file of points is the first; those after the second
// need not be there.
constexpr char kBetweenFiles = '\f';
struct Files {
  std::string_view format;
  std::vector<std::string> names;
};
const Files kSeveral[] = {{"triangle", {"m.node", "m.ele", "m.poly", "m.face", "m.edge"}},
                          {"fesom", {"m.nod2d.out", "m.elem2d.out"}}};

std::vector<std::string> names_of(std::string_view format) {
  for (const Files& files : kSeveral) {
    if (files.format == format) return files.names;
  }
  return {"m"};
}

std::string place(const Scratch& scratch, std::string_view format, std::string_view bytes) {
  const std::vector<std::string> names = names_of(format);
  if (names.size() == 1) return scratch.make(names[0], bytes);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::size_t cut = i + 1 < names.size() ? std::min(bytes.find(kBetweenFiles), bytes.size()) : bytes.size();
    if (i < 2 || cut > 0) static_cast<void>(scratch.make(names[i], bytes.substr(0, cut)));
    bytes.remove_prefix(std::min(cut + 1, bytes.size()));
  }
  return scratch.path(names[0]);
}

/// The files of a mesh that was written, as one.
std::string joined(const Scratch& scratch, std::string_view format) {
  std::string bytes;
  for (const std::string& name : names_of(format)) {
    const std::string path = scratch.path(name);
    bytes +=
        (bytes.empty() ? "" : std::string(1, kBetweenFiles)) + (std::filesystem::exists(path) ? io::slurp(path) : "");
  }
  return bytes;
}

void insist_on_message(const InputError& error) {
  insist(!error.message.empty(), "an error has a message");
  insist(printable(error.message) == error.message || !error.where.empty(), "an error says where");
}

/// The row of formats() that these bytes choose, so that each input is written in one.
const io::Format& chosen_format(std::string_view bytes) {
  std::vector<const io::Format*> writable;
  for (const io::Format& format : io::formats()) {
    if (format.writes) writable.push_back(&format);
  }
  std::size_t sum = bytes.size();
  for (const char c : bytes.substr(0, 64)) sum += static_cast<unsigned char>(c);
  return *writable[sum % writable.size()];
}

void write_and_read_again(const Scratch& scratch, const io::MeshFile& file, const io::Format& format) {
  const std::string out = scratch.path("out" + names_of(format.name)[0].substr(1));
  const auto written = io::write(out, file, {std::string(format.name), {}});
  if (!written) return insist_on_message(written.error());
  const auto again = io::read(out, {.flat = file.z_is_data});
  insist(again.has_value(), again ? "" : std::string(format.name) + ": " + again.error().what());
  insist(again->triangles.size() == file.triangles.size(), "as many triangles are read as were written");
}

void run_tetrahedra(const Scratch& scratch, const io::MeshFile& file, std::string_view bytes) {
  const auto made = io::make_tet_mesh(file);
  if (!made) return insist_on_message(made.error());
  const auto wrong = made->mesh.validate();
  insist(!wrong, wrong.value_or(""));
  const io::Format& format = chosen_format(bytes);
  if (!format.holds_tetrahedra) return;
  const std::string out = scratch.path("out" + names_of(format.name)[0].substr(1));
  const auto written = io::write(out, file, {std::string(format.name), {}});
  if (!written) return insist_on_message(written.error());
  const auto again = io::read(out);
  insist(again.has_value(), again ? "" : std::string(format.name) + ": " + again.error().what());
  insist(again->tetrahedra.corners == file.tetrahedra.corners, "the tetrahedra are read that were written");
}

void run_surface(const Scratch& scratch, const io::MeshFile& file, std::string_view bytes) {
  const auto made = io::make_surface(file);
  if (!made) return insist_on_message(made.error());
  const auto wrong = made->mesh.validate();
  insist(!wrong, wrong.value_or(""));
  const surfaces::Quality quality = surfaces::quality(made->mesh);
  const std::size_t bad = surfaces::cells_at_violations(made->mesh, Criterion::well_centered).size();
  insist(violations(quality, Criterion::well_centered) == bad, "reports count the bad triangles");
  const io::Format& format = chosen_format(bytes);
  if (format.holds_surfaces) write_and_read_again(scratch, file, format);
}

void run(const std::string& format, std::string_view bytes) {
  static const Scratch scratch;
  scratch.clear();
  if (bytes.starts_with("\x89HDF")) return;  // libhdf5 reads it, which may never return
  const auto file = io::read(place(scratch, format, bytes));
  if (!file) return insist_on_message(file.error());
  if (file->dimension() == 3) return run_tetrahedra(scratch, *file, bytes);
  if (file->is_surface()) return run_surface(scratch, *file, bytes);
  insist(printable(file->warnings.empty() ? "" : file->warnings[0]).size() < 100000, "warnings are short");
  const auto made = io::make_mesh(*file);
  if (!made) return insist_on_message(made.error());
  const auto wrong = made->mesh.validate();
  insist(!wrong, wrong.value_or(""));
  write_and_read_again(scratch, *file, chosen_format(bytes));
}

std::vector<std::string> seeds(const io::Format& format) {
  if (format.name == "stl") {
    return {
        "solid s\nfacet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 1 0\n endloop\n endfacet\n"
        "facet normal 1 0 0\n outer loop\n vertex 0 1 0\n vertex 1 0 0\n vertex 1 1 1\n endloop\n endfacet\n"
        "endsolid s\n",
        std::string(80, 's') + std::string("\1\0\0\0", 4) + std::string(24, '\0') +
            std::string("\0\0\x80\x3f\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x80\x3f\0\0\x80\x3f\0\0", 26)};
  }
  if (!format.writes) {
    return {
        "MFEM mesh v1.0\n\n# c\ndimension\n2\n\nelements\n2\n1 2 0 1 2\n1 2 0 2 3\n\nboundary\n1\n3 1 0 1\n\n"
        "vertices\n4\n2\n0 0\n1 0\n1 1\n0 1\n"};
  }
  const Scratch scratch;
  std::vector<std::string> all;
  const std::string out = scratch.path(names_of(format.name)[0]);
  io::MeshFile globe = io::from_mesh(*icosahedral({.level = 1}));
  globe.triangles.corners.pop_back();
  const auto add = [&](const auto& file) {
    for (const auto encoding : {io::Encoding::ascii, io::Encoding::base64, io::Encoding::appended}) {
      scratch.clear();
      if (!io::write(out, file, {std::string(format.name), encoding})) continue;
      std::string bytes = joined(scratch, format.name);
      if (std::find(all.begin(), all.end(), bytes) == all.end()) all.push_back(std::move(bytes));
    }
  };
  for (const auto& file : {io::tamed(io::sample()), io::tamed(io::rich_sample()), globe}) add(file);
  if (format.holds_tetrahedra) add(io::tet_sample());
  if (format.holds_surfaces) {
    io::MeshFile surface = io::from_mesh(*icosahedral({.level = 1}));
    std::vector<Vec3> points = surface.sphere()->places;
    for (Vec3& p : points) p.z *= 1.5;
    if (io::set_points(surface, std::move(points))) add(surface);
  }
  return all;
}

}  // namespace

std::vector<Target> mesh_file_targets() {
  std::vector<Target> all;
  for (const io::Format& format : io::formats()) {
    const std::string name(format.name);
    all.push_back({name, [name](std::string_view bytes) { run(name, bytes); }, [&format] { return seeds(format); }});
  }
  return all;
}

}  // namespace temper::fuzz

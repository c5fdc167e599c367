// Formats that temper recognizes and does not read. The error names the format, and a program that converts it.
#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include "io/formats/format.hpp"

namespace temper::io {
namespace {

std::string_view skip_blanks(std::string_view s) {
  const std::size_t first = s.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos ? std::string_view{} : s.substr(first);
}

bool starts_with_any_case(std::string_view s, std::string_view upper) {
  if (s.size() < upper.size()) return false;
  for (std::size_t i = 0; i < upper.size(); ++i) {
    if (std::toupper(static_cast<unsigned char>(s[i])) != upper[i]) return false;
  }
  return true;
}

bool is_freefem(std::string_view head) {
  // Three counts, then lines "x y label". Columns of x, y and z do not count.
  const auto words = [](std::string_view line) {
    std::vector<std::string_view> all;
    for (line = skip_blanks(line); !line.empty(); line = skip_blanks(line)) {
      const std::size_t end = std::min(line.find_first_of(" \t\r\n"), line.size());
      all.push_back(line.substr(0, end));
      line.remove_prefix(end);
    }
    return all;
  };
  const auto only = [](std::string_view characters) {
    return [characters](std::string_view word) { return word.find_first_not_of(characters) == std::string_view::npos; };
  };
  head = skip_blanks(head);
  const std::size_t end = head.find('\n');
  if (end == std::string_view::npos) return false;
  const auto counts = words(head.substr(0, end));
  const auto point = words(head.substr(end + 1, head.find('\n', end + 1) - end - 1));
  return counts.size() == 3 && std::all_of(counts.begin(), counts.end(), only("0123456789")) && point.size() == 3 &&
         std::all_of(point.begin(), point.end(), only("0123456789+-.eE")) && only("0123456789+-")(point[2]);
}

/// The first line that is no comment.
std::string_view skip_comments(std::string_view s, char comment) {
  for (s = skip_blanks(s); s.starts_with(comment); s = skip_blanks(s)) {
    s.remove_prefix(std::min(s.find('\n'), s.size()));
  }
  return s;
}

/// Blocks between lines of -1, each with its number first.
bool is_universal(std::string_view head) {
  const std::string_view first = skip_blanks(head.substr(0, head.find('\n')));
  if (!first.starts_with("-1") || !skip_blanks(first.substr(2)).empty()) return false;
  const std::string_view second = skip_blanks(head.substr(std::min(head.find('\n'), head.size())));
  constexpr std::array<std::string_view, 5> kBlocks = {"151", "164", "2411", "2412", "2420"};
  return std::ranges::any_of(kBlocks, [&](std::string_view block) {
    return second.starts_with(block) && skip_blanks(second.substr(block.size(), 1)).empty();
  });
}

struct Known {
  std::string_view name;
  bool (*is)(std::string_view head);
  std::string_view advice = {};
};

// The Python package meshio reads these formats, and writes formats of temper.
constexpr std::string_view kMeshio = "; meshio converts it";
constexpr std::string_view kGmsh = ". Next: gmsh IN -save -format msh41 -o OUT";

constexpr Known kKnown[] = {
    {"a Fluent mesh",
     [](std::string_view h) {
       const std::string_view s = skip_blanks(h);
       return s.starts_with("(0 ") || s.starts_with("(1 ") || s.starts_with("(2 ") || s.starts_with("(10 ");
     },
     kMeshio},
    {"a Gmsh mesh of version 1", [](std::string_view h) { return skip_blanks(h).starts_with("$NOD"); }, kGmsh},
    {"a Gmsh mesh of another version than 2 and 4.1",
     [](std::string_view h) { return skip_blanks(h).starts_with("$MeshFormat"); }, kGmsh},
    {"a medit file in binary",
     [](std::string_view h) {
       return h.starts_with(std::string_view("\1\0\0\0", 4)) || h.starts_with(std::string_view("\0\0\0\1", 4));
     },
     kMeshio},
    {"an MFEM INLINE mesh, a recipe without points", [](std::string_view h) { return h.starts_with("MFEM INLINE"); },
     ". Next: load it in MFEM and save it as mesh v1.0, with Mesh::Save"},
    {"an MFEM mesh of another version than v1.0", [](std::string_view h) { return h.starts_with("MFEM "); },
     ". Next: in MFEM's mesh-explorer, c sets the order to 1 and V saves it as VTK"},
    {"a VTK XML file of another type than UnstructuredGrid",
     [](std::string_view h) { return h.find("<VTKFile") != std::string_view::npos; }},
    {"an XDMF file", [](std::string_view h) { return h.find("<Xdmf") != std::string_view::npos; }, kMeshio},
    {"a DOLFIN XML mesh", [](std::string_view h) { return h.find("<dolfin") != std::string_view::npos; }, kMeshio},
    {"an Abaqus input file",
     [](std::string_view h) {
       return starts_with_any_case(skip_blanks(h), "*HEADING") || starts_with_any_case(skip_blanks(h), "*NODE") ||
              h.starts_with("**");
     },
     kMeshio},
    {"an SU2 mesh", [](std::string_view h) { return skip_comments(h, '%').starts_with("NDIME="); }, kMeshio},
    {"a Nastran bulk data file", [](std::string_view h) { return h.find("BEGIN BULK") != std::string_view::npos; },
     kMeshio},
    {"a Tecplot file",
     [](std::string_view h) {
       const std::string_view s = skip_comments(h, '#');
       return (starts_with_any_case(s, "TITLE") || starts_with_any_case(s, "VARIABLES")) &&
              s.substr(0, s.find('\n')).find('=') != std::string_view::npos;
     },
     kMeshio},
    {"a Netgen mesh", [](std::string_view h) { return h.starts_with("mesh3d") || h.starts_with("areamesh"); }, kMeshio},
    {"a compressed file", [](std::string_view h) { return h.starts_with("\x1f\x8b") || h.starts_with("PK\3\4"); }},
    {"a dfsu file of DHI", [](std::string_view h) { return h.starts_with("DHI_DFS_"); },
     ". Next: mikeio.read(IN).geometry.to_mesh(OUT) in Python"},
    {"a CGNS file in ADF",
     [](std::string_view h) { return h.substr(0, 64).find("ADF Database") != std::string_view::npos; },
     ". Next: adf2hdf IN OUT, then meshio"},
    {"a universal file of I-DEAS", is_universal, kGmsh},
    {"an archive of Ansys (CDB)",
     [](std::string_view h) { return h.starts_with("/PREP7") || starts_with_any_case(h, "/COM,ANSYS"); },
     ". Next: mapdl_archive.Archive(IN).grid.save(OUT) in Python, where OUT ends with .vtu"},
    {"an OpenFOAM file", [](std::string_view h) { return h.find("FoamFile") != std::string_view::npos; },
     ". Next: foamToVTK"},
    {"a FreeFem mesh", is_freefem, ". Next: savemesh with a name that ends with .mesh writes medit"},
};

}  // namespace

std::string recognize_unsupported(std::string_view beginning) {
  const std::string_view head = beginning.substr(0, kSniffBytes);
  for (const Known& known : kKnown) {
    if (known.is(head)) return text(known.name, ", which temper does not read", known.advice);
  }
  return {};
}

}  // namespace temper::io

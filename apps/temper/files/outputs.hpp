// Outputs are checked before the work, so that an hour is not lost to a misspelled folder. They are written whole or
// not at all. When one fails, the message names the others that were written.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "options/options.hpp"

namespace temper::app {

struct MeshOutput {
  std::string path;  ///< empty: none
  io::WriteOptions options;
};
/// -o,--output, --format and --encoding. The output is not marked as required.
void add_mesh_output(Command& command, MeshOutput& target, const std::string& value_name,
                     const std::string& sentence = "Mesh file to write. Its suffix selects the format.");

/// The further files of a run, one of each kind. Empty: none.
struct FurtherOutputs {
  std::string report, page, history, trace, picture;
};
/// Adds --write, whose files are sorted by suffix. `kinds` are those of the verb.
struct OutputKind {
  std::string_view suffixes, what;  ///< ".svg .png .pdf", "picture"
  std::string FurtherOutputs::*path;
  CellKinds cells = CellKinds::all;  ///< cells of the meshes that have it
};
inline constexpr OutputKind kReportKind = {".json", "report", &FurtherOutputs::report},
                            kPageKind = {".html", "page", &FurtherOutputs::page, CellKinds::both},
                            kHistoryKind = {".csv", "history", &FurtherOutputs::history},
                            kTraceKind = {".jsonl", "trace", &FurtherOutputs::trace, CellKinds::triangles},
                            kPictureKind = {".svg .png .pdf", "picture", &FurtherOutputs::picture, CellKinds::both};
Option& add_write(Command& command, std::vector<std::string>& paths, std::span<const OutputKind> kinds);
/// ".svg" of "mesh.SVG".
[[nodiscard]] std::string suffix_of(const std::string& path);
/// Says whether one of the kinds has the suffix of the path.
[[nodiscard]] bool is_output_of(std::span<const OutputKind> kinds, const std::string& path);
/// Sorts the paths by suffix. Failure if a suffix is none of these, or occurs twice.
[[nodiscard]] FurtherOutputs sorted_outputs(std::string_view verb, const std::vector<std::string>& paths,
                                            std::span<const OutputKind> kinds);

class Outputs {
 public:
  explicit Outputs(std::string verb) : verb_(std::move(verb)) {}

  /// A mesh file in a format that temper writes. The file, and its companions (.node, .ele and .poly of Triangle), may
  /// not be another output, nor one of the files of `others`, which are inputs. If the mesh goes to standard output,
  /// later messages go to standard error.
  void expect_mesh(const MeshOutput& output, const std::vector<std::string>& others = {});
  /// Failure if the format has no place for the space or the cells of the mesh: before the work, not after it.
  /// Does nothing without an output.
  void expect_place(const MeshOutput& output, const io::MeshFile& file) const;
  /// A text file that must not be another output, or one of the files that these inputs are read from. An empty path
  /// means no output.
  void expect_text(const std::string& option, const std::string& path, const std::vector<std::string>& inputs);
  /// The files of --write.
  void expect(const FurtherOutputs& outputs, const std::vector<std::string>& inputs);
  /// A picture, whose suffix gives the format. It has the conditions of a text file.
  void expect_picture(const std::string& option, const std::string& path, const std::vector<std::string>& inputs);

  /// The warnings of writing.
  std::vector<std::string> write_mesh(const MeshOutput& output, const io::MeshFile& file, Executor* executor = nullptr);
  void write_text(const std::string& path, std::string_view text);
  void write_picture(const std::string& path, std::string_view svg);
  /// Text that is written piece by piece: opened before the work, put in its place after it.
  [[nodiscard]] io::TextStream open(const std::string& path) const;
  void commit(const std::string& path, io::TextStream& stream);

  [[nodiscard]] const std::vector<std::string>& written() const { return written_; }

 private:
  /// A file that will be written, of `option path`.
  struct Expectation {
    std::string option, path, file;
  };
  void expect(const std::string& option, const std::string& path, const std::vector<std::string>& files);
  [[noreturn]] void refuse(const std::string& option, const std::string& message) const;
  [[noreturn]] void fail(const InputError& error) const;

  std::string verb_;
  std::vector<Expectation> expected_;
  std::vector<std::string> written_;
};

/// Says whether two paths are the same file, by name or by inode.
[[nodiscard]] bool same_file(const std::string& a, const std::string& b);

/// The suffixes of pictures that can be written: ".svg", ".png" and ".pdf". A path without a suffix is SVG.
[[nodiscard]] bool is_picture_name(const std::string& path);

/// The bytes of the picture in the format of the path's suffix: PNG and PDF by rsvg-convert, of librsvg. PNG has two
/// pixels for each of the SVG's. Failure (bad input) when rsvg-convert is missing or fails.
[[nodiscard]] std::string picture_bytes(const std::string& path, std::string_view svg);

}  // namespace temper::app

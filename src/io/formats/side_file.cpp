// PATH.weights.csv: the weights of a mesh whose own format has no place for them.
//
//   point,weight
//   1,0.25          the file's own number of the point, and its weight: one row a point, in the order of the file
#include <cmath>
#include <cstring>

#include "io/disk/files.hpp"
#include "io/formats/format.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {

std::string side_file_path(const std::string& path) { return path + ".weights.csv"; }

void read_side_file(Document& document) {
  MeshFile& f = document.file;
  const std::string path = side_file_path(document.names->path);
  if (!f.weights.empty() || is_stream(document.names->path) || !exists(path)) return;
  Source source = load(path);
  // A comma is a blank here, so that the scanner finds its words.
  for (char& c : source.bytes) {
    if (c == ',' || c == ';') c = ' ';
  }
  Scanner scanner(path, source.bytes);
  for (const std::string_view title : {"point", "weight"}) {
    const std::string_view found = scanner.word("the title line 'point,weight'");
    if (found != title)
      scanner.fail_here(ErrorCode::syntax, text("expected the title line 'point,weight', found ", in_quotes(found)));
  }
  std::vector<double> weights;
  weights.reserve(f.points.size());
  for (std::size_t i = 0; i < f.points.size(); ++i) {
    const std::int64_t expected = document.names->points[static_cast<std::int64_t>(i)];
    if (scanner.at_end()) {
      scanner.fail_here(ErrorCode::size_mismatch,
                        text("has ", i, " weights, but ", document.names->path, " has ", f.points.size(), " points"));
    }
    const auto number = scanner.number<std::int64_t>("the number of a point");
    if (number != expected) {
      scanner.fail_here(ErrorCode::index_out_of_range,
                        text("expected the weight of point ", expected, ", found point ", number));
    }
    weights.push_back(scanner.real("a weight"));
    if (!std::isfinite(weights.back())) {
      scanner.fail_here(ErrorCode::not_finite,
                        text("point ", number, " has weight ", weights.back(), ", expected a finite number"));
    }
  }
  if (!scanner.at_end()) {
    scanner.fail_here(ErrorCode::size_mismatch,
                      text("has more weights than ", document.names->path, " has points (", f.points.size(), ")"));
  }
  f.weights = std::move(weights);
}

void write_side_file(const WriteJob& job) {
  const MeshFile& f = job.file;
  const std::string path = side_file_path(job.path);
  bool weighted = false;
  for (const double w : f.weights) weighted = weighted || w != 0 || std::signbit(w);
  if (is_stream(job.path)) {
    if (weighted)
      job.warn("the format has no place for weights, and no file can be beside a stream: they are left out");
    return;
  }
  // An old side file would give its weights to this mesh: it has to be replaced.
  if (!weighted && !exists(path)) return;
  Output& out = job.outputs.open(path);
  out.put("point,weight\n", "");
  for (std::size_t i = 0; i < f.points.size(); ++i) {
    out.put(job.row.details.first_point + static_cast<std::int64_t>(i), ',', f.weights.empty() ? 0.0 : f.weights[i],
            '\n');
  }
  job.warn(text("the format has no place for weights; they are in ", path));
}

}  // namespace temper::io

// The writers behind write_dec: one source file for each format.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/output.hpp"
#include "temper/dec_io.hpp"

namespace temper::io {

struct DecJob {
  const std::string& folder;
  const Mesh& mesh;
  const DecComplex& complex;
  const PowerCells& cells;
  const DecWriteOptions& options;
  OutputSet& outputs;
  std::vector<std::string>& written;

  /// A file of the folder.
  [[nodiscard]] Output& open(std::string_view name) const;
};

void write_dec_npz(const DecJob& job);
void write_dec_mtx(const DecJob& job);
void write_dec_vtu(const DecJob& job);

}  // namespace temper::io

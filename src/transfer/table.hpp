// The table of overlaps, from those that are found in one cell of the mesh after the other. The same for triangles and
// tetrahedra.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "temper/detail/transfer.hpp"

namespace temper {

/// An overlap of a new cell with a former one.
struct FoundOverlap {
  std::uint32_t now = 0;
  CellShare share;
  std::int32_t region = 0;
};

/// What one block of the mesh has found.
struct FoundInBlock {
  std::vector<CellPart> parts;
  std::vector<FoundOverlap> overlaps;

  void add(std::uint32_t cell, std::int32_t region, double size) { parts.push_back({cell, region, size}); }
  /// Adds to the overlaps found since `first`, which are few.
  void add(std::size_t first, const FoundOverlap& found) {
    for (std::size_t i = first; i < overlaps.size(); ++i) {
      FoundOverlap& known = overlaps[i];
      if (known.now != found.now || known.share.former != found.share.former) continue;
      known.share.size += found.share.size;
      return;
    }
    overlaps.push_back(found);
  }
};

/// Sorts what blocks have found by cell, in the order of the blocks: by counting.
template <class Item, class CellOf>
std::vector<Item> by_cell(std::size_t n_cells, const std::vector<std::vector<Item>*>& blocks, const CellOf& cell_of) {
  std::vector<std::size_t> next(n_cells + 1, 0);
  for (const std::vector<Item>* block : blocks) {
    for (const Item& item : *block) ++next[cell_of(item) + 1];
  }
  for (std::size_t c = 0; c < n_cells; ++c) next[c + 1] += next[c];
  std::vector<Item> sorted(next[n_cells]);
  for (std::vector<Item>* block : blocks) {
    for (const Item& item : *block) sorted[next[cell_of(item)]++] = item;
    std::vector<Item>().swap(*block);
  }
  return sorted;
}

/// Joins the pieces of a cell in one region.
[[nodiscard]] std::vector<CellPart> joined_parts(std::size_t n_cells, std::vector<FoundInBlock>& blocks);
/// Fills the parts and shares of a table. Every cell must have been found in some overlap.
void fill_table(CellOverlaps& table, std::vector<FoundInBlock>& blocks);

}  // namespace temper

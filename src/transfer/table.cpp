#include "transfer/table.hpp"

#include "base/assert.hpp"

namespace temper {
namespace {

template <class Item, class Key, class Join>
void sort_and_join(std::vector<Item>& items, const Key& key, const Join& join) {
  std::stable_sort(items.begin(), items.end(), [&](const Item& a, const Item& b) { return key(a) < key(b); });
  std::size_t n = 0;
  for (const Item& item : items) {
    if (n > 0 && key(items[n - 1]) == key(item))
      join(items[n - 1], item);
    else
      items[n++] = item;
  }
  items.resize(n);
}

/// Sorts and joins each run of items with one cell. They are few, so that this is linear.
template <class Item, class CellOf, class Key, class Join>
std::vector<Item> joined(const std::vector<Item>& items, const CellOf& cell_of, const Key& key, const Join& join) {
  std::vector<Item> all, here;
  for (std::size_t i = 0; i < items.size();) {
    here.clear();
    const std::uint32_t cell = cell_of(items[i]);
    for (; i < items.size() && cell_of(items[i]) == cell; ++i) here.push_back(items[i]);
    sort_and_join(here, key, join);
    all.insert(all.end(), here.begin(), here.end());
  }
  return all;
}

std::vector<FoundOverlap> joined_overlaps(std::size_t n_cells, std::vector<FoundInBlock>& blocks) {
  std::vector<std::vector<FoundOverlap>*> of_blocks;
  of_blocks.reserve(blocks.size());
  for (FoundInBlock& block : blocks) of_blocks.push_back(&block.overlaps);
  const auto cell_of = [](const FoundOverlap& found) { return found.now; };
  return joined(
      by_cell(n_cells, of_blocks, cell_of), cell_of,
      [](const FoundOverlap& found) { return std::tuple(found.region, found.share.former); },
      [](FoundOverlap& to, const FoundOverlap& from) { to.share.size += from.share.size; });
}

}  // namespace

std::vector<CellPart> joined_parts(std::size_t n_cells, std::vector<FoundInBlock>& blocks) {
  std::vector<std::vector<CellPart>*> of_blocks;
  of_blocks.reserve(blocks.size());
  for (FoundInBlock& block : blocks) of_blocks.push_back(&block.parts);
  const auto cell_of = [](const CellPart& part) { return part.cell; };
  return joined(
      by_cell(n_cells, of_blocks, cell_of), cell_of, [](const CellPart& part) { return part.region; },
      [](CellPart& to, const CellPart& from) { to.size += from.size; });
}

void fill_table(CellOverlaps& table, std::vector<FoundInBlock>& blocks) {
  table.parts = joined_parts(table.n_cells, blocks);
  const std::vector<FoundOverlap> found = joined_overlaps(table.n_cells, blocks);
  table.shares.reserve(found.size());
  table.starts.reserve(table.parts.size() + 1);
  std::size_t i = 0;
  for (const CellPart& part : table.parts) {
    table.starts.push_back(table.shares.size());
    for (; i < found.size() && found[i].now == part.cell && found[i].region == part.region; ++i)
      table.shares.push_back(found[i].share);
    TEMPER_ASSERT(table.shares.size() > table.starts.back());
  }
  table.starts.push_back(table.shares.size());
  TEMPER_ASSERT(i == found.size());
}

}  // namespace temper

#include "base/supernodes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/instruction_set_choice.hpp"

namespace temper {
namespace {

constexpr int kNone = -1;

/// The entries below the diagonal, row by row in the order of elimination.
struct Rows {
  std::vector<int> starts, columns;

  Rows(const std::vector<int>& place, std::span<const SupernodalCholesky::Entry> entries) : starts(place.size() + 1) {
    const auto places_of = [&](const SupernodalCholesky::Entry& e) {
      return std::minmax(place[static_cast<std::size_t>(e.row)], place[static_cast<std::size_t>(e.column)]);
    };
    for (const auto& e : entries) {
      const auto [column, row] = std::pair<int, int>(places_of(e));
      if (row != column) ++starts[static_cast<std::size_t>(row) + 1];
    }
    for (std::size_t i = 0; i < place.size(); ++i) starts[i + 1] += starts[i];
    columns.resize(static_cast<std::size_t>(starts.back()));
    std::vector<int> next(starts.begin(), starts.end() - 1);
    for (const auto& e : entries) {
      const auto [column, row] = std::pair<int, int>(places_of(e));
      if (row != column) columns[static_cast<std::size_t>(next[static_cast<std::size_t>(row)]++)] = column;
    }
  }
  [[nodiscard]] std::span<const int> of(int row) const {
    const auto i = static_cast<std::size_t>(row);
    return std::span(columns).subspan(static_cast<std::size_t>(starts[i]),
                                      static_cast<std::size_t>(starts[i + 1] - starts[i]));
  }
  [[nodiscard]] int n() const { return static_cast<int>(starts.size()) - 1; }
};

int& at(std::vector<int>& values, int i) { return values[static_cast<std::size_t>(i)]; }
int at(const std::vector<int>& values, int i) { return values[static_cast<std::size_t>(i)]; }

/// The elimination tree: the first row below the diagonal in each column of L, or kNone (Liu 1990).
std::vector<int> elimination_tree(const Rows& rows) {
  std::vector<int> parent(static_cast<std::size_t>(rows.n()), kNone), ancestor = parent;
  for (int i = 0; i < rows.n(); ++i) {
    for (int k : rows.of(i)) {
      while (k != kNone && k < i) {
        const int up = std::exchange(at(ancestor, k), i);
        if (up == kNone) at(parent, k) = i;
        k = up;
      }
    }
  }
  return parent;
}

/// The place of each column if children come right before their parents.
std::vector<int> postorder(const std::vector<int>& parent) {
  const int n = static_cast<int>(parent.size());
  std::vector<int> first(parent.size(), kNone), next = first, place = first, stack;
  for (int i = n; i-- > 0;) {
    if (at(parent, i) != kNone) at(next, i) = std::exchange(at(first, at(parent, i)), i);
  }
  int number = 0;
  for (int root = 0; root < n; ++root) {
    if (at(parent, root) == kNone) stack.push_back(root);
    while (!stack.empty()) {
      const int child = std::exchange(at(first, stack.back()), kNone);
      if (child == kNone) {
        at(place, stack.back()) = number++;
        stack.pop_back();
        continue;
      }
      at(first, stack.back()) = at(next, child);
      stack.push_back(child);
    }
  }
  return place;
}

/// Numbers of entries in each column of L.
std::vector<int> column_counts(const Rows& rows, const std::vector<int>& parent) {
  std::vector<int> count(parent.size(), 1), seen(parent.size(), kNone);
  for (int i = 0; i < rows.n(); ++i) {
    at(seen, i) = i;
    for (int k : rows.of(i)) {
      for (; at(seen, k) != i; k = at(parent, k)) at(seen, k) = i, ++at(count, k);
    }
  }
  return count;
}

/// Says whether zeros in wider panels cost less than they save.
bool pays(std::size_t columns, double zeros, double all) {
  if (columns <= 4) return true;
  return zeros < all * (columns <= 16 ? 0.5 : columns <= 48 ? 0.1 : 0.05);
}

}  // namespace

void SupernodalCholesky::analyze(std::vector<int> place, std::span<const Entry> entries) {
  place_ = std::move(place);
  const std::vector<int> post = postorder(elimination_tree(Rows(place_, entries)));
  for (int& p : place_) p = at(post, p);
  const Rows rows(place_, entries);
  const std::vector<int> parent = elimination_tree(rows);
  find_supernodes(parent, column_counts(rows, parent));
  find_rows(rows.starts, rows.columns);
  where_.assign(place_.size(), 0);
  slots_.clear();
  for (const Entry& e : entries) {
    const auto [column, row] = std::pair<int, int>(std::minmax(at(place_, e.row), at(place_, e.column)));
    const Supernode& s = supernodes_[static_cast<std::size_t>(at(supernode_of_, column))];
    const auto first = rows_.begin() + static_cast<std::ptrdiff_t>(s.rows_at);
    const auto found = std::lower_bound(first, first + static_cast<std::ptrdiff_t>(s.rows), row);
    slots_.push_back(s.values_at + static_cast<std::size_t>(column - s.first) * s.rows +
                     static_cast<std::size_t>(found - first));
  }
}

/// Joins columns with the same rows, and supernodes with their parents where this pays.
void SupernodalCholesky::find_supernodes(const std::vector<int>& parent, const std::vector<int>& count) {
  const int n = static_cast<int>(parent.size());
  supernodes_.clear();
  std::vector<double> zeros;
  for (int j = 0; j < n;) {
    int end = j + 1;
    while (end < n && at(parent, end - 1) == end && at(count, end) == at(count, end - 1) - 1) ++end;
    Supernode s = {j, static_cast<std::size_t>(end - j), 0, static_cast<std::size_t>(at(count, j)), 0};
    double of_s = 0;
    while (!supernodes_.empty()) {
      const Supernode& last = supernodes_.back();
      const int up = at(parent, s.first - 1);
      if (up == kNone || up >= end) break;
      const std::size_t columns = last.columns + s.columns, n_rows = last.columns + s.rows;
      const double joined = zeros.back() + of_s + static_cast<double>(last.columns * (n_rows - last.rows));
      if (!pays(columns, joined, static_cast<double>(columns * n_rows))) break;
      s = {last.first, columns, 0, n_rows, 0};
      of_s = joined;
      supernodes_.pop_back();
      zeros.pop_back();
    }
    supernodes_.push_back(s);
    zeros.push_back(of_s);
    j = end;
  }
  supernode_of_.assign(parent.size(), 0);
  for (std::size_t i = 0; i < supernodes_.size(); ++i) {
    const auto first = supernode_of_.begin() + supernodes_[i].first;
    std::fill(first, first + static_cast<std::ptrdiff_t>(supernodes_[i].columns), static_cast<int>(i));
  }
}

/// A supernode has the rows of its own columns, rows of the matrix below them, and rows of its children.
void SupernodalCholesky::find_rows(const std::vector<int>& starts, const std::vector<int>& columns) {
  std::vector<std::vector<int>> below(supernodes_.size()), children(supernodes_.size());
  for (int row = 0; row + 1 < static_cast<int>(starts.size()); ++row) {
    for (int k = at(starts, row); k < at(starts, row + 1); ++k) {
      std::vector<int>& list = below[static_cast<std::size_t>(at(supernode_of_, at(columns, k)))];
      if (list.empty() || list.back() != row) list.push_back(row);
    }
  }
  rows_.clear();
  std::size_t values = 0;
  for (std::size_t i = 0; i < supernodes_.size(); ++i) {
    Supernode& s = supernodes_[i];
    const int end = s.first + static_cast<int>(s.columns);
    std::vector<int>& rows = below[i];
    for (const int c : children[i]) {
      const Supernode& child = supernodes_[static_cast<std::size_t>(c)];
      const auto first = rows_.begin() + static_cast<std::ptrdiff_t>(child.rows_at);
      rows.insert(rows.end(), first + static_cast<std::ptrdiff_t>(child.columns),
                  first + static_cast<std::ptrdiff_t>(child.rows));
    }
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    rows.erase(rows.begin(), std::lower_bound(rows.begin(), rows.end(), end));
    s.rows_at = rows_.size(), s.rows = s.columns + rows.size(), s.values_at = values;
    for (int j = s.first; j < end; ++j) rows_.push_back(j);
    rows_.insert(rows_.end(), rows.begin(), rows.end());
    if (!rows.empty())
      children[static_cast<std::size_t>(at(supernode_of_, rows.front()))].push_back(static_cast<int>(i));
    rows = {};
    values += s.rows * s.columns;
  }
  values_.assign(values + kLanes, 0.0);
}

bool SupernodalCholesky::factor(std::span<const double> values, double shift) {
  std::fill(values_.begin(), values_.end(), 0.0);
  for (std::size_t i = 0; i < slots_.size(); ++i) values_[slots_[i]] += values[i];
  // Panels that have rows among the columns of a supernode, and the first such row of each.
  std::vector<int> list(supernodes_.size(), kNone), next = list;
  std::vector<std::size_t> begin(supernodes_.size());
  const auto wait = [&](int i, std::size_t row) {
    const Supernode& s = supernodes_[static_cast<std::size_t>(i)];
    if (row == s.rows) return;
    begin[static_cast<std::size_t>(i)] = row;
    at(next, i) = std::exchange(at(list, at(supernode_of_, rows_[s.rows_at + row])), i);
  };
  for (int i = 0; i < static_cast<int>(supernodes_.size()); ++i) {
    const Supernode& s = supernodes_[static_cast<std::size_t>(i)];
    for (std::size_t j = 0; j < s.columns; ++j) values_[s.values_at + j * (s.rows + 1)] += shift;
    for (std::size_t k = 0; k < s.rows; ++k) at(where_, rows_[s.rows_at + k]) = static_cast<int>(k);
    for (int d = at(list, i), then = kNone; d != kNone; d = then) {
      then = at(next, d);
      const Supernode& from = supernodes_[static_cast<std::size_t>(d)];
      const std::size_t first = begin[static_cast<std::size_t>(d)];
      std::size_t last = first;
      while (last < from.rows && rows_[from.rows_at + last] < s.first + static_cast<int>(s.columns)) ++last;
      subtract_products(s, from, first, last);
      wait(d, last);
    }
    if (!factor_panel(s)) return false;
    wait(i, s.columns);
  }
  return true;
}

/// From the columns that are rows `first` to `last` of an earlier panel.
void SupernodalCholesky::subtract_products(const Supernode& to, const Supernode& from, std::size_t first,
                                           std::size_t last) {
  const std::size_t m = from.rows - first, apart = padded(m);
  if (products_.size() < apart * (last - first)) products_.resize(apart * (last - first));
  TEMPER_IN_USE(kPanelKernels)
      ->product(&values_[from.values_at + first], from.rows, m, last - first, from.columns, products_.data());
  const int* const numbers = &rows_[from.rows_at + first];
  for (std::size_t j = 0; j < last - first; ++j) {
    double* const column = &values_[to.values_at + static_cast<std::size_t>(numbers[j] - to.first) * to.rows];
    const double* const product = &products_[j * apart];
    for (std::size_t i = j; i < m; ++i) column[at(where_, numbers[i])] -= product[i];
  }
}

/// A few columns at once, after the products of those before them.
bool SupernodalCholesky::factor_panel(const Supernode& s) {
  constexpr std::size_t kColumns = 8;
  for (std::size_t begin = 0; begin < s.columns; begin += kColumns) {
    const std::size_t end = std::min(begin + kColumns, s.columns), m = s.rows - begin, apart = padded(m);
    const auto column = [&](std::size_t j) { return &values_[s.values_at + j * s.rows]; };
    if (begin > 0) {
      if (products_.size() < apart * kColumns) products_.resize(apart * kColumns);
      TEMPER_IN_USE(kPanelKernels)->product(column(0) + begin, s.rows, m, end - begin, begin, products_.data());
      for (std::size_t j = begin; j < end; ++j) {
        const double* const product = &products_[(j - begin) * apart];
        for (std::size_t i = j; i < s.rows; ++i) column(j)[i] -= product[i - begin];
      }
    }
    for (std::size_t j = begin; j < end; ++j) {
      double* const own = column(j);
      for (std::size_t k = begin; k < j; ++k) {
        const double* const before = column(k);
        const double factor = before[j];
        for (std::size_t i = j; i < s.rows; ++i) own[i] -= factor * before[i];
      }
      if (!(own[j] > 0)) return false;
      own[j] = std::sqrt(own[j]);
      const double inverse = 1 / own[j];
      for (std::size_t i = j + 1; i < s.rows; ++i) own[i] *= inverse;
    }
  }
  return true;
}

void SupernodalCholesky::solve(std::span<double> x) const {
  const PanelKernels& kernels = *TEMPER_IN_USE(kPanelKernels);
  std::vector<double> in_order(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) in_order[place(i)] = x[i];
  for (const Supernode& s : supernodes_) kernels.forward(panel(s), in_order.data());
  for (std::size_t i = supernodes_.size(); i-- > 0;) kernels.backward(panel(supernodes_[i]), in_order.data());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = in_order[place(i)];
}

void SupernodalCholesky::solve_lanes(double* x) const {
  const PanelKernels& kernels = *TEMPER_IN_USE(kPanelKernels);
  for (const Supernode& s : supernodes_) kernels.forward_lanes(panel(s), x);
  for (std::size_t i = supernodes_.size(); i-- > 0;) kernels.backward_lanes(panel(supernodes_[i]), x);
}

}  // namespace temper
